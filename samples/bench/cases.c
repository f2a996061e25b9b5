/* The table of cases, and timing with a warm cache. SPDX-License-Identifier: MIT */
#include "bench.h"

#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#define WARM(name, shape, finish, method, triangles) {name, shape, finish, method, triangles, 1, 0, 0, 0}
#define FOAW(name, shape, finish, method, triangles) {name, shape, finish, method, triangles, 1, 0, 1, 0}
#define HIPS(name, shape, triangles, hips) {name, shape, BENCH_TEXTURED, KNURL_METHOD_S2, triangles, hips, 0, 0, 0}
#define PACED(name, shape, triangles, thrashes)                                                                        \
    {name, shape, BENCH_TEXTURED, KNURL_METHOD_S2, triangles, 1, 1, 0, thrashes}
#define MESH(name, triangles)                                                                                          \
    WARM(name, BENCH_MESH, BENCH_TEXTURED, KNURL_METHOD_S2, triangles),                                                \
        WARM(name "_bandlimited", BENCH_MESH, BENCH_TEXTURED, KNURL_METHOD_BANDLIMITED, triangles),                    \
        WARM(name "_smooth", BENCH_MESH, BENCH_SMOOTH, KNURL_METHOD_S2, triangles),                                    \
        WARM(name "_friction", BENCH_MESH, BENCH_FRICTIONAL, KNURL_METHOD_S2, triangles)

/* Names keep their meaning from release to release. Without a suffix: S2, with a given velocity. */
const bench_case bench_cases[] = {
    WARM("empty", BENCH_EMPTY, 0, KNURL_METHOD_S2, 0),
    FOAW("motion_foaw", BENCH_FOAW, 0, 0, 0),
    WARM("grating_S1", BENCH_GRATING, 0, KNURL_METHOD_S1, 0),
    WARM("grating_S2", BENCH_GRATING, 0, KNURL_METHOD_S2, 0),
    WARM("grating_bandlimited", BENCH_GRATING, 0, KNURL_METHOD_BANDLIMITED, 0),
    WARM("plane", BENCH_PLANE, BENCH_TEXTURED, KNURL_METHOD_S2, 0),
    WARM("plane_bandlimited", BENCH_PLANE, BENCH_TEXTURED, KNURL_METHOD_BANDLIMITED, 0),
    FOAW("plane_foaw", BENCH_PLANE, BENCH_TEXTURED, KNURL_METHOD_BANDLIMITED, 0),
    WARM("plane_smooth", BENCH_PLANE, BENCH_SMOOTH, KNURL_METHOD_S2, 0),
    WARM("plane_friction", BENCH_PLANE, BENCH_FRICTIONAL, KNURL_METHOD_S2, 0),
    MESH("mesh_1k", 1000),
    MESH("mesh_10k", 10000),
    WARM("curved_10k", BENCH_CURVED, BENCH_TEXTURED, KNURL_METHOD_S2, 10000),
    MESH("mesh_100k", 100000),
    FOAW("mesh_100k_foaw", BENCH_MESH, BENCH_TEXTURED, KNURL_METHOD_BANDLIMITED, 100000),
    MESH("mesh_1m", 1000000),
    WARM("mesh_10m", BENCH_MESH, BENCH_TEXTURED, KNURL_METHOD_S2, 10000000),
    WARM("surfaces_10k", BENCH_FIELD, BENCH_TEXTURED, KNURL_METHOD_S2, 0),
    WARM("moving_1k", BENCH_MOVING_FIELD, BENCH_TEXTURED, KNURL_METHOD_S2, 0),
    WARM("crowded", BENCH_CROWD, BENCH_TEXTURED, KNURL_METHOD_S2, 0),
    WARM("corner_2_faces", BENCH_CORNER, BENCH_TEXTURED, KNURL_METHOD_S2, 2),
    WARM("corner_3_faces", BENCH_CORNER, BENCH_TEXTURED, KNURL_METHOD_S2, 3),
    WARM("moving", BENCH_MOVING, BENCH_TEXTURED, KNURL_METHOD_S2, 0),
    WARM("worst_reach_327k", BENCH_WORST_REACH, BENCH_TEXTURED, KNURL_METHOD_S1, 327000),
    WARM("worst_reach_2m", BENCH_WORST_REACH, BENCH_TEXTURED, KNURL_METHOD_S1, 2000000),
    WARM("worst_crowd", BENCH_WORST_CROWD, BENCH_TEXTURED, KNURL_METHOD_S1, 20000),
    WARM("worst_heap", BENCH_WORST_HEAP, BENCH_TEXTURED, KNURL_METHOD_S1, 100000),
    WARM("worst_planes", BENCH_WORST_PLANES, BENCH_TEXTURED, KNURL_METHOD_S1, 0),
    HIPS("two_hips", BENCH_MESH, 100000, 2),
    HIPS("eight_hips", BENCH_MESH, 100000, 8),
    HIPS("moving_1k_two_hips", BENCH_MOVING_FIELD, 0, 2), /* edits per second while another HIP ticks continuously */
    PACED("paced_plane", BENCH_PLANE, 0, 0),
    PACED("paced_plane_thrashed", BENCH_PLANE, 0, 1),
    PACED("paced_mesh_100k", BENCH_MESH, 100000, 0),
    PACED("paced_mesh_100k_thrashed", BENCH_MESH, 100000, 1),
    {NULL, 0, 0, 0, 0, 0, 0, 0, 0}};

