/* Ridges from a picture: knurl tag --from-texture and --from-picture. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEXTURE_H
#define KNURL_TEXTURE_H

#include "picture.h"
#include "ridges.h"
#include "whole_file.h"

#include <knurl/base.h>

/* A picture whose ridges are searched, and its size on the surface. */
typedef struct texture {
    const unsigned char *data; /* its file */
    size_t size;
    const char *use;  /* "normal", "occlusion", "base colour", "height", or "picture": normals are recognised */
    const char *name; /* in messages */
    double map[2][2]; /* cycles/m along x and y = map (cycles across its width, down its height); 0: from metres */
    double metres[2]; /* its width and height on the surface, nearly if the map is skew; an image file's height may be
                         0: by its width and pixels */
    double depth;     /* m: a height picture's from black to white */
    double steepness; /* of a normal picture: knurl_gltf_texture.scale */
} texture;

/* The ridges that were found, in the tag's words. */
typedef struct texture_result {
    texture from;
    const char *use;        /* as it was read */
    uint32_t width, height; /* pixels */
    uint32_t step;          /* picture_part.step of the whole picture */
    int in_middle;          /* 1: the ridges were found in the picture's middle, in pixels; 0: in all of it */
    ridges found;
    double in_picture[RIDGES_AXES][2]; /* cycles across and down the picture */
    double apart[RIDGES_AXES];         /* m from ridge to ridge */
    double direction[RIDGES_AXES];     /* rad from x, counter-clockwise, across the ridges; -89.5 to 90.5 degrees */
    double amplitude[RIDGES_AXES];     /* m; NAN: a picture of colours has no heights */
    int is_regular;                    /* 0: no pattern, and no tag */
    char tag[256];                     /* a patch for knurl_gltf_set_tag() */
    const char *note;                  /* about an axis that the tag leaves out; or null. Static */
} texture_result;

/* Searches one picture. TOOL_OK, also without a pattern; or TOOL_FAILURE, and why holds the reason. */
int texture_search(const texture *from, texture_result *result, char why[256]);

/* The samples that are searched: slopes, or one brightness; the caller frees made->right. 0 if there is no memory. */
int texture_field(const texture_result *r, const picture_part *part, field *made);

/* Draws the picture with the ridges over it, and its spectrum, as an SVG. TOOL_OK, or TOOL_FAILURE having said why. */
int texture_draw(const texture_result *result, const char *path);

/* --- knurl tag (from_texture.c, or from_texture_none.c) --- */

typedef struct texture_options {
    int from_texture;         /* 1: the object's own textures */
    const char *from_picture; /* or null: an image file */
    const char *drawing;      /* or null: path of the SVG */
    double size[2];           /* m: of the image file; the second is 0: by its aspect */
    double depth;             /* m: the image file is a height map; 0: it is not */
} texture_options;

/* Finds the ridges for the object in a file (null: from_picture alone), and the tag's keys. print: 1: as JSON, too.
 * TOOL_OK, TOOL_CHECK having said that there is no pattern, or another code having said why. */
int texture_keys(const texture_options *options, const whole_file *file, const char *path, const char *array,
                 uint32_t index, int print, int pretty, char keys[256]);

#endif
