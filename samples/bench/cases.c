/* The cases, and the loops that time them. SPDX-License-Identifier: MIT */
#include "bench.h"

#include <errno.h>
#include <math.h>
#include <pthread.h>
#include <sched.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define MESH(name, triangles)                                                                                          \
    {name, BENCH_MESH, BENCH_TEXTURED, 0, triangles, 1, 0},                                                            \
        {name "_smooth", BENCH_MESH, BENCH_SMOOTH, 0, triangles, 1, 0},                                                \
        {name "_friction", BENCH_MESH, BENCH_FRICTIONAL, 0, triangles, 1, 0}

const bench_case bench_cases[] = {{"empty", BENCH_EMPTY, 0, 0, 0, 1, 0},
                                  {"motion_foaw", BENCH_FOAW, 0, 0, 0, 1, 0},
                                  {"grating_S1", BENCH_GRATING, 0, KNURL_S1, 0, 1, 0},
                                  {"grating_S2", BENCH_GRATING, 0, KNURL_S2, 0, 1, 0},
                                  {"grating_locked", BENCH_GRATING, 0, KNURL_LOCKED, 0, 1, 0},
                                  {"grating_area", BENCH_GRATING, 0, KNURL_AREA, 0, 1, 0},
                                  {"plane", BENCH_PLANE, BENCH_TEXTURED, 0, 0, 1, 0},
                                  {"plane_smooth", BENCH_PLANE, BENCH_SMOOTH, 0, 0, 1, 0},
                                  {"plane_friction", BENCH_PLANE, BENCH_FRICTIONAL, 0, 0, 1, 0},
                                  MESH("mesh_1k", 1000),
                                  MESH("mesh_10k", 10000),
                                  MESH("mesh_100k", 100000),
                                  MESH("mesh_1m", 1000000),
                                  {"surfaces_10k", BENCH_FIELD, BENCH_TEXTURED, 0, 0, 1, 0},
                                  {"moving", BENCH_MOVING, BENCH_TEXTURED, 0, 0, 1, 0},
                                  {"two_hips", BENCH_MESH, BENCH_TEXTURED, 0, 100000, 2, 0},
                                  {"paced_plane", BENCH_PLANE, BENCH_TEXTURED, 0, 0, 1, 1},
                                  {"paced_mesh_100k", BENCH_MESH, BENCH_TEXTURED, 0, 100000, 1, 1},
                                  {NULL, 0, 0, 0, 0, 0, 0}};

/* What one case ticks. */
typedef struct subject {
    bench *owner;
    const bench_case *timed;
    uint32_t hip;
    void (*tick)(struct subject *, const knurl_tick_input *);
    knurl_velocity velocity;
    knurl_grating grating;
    knurl_grating_state grating_state;
    volatile double sink; /* what comes out is used, or it would not be computed */
} subject;

static void tick_foaw(subject *s, const knurl_tick_input *input) {
    double velocity[3];
    knurl_velocity_update(&s->velocity, input->position, velocity);
    s->sink = velocity[0];
}

static void tick_grating(subject *s, const knurl_tick_input *input) {
    knurl_grating_output output;
    knurl_grating_step(&s->grating, &s->grating_state, input->position, input->velocity, &output);
    s->sink = output.height;
}

static void tick_scene(subject *s, const knurl_tick_input *input) {
    knurl_tick_output output;
    (void)knurl_scene_tick(s->owner->stage.scene, s->hip, input, &output);
    s->sink = output.device_force[2];
}

static knurl_result prepare(bench *b, const bench_case *c, subject *s, bench_result *result) {
    memset(s, 0, sizeof *s);
    s->owner = b;
    s->timed = c;
    if (c->shape == BENCH_FOAW) {
        s->tick = tick_foaw;
        result->bytes = sizeof s->velocity;
        return knurl_velocity_init(KNURL_VELOCITY_FOAW, BENCH_RESOLUTION, BENCH_RATE, &s->velocity);
    }
    if (c->shape == BENCH_GRATING) {
        s->tick = tick_grating;
        result->bytes = sizeof s->grating_state;
        s->grating.spatial_frequency[0] = 1.0 / BENCH_PERIOD;
        s->grating.amplitude = BENCH_AMPLITUDE;
        s->grating.update_rate_hz = BENCH_RATE;
        s->grating.method = c->method;
        return knurl_grating_check(&s->grating);
    }
    s->tick = tick_scene;
    const knurl_result code = bench_stage_set(&b->stage, c);
    result->bytes = b->stage.bytes;
    result->build_ms = b->stage.build_ms;
    result->triangles = b->stage.triangles;
    return code;
}

/* What happens between two timed ticks: the hand moves on, and where things move a game sends them on. */
static knurl_result between(const subject *s, uint64_t tick, knurl_tick_input *input) {
    bench_stroke(s->timed, s->hip, tick, input);
    const double frame = floor((double)tick * BENCH_FRAME_RATE / BENCH_RATE);
    if (s->timed->shape == BENCH_MOVING && frame > floor(((double)tick - 1.0) * BENCH_FRAME_RATE / BENCH_RATE)) {
        return bench_stage_move(&s->owner->stage, frame / BENCH_FRAME_RATE);
    }
    return KNURL_OK;
}

static int64_t timed(subject *s, const knurl_tick_input *input) {
    const int64_t before = bench_now();
    s->tick(s, input);
    return bench_now() - before;
}

