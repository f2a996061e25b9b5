/* Watching a loop. SPDX-License-Identifier: MIT */
#include "watch.h"

#include "faults.h"
#include "os.h"

#include <unistd.h>

static int first_fault(const faults *f) {
    for (int32_t code = 0; code < FAULT_CODES; code++) {
        if (f->counts[code] > 0 && code != KNURL_FAULT_OVERRUN) {
            return code;
        }
    }
    return 0;
}

void watch_key(volatile sig_atomic_t *interrupted) {
    if (isatty(STDIN_FILENO) && os_wait_for_key() > 0) {
        *interrupted = SIGINT;
    }
}

int watch_loop(knurl_loop *loop, knurl_device *device, uint64_t ticks, double rate, int simulated,
               volatile sig_atomic_t *interrupted, knurl_loop_stats *stats) {
    faults f;
    faults_start(&f);
    if (!simulated) {
        os_forget_keys();
    }
    do {
        if (simulated) {
            (void)knurl_loop_step(loop, 20);
        } else {
            (void)knurl_loop_wait(loop, 0.02);
        }
        (void)knurl_loop_get_stats(loop, stats);
        const double now = (double)stats->ticks / rate;
        faults_show(&f, device, simulated ? now : -1.0);
        if (!simulated) {
            watch_key(interrupted);
        }
        if (*interrupted || first_fault(&f)) {
            knurl_loop_request_stop(loop);
        }
        say_progress("%5.1f of %.1f s ", now, (double)ticks / rate);
    } while (stats->state == KNURL_LOOP_RUNNING);
    say_progress_end();
    return first_fault(&f);
}
