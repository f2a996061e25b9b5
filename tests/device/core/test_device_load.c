/* A loop at 1 kHz over a device whose exchanges take 0.3 ms, beside a busy core. Prints the lateness of ticks, the
 * number of exchanges and the cost of the device's code, without assertions, because they depend on the machine.
 * KNURL_DEVICE_SECONDS: duration, default 0.5. SPDX-License-Identifier: MIT */
#include "home.h"

#include "base/histogram.h"

#include <knurl/loop.h>
#include <pthread.h>
#include <stdlib.h>
#include <time.h>

#define EXCHANGE_NS 300000

/* CPU time of the calling thread, ns. */
static int64_t cpu_ns(void) {
    struct timespec now;
    (void)clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
}

/* --- the haptic thread's time in the device; linked with --wrap --- */

static struct {
    knurl_histogram wall; /* ns of a read and a write */
    int64_t cpu;          /* ns in all */
    int64_t wall_now;     /* of the read of this tick */
    uint64_t ticks;
} spent;

knurl_result __real_knurl_device_read(knurl_device *device, knurl_device_sample *sample);
knurl_result __wrap_knurl_device_read(knurl_device *device, knurl_device_sample *sample);
knurl_result __wrap_knurl_device_read(knurl_device *device, knurl_device_sample *sample) {
    const int64_t cpu = cpu_ns();
    const int64_t wall = now_ns();
    const knurl_result result = __real_knurl_device_read(device, sample);
    spent.wall_now = now_ns() - wall;
    spent.cpu += cpu_ns() - cpu;
    return result;
}

knurl_result __real_knurl_device_write(knurl_device *device, const double force[3]);
knurl_result __wrap_knurl_device_write(knurl_device *device, const double force[3]);
knurl_result __wrap_knurl_device_write(knurl_device *device, const double force[3]) {
    const int64_t cpu = cpu_ns();
    const int64_t wall = now_ns();
    const knurl_result result = __real_knurl_device_write(device, force);
    knurl_histogram_add(&spent.wall, spent.wall_now + now_ns() - wall);
    spent.cpu += cpu_ns() - cpu;
    spent.ticks++;
    return result;
}

/* The measurement's own share of spent.cpu and spent.wall, ns per tick. */
static void measure_nothing(double *cpu_cost, double *wall_cost) {
    int64_t cpu_sum = 0;
    int64_t wall_sum = 0;
    for (int k = 0; k < 2 * 20000; k++) { /* two pairs a tick */
        const int64_t cpu = cpu_ns();
        const int64_t wall = now_ns();
        wall_sum += now_ns() - wall;
        cpu_sum += cpu_ns() - cpu;
    }
    *cpu_cost = (double)cpu_sum / 20000.0;
    *wall_cost = (double)wall_sum / 20000.0;
}

/* --- the device --- */

static struct {
    int64_t first_cpu, latest_cpu; /* ns, of the I/O thread */
    uint64_t exchanges;            /* its own count */
    double force;                  /* of the last one */
} lean;

static void lean_info(void *user, knurl_device_info *info) {
    (void)user;
    info->max_force = 3.0;
}

static knurl_result lean_write(void *user, const double force[3]) {
    (void)user;
    lean.force = force[1];
    lean.latest_cpu = cpu_ns();
    lean.first_cpu = lean.first_cpu ? lean.first_cpu : lean.latest_cpu;
    lean.exchanges++;
    return KNURL_OK;
}

static knurl_result lean_read(void *user, knurl_device_sample *sample) {
    (void)user;
    sleep_ns(EXCHANGE_NS);
    memset(sample, 0, sizeof *sample);
    sample->position[0] = 0.01;
    return KNURL_OK;
}

static void pull(uint64_t tick, const knurl_device_sample *sample, double force[3], void *user) {
    (void)user;
    force[1] = 1.0 + sample->position[0] + 1e-6 * (double)(tick % 100);
}

