/* Judges the forces of a device against the promises of docs/safety.md, in the device's axes. It gets
 * the game's calls and every force; it shares no code with the library. SPDX-License-Identifier: MIT */
#ifndef KNURL_CONFORM_JUDGE_H
#define KNURL_CONFORM_JUDGE_H

#include <knurl/knurl.h>

/* Code, name, sentence. Those up to CLOSED are checked at each force, the others by the trial. */
#define JUDGE_PROMISES(X)                                                                                              \
    X(FINITE, "finite", "Every force is a number.")                                                                    \
    X(BOUNDED, "bounded", "No force is above the device's max_force.")                                                 \
    X(SLEW, "slew",                                                                                                    \
      "The force grows from zero to max_force in 5 ms at the fastest, whatever turns: only a texture's and a "         \
      "vibration's own steps are faster, and a falling force.")                                                        \
    X(SQUEEZED, "squeezed", "If surfaces close over the hand and release it, the force falls no faster.")              \
    X(HEAT, "heat", "The motors never get warmer than continuous_force makes them in the long run.")                   \
    X(RAMP, "ramp", "After a halt, a fault or a pause the force comes back by the ramp.")                              \
    X(HALTED, "halted", "The first force after a halt is zero.")                                                       \
    X(ABSENT, "absent", "Without a valid position the force is zero.")                                                 \
    X(PAUSED, "paused", "In a pause the force is zero once its ramp is over.")                                         \
    X(MUTED, "muted", "With a gain of 0 the force is zero once the ramp is over.")                                     \
    X(TOLD, "told", "The force that a tick reports is the force that the device gets.")                                \
    X(ENDED, "ended", "When a loop has ended its device has no force.")                                                \
    X(CLOSED, "closed", "When knurl_device_close() returns the force is zero, and it stays zero.")                     \
    X(SILENCED, "silenced", "Motors have no force soon after a pause, a gain of 0, a fault or an end.")                \
    X(REPORTED, "reported", "Each fault is an event.")                                                                 \
    X(ALIVE, "alive", "When all is well again the force comes back.")                                                  \
    X(ANSWERS, "answers", "The device gives finite positions without gaps or jumps, and results that it may give.")

enum {
#define JUDGE_ENUMERATOR(code, name, sentence) JUDGE_##code,
    JUDGE_PROMISES(JUDGE_ENUMERATOR)
#undef JUDGE_ENUMERATOR
        JUDGE_COUNT
};

typedef struct judge_promise {
    const char *name;
    const char *sentence;
} judge_promise;

extern const judge_promise judge_promises[JUDGE_COUNT];

/* How a promise was broken. */
typedef struct judge_breach {
    uint64_t count;    /* forces */
    uint64_t seed;     /* of the first */
    uint64_t tick;     /* its force, counted from the trial's start */
    double worst;      /* N beyond what is allowed */
    const char *after; /* the game's last call before the first; static */
} judge_breach;

#define JUDGE_SURFACES 32

/* The judge's copy of a surface's material and contact. */
typedef struct judge_surface {
    knurl_surface_id id; /* 0: none */
    double stiffness;    /* N/m, at most */
    double crest;        /* m: the greatest height since it was added */
    int touched;         /* at the last tick */
} judge_surface;

typedef struct judge {
    /* the device and its HIP */
    double max_force;  /* N */
    double continuous; /* N */
    double cooling;    /* share of the way to its final value that heat goes in a tick */
    double slew;       /* N a tick */
    double ramp;       /* ticks from full force to zero */
    double rate;       /* Hz */
    int slack;         /* ticks by which haptic thread and game may differ; 0: the loop is stepped */
    int sees_writes;   /* 1: judge_write() is called by the device's own write() */
    uint64_t seed;
    const char *after; /* the game's last call */
    int lock;

    /* the game's state */
    int paused, halted, absent, ending, closed, edited;
    double gain;
    judge_surface surfaces[JUDGE_SURFACES];
    knurl_wave wave;
    uint64_t wave_tick, wave_ticks;

    /* limits */
    double loop_gain, game_gain; /* by the ramp */
    double cap;                  /* share of max_force, of this tick */
    int reset;                   /* 1: the force comes from zero */
    double paused_ticks, muted_ticks;
    double theta; /* heat */

    /* forces seen */
    double previous[3], force[3]; /* N; the last judged force, and the present one */
    int pending;                  /* `force` was written, its step is not judged yet */
    double height, wave_value;
    knurl_surface_id deepest;
    uint64_t tick; /* of the scene's */
    int has_tick;
    uint64_t forces, ticks, contacts, squeezed_ticks; /* counts */
    uint64_t faults[64];                              /* events, by code */
    judge_breach breaches[JUDGE_COUNT];
} judge;

/* Starts a trial, with its own device and loop. Breaches and counts stay. ramp_s: the loop's. slew_rate: the HIP's,
 * N/s, or KNURL_DEFAULT. */
void judge_begin(judge *j, const knurl_device_info *info, double rate_hz, double ramp_s, double slew_rate);

/* Another loop on the same device: gains and contacts start again, heat continues. */
void judge_begin_loop(judge *j, double ramp_s);

/* A force reaches the device. */
void judge_write(judge *j, const double force[3]);

/* A force reaches a device whose writes belong to no tick: each is judged by itself. */
void judge_look(judge *j, const double force[3]);

/* The tick that made that force; call it after judge_write(). */
void judge_tick(judge *j, const knurl_tick_output *output, const knurl_hip_contact *contacts, uint32_t count);

/* A tick that was not judged: the next one's change is unknown. */
void judge_pass_over(judge *j, const knurl_tick_output *output);

/* The device could not be read for that many cycles, and got no force. */
void judge_miss(judge *j, uint64_t cycles);

/* A surface was added, or its material changed. */
void judge_surface_is(judge *j, knurl_surface_id id, const knurl_material_desc *material);
void judge_surface_gone(judge *j, knurl_surface_id id);

/* Surfaces or the workspace moved: gratings may restart. */
void judge_edits(judge *j);

void judge_vibrate(judge *j, int32_t method, double frequency_hz, double amplitude, double seconds);

/* Null: not found. id 0: a free place. */
judge_surface *judge_find_surface(judge *j, knurl_surface_id id);

/* N: the change of force that textures in contact and the vibration may cause in this tick (judge_steps.c). */
double judge_texture_steps(judge *j, const knurl_tick_output *output, const knurl_hip_contact *contacts,
                           uint32_t count);
double judge_wave_step(judge *j);

/* Gratings restart. */
void judge_forget_contacts(judge *j);

/* Records that `promise` is broken unless the last force is zero. */
void judge_expect_zero(judge *j, int promise);

/* Records a broken promise and its excess, N. */
void judge_breaks(judge *j, int promise, double excess);

/* The lock of haptic thread and game: the game waits, the haptic thread does not (returns 0). */
void judge_wait(judge *j);
int judge_try(judge *j);
void judge_leave(judge *j);

#endif
