/* Parts of study `area`. SPDX-License-Identifier: MIT */
#ifndef KNURL_STUDY_AREA_PARTS_H
#define KNURL_STUDY_AREA_PARTS_H

#include "json.h"

/** Raw positions or a filtered way, for each encoder and rate; prints its table. 0, or 1 without memory. */
int area_positions(json_writer *json);

/** All spatial methods at steady speeds, exact positions. 0, or 1 without memory. */
int area_steady(json_writer *json);

/** The fundamental and its evenness over every whole frequency, ten start phases each; prints its table. 0, or 1
 * without memory. */
int area_levels(json_writer *json);

#endif