static uint32_t spins = 1; /* atomic */

static void *spin(void *unused) {
    while (knurl_load_acquire(&spins)) {}
    return unused;
}

static double seconds(void) {
    const char *given = getenv("KNURL_DEVICE_SECONDS");
    return given ? fmax(0.1, strtod(given, NULL)) : 0.5;
}

static void print_all(const knurl_loop_stats *stats, const knurl_device_status *status, double took) {
    double cpu_cost;
    double wall_cost;
    measure_nothing(&cpu_cost, &wall_cost);
    const double ticks = (double)spent.ticks;
    print_message("%.1f s, %.0f ticks, %.0f absences, real-time scheduling %s\n", took, (double)stats->ticks,
                  (double)stats->absences, stats->realtime ? "yes" : "no");
    print_message("overruns        %8.0f (%.3f %% of ticks)\n", (double)stats->overruns,
                  100.0 * (double)stats->overruns / (double)stats->ticks);
    print_message("jitter          %8.1f us p50, %.1f us p99, %.1f us max\n", 1e-3 * stats->jitter_ns.p50,
                  1e-3 * stats->jitter_ns.p99, 1e-3 * stats->jitter_ns.max);
    print_message("exchanges       %8.1f a second; %.1f us p50, %.1f us p99\n", (double)status->exchanges / took,
                  1e-3 * status->exchange_ns_p50, 1e-3 * status->exchange_ns_p99);
    print_message(
        "haptic thread   %8.0f ns CPU a tick for read and write (%.0f with the measuring, which takes %.0f)\n",
        (double)spent.cpu / ticks - cpu_cost, (double)spent.cpu / ticks, cpu_cost);
    print_message("                %8.0f ns p50 by the wall clock, %.0f p99 (less %.0f of measuring)\n",
                  knurl_histogram_percentile(&spent.wall, 0.5) - wall_cost,
                  knurl_histogram_percentile(&spent.wall, 0.99) - wall_cost, wall_cost);
    print_message("I/O thread      %8.2f us CPU an exchange, two sleeps and the simulated device in it\n",
                  1e-3 * (double)(lean.latest_cpu - lean.first_cpu) / (double)(lean.exchanges - 1));
    print_message("events          %8.0f\n", (double)status->events);
}

TEST(a_loop_over_an_io_thread_runs_beside_a_busy_core) {
    pthread_t busy;
    knurl_loop_desc desc;
    knurl_device_functions f;
    knurl_device *device = NULL;
    knurl_loop *loop = NULL;
    knurl_device_functions_init(&f, sizeof f);
    f.blocking = 1;
    f.get_info = lean_info;
    f.read = lean_read;
    f.write = lean_write;
    assert_int_equal(knurl_device_open_functions(&f, &device), KNURL_OK);
    knurl_loop_desc_init(&desc, sizeof desc);
    desc.device = device;
    desc.force_callback = pull;
    desc.reconnect = 1;
    assert_int_equal(pthread_create(&busy, NULL, spin, NULL), 0);
    assert_int_equal(knurl_loop_create(&desc, &loop), KNURL_OK);
    const int64_t start = now_ns();
    assert_int_equal(knurl_loop_start(loop), KNURL_OK);
    sleep_ns((int64_t)(seconds() * 1e9));
    knurl_loop_stop(loop);
    const double took = 1e-9 * (double)(now_ns() - start);
    knurl_store_release(&spins, 0u);
    assert_int_equal(pthread_join(busy, NULL), 0);
    knurl_loop_stats stats = loop_stats(loop);
    knurl_device_status status = device_status(device);
    knurl_loop_destroy(loop);
    knurl_device_close(device);
    print_all(&stats, &status, took);
    assert_true(stats.ticks > 10 && status.exchanges > 10 && lean.exchanges > 10);
    CHECK_SAME(lean.force, 0.0L);
    assert_int_equal(stats.state, KNURL_LOOP_DONE);
}
