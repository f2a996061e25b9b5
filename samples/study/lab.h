/* The stability laboratory: a simulated device in a simulated hand against a wall or a grating, tick by tick, and a
 * verdict from the signals. "Height" below is the true position's distance from the surface along the wall's normal: m,
 * negative inside; of a wavy wall, from the waves themselves.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_STUDY_LAB_H
#define KNURL_STUDY_LAB_H

#include <knurl/knurl.h>

#include <stddef.h>

/** A hand that holds a device: a spring, a damper and a mass. */
typedef struct lab_grip {
    const char *name;
    double stiffness; /**< N/m */
    double damping;   /**< N s/m */
    double mass;      /**< kg */
} lab_grip;

/** "none", "loose", "light", "medium", "firm", ended by a null name (sources: lab_run.c). */
extern const lab_grip lab_grips[];

/** Null: unknown name. */
const lab_grip *lab_grip_named(const char *name);

/** Walls (lab_wall.h). */
enum { LAB_PLANE = 0, LAB_FACETS = 1, LAB_SMOOTH = 2 };

/** A case to run. lab_case_init() fills in the defaults. */
typedef struct lab_case {
    const char *device;   /**< the keys after "fake:?"; default "preset=touch". Unless given, the tremor is off and the
                             workspace 4 m wide */
    const lab_grip *grip; /**< default "light" */
    double rate;          /**< Hz; default 1000 */
    double settle;    /**< s between the hand's contact and the judged part; default 0.25. S2 plays an event that starts
                         near rest to its end: up to 2 s on 2 mm */
    double seconds;   /**< judged; default 0.75 */
    double press;     /**< N that the hand presses with at rest; default 1 */
    double approach;  /**< m/s at which the hand crosses the surface; default 0.05; 0: it starts 5 mm above */
    double speed;     /**< m/s along the surface; 0 (default): no motion along it */
    double stiffness; /**< K: N/m; default 400 */
    double damping;   /**< B: N s/m; default 0 */
    double amplitude; /**< A: m; default 0: a flat wall */
    double period;    /**< m; default 0.002 */
    int32_t method;   /**< KNURL_METHOD_S1, ... */
    uint32_t without; /**< KNURL_PROTECT_; default all: raw */
    int32_t bilateral; /**< 1: the lab's own law F = -K x - B (x - x one tick ago)/T instead of a scene's wall */
    int32_t effect;    /**< KNURL_EFFECT_ at height 0 with K, B and the period as spacing, instead of a wall; or 0 */
    int32_t wall;      /**< LAB_PLANE (default), LAB_FACETS, LAB_SMOOTH */
} lab_case;

/** Recorded signals, one value per tick. Zero it first; the arrays are reused from run to run; lab_signals_free(). */
typedef struct lab_signals {
    size_t count, capacity;
    size_t judged;     /**< from this tick on: the transient of the hand's contact has decayed */
    double *height;    /**< m */
    double *measured;  /**< m: the same, by the encoders */
    double *motor;     /**< N: the force that acted along the normal over the tick that ends here */
    double *written;   /**< N: the force along the normal requested by this tick */
    double *texture;   /**< H: m */
    double *reference; /**< m: the height of the same device and hand without delay, quantum and dry friction, on a
                          continuous-time wall that follows the same H */
    double *reference_force; /**< N: on it */
    int64_t *event;
    uint32_t *flags; /**< of the tick */
} lab_signals;

/** Outcomes of a run. */
enum {
    LAB_REST = 0,        /**< nothing felt but the press */
    LAB_VIBRATION = 1,   /**< bounded, as requested by the texture */
    LAB_LIMIT_CYCLE = 2, /**< bounded, and felt beyond the texture: "aliveness", buzzing */
    LAB_UNSTABLE = 3     /**< a runaway: it grows, or swings between the force limit and the loss of contact */
};

typedef struct lab_result {
    int outcome;             /**< LAB_ */
    double energy;           /**< J: maximum of the motors' net work on the hand */
    double unauthorised;     /**< J: the same without the texture's work */
    double activity_force;   /**< N rms: the acting force, 20 to 500 Hz, beyond the reference */
    double activity_motion;  /**< m rms: the same of the position */
    double activity;         /**< the motion's, in detection thresholds (lab_threshold()), root of sum of squares */
    double felt;             /**< all of the motion, in detection thresholds */
    double asked;            /**< the reference's motion, in detection thresholds */
    double bangs;            /**< swings between the force limit and no contact, while judged */
    double reference_bangs;  /**< the same of the reference */
    double swing;            /**< m from the lowest to the highest position, while judged */
    double reference_swing;  /**< m */
    double growth;           /**< rms about the mean of the last third over that of the first, while judged */
    double reference_growth; /**< the same of the reference */
    double force_max;        /**< N, of the acting force */
    double guarded_ticks;    /**< ticks in which a protection took effect */
} lab_result;

void lab_case_init(lab_case *c);

/** Runs it. 0, or 1 with the library's message. */
int lab_run(const lab_case *c, lab_signals *signals, lab_result *result);

void lab_signals_free(lab_signals *signals);

/** Finds the outcome and its numbers from recorded signals (lab_judge.c). max_force: N. 0, or 1 if memory runs out. */
int lab_judge(const lab_case *c, const lab_signals *signals, double max_force, lab_result *result);

/** Computes the energies: the work of the motors and of the texture (lab_judge.c). */
void lab_energies(const lab_case *c, const lab_signals *signals, lab_result *result);

/** m rms at which a vibration of a held tool is just felt: 0.2 um at 250 Hz, more below and above. */
double lab_threshold(double hz);

/** "rest", "vibration", "limit cycle", "unstable". */
const char *lab_outcome_name(int outcome);

#endif
