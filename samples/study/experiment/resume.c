/* Decides whether a session starts, or continues after the trials in its file. SPDX-License-Identifier: MIT */
#include "experiment.h"

#include "os.h"

#include <stdlib.h>
#include <string.h>

static int is_trial(const exp_record *r, const exp_trial *t, uint32_t number) {
    return r->number == number && r->trial.block == t->block && r->trial.period == t->period &&
           r->trial.amplitude == t->amplitude && memcmp(r->trial.methods, t->methods, sizeof t->methods) == 0 &&
           memcmp(r->trial.faults, t->faults, sizeof t->faults) == 0;
}

/* 1: the rows are the session's first trials. */
static int is_beginning(const exp_session *s, const exp_records *records, const exp_trial *trials, uint32_t count) {
    int same = records->count <= count;
    for (size_t i = 0; same && i < records->count; i++) {
        const exp_record *r = &records->rows[i];
        same = exp_is_of(r, s->design) && strcmp(r->subject, s->subject) == 0 && r->seed == s->seed &&
               strncmp(r->device, s->uri, sizeof r->device - 1) == 0 && r->sound == s->sound &&
               r->simulated == (s->answers == EXP_SIMULATED) && is_trial(r, &trials[i], (uint32_t)i + 1);
    }
    return same;
}

static int read_text(const char *path, char **text) {
    const char *why = "";
    FILE *f = os_open_input(path, &why);
    char *all = calloc(1, EXP_TEXT_MAX + 1);
    const size_t size = f && all ? fread(all, 1, EXP_TEXT_MAX, f) : 0;
    if (f) {
        (void)fclose(f);
    }
    if (size == 0 || size == EXP_TEXT_MAX) {
        free(all);
        return tool_error(TOOL_FAILURE, "%s: cannot be read: %s", path, f ? "its size is wrong" : why);
    }
    all[size] = all[size - 1] == '\n' ? 0 : '\n'; /* an editor may have left the last line without its end */
    *text = all;
    return TOOL_OK;
}

int exp_resume(const exp_session *session, const exp_trial *trials, uint32_t count, uint32_t *done, char **text) {
    exp_records records = {NULL, 0, 0};
    os_file existing;
    *done = 0;
    *text = NULL;
    if (os_identify(session->out, &existing)) {
        return TOOL_OK;
    }
    if (!existing.is_regular) {
        return tool_error(TOOL_FAILURE, "%s: expected a file, which is written anew after each trial", session->out);
    }
    int code = exp_read_records(session->out, &records);
    if (code == TOOL_OK && is_beginning(session, &records, trials, count) && records.count < count) {
        *done = (uint32_t)records.count;
        code = read_text(session->out, text);
    } else if (code == TOOL_OK && !records.rows[0].simulated) {
        code = tool_error(
            TOOL_FAILURE,
            "%s: is there already and neither an unfinished part of this session nor of simulated answers; choose "
            "another --out or --subject",
            session->out);
    }
    free(records.rows);
    return code;
}
