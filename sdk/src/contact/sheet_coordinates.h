/* Surface coordinates of a flat sheet if they are affine. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_SHEET_COORDINATES_H
#define KNURL_SRC_SHEET_COORDINATES_H

#include "contact/plane.h"
#include "contact/sheet.h"

/* Rotates the sheet's x to the grating's; sets the plane's x, map, stretch and has_coordinates, relative to the sheet's
 * origin. *why: set if the sheet cannot be a plane. */
void knurl_sheet_coordinates(knurl_sheet *sheet, const double axis[3], knurl_plane *plane, const char **why);

#endif
