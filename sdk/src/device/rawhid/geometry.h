/* The mechanics of a WoodenHaptics or similar device, read from a text file, so that a variant needs no code: one
 * `key = value` per line, comments from # on, SI units.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_RAWHID_GEOMETRY_H
#define KNURL_SRC_RAWHID_GEOMETRY_H

#include "base/number.h"
#include "device/rawhid/kinematics.h"

#include <knurl/base.h>

#include <stddef.h>

/* Minimum, maximum and unit of each quantity. */
#define KNURL_RAWHID_ID       0, 65535, ""
#define KNURL_RAWHID_USAGE    1, 65535, ""
#define KNURL_RAWHID_REPORT   0, 64, "bytes"
#define KNURL_RAWHID_HEIGHT   0.0, 1.0, "m"
#define KNURL_RAWHID_LINK     0.01, 1.0, "m"
#define KNURL_RAWHID_ORIGIN   -1.0, 1.0, "m"
#define KNURL_RAWHID_DIAMETER 0.001, 1.0, "m"
#define KNURL_RAWHID_COUNTS   16, 1000000, "counts a turn"
#define KNURL_RAWHID_SIGN     -1, 1, ""
#define KNURL_RAWHID_TORQUE   0.0001, 10.0, "N m/A"
#define KNURL_RAWHID_HOME     -32768, 32767, "counts"
#define KNURL_RAWHID_FLAG     0, 1, ""
#define KNURL_RAWHID_CURRENT  0.001, 2.0, "A"
#define KNURL_RAWHID_RADIUS   0.001, 1.0, "m"

/* Every key except `name`: key, field, default, range, kind. The defaults are WoodenHaptics v2015:
 * lengths, diameters, counts, torque constants (Maxon RE 30 310007), signs, home, workspace radius and the limit of 2 A
 * as in its makers' interface; 1000 N/m and 8 N s/m from CHAI3D, whose 5 N are reduced to 3 N, which 2 A can give; the
 * continuous force, heat time, mass and frictions are assumed. No file can raise the 2 A: the makers' amplifiers (Escon
 * 24/4) cannot sustain more, and their firmware stops only at 3 A. */
