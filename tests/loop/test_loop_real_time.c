/* The loop by the system's clock, which no other test here uses: they simulate time.
 * SPDX-License-Identifier: MIT */
#include "support/close.h"
#include "support/rig.h"

#include "base/system.h"

/* How promptly is the machine's; no sooner, and not much later in the end, is the loop's. */
TEST_WITH(a_quarter_of_a_second_at_1_khz_is_250_ticks_and_no_sooner_over, begin_rig, end_rig) {
    r.desc.clock = NULL;
    r.desc.watchdog_s = 1.0;
    r.desc.tick_limit = 250;
    rig_create(&r);
    const int64_t start = knurl_system_now_ns();
    rig_run(&r);
    const double took = 1e-9 * (double)(knurl_system_now_ns() - start);
    const knurl_loop_stats stats = rig_stats(&r);
    assert_int_equal(stats.state, KNURL_LOOP_DONE);
    assert_int_equal(stats.ticks, 250);
    assert_int_equal(r.calls, 250);
    assert_true(took >= 0.25 && took < 8.0);
    assert_true(stats.overruns <= 250);
    assert_true(stats.tick_ns.p50 > 0.0 && stats.tick_ns.p50 <= stats.tick_ns.p99);
    assert_true(stats.tick_ns.p99 <= 1.03 * stats.tick_ns.max + 1.0 && stats.tick_ns.max < 1e9);
    assert_true(stats.jitter_ns.p50 > 0.0 && stats.jitter_ns.p50 <= stats.jitter_ns.p99);
    assert_true(stats.jitter_ns.p99 <= 1.03 * stats.jitter_ns.max + 1.0 && stats.jitter_ns.max < 8e9);
    assert_true(stats.realtime <= 1 && stats.memory_locked <= 1);
}
