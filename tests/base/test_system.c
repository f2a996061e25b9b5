/* Histograms, snapshots, time and threads, against their headers' promises. SPDX-License-Identifier: MIT */
#include "support/close.h"

#include "base/atomic.h"
#include "base/histogram.h"
#include "base/seqlock.h"
#include "base/system.h"

#include <limits.h>
#include <pthread.h>
#include <stdio.h>
#include <time.h>
#ifdef __linux__
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>
#endif

/* --- histogram --- */

static knurl_histogram histogram; /* 15 KiB */

/* The histogram's percentile is within 3 % (or half a nanosecond) of the exact one, which an ascending array gives. */
static void check_percentiles(const int64_t *ascending, size_t count) {
    static const double shares[] = {0.01, 0.25, 0.5, 0.9, 0.99, 0.999, 1.0};
    memset(&histogram, 0, sizeof histogram);
    for (size_t i = 0; i < count; i++) {
        knurl_histogram_add(&histogram, ascending[i * 7919 % count]); /* in no order: 7919 is a prime above any count */
    }
    for (size_t i = 0; i < COUNT_OF(shares); i++) {
        const double exact = (double)ascending[(size_t)ceil(shares[i] * (double)count) - 1];
        CHECK_CLOSE(knurl_histogram_percentile(&histogram, shares[i]), exact, fmax(0.5, 0.03 * exact));
    }
    assert_int_equal(histogram.max, (uint64_t)ascending[count - 1]);
    assert_int_equal(histogram.total, count);
}

TEST(percentiles_of_known_distributions_are_within_three_percent) {
    static int64_t values[5000];
    for (size_t i = 0; i < COUNT_OF(values); i++) {
        values[i] = (int64_t)i * 20;
    }
    check_percentiles(values, COUNT_OF(values)); /* uniform */
    for (size_t i = 0; i < COUNT_OF(values); i++) {
        values[i] = (int64_t)(10.0 * exp(0.008 * (double)i)); /* logarithmic, to 2.3e18 ns */
    }
    check_percentiles(values, COUNT_OF(values));
    for (size_t i = 0; i < COUNT_OF(values); i++) {
        values[i] = i < 4900 ? 230 : 1000000; /* 2 % outliers: the 99th percentile is one of them, the 90th is not */
    }
    check_percentiles(values, COUNT_OF(values));
}

TEST(every_value_is_within_three_percent) {
    uint64_t random = 99;
    for (int i = 0; i < 2000; i++) {
        const int64_t value = (int64_t)(random_bits(&random) >> (1 + i % 63));
        check_percentiles(&value, 1);
    }
}

TEST(values_below_32_are_exact) {
    for (int64_t value = 0; value < 32; value++) {
        memset(&histogram, 0, sizeof histogram);
        knurl_histogram_add(&histogram, value);
        CHECK_SAME(knurl_histogram_percentile(&histogram, 0.5), (long double)value);
    }
}

TEST(an_empty_histogram_gives_zero_and_its_extremes_hold) {
    memset(&histogram, 0, sizeof histogram);
    CHECK_SAME(knurl_histogram_percentile(&histogram, 0.5), 0.0L);
    knurl_histogram_add(&histogram, INT64_MIN);
    knurl_histogram_add(&histogram, -1);
    CHECK_SAME(knurl_histogram_percentile(&histogram, 1.0), 0.0L);
    assert_int_equal(histogram.max, 0);
    knurl_histogram_add(&histogram, INT64_MAX);
    CHECK_CLOSE(knurl_histogram_percentile(&histogram, 1.0), 9.223372036854775807e18L, 0.03L * 9.3e18L);
    CHECK_SAME(knurl_histogram_percentile(&histogram, 0.0), 0.0L);
    assert_true(histogram.max == (uint64_t)INT64_MAX);
}

/* --- snapshots --- */

typedef struct snapshot {
    uint64_t words[16];
} snapshot;

typedef struct published {
    KNURL_SEQLOCK(snapshot) lock;
    uint32_t done;
} published;

#if defined(__SANITIZE_THREAD__)
#define SNAPSHOTS 100000 /* a hundred times slower, and it needs no luck */
#else
#define SNAPSHOTS 3000000 /* some 0.1 s: fewer may all be written between two reads */
#endif

static void *write_snapshots(void *argument) {
    published *p = argument;
    snapshot value;
    for (uint64_t i = 1; i <= SNAPSHOTS; i++) {
        for (size_t word = 0; word < COUNT_OF(value.words); word++) {
            value.words[word] = i * (word + 1);
        }
        knurl_seqlock_write(&p->lock.sequence, p->lock.words, &value, sizeof value);
    }
    knurl_store_release(&p->done, 1u);
    return NULL;
}

