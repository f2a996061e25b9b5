#include "study.h"

int study_coverage(const char *folder) {
    (void)folder;
    fputs("knurl: study: coverage is not built yet\n", stderr);
    return 1;
}
