/* umockdev-wrapper emulate_rawhid -- COMMAND...: runs COMMAND on a machine with an emulated WoodenHaptics, whose hand
 * strokes along x, 1 mm below y = 0 at the middle of its workspace. Exits with COMMAND's code. SPDX-License-Identifier:
 * MIT */
#include "device/rawhid/emulated_hid.h"

#include <stdio.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

int main(int argc, char **argv) {
    emulated_hid hid;
    knurl_stroke_desc stroke;
    int status = 0;
    if (argc < 3 || strcmp(argv[1], "--") != 0) {
        (void)fprintf(stderr, "usage: umockdev-wrapper %s -- COMMAND...\n", argv[0]);
        return 2;
    }
    knurl_stroke_desc_init(&stroke, sizeof stroke);
    (void)knurl_stroke_check(&stroke); /* the default is right; this resolves its speed */
    emulated_hid_init(&hid);
    if (!emulated_hid_plug(&hid, 0xffab, 64, &stroke)) {
        return 2;
    }
    const pid_t child = fork();
    if (child == 0) {
        (void)execvp(argv[2], argv + 2);
        perror(argv[2]);
        _exit(127);
    }
    const int waited = child > 0 && waitpid(child, &status, 0) == child;
    emulated_hid_destroy(&hid);
    return waited && WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}
