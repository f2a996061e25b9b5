/* Vectors of three doubles, quaternions x, y, z, w: plain arrays, inlined. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_VEC3_H
#define KNURL_SRC_VEC3_H

#include "base/finite.h"

#include <math.h>

/* Inlined, unlike fmin() and fmax(). If either is NaN, the result is b. */
static inline double knurl_min(double a, double b) {
    return a < b ? a : b;
}

static inline double knurl_max(double a, double b) {
    return a > b ? a : b;
}

static inline void vec3_copy(const double a[3], double out[3]) {
    out[0] = a[0];
    out[1] = a[1];
    out[2] = a[2];
}

static inline void vec3_sub(const double a[3], const double b[3], double out[3]) {
    out[0] = a[0] - b[0];
    out[1] = a[1] - b[1];
    out[2] = a[2] - b[2];
}

/* out = a + s b */
static inline void vec3_madd(const double a[3], double s, const double b[3], double out[3]) {
    out[0] = a[0] + s * b[0];
    out[1] = a[1] + s * b[1];
    out[2] = a[2] + s * b[2];
}

static inline void vec3_scale(double s, const double a[3], double out[3]) {
    out[0] = s * a[0];
    out[1] = s * a[1];
    out[2] = s * a[2];
}

static inline double vec3_dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void vec3_cross(const double a[3], const double b[3], double out[3]) {
    const double x = a[1] * b[2] - a[2] * b[1];
    const double y = a[2] * b[0] - a[0] * b[2];
    const double z = a[0] * b[1] - a[1] * b[0];
    out[0] = x;
    out[1] = y;
    out[2] = z;
}

static inline double vec3_distance2(const double a[3], const double b[3]) {
    double difference[3];
    vec3_sub(a, b, difference);
    return vec3_dot(difference, difference);
}

static inline double vec3_length(const double a[3]) {
    return sqrt(vec3_dot(a, a));
}

/* Returns the length; leaves a zero vector as it is. */
static inline double vec3_normalise(double a[3]) {
    const double length = vec3_length(a);
    if (length > 0.0) {
        vec3_scale(1.0 / length, a, a);
    }
    return length;
}

/* Removes the component of a along the unit vector n. */
static inline void vec3_make_tangent(const double n[3], double a[3]) {
    vec3_madd(a, -vec3_dot(a, n), n, a);
}

/* |x| + |y| + |z| */
static inline double vec3_sum(const double a[3]) {
    return fabs(a[0]) + fabs(a[1]) + fabs(a[2]);
}

/* 1 if all three are finite and their sum does not overflow. */
static inline int vec3_finite(const double a[3]) {
    return knurl_is_finite(vec3_sum(a));
}

/* 1 if each is from -most to most. */
static inline int vec3_within(const double a[3], double most) {
    return fabs(a[0]) <= most && fabs(a[1]) <= most && fabs(a[2]) <= most;
}

/* Any unit vector at right angles to the unit vector n. */
static inline void vec3_any_tangent(const double n[3], double out[3]) {
    const double ax[3] = {fabs(n[0]) < 0.9 ? 1.0 : 0.0, fabs(n[0]) < 0.9 ? 0.0 : 1.0, 0.0};
    vec3_copy(ax, out);
    vec3_make_tangent(n, out);
    vec3_normalise(out);
}

/* Row-major rotation matrix of a unit quaternion. */
static inline void quat_to_matrix(const double q[4], double m[9]) {
    const double x = q[0], y = q[1], z = q[2], w = q[3];
    m[0] = 1.0 - 2.0 * (y * y + z * z);
    m[1] = 2.0 * (x * y - z * w);
    m[2] = 2.0 * (x * z + y * w);
    m[3] = 2.0 * (x * y + z * w);
    m[4] = 1.0 - 2.0 * (x * x + z * z);
    m[5] = 2.0 * (y * z - x * w);
    m[6] = 2.0 * (x * z - y * w);
    m[7] = 2.0 * (y * z + x * w);
    m[8] = 1.0 - 2.0 * (x * x + y * y);
}

static inline void mat3_mul(const double m[9], const double a[3], double out[3]) {
    const double x = m[0] * a[0] + m[1] * a[1] + m[2] * a[2];
    const double y = m[3] * a[0] + m[4] * a[1] + m[5] * a[2];
    const double z = m[6] * a[0] + m[7] * a[1] + m[8] * a[2];
    out[0] = x;
    out[1] = y;
    out[2] = z;
}

/* By the transpose: the inverse of a rotation. */
static inline void mat3_mul_transposed(const double m[9], const double a[3], double out[3]) {
    const double x = m[0] * a[0] + m[3] * a[1] + m[6] * a[2];
    const double y = m[1] * a[0] + m[4] * a[1] + m[7] * a[2];
    const double z = m[2] * a[0] + m[5] * a[1] + m[8] * a[2];
    out[0] = x;
    out[1] = y;
    out[2] = z;
}

#endif
