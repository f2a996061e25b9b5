/* Timing at a device's pace: a loop at 1 kHz on a device that plays a stroke. SPDX-License-Identifier: MIT */
#include "bench.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#define THRASHED (64u << 20) /* bytes: larger than most last-level caches */
#define LINE     64u         /* bytes of a cache's line */

/* Evicts the caches until it is stopped. */
typedef struct thrasher {
    unsigned char *memory;
    pthread_t thread;
    int stop; /* atomic */
} thrasher;

static void *thrash(void *argument) {
    thrasher *t = argument;
    for (uint32_t at = 0; !__atomic_load_n(&t->stop, __ATOMIC_RELAXED); at = (at + LINE) % THRASHED) {
        t->memory[at]++;
    }
    return NULL;
}

static knurl_result start_thrasher(thrasher *t) {
    t->memory = calloc(THRASHED, 1);
    if (!t->memory || pthread_create(&t->thread, NULL, thrash, t) != 0) {
        free(t->memory);
        return knurl_fail(KNURL_ERROR_SYSTEM, "a second thread, or %u bytes for it to write to, were refused",
                          THRASHED);
    }
    return KNURL_OK;
}

static void end_thrasher(thrasher *t) {
    __atomic_store_n(&t->stop, 1, __ATOMIC_RELAXED);
    (void)pthread_join(t->thread, NULL);
    free(t->memory);
}

typedef struct stroked {
    bench *owner;
    const bench_case *timed;
    knurl_loop *loop;
    size_t ticks; /* to time */
    size_t reads, writes;
    int64_t read_at; /* ns */
    knurl_tick_input
        next; /* computed after the last write, so that the loop finds the caches as other code leaves them */
} stroked;

static void get_info(void *user, knurl_device_info *info) {
    (void)user;
    info->max_force = 3.3;
    info->resolution = 0.0;
}

static knurl_result read_stroke(void *user, knurl_device_sample *sample) {
    stroked *s = user;
    memcpy(sample->position, s->next.position, sizeof sample->position);
    s->reads++;
    s->read_at = bench_now();
    return KNURL_OK;
}

static knurl_result write_force(void *user, const double force[3]) {
    stroked *s = user;
    const int64_t at = bench_now();
    (void)force;
    if (s->writes < s->reads && s->writes < s->ticks) {
        s->owner->samples[s->writes++] = at - s->read_at;
    }
    if (s->loop && (s->writes == s->ticks || *s->owner->interrupted)) {
        knurl_loop_request_stop(s->loop);
    }
    bench_stroke(s->timed, 0, s->reads, &s->next);
    return KNURL_OK;
}

static knurl_result run(bench *b, stroked *s, knurl_device *device, double *overruns) {
    knurl_loop_stats stats;
    knurl_loop_desc d;
    knurl_loop_desc_init(&d, sizeof d);
    d.device = device;
    d.scene = b->stage.scene;
    d.update_rate_hz = BENCH_RATE;
    d.tick_limit = s->ticks;
    knurl_result result = knurl_loop_create(&d, &s->loop);
    result = result ? result : knurl_loop_start(s->loop);
    while (!result && !knurl_loop_wait(s->loop, 1.0)) {}
    knurl_loop_stats_init(&stats, sizeof stats);
    if (!result && knurl_loop_get_stats(s->loop, &stats) == KNURL_OK) {
        *overruns = (double)stats.overruns;
    }
    knurl_loop_destroy(s->loop);
    s->loop = NULL;
    return result;
}

knurl_result bench_pace(bench *b, const bench_case *c, size_t ticks, size_t *count, double *overruns) {
    stroked s;
    knurl_device *device = NULL;
    knurl_device_functions functions;
    memset(&s, 0, sizeof s);
    s.owner = b;
    s.timed = c;
    s.ticks = ticks;
    bench_stroke(c, 0, 0, &s.next);
    knurl_device_functions_init(&functions, sizeof functions);
    functions.user = &s;
    functions.motors_known = 1; /* simulated */
    functions.get_info = get_info;
    functions.read = read_stroke;
    functions.write = write_force;
    thrasher beside = {NULL, 0, 0};
    knurl_result result = c->thrashes ? start_thrasher(&beside) : KNURL_OK;
    if (result) {
        return result;
    }
    result = knurl_device_open_functions(&functions, &device);
    result = result ? result : run(b, &s, device, overruns);
    knurl_device_close(device);
    if (c->thrashes) {
        end_thrasher(&beside);
    }
    *count = s.writes;
    return result;
}
