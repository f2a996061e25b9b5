#include "study.h"

int study_temporal(const char *folder) {
    (void)folder;
    fputs("knurl: study: temporal is not built yet\n", stderr);
    return 1;
}
