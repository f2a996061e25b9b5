#include "study.h"

int study_device(const char *folder) {
    (void)folder;
    fputs("knurl: study: device is not built yet\n", stderr);
    return 1;
}
