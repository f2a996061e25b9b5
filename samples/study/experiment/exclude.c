/* Excludes rows of experiment 4 by rules that are fixed before there are data.
 * SPDX-License-Identifier: MIT */
#include "experiment.h"

#include "say.h"

#include <string.h>

/* A subject's rows of one comparison, both conditions of sound. */
typedef struct subject_rows {
    uint32_t taught, right, asked, second;
} subject_rows;

static int belongs(const exp_record *r, const exp_record *of) {
    exp_design design;
    return exp_compare(of->trial.methods[0], of->trial.methods[1], &design) == TOOL_OK && exp_is_of(r, &design) &&
           strcmp(r->subject, of->subject) == 0;
}

static subject_rows count_rows(const exp_records *records, const exp_record *of) {
    subject_rows c = {0, 0, 0, 0};
    for (size_t i = 0; i < records->count; i++) {
        const exp_record *r = &records->rows[i];
        if (!belongs(r, of)) {
            continue;
        }
        if (r->trial.block == 0) {
            c.taught++;
            c.right += r->trial.faults[r->side] == EXP_GOOD;
        } else {
            c.asked++;
            c.second += (uint32_t)r->side;
        }
    }
    return c;
}

/* Why a subject's answers do not count, or null. */
static const char *subject_fault(const subject_rows *c) {
    const double most = EXP_SIDE_MOST * c->asked;
    if (c->taught < EXP_TRAINING) {
        return "no complete training";
    }
    if (c->right * EXP_TRAINING < EXP_RIGHT_LEAST * c->taught) { /* of all 12 if the subject had the training twice */
        return "too few right answers in training";
    }
    return c->second > most || c->asked - c->second > most ? "nearly always the same side" : NULL;
}

static const char *trial_fault(const exp_record *r) {
    if (r->contact_s[0] < EXP_CONTACT_S || r->contact_s[1] < EXP_CONTACT_S) {
        return "too little contact";
    }
    if (r->overruns > EXP_LATE_SHARE * r->ticks) {
        return "late ticks";
    }
    return r->force_limit_ticks > EXP_LIMIT_SHARE * r->ticks ? "force limited"
           : r->softer_ticks > EXP_LIMIT_SHARE * r->ticks    ? "wall softened"
                                                             : NULL;
}

static void exclude_subject(exp_records *records, size_t first) {
    const exp_record *of = &records->rows[first];
    const subject_rows c = count_rows(records, of);
    const char *why = subject_fault(&c);
    if (why) {
        say(stdout, "excluded: subject %s: %s (%u of %u right in training, the second chosen in %u of %u)\n",
            of->subject, why, (unsigned)c.right, (unsigned)c.taught, (unsigned)c.second, (unsigned)c.asked);
    }
    for (size_t i = records->count; why && i-- > first;) { /* the first row last: `of` is that row */
        if (belongs(&records->rows[i], of)) {
            records->rows[i].excluded = 1;
        }
    }
}

static int seen_before(const exp_records *records, size_t row) {
    for (size_t i = 0; i < row; i++) {
        if (records->rows[i].experiment == EXP_COMPARE && belongs(&records->rows[i], &records->rows[row])) {
            return 1;
        }
    }
    return 0;
}

void exp_exclude(exp_records *records) {
    for (size_t i = 0; i < records->count; i++) {
        if (records->rows[i].experiment == EXP_COMPARE && !seen_before(records, i)) {
            exclude_subject(records, i);
        }
    }
    for (size_t i = 0; i < records->count; i++) {
        exp_record *r = &records->rows[i];
        const char *why = r->experiment == EXP_COMPARE && r->trial.block > 0 && !r->excluded ? trial_fault(r) : NULL;
        if (why) {
            say(stdout, "excluded: subject %s, sound %s, trial %u: %s\n", r->subject, r->sound ? "yes" : "no",
                (unsigned)r->number, why);
            r->excluded = 1;
        }
    }
}
