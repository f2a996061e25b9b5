/* Surface coordinates of a flat sheet where they are affine. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_SHEET_COORDINATES_H
#define KNURL_SRC_SHEET_COORDINATES_H

#include "contact/plane.h"
#include "contact/sheet.h"

/* Turns the sheet's x along the grating's; fills in the plane's x, map, stretch and has_coordinates, from the sheet's
 * origin. */
void knurl_sheet_coordinates(knurl_sheet *sheet, const double axis[3], knurl_plane *plane, const char **why);

#endif
