/* Lock-free passing between threads: the newest value, and the last events.
 * SPDX-License-Identifier: MIT */
#include "support/close.h"

#include "base/atomic.h"
#include "base/mailbox.h"
#include "base/system.h"
#include "device/events.h"

#include <pthread.h>

#define POSTS   200000
#define REPORTS 40000 /* of each writer */

/* --- mailbox --- */

/* Long enough to be torn; all words are equal. */
typedef struct letter {
    uint64_t words[16];
} letter;

static struct {
    knurl_mailbox box;
    letter slots[3];
    uint32_t is_done; /* atomic */
} post;

static void write_letter(uint64_t number) {
    for (size_t i = 0; i < COUNT_OF(post.slots[0].words); i++) {
        post.slots[post.box.back].words[i] = number;
    }
    knurl_mailbox_post(&post.box);
}

TEST(a_mailbox_gives_the_newest_once) {
    memset(&post, 0, sizeof post);
    knurl_mailbox_init(&post.box);
    assert_int_equal(knurl_mailbox_take(&post.box), 0);
    for (uint64_t burst = 1; burst < 10; burst++) {
        for (uint64_t number = 1; number <= burst; number++) {
            write_letter(100 * burst + number);
        }
        assert_int_equal(knurl_mailbox_take(&post.box), 1);
        assert_int_equal(post.slots[post.box.front].words[0], 101 * burst);
        assert_int_equal(knurl_mailbox_take(&post.box), 0); /* the taken value stays readable */
        assert_int_equal(post.slots[post.box.front].words[15], 101 * burst);
    }
}

/* In any order of posts and takes, writer, reader and middle have one slot each. */
TEST(the_three_slots_are_never_shared) {
    uint64_t random = 5;
    memset(&post, 0, sizeof post);
    knurl_mailbox_init(&post.box);
    for (int i = 0; i < 10000; i++) {
        if (random_bits(&random) % 2) {
            write_letter((uint64_t)i);
        } else {
            (void)knurl_mailbox_take(&post.box);
        }
        assert_int_equal((1u << post.box.back) | (1u << post.box.front) | (1u << (post.box.middle & 3u)), 7);
    }
}

static void *post_many(void *unused) {
    for (uint64_t number = 1; number <= POSTS; number++) {
        write_letter(number);
    }
    knurl_store_release(&post.is_done, 1u);
    return unused;
}

TEST(between_threads_nothing_is_torn_and_nothing_older_comes_after_something_newer) {
    pthread_t writer;
    uint64_t latest = 0;
    uint32_t was_done;
    memset(&post, 0, sizeof post);
    knurl_mailbox_init(&post.box);
    assert_int_equal(pthread_create(&writer, NULL, post_many, NULL), 0);
    do {
        was_done = knurl_load_acquire(&post.is_done);
        if (knurl_mailbox_take(&post.box)) {
            const letter found = post.slots[post.box.front];
            for (size_t i = 1; i < COUNT_OF(found.words); i++) {
                assert_true(found.words[i] == found.words[0]);
            }
            assert_true(found.words[0] > latest);
            latest = found.words[0];
        }
    } while (!was_done);
    assert_int_equal(pthread_join(writer, NULL), 0);
    assert_int_equal(latest, POSTS);
}

/* --- events --- */

static knurl_events ring;

static void report_numbers(int from, int to) {
    for (int i = from; i < to; i++) {
        knurl_events_report(&ring, i % 7, i);
    }
}

/* The next events have the values from `from` to `to` - 1. */
static void check_numbers(int from, int to) {
    knurl_device_event event;
    for (int number = from; number < to; number++) {
        assert_int_equal(knurl_events_next(&ring, &event), 1);
        CHECK_SAME(event.value, (long double)number);
    }
}