/* State of one case. */
typedef struct subject {
    bench *owner;
    const bench_case *timed;
    uint32_t hip;
    void (*tick)(struct subject *, const knurl_tick_input *);
    knurl_velocity velocity;
    knurl_grating grating;
    knurl_grating_state grating_state;
    int64_t editing_ns; /* duration of `edits` edits */
    uint64_t edits;
    volatile double sink; /* uses the results, so that the compiler keeps the computation */
} subject;

static int is_moving(const bench_case *c) {
    return c->shape == BENCH_MOVING || c->shape == BENCH_MOVING_FIELD || c->shape == BENCH_WORST_PLANES;
}

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
        return knurl_velocity_prepare(KNURL_VELOCITY_FOAW, BENCH_RESOLUTION, BENCH_RATE, &s->velocity);
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

/* Between two timed ticks: moves the hand on, and starts moves of surfaces. */
static knurl_result between(subject *s, uint64_t tick, knurl_tick_input *input) {
    bench_stroke(s->timed, s->hip, tick, input);
    const double frame = floor((double)tick * BENCH_FRAME_RATE / BENCH_RATE);
    if (is_moving(s->timed) && frame > floor(((double)tick - 1.0) * BENCH_FRAME_RATE / BENCH_RATE)) {
        uint32_t moved = 0;
        const int64_t before = bench_now();
        const knurl_result result = bench_stage_move(&s->owner->stage, frame / BENCH_FRAME_RATE, &moved);
        s->editing_ns += bench_now() - before;
        s->edits += moved;
        return result;
    }
    return KNURL_OK;
}

static int64_t timed(subject *s, const knurl_tick_input *input) {
    const int64_t before = bench_now();
    s->tick(s, input);
    return bench_now() - before;
}

/* Times ticks as fast as possible, with warm caches. is_repeat: keeps the minimum time of each tick. */
static size_t time_warm(subject *s, size_t ticks, int is_repeat, knurl_result *failed) {
    const bench *b = s->owner;
    const int64_t end = bench_now() + (int64_t)(1e9 * BENCH_SECONDS);
    const int is_timed_out = b->ticks == 0.0 && !is_repeat;
    size_t i = 0;
    while (i < ticks && !*b->interrupted && !(is_timed_out && i % 1024 == 0 && bench_now() > end)) {
        knurl_tick_input input;
        *failed = between(s, i, &input);
        if (*failed) {
            break;
        }
        const int64_t ns = timed(s, &input);
        b->samples[i] = is_repeat && b->samples[i] < ns ? b->samples[i] : ns;
        i++;
    }
    return i;
}

/* If a tick takes 5 us or more, the system interrupts one in about a hundred, and p99.9 would measure interrupts. The
 * work of a tick is the same in each repetition. */
static size_t time_repeatedly(subject *s, size_t ticks, knurl_result *failed) {
    const size_t count = time_warm(s, ticks, 0, failed);
    for (int run = 1; run < BENCH_WORST_RUNS && !*failed; run++) {
        *failed = bench_stage_reset(&s->owner->stage, s->timed);
        if (!*failed) {
            (void)time_warm(s, count, 1, failed);
        }
    }
    return count;
}

/* The same without reading the clock at each tick, because some clocks are too coarse. Returns ns per tick. */
static double time_batches(subject *s, size_t ticks) {
    const bench *b = s->owner;
    const int64_t end = bench_now() + (int64_t)(1e9 * BENCH_SECONDS);
    size_t batches = 0;
    while ((batches + 1) * BENCH_BATCH <= ticks && !*b->interrupted && (b->ticks > 0.0 || bench_now() < end)) {
        knurl_tick_input inputs[BENCH_BATCH];
        for (size_t i = 0; i < BENCH_BATCH; i++) {
            bench_stroke(s->timed, s->hip, batches * BENCH_BATCH + i, &inputs[i]);
        }
        const int64_t before = bench_now();
        for (size_t i = 0; i < BENCH_BATCH; i++) {
            s->tick(s, &inputs[i]);
        }
        b->samples[batches++] = bench_now() - before;
    }
    return bench_median(b->samples, batches) / BENCH_BATCH;
}