TEST(a_snapshot_is_never_torn_and_never_older_than_the_one_before) {
    static published p;
    pthread_t thread;
    snapshot value;
    uint64_t latest = 0;
    uint32_t done = 0;
    memset(&p, 0, sizeof p);
    knurl_seqlock_read(&p.lock.sequence, p.lock.words, &value, sizeof value);
    assert_int_equal(value.words[15], 0); /* zeroed memory is a valid, zero value */
    assert_int_equal(pthread_create(&thread, NULL, write_snapshots, &p), 0);
    while (!done) {
        done = knurl_load_acquire(&p.done);
        knurl_seqlock_read(&p.lock.sequence, p.lock.words, &value, sizeof value);
        assert_true(value.words[0] >= latest);
        latest = value.words[0];
        for (size_t word = 0; word < COUNT_OF(value.words); word++) {
            assert_true(value.words[word] == latest * (word + 1));
        }
    }
    assert_int_equal(pthread_join(thread, NULL), 0);
    assert_int_equal(latest, SNAPSHOTS); /* a read after the last write returns the last write */
}

/* --- time and threads --- */

TEST(sleeping_ends_at_its_deadline_and_not_before) {
    const int64_t start = knurl_system_now_ns();
    knurl_system_sleep_until_ns(start + 3000000);
    assert_true(knurl_system_now_ns() >= start + 3000000);
    knurl_system_sleep_until_ns(start); /* long past */
    knurl_system_sleep_until_ns(-1);
}

static void tell_id(void *argument) {
    *(uintptr_t *)argument = knurl_system_thread_id();
}

TEST(a_thread_runs_its_entry_and_has_an_id_of_its_own) {
    uintptr_t theirs = 0;
    knurl_thread *thread = knurl_system_start_thread(tell_id, &theirs, (size_t)256 * 1024);
    assert_non_null(thread);
    knurl_system_join_thread(thread);
    assert_true(theirs != 0 && theirs != knurl_system_thread_id());
    assert_true(knurl_system_thread_id() != 0 && knurl_system_thread_id() == knurl_system_thread_id());
}

TEST(a_thread_that_the_system_refuses_is_null) {
    uintptr_t theirs = 0;
    assert_null(knurl_system_start_thread(tell_id, &theirs, 1)); /* below any system's least stack */
    assert_int_equal(theirs, 0);
}

#ifdef __linux__
/* In a time namespace whose CLOCK_BOOTTIME is an hour ahead of CLOCK_MONOTONIC, as after an hour's sleep: s by which
 * the library's clock is ahead; below 0: the system permits no such thing. */
static double lead_after_a_sleep(void) {
    struct timespec monotonic;
    FILE *offsets = syscall(SYS_unshare, 0x80 /* CLONE_NEWTIME */) ? NULL : fopen("/proc/self/timens_offsets", "w");
    int lead[2];
    if (!offsets || fputs("boottime 3600 0\n", offsets) < 0 || fclose(offsets) || pipe(lead)) {
        return -1.0;
    }
    const pid_t child = fork(); /* its clocks are the namespace's */
    if (child == 0) {
        (void)clock_gettime(CLOCK_MONOTONIC, &monotonic);
        const double seconds = 1e-9 * (double)knurl_system_now_ns() - (double)monotonic.tv_sec;
        _exit(write(lead[1], &seconds, sizeof seconds) != sizeof seconds);
    }
    double seconds = -1.0;
    (void)waitpid(child, NULL, 0);
    return read(lead[0], &seconds, sizeof seconds) == sizeof seconds ? seconds : -1.0;
}

TEST(the_clock_goes_on_while_the_machine_sleeps) {
    const pid_t child = fork(); /* whose children are in the namespace: this process's must not be */
    if (child == 0) {
        const double lead = lead_after_a_sleep();
        _exit(lead < 0.0 ? 77 : lead < 3000.0);
    }
    int status = 0;
    assert_int_equal(waitpid(child, &status, 0), child);
    if (WEXITSTATUS(status) == 77) {
        print_message("skipped: time namespaces are not permitted here\n");
        skip();
    }
    assert_int_equal(status, 0);
}

static void check_priority(void *kept) {
    struct sched_param parameters = {0};
    int policy = SCHED_RR;
    parameters.sched_priority = 3;
    if (pthread_setschedparam(pthread_self(), policy, &parameters) != 0) {
        return; /* not permitted */
    }
    const int is_realtime = knurl_system_make_realtime();
    (void)pthread_getschedparam(pthread_self(), &policy, &parameters);
    *(int *)kept = is_realtime && policy == SCHED_RR && parameters.sched_priority == 3 ? 1 : -1;
}

TEST(a_thread_that_runs_in_real_time_keeps_the_priority_that_it_has) {
    int kept = 0;
    knurl_thread *thread = knurl_system_start_thread(check_priority, &kept, (size_t)256 * 1024);
    assert_non_null(thread);
    knurl_system_join_thread(thread);
    if (kept == 0) {
        skip(); /* real-time scheduling is not permitted here */
    }
    assert_int_equal(kept, 1);
}
#endif