/* As fast as they go: what a tick costs with everything warm. */
static size_t time_warm(subject *s, size_t ticks, knurl_result *failed) {
    const bench *b = s->owner;
    const int64_t end = bench_now() + (int64_t)(1e9 * BENCH_SECONDS);
    size_t i = 0;
    while (i < ticks && !*b->interrupted && !(b->ticks == 0.0 && i % 1024 == 0 && bench_now() > end)) {
        knurl_tick_input input;
        *failed = between(s, i, &input);
        if (*failed) {
            break;
        }
        b->samples[i++] = timed(s, &input);
    }
    return i;
}

/* Once a millisecond, asleep in between: caches as cold as whoever else runs leaves them. The input is made before the
 * sleep; timed is from the waking to the tick's end. */
static size_t time_paced(subject *s, size_t ticks) {
    const int64_t period = (int64_t)(1e9 / BENCH_RATE);
    int64_t due = bench_now();
    size_t i = 0;
    while (i < ticks && !*s->owner->interrupted) {
        knurl_tick_input input;
        bench_stroke(s->timed, s->hip, i, &input);
        due += period * (1 + (bench_now() - due) / period); /* a tick that is missed is not made up for */
        const struct timespec wake = {due / 1000000000, due % 1000000000};
        while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &wake, NULL) == EINTR && !*s->owner->interrupted) {}
        s->owner->samples[i++] = timed(s, &input);
    }
    return i;
}

/* Real-time scheduling where it is permitted, as a haptic loop has it; else a tick may be cut in two. */
static size_t time_paced_in_real_time(subject *s, size_t ticks) {
    struct sched_param before;
    struct sched_param wanted;
    int policy = SCHED_OTHER;
    memset(&wanted, 0, sizeof wanted);
    wanted.sched_priority = 1;
    const int known = pthread_getschedparam(pthread_self(), &policy, &before) == 0;
    (void)pthread_setschedparam(pthread_self(), SCHED_FIFO, &wanted);
    const size_t count = time_paced(s, ticks);
    if (known) {
        (void)pthread_setschedparam(pthread_self(), policy, &before);
    }
    return count;
}

/* Another HIP of the same scene, in a thread of its own, which ticks until it is told to stop. */
typedef struct neighbour {
    subject subject;
    int stop;
} neighbour;

static void *tick_beside(void *argument) {
    neighbour *n = argument;
    for (uint64_t i = 0; !__atomic_load_n(&n->stop, __ATOMIC_RELAXED); i++) {
        knurl_tick_input input;
        bench_stroke(n->subject.timed, n->subject.hip, i, &input);
        n->subject.tick(&n->subject, &input);
    }
    return NULL;
}

static size_t time_beside_another(subject *s, size_t ticks, knurl_result *failed) {
    neighbour n = {*s, 0};
    pthread_t thread;
    n.subject.hip = 1;
    if (pthread_create(&thread, NULL, tick_beside, &n) != 0) {
        *failed = knurl_fail(KNURL_ERROR_SYSTEM, "a second thread was refused");
        return 0;
    }
    const size_t count = time_warm(s, ticks, failed);
    __atomic_store_n(&n.stop, 1, __ATOMIC_RELAXED);
    (void)pthread_join(thread, NULL);
    return count;
}

static size_t default_ticks(const bench_case *c) {
    return c->paced ? BENCH_PACED_TICKS : BENCH_TICKS;
}

int bench_start(bench *b) {
    const double room = fmax(b->ticks, BENCH_TICKS);
    b->samples = calloc((size_t)room, sizeof *b->samples); /* zeroed, and touched below: no page is new when timed */
    if (!b->samples) {
        return 1;
    }
    memset(b->samples, 1, (size_t)room * sizeof *b->samples);
    b->timer_ns = bench_timer_cost(b->samples, BENCH_TIMER_READINGS);
    return 0;
}

void bench_end(bench *b) {
    knurl_scene_destroy(b->stage.scene);
    free(b->samples);
    memset(b, 0, sizeof *b);
}

/* All ticks of the first HIP since its case began are timed ones. */
static double contact_share(const bench *b) {
    knurl_tick_output last;
    knurl_hip_counts counts;
    return knurl_scene_get_tick(b->stage.scene, 0, &last, &counts) || counts.ticks == 0
               ? 0.0
               : (double)counts.contact_ticks / (double)counts.ticks;
}

int bench_run(bench *b, const bench_case *c, bench_result *result) {
    subject s;
    memset(result, 0, sizeof *result);
    knurl_result failed = prepare(b, c, &s, result);
    const size_t ticks = b->ticks > 0.0 ? (size_t)b->ticks : default_ticks(c);
    size_t count = 0;
    if (!failed && !*b->interrupted) {
        count = c->paced      ? time_paced_in_real_time(&s, ticks)
                : c->hips > 1 ? time_beside_another(&s, ticks, &failed)
                              : time_warm(&s, ticks, &failed);
    }
    if (failed) {
        return failed == KNURL_ERROR_UNSUPPORTED ? BENCH_SKIPPED : BENCH_FAILED;
    }
    if (*b->interrupted) {
        return BENCH_INTERRUPTED;
    }
    bench_percentiles(b->samples, count, b->timer_ns, result);
    result->ticks = (double)count;
    result->contact = s.tick == tick_scene ? contact_share(b) : 0.0;
    return BENCH_DONE;
}