/* A thread that ticks the other HIPs of the same scene in turn until it is stopped. */
typedef struct neighbour {
    subject subject;
    int stop;
} neighbour;

static void *tick_beside(void *argument) {
    neighbour *n = argument;
    for (uint64_t i = 0; !__atomic_load_n(&n->stop, __ATOMIC_RELAXED); i++) {
        for (n->subject.hip = 1; n->subject.hip < n->subject.timed->hips; n->subject.hip++) {
            knurl_tick_input input;
            bench_stroke(n->subject.timed, n->subject.hip, i, &input);
            n->subject.tick(&n->subject, &input);
        }
    }
    return NULL;
}

static size_t time_beside_others(subject *s, size_t ticks, knurl_result *failed) {
    neighbour n = {*s, 0};
    pthread_t thread;
    if (pthread_create(&thread, NULL, tick_beside, &n) != 0) {
        *failed = knurl_fail(KNURL_ERROR_SYSTEM, "a second thread was refused");
        return 0;
    }
    const size_t count = time_warm(s, ticks, 0, failed);
    __atomic_store_n(&n.stop, 1, __ATOMIC_RELAXED);
    (void)pthread_join(thread, NULL);
    return count;
}

static size_t default_ticks(const bench_case *c) {
    return c->paced ? BENCH_PACED_TICKS : BENCH_TICKS;
}

int bench_start(bench *b) {
    const double room = fmax(b->ticks, BENCH_TICKS);
    b->samples =
        calloc((size_t)room, sizeof *b->samples); /* zeroed and touched below, so that timing causes no page faults */
    if (!b->samples) {
        return 1;
    }
    memset(b->samples, 1, (size_t)room * sizeof *b->samples);
    b->timer_ns = bench_timer_cost(b->samples, BENCH_TIMER_READINGS, &b->step_ns);
    return 0;
}

void bench_end(bench *b) {
    knurl_scene_destroy(b->stage.scene);
    free(b->samples);
    memset(b, 0, sizeof *b);
}

/* All ticks of the first HIP since the start of its case are timed. */
static void tell_shares(const bench *b, bench_result *result) {
    knurl_tick_output last;
    knurl_hip_counts counts;
    if (knurl_scene_get_tick(b->stage.scene, 0, &last, &counts) == KNURL_OK && counts.ticks > 0) {
        result->contact = (double)counts.contact_ticks / (double)counts.ticks;
        result->visit_limit = (double)counts.visit_limit_ticks / (double)counts.ticks;
    }
}

int bench_run(bench *b, const bench_case *c, bench_result *result) {
    subject s;
    memset(result, 0, sizeof *result);
    knurl_result failed = prepare(b, c, &s, result);
    const size_t ticks = b->ticks > 0.0 ? (size_t)b->ticks : default_ticks(c);
    size_t count = 0;
    if (!failed && !*b->interrupted) {
        if (c->paced) {
            failed = bench_pace(b, c, ticks, &count, &result->overruns);
        } else {
            count = c->hips > 1                ? time_beside_others(&s, ticks, &failed)
                    : bench_is_worst(c->shape) ? time_repeatedly(&s, ticks, &failed)
                                               : time_warm(&s, ticks, 0, &failed);
        }
    }
    if (failed) {
        return failed == KNURL_ERROR_UNSUPPORTED ? BENCH_SKIPPED : BENCH_FAILED;
    }
    if (*b->interrupted) {
        return BENCH_INTERRUPTED;
    }
    bench_percentiles(b->samples, count, b->timer_ns, result);
    result->edits_per_s = s.edits > 0 ? 1e9 * (double)s.edits / (double)s.editing_ns : 0.0;
    result->ticks = (double)count;
    if (s.tick == tick_scene) {
        tell_shares(b, result);
        failed = bench_stage_reset(&b->stage, c); /* otherwise the batches would start with a jump through surfaces */
    }
    if (!failed && !c->paced && c->hips == 1 && !is_moving(c)) {
        result->batch_ns = time_batches(&s, ticks);
    }
    return failed ? BENCH_FAILED : BENCH_DONE;
}