#define KNURL_RAWHID_KEYS(X)                                                                                           \
    X(vendor, vendor, 0, KNURL_RAWHID_ID, HEX)   /* 0: any known device */                                             \
    X(product, product, 0, KNURL_RAWHID_ID, HEX) /* 0: any known device */                                             \
    X(usage_page, usage_page, 0xffab, KNURL_RAWHID_USAGE, HEX)                                                         \
    X(usage, usage, 0x0200, KNURL_RAWHID_USAGE, HEX)                                                                   \
    X(report_bytes, report_bytes, 0, KNURL_RAWHID_REPORT, WHOLE) /* 0: of the known device, or 64 */                   \
    X(length_a, length[0], 0.080, KNURL_RAWHID_HEIGHT, REAL)     /* shoulder above the base */                         \
    X(length_b, length[1], 0.205, KNURL_RAWHID_LINK, REAL)       /* shoulder to elbow */                               \
    X(length_c, length[2], 0.245, KNURL_RAWHID_LINK, REAL)       /* elbow to grip */                                   \
    X(origin_x, origin[0], 0.220, KNURL_RAWHID_ORIGIN, REAL)     /* workspace centre from the base, the arm's axes */  \
    X(origin_y, origin[1], 0.0, KNURL_RAWHID_ORIGIN, REAL)                                                             \
    X(origin_z, origin[2], 0.080, KNURL_RAWHID_ORIGIN, REAL)                                                           \
    X(capstan_a, capstan[0], 0.010, KNURL_RAWHID_DIAMETER, REAL) /* diameters */                                       \
    X(capstan_b, capstan[1], 0.010, KNURL_RAWHID_DIAMETER, REAL)                                                       \
    X(capstan_c, capstan[2], 0.010, KNURL_RAWHID_DIAMETER, REAL)                                                       \
    X(body_a, body[0], 0.160, KNURL_RAWHID_DIAMETER, REAL)                                                             \
    X(body_b, body[1], 0.120, KNURL_RAWHID_DIAMETER, REAL)                                                             \
    X(body_c, body[2], 0.120, KNURL_RAWHID_DIAMETER, REAL)                                                             \
    X(counts_a, counts[0], 2000, KNURL_RAWHID_COUNTS, WHOLE)                                                           \
    X(counts_b, counts[1], 2000, KNURL_RAWHID_COUNTS, WHOLE)                                                           \
    X(counts_c, counts[2], 2000, KNURL_RAWHID_COUNTS, WHOLE)                                                           \
    X(sign_a, sign[0], 1, KNURL_RAWHID_SIGN, SIGN) /* -1: the motor turns the body backwards */                        \
    X(sign_b, sign[1], 1, KNURL_RAWHID_SIGN, SIGN)                                                                     \
    X(sign_c, sign[2], 1, KNURL_RAWHID_SIGN, SIGN)                                                                     \
    X(torque_constant_a, torque_constant[0], 0.0259, KNURL_RAWHID_TORQUE, REAL)                                        \
    X(torque_constant_b, torque_constant[1], 0.0259, KNURL_RAWHID_TORQUE, REAL)                                        \
    X(torque_constant_c, torque_constant[2], 0.0259, KNURL_RAWHID_TORQUE, REAL)                                        \
    X(home_a, home[0], 0, KNURL_RAWHID_HOME, WHOLE) /* encoder counts in the home pose */                              \
    X(home_b, home[1], 0, KNURL_RAWHID_HOME, WHOLE)                                                                    \
    X(home_c, home[2], 6000, KNURL_RAWHID_HOME, WHOLE)                                                                 \
    X(home_on_open, home_on_open, 0, KNURL_RAWHID_FLAG, WHOLE) /* 1: as ?home=1 */                                     \
    X(max_current, max_current, 2.0, KNURL_RAWHID_CURRENT, REAL)                                                       \
    X(max_force, max_force, 3.0, KNURL_RANGE_FORCE, REAL)                                                              \
    X(continuous_force, continuous_force, 1.7, KNURL_RANGE_FORCE, REAL)                                                \
    X(heat_time, heat_time, 60.0, KNURL_RANGE_HEAT_TIME, REAL)                                                         \
    X(max_stiffness, max_stiffness, 1000.0, KNURL_RANGE_STIFFNESS, REAL)                                               \
    X(workspace_radius, workspace_radius, 0.100, KNURL_RAWHID_RADIUS, REAL)                                            \
    X(mass, mass, 0.2, KNURL_RANGE_MASS, REAL)                                                                         \
    X(viscous, viscous, 0.5, KNURL_RANGE_VISCOUS, REAL)                                                                \
    X(coulomb, coulomb, 0.3, KNURL_RANGE_COULOMB, REAL)

typedef struct knurl_rawhid_geometry {
    char name[64];
    double vendor, product, usage_page, usage, report_bytes;
    double length[3], origin[3], capstan[3], body[3], counts[3], sign[3], torque_constant[3], home[3];
    double home_on_open;
    double max_current, max_force, continuous_force, heat_time, max_stiffness;
    double workspace_radius, mass, viscous, coulomb;
} knurl_rawhid_geometry;

#define KNURL_RAWHID_FILE_ROOM 65536 /* size limit of a geometry file */

/* Sets the defaults: WoodenHaptics v2015. */
void knurl_rawhid_geometry_init(knurl_rawhid_geometry *geometry);

/* Parses a file's text; missing keys keep their defaults. `where`: the file, for messages. Errors: KNURL_ERROR_FORMAT:
 * file, line, key, expected, found. */
knurl_result knurl_rawhid_geometry_parse(const char *where, const char *text, size_t size,
                                         knurl_rawhid_geometry *geometry);

/* Reads and parses a file. Further errors: KNURL_ERROR_IO, KNURL_ERROR_MEMORY. */
knurl_result knurl_rawhid_geometry_load(const char *path, knurl_rawhid_geometry *geometry);

/* Derives the arm from a checked geometry. */
void knurl_rawhid_arm_init(knurl_rawhid_arm *arm, const knurl_rawhid_geometry *geometry);

#endif
