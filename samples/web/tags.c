/* Tags that the page writes into a .glb. SPDX-License-Identifier: MIT */
#include <knurl/gltf.h>

#include <emscripten.h>
#include <stdlib.h>
#include <string.h>

static void *written;
static uint32_t written_size;

static void keep(void *user, const void *data, uint64_t size) {
    (void)user;
    free(written);
    written = malloc((size_t)size);
    written_size = written ? (uint32_t)size : 0;
    if (written) {
        memcpy(written, data, (size_t)size);
    }
}

/* Makes a copy of a .glb in which a node's tag is `tag`, see knurl_gltf_set_tag(). It is at *web_written(), and the
 * next call frees it. */
EMSCRIPTEN_KEEPALIVE int web_tag(const void *data, uint32_t size, const char *name, uint32_t node, const char *tag) {
    written_size = 0;
    const knurl_result result = knurl_gltf_set_tag(data, size, name, "nodes", node, tag, keep, NULL);
    return result || written_size ? result : knurl_fail(KNURL_ERROR_MEMORY, "%s: no memory for a copy", name);
}

EMSCRIPTEN_KEEPALIVE const void *web_written(void) {
    return written;
}

EMSCRIPTEN_KEEPALIVE uint32_t web_written_size(void) {
    return written_size;
}
