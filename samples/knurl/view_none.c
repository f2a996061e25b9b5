/* --view in a build without libwebsockets. SPDX-License-Identifier: MIT */
#include "view.h"

#include "options.h"

int view_open(const view_desc *desc, view **opened) {
    (void)desc;
    (void)opened;
    return tool_error(TOOL_FAILURE,
                      "run: --view: this knurl was built without libwebsockets, as all are for "
                      "Windows; elsewhere install libwebsockets-dev and build it again, or use ./run test");
}

const char *view_url(const view *v) {
    (void)v;
    return "";
}

void view_take(view *v, const knurl_tick_output *output) {
    (void)v;
    (void)output;
}

void view_close(view *v) {
    (void)v;
}
