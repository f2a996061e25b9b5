/* The mechanics of a WoodenHaptics or a similar device, from a text file, so that a variant needs no code: one `key =
 * value` per line, comments from # on, SI units.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_RAWHID_GEOMETRY_H
#define KNURL_SRC_RAWHID_GEOMETRY_H

#include "base/finite.h"
#include "device/rawhid/kinematics.h"

#include <knurl/base.h>

#include <stddef.h>

/* Every key but `name`: key, field, default, least, greatest, unit, kind. The defaults are WoodenHaptics v2015:
 * lengths, diameters, counts, torque constants (Maxon RE 30 310007), signs, home, workspace radius and the cap of 2 A
 * as in its makers' interface; 5 N, 1000 N/m and 8 N s/m as CHAI3D has them; what its motors hold for ever, how they
 * warm up, its mass and frictions are assumed. No file can raise the 2 A: the makers' amplifiers (Escon 24/4) do no
 * more for long, and their firmware stops at 3 A only. */
#define KNURL_RAWHID_KEYS(X)                                                                                           \
    X(vendor, vendor, 0, 0, 65535, "", HEX)   /* 0: whichever is known */                                              \
    X(product, product, 0, 0, 65535, "", HEX) /* 0: whichever is known */                                              \
    X(usage_page, usage_page, 0xffab, 1, 65535, "", HEX)                                                               \
    X(usage, usage, 0x0200, 1, 65535, "", HEX)                                                                         \
    X(report_bytes, report_bytes, 0, 0, 64, "bytes", WHOLE) /* 0: as the device that is known, or 64 */                \
    X(length_a, length[0], 0.080, 0.0, 1.0, "m", REAL)      /* shoulder above the base */                              \
    X(length_b, length[1], 0.205, 0.01, 1.0, "m", REAL)     /* shoulder to elbow */                                    \
    X(length_c, length[2], 0.245, 0.01, 1.0, "m", REAL)     /* elbow to grip */                                        \
    X(origin_x, origin[0], 0.220, -1.0, 1.0, "m", REAL)     /* middle of the workspace from the base, its own axes */  \
    X(origin_y, origin[1], 0.0, -1.0, 1.0, "m", REAL)                                                                  \
    X(origin_z, origin[2], 0.080, -1.0, 1.0, "m", REAL)                                                                \
    X(capstan_a, capstan[0], 0.010, 0.001, 1.0, "m", REAL) /* diameters */                                             \
    X(capstan_b, capstan[1], 0.010, 0.001, 1.0, "m", REAL)                                                             \
    X(capstan_c, capstan[2], 0.010, 0.001, 1.0, "m", REAL)                                                             \
    X(body_a, body[0], 0.160, 0.001, 1.0, "m", REAL)                                                                   \
    X(body_b, body[1], 0.120, 0.001, 1.0, "m", REAL)                                                                   \
    X(body_c, body[2], 0.120, 0.001, 1.0, "m", REAL)                                                                   \
    X(counts_a, counts[0], 2000, 16, 1000000, "counts a turn", WHOLE)                                                  \
    X(counts_b, counts[1], 2000, 16, 1000000, "counts a turn", WHOLE)                                                  \
    X(counts_c, counts[2], 2000, 16, 1000000, "counts a turn", WHOLE)                                                  \
    X(sign_a, sign[0], 1, -1, 1, "", SIGN) /* -1: the motor turns the body the other way */                            \
    X(sign_b, sign[1], 1, -1, 1, "", SIGN)                                                                             \
    X(sign_c, sign[2], 1, -1, 1, "", SIGN)                                                                             \
    X(torque_constant_a, torque_constant[0], 0.0259, 0.0001, 10.0, "N m/A", REAL)                                      \
    X(torque_constant_b, torque_constant[1], 0.0259, 0.0001, 10.0, "N m/A", REAL)                                      \
    X(torque_constant_c, torque_constant[2], 0.0259, 0.0001, 10.0, "N m/A", REAL)                                      \
    X(home_a, home[0], 0, -32768, 32767, "counts", WHOLE) /* what the encoders say in the home pose */                 \
    X(home_b, home[1], 0, -32768, 32767, "counts", WHOLE)                                                              \
    X(home_c, home[2], 6000, -32768, 32767, "counts", WHOLE)                                                           \
    X(home_on_open, home_on_open, 0, 0, 1, "", WHOLE) /* 1: as ?home=1 */                                              \
    X(max_current, max_current, 2.0, 0.001, 2.0, "A", REAL)                                                            \
    X(max_force, max_force, 3.0, 0.1, 100.0, "N", REAL)                                                                \
    X(continuous_force, continuous_force, 1.7, 0.01, 100.0, "N", REAL)                                                 \
    X(heat_time, heat_time, 60.0, 0.1, 10000.0, "s", REAL)                                                             \
    X(max_stiffness, max_stiffness, 1000.0, 1.0, 1000000.0, "N/m", REAL)                                               \
    X(max_damping, max_damping, 8.0, 0.0, 10000.0, "N s/m", REAL)                                                      \
    X(workspace_radius, workspace_radius, 0.100, 0.001, 1.0, "m", REAL)                                                \
    X(mass, mass, 0.2, 0.001, 10.0, "kg", REAL)                                                                        \
    X(viscous, viscous, 0.5, 0.0, 1000.0, "N s/m", REAL)                                                               \
    X(coulomb, coulomb, 0.3, 0.0, 10.0, "N", REAL)

typedef struct knurl_rawhid_geometry {
    char name[64];
    double vendor, product, usage_page, usage, report_bytes;
    double length[3], origin[3], capstan[3], body[3], counts[3], sign[3], torque_constant[3], home[3];
    double home_on_open;
    double max_current, max_force, continuous_force, heat_time, max_stiffness, max_damping;
    double workspace_radius, mass, viscous, coulomb;
} knurl_rawhid_geometry;

#define KNURL_RAWHID_FILE_ROOM 65536 /* bytes of a geometry file */

/* WoodenHaptics v2015. */
void knurl_rawhid_geometry_init(knurl_rawhid_geometry *geometry);

/* Reads a file's text; keys that are not there keep their defaults. `where` is for messages.
 * Errors: KNURL_ERROR_FORMAT: file, line, key, expected, found. */
knurl_result knurl_rawhid_geometry_parse(const char *where, const char *text, size_t size,
                                         knurl_rawhid_geometry *geometry);

/* The same from a file. Errors also: KNURL_ERROR_IO, KNURL_ERROR_MEMORY. */
knurl_result knurl_rawhid_geometry_load(const char *path, knurl_rawhid_geometry *geometry);

/* Of a checked geometry. */
void knurl_rawhid_arm_init(knurl_rawhid_arm *arm, const knurl_rawhid_geometry *geometry);

#endif
