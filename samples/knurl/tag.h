/* knurl tag: its options, read and checked. SPDX-License-Identifier: MIT */
#ifndef KNURL_TAG_H
#define KNURL_TAG_H

#include "texture.h"

typedef struct tag_options {
    const char *array;  /* "materials", "meshes" or "nodes" */
    const char *object; /* a name or an index; null: the only one */
    const char *preset; /* a tag's JSON, or null */
    const char *keys;   /* a tag's JSON, or null: no key is given. Static */
    const char *out;
    int in_place, remove, list, pretty;
    texture_options texture;
} tag_options;

/* Returns TOOL_OK, or TOOL_USAGE having said why. */
int tag_read_options(int argc, char **argv, tag_options *options, const char **path);

#endif
