/* The CSV of a session, a row a trial. SPDX-License-Identifier: MIT */
#include "experiment.h"

#include "in.h"
#include "os.h"
#include "out.h"

#include <stdlib.h>
#include <string.h>

/* period: ms of the medium, in experiment 3 mm of the grating; amplitude: N, in experiment 3 mm. */
const char exp_csv_header[] = "experiment,subject,answers,device,seed,sound,trial,block,period,amplitude,first,second,"
                              "preferred,rt_s,ticks,force_limit_ticks,above_nyquist_ticks,overruns,restarts,"
                              "contact_first_s,contact_second_s";

const char *const exp_answer_names[] = {"keyboard", "buttons", "SIMULATED"};

static const char *method_name(const exp_design *design, int32_t method) {
    return design->names[method == design->methods[1]];
}

void exp_write_record(FILE *f, const exp_session *session, uint32_t number, const exp_trial *trial,
                      const exp_outcome *o) {
    const exp_design *d = session->design;
    const double numbers[] = {o->rt_s,
                              (double)o->ticks,
                              (double)o->force_limit_ticks,
                              (double)o->above_nyquist_ticks,
                              (double)o->overruns,
                              (double)o->restarts,
                              o->contact_s[0],
                              o->contact_s[1]};
    fprintf(f, "%d,%s,%s,%s,%llu,%s,%u,%u,", (int)d->experiment, session->subject, exp_answer_names[session->answers],
            session->uri, (unsigned long long)session->seed, session->sound ? "yes" : "no", (unsigned)number,
            (unsigned)trial->block);
    out_number(f, trial->period);
    fputc(',', f);
    out_number(f, trial->amplitude);
    fprintf(f, ",%s,%s,%s", method_name(d, trial->methods[0]), method_name(d, trial->methods[1]),
            method_name(d, trial->methods[o->chosen]));
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        fputc(',', f);
        out_number(f, numbers[i]);
    }
    fputc('\n', f);
}

void exp_chop(char *line) {
    char *end = strpbrk(line, "\r\n");
    if (end) {
        *end = 0;
    }
}

int exp_may_replace(const char *path) {
    os_file existing;
    const char *why = "";
    char *line = NULL;
    size_t size = 0;
    unsigned long lines = 0;
    int may = 1;
    int too_long = 0;
    if (os_identify(path, &existing) || !existing.is_regular) {
        return 1;
    }
    FILE *f = os_open_input(path, &why);
    while (f && may && in_line(f, &line, &size, &too_long) != -1) {
        lines++;
        exp_chop(line);
        may = lines == 1 ? strcmp(line, exp_csv_header) == 0 : strstr(line, ",SIMULATED,") != NULL;
    }
    free(line);
    if (f) {
        (void)fclose(f);
    }
    return f && may && !too_long;
}
