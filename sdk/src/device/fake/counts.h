/* Finds an encoder's counts in recorded positions. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_COUNTS_H
#define KNURL_SRC_COUNTS_H

#include "base/finite.h"

#include <knurl/base.h>

/* The quantum of recorded positions, m; 0 if they are exact, or if it is not certain that they are in counts. rows: t,
 * x, y, z. Errors: KNURL_ERROR_MEMORY. */
knurl_result knurl_counts_find(const double *rows, uint64_t row_count, double *quantum);

#endif
