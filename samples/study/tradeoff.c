#include "study.h"

int study_tradeoff(const char *folder) {
    (void)folder;
    fputs("knurl: study: tradeoff is not built yet\n", stderr);
    return 1;
}
