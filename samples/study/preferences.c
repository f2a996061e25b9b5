#include "study.h"

int study_preferences(const char *folder) {
    (void)folder;
    fputs("knurl: study: preferences is not built yet\n", stderr);
    return 1;
}