TEST(events_come_oldest_first_with_the_time_at_which_they_were_seen) {
    knurl_device_event event;
    memset(&ring, 0, sizeof ring);
    memset(&event, 0xaa, sizeof event);
    assert_int_equal(knurl_events_next(&ring, &event), 0);
    assert_int_equal((uint32_t)event.code, 0xaaaaaaaau); /* untouched */
    const int64_t before = knurl_system_now_ns();
    report_numbers(0, 30);
    const int64_t after = knurl_system_now_ns();
    int64_t last = before;
    for (int i = 0; i < 30; i++) {
        assert_int_equal(knurl_events_next(&ring, &event), 1);
        assert_int_equal(event.code, i % 7);
        CHECK_SAME(event.value, (long double)i);
        assert_int_equal(event.reserved, 0);
        assert_true(event.time_ns >= last && event.time_ns <= after);
        last = event.time_ns;
    }
    assert_int_equal(knurl_events_next(&ring, &event), 0);
}

TEST(the_ring_keeps_the_latest_64_and_counts_all) {
    static const int bursts[] = {1, 63, 64, 65, 127, 128, 1000, 12345};
    for (size_t i = 0; i < COUNT_OF(bursts); i++) {
        knurl_device_event event;
        const int first = bursts[i] > 64 ? bursts[i] - 64 : 0;
        memset(&ring, 0, sizeof ring);
        report_numbers(0, bursts[i]);
        assert_int_equal(ring.head, bursts[i]);
        check_numbers(first, bursts[i]);
        assert_int_equal(knurl_events_next(&ring, &event), 0);
        report_numbers(-5, -4);
        check_numbers(-5, -4);
    }
}

static uint32_t writers; /* atomic: at work */

/* Values contain writer and number, codes the number, so torn events are detected. */
static void *report_many(void *which) {
    const int32_t base = *(const int32_t *)which;
    for (int32_t i = 0; i < REPORTS; i++) {
        knurl_events_report(&ring, base + i, base + i);
    }
    (void)__atomic_fetch_sub(&writers, 1, __ATOMIC_RELEASE);
    return NULL;
}

TEST(two_writers_and_a_reader_see_nothing_torn_and_each_writers_events_in_order) {
    static int32_t bases[] = {0, 1000000};
    int32_t latest[] = {-1, -1};
    pthread_t threads[2];
    knurl_device_event event;
    uint32_t at_work;
    memset(&ring, 0, sizeof ring);
    writers = 2;
    for (size_t i = 0; i < 2; i++) {
        assert_int_equal(pthread_create(&threads[i], NULL, report_many, &bases[i]), 0);
    }
    uint64_t seen = 0;
    do {
        at_work = __atomic_load_n(&writers, __ATOMIC_ACQUIRE);
        while (knurl_events_next(&ring, &event)) {
            const int which = event.code >= bases[1];
            CHECK_SAME(event.value, (long double)event.code);
            assert_true(event.code - bases[which] > latest[which]);
            latest[which] = event.code - bases[which];
            seen++;
        }
    } while (at_work > 0);
    for (size_t i = 0; i < 2; i++) {
        assert_int_equal(pthread_join(threads[i], NULL), 0);
    }
    assert_true(ring.head == 2 * (uint64_t)REPORTS);
    assert_true(seen >= 60); /* the last 64, less one whose writer was held up */
    assert_true(latest[0] == REPORTS - 1 || latest[1] == REPORTS - 1);
}

/* A thread may be held up anywhere, also between taking its number and writing its event down, while others report more
 * than the ring has room for. Its late write must neither be read as one of theirs, nor block later events. */
TEST(a_writer_that_is_held_up_for_a_whole_ring_costs_one_event_and_tears_none) {
    for (int is_inside = 0; is_inside < 2; is_inside++) {
        knurl_device_event event;
        memset(&ring, 0, sizeof ring);
        report_numbers(0, 10);
        const uint64_t held_up = ring.head++;
        const size_t at = held_up % KNURL_EVENT_ROOM;
        if (is_inside) {
            ring.slots[at].sequence = 2 * held_up + 1;
        }
        report_numbers(11, 100);
        ring.slots[at].code = is_inside ? -77 : ring.slots[at].code;
        if (is_inside) {
            ring.slots[at].sequence = 2 * held_up + 2;
        }
        int count = 0;
        for (double last = 0.0; knurl_events_next(&ring, &event); last = event.value) {
            assert_int_equal(event.code, (int)event.value % 7);
            assert_true(event.value > last);
            count++;
        }
        assert_in_range(count, 63, 64);
        CHECK_SAME(event.value, 99.0L);
        report_numbers(100, 300); /* the slot works as before */
        check_numbers(236, 300);
    }
}

