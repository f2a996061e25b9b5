/* Chooses the mutant, before main() and without a system call later: KNURL_MUTANT is its number, KNURL_MUTANT_MET a
 * file in which those that were reached are marked, by child processes too. SPDX-License-Identifier: MIT */
#include "mutant.h"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <unistd.h>

#define MOST 65536

static unsigned char unread[MOST];
int knurl_mutant;
unsigned char *knurl_mutant_met = unread;

__attribute__((constructor(101))) static void choose(void) {
    const char *number = getenv("KNURL_MUTANT");
    const char *path = getenv("KNURL_MUTANT_MET");
    const int file = path ? open(path, O_RDWR) : -1;
    knurl_mutant = number ? (int)strtol(number, NULL, 10) : 0;
    if (file >= 0) {
        unsigned char *met = mmap(NULL, MOST, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
        knurl_mutant_met = met == MAP_FAILED ? unread : met;
        close(file);
    }
}
