/* Runs of the program knurl_experiment. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_EXPERIMENT_RUNS_H
#define KNURL_TEST_EXPERIMENT_RUNS_H

#include "support/tool.h"

#define RUN(...) run_tool((const char *const[]){KNURL_TEST_EXPERIMENT, __VA_ARGS__, NULL})

/** It failed with `code` and one line on standard error that holds `word`. Frees. */
static inline void check_failed(process *p, int code, const char *word) {
    if (p->signal != 0 || p->exit_code != code || strncmp(p->err, "knurl_experiment: ", 18) != 0 ||
        lines_in(p->err) != 1 || !strstr(p->err, word) || p->sizes[0] != 0) {
        fail_msg("exit %d instead of %d, wanted \"%s\": %s", p->exit_code, code, word, p->err);
    }
    process_free(p);
}

#endif
