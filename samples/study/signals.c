#include "study.h"

int study_signals(const char *folder) {
    (void)folder;
    fputs("knurl: study: signals is not built yet\n", stderr);
    return 1;
}
