/* knurl verify: findings, and functions that its steps share. SPDX-License-Identifier: MIT */
#include "verify.h"

#include "say.h"

#include <math.h>
#include <stdarg.h>

int verify_count(const verify *v, int verdict) {
    int count = 0;
    for (int i = 0; i < v->finding_count; i++) {
        count += v->findings[i].verdict == verdict;
    }
    return count;
}

const char *const verify_verdicts[] = {"pass", "FAIL", "not measured"};

/* "0.7 to 1", "500 or more"; "" if nothing is expected. */
void verify_range_text(const verify_finding *f, char *text, size_t size) {
    if (isnan(f->least) || isnan(f->most)) {
        text[0] = '\0';
    } else if (isinf(f->most)) {
        (void)snprintf(text, size, "%.4g or more", f->least);
    } else if (f->least == f->most) {
        (void)snprintf(text, size, "%.4g", f->least);
    } else {
        (void)snprintf(text, size, "%.4g to %.4g", f->least, f->most);
    }
}

static void print(const verify_finding *f, FILE *stream) {
    char range[64];
    verify_range_text(f, range, sizeof range);
    if (isnan(f->measured)) {
        say(stream, "  %-12s  %s: %s\n", verify_verdicts[f->verdict], f->what, f->note);
        return;
    }
    say(stream, "  %-12s  %s: %.4g%s%s, expected %s\n", verify_verdicts[f->verdict], f->what, f->measured,
        f->unit[0] ? " " : "", f->unit, range);
    if (f->note[0]) {
        say(stream, "  %-12s  %s\n", "", f->note);
    }
}

const char *verify_ask(verify *v, verify_wish wish, const char *sentence) {
    return v->person && v->person->ask(v, wish, sentence) ? "left out" : NULL;
}

const char *verify_ask_to_hold(verify *v) {
    return verify_ask(v, VERIFY_HOLD, "Hold the grip loosely in the middle, as when you feel a surface");
}

int verify_find(verify *v, const char *what, double measured, const char *unit, double least, double most,
                const char *source, const char *note, ...) {
    const int is_good = measured >= least && measured <= most;
    verify_finding *f = &v->findings[v->finding_count];
    if (v->finding_count == VERIFY_FINDINGS) {
        return is_good;
    }
    const verify_finding found = {v->step->name,
                                  what,
                                  unit,
                                  least,
                                  most,
                                  measured,
                                  source,
                                  isnan(measured) ? VERIFY_NOT_MEASURED
                                  : is_good       ? VERIFY_PASS
                                                  : VERIFY_FAIL,
                                  ""};
    *f = found;
    v->finding_count++;
    if (!is_good) {
        va_list arguments;
        va_start(arguments, note);
        (void)vsnprintf(f->note, sizeof f->note, note, arguments);
        va_end(arguments);
    }
    if (v->stream) {
        print(f, v->stream);
    }
    return is_good;
}
