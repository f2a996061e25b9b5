/* The CSV of a session, one row per trial. SPDX-License-Identifier: MIT */
#include "experiment.h"

#include "out.h"

#include <string.h>

/* period: ms of the medium, with gratings mm; amplitude: N, with gratings mm. block 0: training. */
const char exp_csv_header[] = "experiment,subject,answers,device,seed,sound,trial,block,period,amplitude,first,second,"
                              "preferred,rt_s,ticks,force_limit_ticks,above_nyquist_ticks,overruns,restarts,"
                              "contact_first_s,contact_second_s,softer_ticks,fault_first,fault_second";

const char *const exp_answer_names[] = {"keyboard", "buttons", "SIMULATED"};
const char *const exp_fault_names[] = {"none", "steady", "rough", "push"};

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
                              o->contact_s[1],
                              (double)o->softer_ticks};
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
    fprintf(f, ",%s,%s\n", exp_fault_names[trial->faults[0]], exp_fault_names[trial->faults[1]]);
}

void exp_chop(char *line) {
    char *end = strpbrk(line, "\r\n");
    if (end) {
        *end = 0;
    }
}
