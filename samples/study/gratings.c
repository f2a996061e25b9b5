#include "study.h"

int study_gratings(const char *folder) {
    (void)folder;
    fputs("knurl: study: gratings is not built yet\n", stderr);
    return 1;
}
