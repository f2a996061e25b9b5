/* Spatial methods: their properties and height functions, in one table. A new method is a number in <knurl/grating.h>,
 * a height function and a row in methods.c. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_METHOD_H
#define KNURL_SRC_METHOD_H

#include <knurl/grating.h>

/* Along a surface's x and y. Passed by value, so that it stays in registers: storing two numbers and at once loading
 * them as one vector takes a third of a tick's time. */
typedef struct knurl_along {
    double x, y;
} knurl_along;

/* Where a HIP is on a grating, and how fast it moves there. */
typedef struct knurl_grating_input {
    knurl_along position; /* m; not used unless has_position */
    knurl_along velocity; /* m/s */
    double period;        /* s: 1/f_h */
    int32_t has_position;
} knurl_grating_input;

/* The height of this tick, m, if no event is playing. output: set up, but for the height; a method may set `event`. */
typedef double knurl_height(const knurl_grating *grating, knurl_grating_state *state, knurl_along position,
                            knurl_along velocity, double period, int32_t has_position,
                            knurl_grating_output *output) KNURL_NONBLOCKING;

/* The library's own, in files of their names; S1 and S2 in paper.c. */
knurl_height knurl_s1_height, knurl_s2_height, knurl_bandlimited_height;

typedef struct knurl_method {
    const char *name;
    knurl_height *height;
    double crest;             /* A: the highest height */
    double swing;             /* A: from the lowest height to the highest */
    int32_t follows_position; /* 1: ridges are at surface coordinates; 0: counted in metres along the path */
    int32_t needs_position;   /* 1: cannot do without surface coordinates */
} knurl_method;

/* Numbers below it are the library's own; the caller's own methods follow. */
#define KNURL_BUILT_IN_METHODS (KNURL_METHOD_BANDLIMITED + 1)
#define KNURL_OWN_METHODS      16

/* By number, KNURL_METHOD_S1 and on; the first row is unused. A row never changes once it is counted. */
extern knurl_method knurl_methods[KNURL_BUILT_IN_METHODS + KNURL_OWN_METHODS];
extern int32_t knurl_method_count; /* atomic */

#endif
