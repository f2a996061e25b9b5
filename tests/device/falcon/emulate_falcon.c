/* umockdev-wrapper emulate_falcon [--unplug-after S] [--no-firmware] [--split] [--busy] [--unhomed FRAMES] --
 * COMMAND...: runs a command on a machine to which an emulated Falcon is connected, its hand stroking along x a
 * millimetre below the middle of its workspace; exits as the command does. SPDX-License-Identifier: MIT */
#include "falcon_emulated.h"
#include "falcon_image.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

/* --no-firmware: needs the image of this size from falcon_image_make(). */
#define IMAGE_SIZE 4096

static int run(char **command) {
    int status = 0;
    const pid_t pid = fork();
    if (pid == 0) {
        (void)execvp(command[0], command);
        perror(command[0]);
        _exit(127);
    }
    if (pid < 0 || waitpid(pid, &status, 0) != pid) {
        perror("emulate_falcon");
        return 126;
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

int main(int argc, char **argv) {
    falcon_emulation setup;
    int at = 1;
    memset(&setup, 0, sizeof setup);
    falcon_sim_init(&setup.sim, NULL);
    for (; at < argc && strcmp(argv[at], "--") != 0; at++) {
        if (strcmp(argv[at], "--unplug-after") == 0 && at + 1 < argc) {
            setup.unplug_after = strtod(argv[++at], NULL);
        } else if (strcmp(argv[at], "--no-firmware") == 0) {
            uint8_t image[IMAGE_SIZE];
            falcon_sim_forget_firmware(&setup.sim, IMAGE_SIZE, falcon_image_make(image, IMAGE_SIZE));
        } else if (strcmp(argv[at], "--busy") == 0) {
            setup.is_held = 1;
        } else if (strcmp(argv[at], "--split") == 0) {
            setup.is_split = 1;
        } else if (strcmp(argv[at], "--unhomed") == 0 && at + 1 < argc) {
            setup.sim.unhomed_for = strtoul(argv[++at], NULL, 10);
        } else {
            at = argc;
        }
    }
    if (at + 1 >= argc) {
        (void)fputs(
            "emulate_falcon [--unplug-after S] [--no-firmware] [--split] [--busy] [--unhomed FRAMES] -- COMMAND...\n",
            stderr);
        return 2;
    }
    if (!falcon_emulated_start(&setup)) {
        return 2;
    }
    const int code = run(argv + at + 1);
    falcon_emulated_stop();
    return code;
}
