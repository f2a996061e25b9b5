/* The cases of `knurl bench`. A case is a scene and a motion through it; its ticks are timed one by one, minus the
 * timer's own cost.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SAMPLES_BENCH_H
#define KNURL_SAMPLES_BENCH_H

#include <knurl/knurl.h>

#include <signal.h>

#define BENCH_RATE           1000.0  /* Hz */
#define BENCH_TICKS          1000000 /* per case, unless its time is up before */
#define BENCH_PACED_TICKS    3000
#define BENCH_SECONDS        0.3   /* limit of one case, so that the whole run ends within 40 s */
#define BENCH_WORST_RUNS     5     /* repetitions of the same ticks; the minimum time of each tick counts */
#define BENCH_BATCH          64    /* ticks between two readings of the clock, for the median of batches */
#define BENCH_FRAME_RATE     120.0 /* Hz: of the game's moves of surfaces */
#define BENCH_TIMER_READINGS 10000

#define BENCH_STIFFNESS  800.0  /* N/m: the same as in the measurement of CHAI3D */
#define BENCH_DEPTH      0.001  /* m */
#define BENCH_REACH      0.02   /* m either side of the origin: a stroke of 40 mm */
#define BENCH_PEAK_SPEED 0.25   /* m/s */
#define BENCH_PERIOD     0.001  /* m: of the grating */
#define BENCH_AMPLITUDE  0.0002 /* m */
#define BENCH_TILE       0.008  /* m: the side of BENCH_FIELD's tiles, of which there are 100 x 100 */
#define BENCH_CROWD_TILE                                                                                               \
    0.0015                        /* m: of BENCH_CROWD's, 40 x 40: more than 100 within a HIP's search radius of 10 mm \
                                   */
#define BENCH_FRICTION   0.3      /* Coulomb coefficient */
#define BENCH_RESOLUTION 0.055e-3 /* m: the Touch's, for FOAW */

/* Shapes of a case. */
enum {
    BENCH_FOAW,
    BENCH_GRATING,
    BENCH_EMPTY,
    BENCH_PLANE,
    BENCH_MESH,
    BENCH_CURVED, /* a mesh that is felt smooth */
    BENCH_FIELD,
    BENCH_MOVING_FIELD, /* a thousand of its tiles move */
    BENCH_CROWD,
    BENCH_CORNER, /* planes at right angles, all of which hold the HIP */
    BENCH_MOVING,
    /* worst cases for contact; only run by their names: */
    BENCH_WORST_REACH, /* a sphere whose amplitude exceeds its radius */
    BENCH_WORST_CROWD, /* 32 spheres in one place */
    BENCH_WORST_HEAP,  /* triangles that all go through one point */
    BENCH_WORST_PLANES /* a thousand moving planes in one place */
};

#define BENCH_TRIANGLES_MAX 1000000 /* in a mesh of the default run; more are built for their names only */

static inline int bench_is_worst(int shape) {
    return shape >= BENCH_WORST_REACH;
}

/* Finishes of a surface. */
enum { BENCH_TEXTURED, BENCH_SMOOTH, BENCH_FRICTIONAL };

typedef struct bench_case {
    const char *name;
    int shape;          /**< BENCH_FOAW to _WORST_PLANES */
    int finish;         /**< BENCH_TEXTURED, _SMOOTH or _FRICTIONAL */
    int32_t method;     /**< KNURL_METHOD_ */
    uint32_t triangles; /**< BENCH_MESH, _CURVED: about as many; BENCH_CORNER: planes, 2 or 3 */
    uint32_t hips;      /**< number of HIPs: the first is timed, another thread ticks the others in turn */
    int paced;          /**< 1: in a loop at 1 kHz; 0: as fast as possible */
    int estimates; /**< 1: positions in a device's counts, from which FOAW estimates the velocity; 0: it is given */
    int thrashes;  /**< 1: another thread evicts the caches meanwhile; paced cases only */
} bench_case;

/** 1: needs much time or memory, so it runs only by its name. */
static inline int bench_is_on_request(const bench_case *c) {
    return bench_is_worst(c->shape) || c->triangles > BENCH_TRIANGLES_MAX || c->thrashes;
}

