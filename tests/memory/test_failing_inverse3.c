/* An Inverse3, whose service answers, when memory runs out. SPDX-License-Identifier: MIT */
#include "memory/failing.h"

#include <libwebsockets.h>
#include <string.h>

#define CONTEXTS 2 /* of an open device: forces and states, and events */

static char uri[64];
static knurl_device *device;

static knurl_result open_it(void) {
    return knurl_device_open(uri, &device);
}

static void close_it(void) {
    knurl_device_close(device);
    device = NULL;
}

static knurl_result open_nothing(void) {
    return knurl_device_open("inverse3:?port=1", &device); /* a port without a listener */
}

static void state_of_device(char *text, size_t size) {
    (void)snprintf(text, size, "%s", device ? "open" : "none");
}

/* libwebsockets 4.3.5 (Debian 13) leaves the eventfd of a destroyed context open: measured without Knurl. */
static int files_of_a_context(void) {
    struct lws_context_creation_info info;
    memset(&info, 0, sizeof info);
    info.port = CONTEXT_PORT_NO_LISTEN;
    lws_set_log_level(0, NULL);
    lws_context_destroy(lws_create_context(&info)); /* opens what stays open for the whole process */
    const int before = failing_open_files();
    lws_context_destroy(lws_create_context(&info));
    return failing_open_files() - before;
}

TEST(an_inverse3_is_open_or_is_not_wherever_memory_runs_out) {
    const failing_call calls[] = {
        {"knurl_device_open(inverse3)", NULL, open_it, close_it, NULL, 0, 0},
        {"... of one that is not there", NULL, open_nothing, NULL, state_of_device, 1, 0},
    };
    const int left = files_of_a_context();
    failing_files_of_library = CONTEXTS * left;
    if (left > 0) {
        print_message("libwebsockets %s leaves %d files open after each context\n", lws_get_library_version(), left);
    }
    failing_run(calls, COUNT_OF(calls));
}

int main(int count, char **arguments) {
    (void)snprintf(uri, sizeof uri, "inverse3:?port=%s", count > 1 ? arguments[1] : "");
    return suite_run("failing_inverse3");
}
