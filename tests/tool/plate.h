/* The demo plate, the tag of the plate that write_plate() writes, and checks of the tool's files.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_PLATE_H
#define KNURL_TEST_PLATE_H

#include "support/tool.h"

/** Five bars. Steel, its fourth material, has no tag. */
static const char plate[] = KNURL_TEST_ASSETS "/plate_1d.glb";

/** 1 mm period along x, 0.2 mm, 400 N/m. */
#define TAG                                                                                                            \
    "{\"knurl\":{\"version\":1,\"spatial_frequency\":[1000,0],\"amplitude\":0.0002,\"stiffness\":400,\"axis\":[1,0,0]}}"

/** The first line of a run's CSV. */
#define RUN_HEADER "t,x,y,z,vx,vy,surface,depth,fs,ft,height,fx,fy,fz\n"

/** Runs `knurl` with the arguments that follow, which must go well. */
#define RUN_DONE(...)                                                                                                  \
    do {                                                                                                               \
        SCOPED_PROCESS run_ = RUN_TOOL(__VA_ARGS__);                                                                   \
        check_done(&run_);                                                                                             \
    } while (0)

/** The whole file. */
static inline void check_text(const char *path, const char *expected) {
    char *text = read_file(path);
    assert_string_equal(text, expected);
    free(text);
}

/** Every key of `keys`, apart by spaces, is in a JSON text. */
static inline void check_keys(const char *json, const char *keys) {
    char all[1024];
    (void)snprintf(all, sizeof all, "%s", keys);
    for (const char *key = strtok(all, " "); key; key = strtok(NULL, " ")) {
        char quoted[64];
        (void)snprintf(quoted, sizeof quoted, "\"%s\":", key);
        if (!strstr(json, quoted)) {
            fail_msg("no %s in %s", quoted, json);
        }
    }
}

#endif