typedef struct bench_result {
    double p50_ns, p99_ns, p999_ns, max_ns; /**< a tick, less the timer; paced: from position read to force written */
    double batch_ns;                        /**< per tick, the median of batches; 0: not measured */
    double edits_per_s;                     /**< moves of surfaces; 0: no surface moves */
    double bytes;                           /**< memory of the surfaces */
    double build_ms;                        /**< to add the surfaces and commit */
    double triangles;                       /**< in all surfaces */
    double ticks;                           /**< timed */
    double contact;                         /**< share of them in contact */
    double visit_limit;                     /**< share of them that reached the limit of visits */
    double overruns;                        /**< paced: of the loop */
} bench_result;

/* The present scene; kept while the next case can use it. */
typedef struct bench_stage {
    knurl_scene *scene;
    int shape;
    uint32_t asked_triangles, hips;
    double bytes, build_ms, triangles;
} bench_stage;

typedef struct bench {
    const volatile sig_atomic_t *interrupted;
    double ticks;     /**< per case; 0: the defaults, within BENCH_SECONDS */
    double timer_ns;  /**< the timer's own cost: the median of back-to-back readings */
    double step_ns;   /**< the smallest difference of two readings */
    int64_t *samples; /**< room for the ticks of a case, ns */
    bench_stage stage;
} bench;

enum { BENCH_DONE, BENCH_SKIPPED, BENCH_FAILED, BENCH_INTERRUPTED };

/** All cases in the order they run (those of one scene together), ended by a null name. */
extern const bench_case bench_cases[];

/** Measures the timer and allocates memory. Set `interrupted` and `ticks` before. Returns 0, or 1 if memory runs out.
 */
int bench_start(bench *b);
void bench_end(bench *b);

/** Runs one case. BENCH_SKIPPED: this library does not support the case; BENCH_FAILED: any other error; both with a
 * message in knurl_error_message(). */
int bench_run(bench *b, const bench_case *c, bench_result *result);

/* --- stage.c: scenes --- */

/** Makes a case's scene, or changes the present one. Results as the library's. */
knurl_result bench_stage_set(bench_stage *stage, const bench_case *c);

/** Clears the state of the HIPs, so that a case's ticks can be repeated. Results as the library's. */
knurl_result bench_stage_reset(const bench_stage *stage, const bench_case *c);

/** A frame of a game at 120 Hz: starts the next move of each moving surface. *moved: the number of surfaces. */
knurl_result bench_stage_move(bench_stage *stage, double seconds, uint32_t *moved);

/* --- worst.c --- */

/** The surfaces of a BENCH_WORST_ case. Results as the library's. */
knurl_result bench_worst_add(knurl_scene *scene, const bench_case *c);

/** A frame of BENCH_WORST_PLANES. *moved: the number of surfaces. */
knurl_result bench_worst_move(knurl_scene *scene, double seconds, uint32_t *moved);

/** The HIP's position in a BENCH_WORST_ case, m. */
void bench_worst_place(double seconds, double out[3]);

/* --- stroke.c: position of the HIP --- */

/** HIP `hip` at a tick of the case's stroke; the velocity is the distance since the last tick. */
void bench_stroke(const bench_case *c, uint32_t hip, uint64_t tick, knurl_tick_input *input);

/* --- paced.c --- */

/** Runs a case in a loop at 1 kHz, on a device that plays a stroke. The samples are the times from its read() to its
 * write(). *count: number of samples. *overruns: of the loop. Results as the library's. */
knurl_result bench_pace(bench *b, const bench_case *c, size_t ticks, size_t *count, double *overruns);

/* --- timing.c --- */

/** Monotonic, ns. */
int64_t bench_now(void);

/** The median of back-to-back readings of the clock, ns. *step: the smallest difference of two. */
double bench_timer_cost(int64_t *room, size_t count, double *step);

/** The median; sorts the samples. */
double bench_median(int64_t *samples, size_t count);

/** Sorts the samples and computes the percentiles, less the timer's cost; never below 0. */
void bench_percentiles(int64_t *samples, size_t count, double timer_ns, bench_result *result);

#endif
