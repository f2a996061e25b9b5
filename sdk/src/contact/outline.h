/* The outline of a flat sheet. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_OUTLINE_H
#define KNURL_SRC_OUTLINE_H

#include "contact/plane.h"
#include "contact/sheet.h"

/* Fills in the plane's outline, counter-clockwise in the sheet's x and y. *error: m, largest distance of the vertices
 * left out from the outline. *why: set if the sheet cannot be a plane. Errors: KNURL_ERROR_MEMORY. */
knurl_result knurl_sheet_outline(knurl_heap *heap, const knurl_sheet *sheet, knurl_plane *plane, double *error,
                                 const char **why);

#endif