/* --- names --- */

/* Copied from the header's documentation: a changed constant breaks compiled callers. */
static const struct {
    int32_t code;
    int32_t number;
    const char *name;
    const char *word; /* of its sentence */
    const char *unit; /* of its value */
} faults[] = {
    {KNURL_FAULT_LOST, 1, "lost", "unplugged", ""},
    {KNURL_FAULT_SILENT, 2, "silent", "no position", "s"},
    {KNURL_FAULT_CORRUPT, 3, "corrupt", "discarded", "bytes"},
    {KNURL_FAULT_NOT_FINITE, 4, "not_finite", "not a number", ""},
    {KNURL_FAULT_JUMP, 5, "jump", "hand", "m"},
    {KNURL_FAULT_LATE, 6, "late", "too old", "s"},
    {KNURL_FAULT_OVERRUN, 7, "overrun", "late", "s"},
    {KNURL_FAULT_WATCHDOG, 8, "watchdog", "haptic thread", "s"},
    {KNURL_FAULT_HEARTBEAT, 9, "heartbeat", "game", "s"},
    {KNURL_FAULT_REFUSED, 10, "refused", "refused", "(its own code)"},
    {KNURL_FAULT_UNCALIBRATED, 11, "uncalibrated", "not homed", ""},
    {KNURL_FAULT_UNGUARDED, 12, "unguarded", "guard process", ""},
    {KNURL_FAULT_GAP, 13, "gap", "paused", "s"},
    {KNURL_FAULT_FORCE_OFF, 17, "force_off", "forces off", ""},
    {KNURL_FAULT_RESUMED, 32, "resumed", "no fault", ""},
    {KNURL_FAULT_RECONNECTED, 33, "reconnected", "no fault", ""},
};

TEST(every_fault_has_its_number_its_name_a_sentence_and_a_unit) {
    for (size_t i = 0; i < COUNT_OF(faults); i++) {
        assert_int_equal(faults[i].code, faults[i].number);
        assert_string_equal(knurl_fault_name(faults[i].code), faults[i].name);
        assert_non_null(strstr(knurl_fault_string(faults[i].code), faults[i].word));
        assert_string_equal(knurl_fault_unit(faults[i].code), faults[i].unit);
        for (size_t k = 0; k < i; k++) {
            assert_string_not_equal(knurl_fault_string(faults[i].code), knurl_fault_string(faults[k].code));
        }
    }
}

TEST(unknown_codes_have_texts_too) {
    static const int32_t unknown[] = {0, -1, 18, 31, 35, INT32_MAX, INT32_MIN};
    for (size_t i = 0; i < COUNT_OF(unknown); i++) {
        assert_string_equal(knurl_fault_name(unknown[i]), "unknown");
        assert_string_equal(knurl_fault_unit(unknown[i]), "");
        assert_true(strlen(knurl_fault_string(unknown[i])) > 10);
    }
}

TEST(why_a_device_has_switched_its_forces_off_has_a_sentence) {
    static const struct {
        double value;
        const char *word;
    } cases[] = {{KNURL_FORCE_OFF_UNTOLD, "no reason given"},
                 {KNURL_FORCE_OFF_BUTTON, "force button"},
                 {KNURL_FORCE_OFF_VELOCITY, "faster"},
                 {KNURL_FORCE_OFF_WATCHDOG, "no command"},
                 {KNURL_FORCE_OFF_SOFTWARE, "library"},
                 {KNURL_FORCE_OFF_CABLE, "cable"},
                 {KNURL_FORCE_OFF_DEADMAN, "released"},
                 {KNURL_FORCE_OFF_POWER, "power supply"},
                 {KNURL_FORCE_OFF_NOT_READY, "is not ready"},
                 {KNURL_FORCE_OFF_BRAKE, "emergency brake"},
                 {10.0, "no reason given"},
                 {-1.0, "no reason given"},
                 {(double)NAN, "no reason given"},
                 {1e300, "no reason given"}};
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        assert_non_null(strstr(knurl_fault_cause(KNURL_FAULT_FORCE_OFF, cases[i].value), cases[i].word));
        assert_string_equal(knurl_fault_cause(KNURL_FAULT_REFUSED, cases[i].value), "");
    }
}
