/* knurl verify: a table of short steps that a person and a device go through. A step asks the person for something,
 * plays forces in some, and adds findings: expected, measured, verdict. SPDX-License-Identifier: MIT */
#ifndef KNURL_VERIFY_H
#define KNURL_VERIFY_H

#include "sweep.h"

#include <knurl/loop.h>

#include <stdio.h>

#define VERIFY_RATE     1000.0 /* Hz */
#define VERIFY_FORCE    1.0    /* N: the most that is sent, unless a mass is weighed */
#define VERIFY_WEIGHING 3.0    /* N: the same while a mass is weighed */
#define VERIFY_ROWS     16000  /* ticks that are kept */
#define VERIFY_LAST_HZ  300.0  /* Hz: up to here --response needs a response */
#define VERIFY_FINDINGS 48

/** The fake device's hand, and so that of predictions. N/m and N s/m */
#define VERIFY_HAND_STIFFNESS 700.0
#define VERIFY_HAND_DAMPING   5.0
#define VERIFY_HAND           "a hand of 700 N/m and 5 N s/m"

enum { VERIFY_PASS, VERIFY_FAIL, VERIFY_NOT_MEASURED };

typedef struct verify_finding {
    const char *step, *what, *unit;
    double least, most, measured; /* expected from least to most */
    const char *source;           /* of the expectation */
    int verdict;
    char note[256]; /* if it failed: the meaning; if it was not measured: the reason */
} verify_finding;

/** Requests to a person. The last four come while a loop runs, so they do not wait for Enter. */
typedef enum verify_wish {
    VERIFY_HOLD,
    VERIFY_LET_GO,
    VERIFY_RIGHT,
    VERIFY_UP,
    VERIFY_TOWARDS,
    VERIFY_PRESS,
    VERIFY_TURN,
    VERIFY_HANG,
    VERIFY_PULL,
    VERIFY_PLUG,
    VERIFY_STOP,
    VERIFY_GO
} verify_wish;

typedef struct verify verify;

/** Who holds the device. */
typedef struct verify_person {
    /** Says the sentence. 0 once it can begin, 1: to be left out. */
    int (*ask)(verify *v, verify_wish wish, const char *sentence);
    /** A simulated person's motions and forces, in place of a person's; null for a person. [haptic thread] */
    void (*move)(verify *v, knurl_device_sample *sample);
    void (*push)(verify *v, double force[3]);
} verify_person;

typedef struct verify_row {
    double position[3], orientation[4];
    uint32_t buttons;
} verify_row;

/** Adds to the force of a tick, v->count - 1 being its row. [haptic thread] */
typedef void verify_shape(verify *v, uint64_t tick, double force[3]);

struct verify {
    knurl_device *device;
    const verify_person *person; /* null: nobody, for a prediction */
    void *hand;                  /* the person's own */
    volatile sig_atomic_t *interrupted;
    double (*seconds)(void); /* a clock; null: time is simulated, and not judged */
    int simulated;           /* 1: loops are stepped on this thread */
    double mass;             /* kg: of --mass; NAN: not given */
    const char *response_path;
    const char *only, *skip; /* names with commas in between; null: not given */
    FILE *stream;            /* findings are printed there as they come; or null */

    knurl_device_info info;
    double newtons;         /* VERIFY_FORCE, or less if the device can hold less */
    int is_awake;           /* 1: its driver has had the forces to check its motors with */
    double limit;           /* N: of every force; `newtons`, or more while a mass is weighed */
    double scale;           /* N for each N that is sent, if it was measured; else 1 */
    const char *is_unclear; /* null, or why a latency would tell nothing: noise, or a joint that sticks */
    const char *is_wrong;   /* null, or why no further step may push: motors that are backwards or swapped */

    /* of the present step */
    const struct verify_step *step;
    knurl_loop *loop;
    verify_shape *shape;
    int axis;
    double state[16]; /* the shape's own */
    struct weighing *weighing;
    verify_row *rows;
    uint64_t count;  /* of rows */
    double times[2]; /* s: of the first and the last tick */
    knurl_loop_stats stats;
    int32_t fault;   /* that ended it; 0: no fault */
    const char *why; /* the last verify_play() ended early; or null */

    verify_finding findings[VERIFY_FINDINGS];
    int finding_count;
    sweep response; /* no rows: not measured */
};

/** A step: null, or why it was not measured. */
typedef struct verify_step {
    const char *name, *title;
    int has_force;
    const char *(*run)(verify *v);
} verify_step;

extern const verify_step verify_steps[]; /* ended by a null name */

/** The rest of a list of steps' names from the first unknown one on, or null. */
const char *verify_unknown(const char *names);

/** 1: --only and --skip leave no step. */
int verify_is_empty(const verify *v);

/** Runs all steps that are wanted. Returns 0, or 1: no memory, or the device has no properties. */
int verify_run(verify *v);

int verify_count(const verify *v, int verdict);
extern const char *const verify_verdicts[]; /* "pass", "FAIL", "not measured" */

/** "0.7 to 1", "500 or more"; "" if nothing is expected. */
void verify_range_text(const verify_finding *f, char *text, size_t size);

/** Plays a shape (null: no force) for so long. Returns null, or why it did not get to the end. */
const char *verify_play(verify *v, double seconds, verify_shape *shape);

/** The same number from a fake device with this one's mass, friction, resolution and delay, in the laboratory's hand.
 */
double verify_predict(const verify *v, double (*measure)(verify *v));

/** Opens a device; a fake one's hand holds still. */
knurl_result verify_open(const char *uri, knurl_device **device);

/** Measures and predicts the same, unless there is a reason why not. Null, or why not. */
const char *verify_compare(verify *v, const char *why, double (*measure)(verify *v), double *measured,
                           double *expected);

/** Null, or that the person leaves it out. */
const char *verify_ask(verify *v, verify_wish wish, const char *sentence);
const char *verify_ask_to_hold(verify *v);

/** Adds a finding of this step. NAN is not measured; the note holds the reason, or else the meaning of a value out of
 * the range. Returns 1 if it passed. */
int verify_find(verify *v, const char *what, double measured, const char *unit, double least, double most,
                const char *source, const char *note, ...) KNURL_PRINTF(8, 9);

double verify_length(const double vector[3]);
int verify_largest(const double vector[3]); /* the axis of the largest component */

/* --- steps: verify_held.c, verify_pushed.c, verify_ends.c --- */
const char *verify_rate(verify *v);
const char *verify_noise(verify *v);
const char *verify_axes(verify *v);
const char *verify_buttons(verify *v);
const char *verify_orientation(verify *v);
const char *verify_signs(verify *v);
const char *verify_scale(verify *v);
const char *verify_latency(verify *v);
const char *verify_friction(verify *v);
const char *verify_wall(verify *v);
const char *verify_response(verify *v);
const char *verify_faults(verify *v);

/* --- reports: verify_page.c --- */
void verify_write_json(const verify *v, FILE *stream, const char *uri, int pretty);
void verify_write_page(const verify *v, FILE *stream, const char *uri);

/* --- a simulated person: verify_hand.c --- */

/** In verify.hand; set uri, all others 0. */
typedef struct verify_hand {
    const char *uri; /* of a fake device, which is opened anew to let its grip go; null: another device */
    int is_loose;
    verify_wish wish;
    uint64_t ticks; /* since that */
    double weight;  /* N that hangs from the grip */
} verify_hand;

extern const verify_person verify_hand_person;

#endif
