/* An Inverse3, whose service answers, when memory runs out. SPDX-License-Identifier: MIT */
#include "memory/failing.h"

static char uri[64];
static knurl_device *device;

static knurl_result open_it(void) {
    return knurl_device_open(uri, &device);
}

static void close_it(void) {
    knurl_device_close(device);
    device = NULL;
}

TEST(an_inverse3_is_open_or_is_not_wherever_memory_runs_out) {
    const failing_call calls[] = {{"knurl_device_open(inverse3)", NULL, open_it, close_it, NULL, 0, 0}};
    failing_run(calls, COUNT_OF(calls));
}

int main(int count, char **arguments) {
    (void)snprintf(uri, sizeof uri, "inverse3:?port=%s", count > 1 ? arguments[1] : "");
    return suite_run("failing_inverse3");
}
