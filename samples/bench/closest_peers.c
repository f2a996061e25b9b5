/* The loops of closest.py, which compiles this file: knurl_scene_find_closest(), and Embree's point query with the
 * closest point of a triangle as in Embree's own tutorial (Ericson 2005). SPDX-License-Identifier: MIT */
#include <knurl/knurl.h>

#include <dlfcn.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define PUBLIC __attribute__((visibility("default")))

static double now_ns(void) {
    struct timespec t;
    (void)clock_gettime(CLOCK_MONOTONIC, &t);
    return 1e9 * (double)t.tv_sec + (double)t.tv_nsec;
}

/* Query i begins at answer i - 1. */
enum { ALONE, FOLLOWED };

PUBLIC knurl_scene *peer_knurl_make(const float *positions, uint32_t vertices, const uint32_t *indices,
                                    uint64_t corners) {
    knurl_scene *scene = NULL;
    knurl_surface_desc surface;
    knurl_mesh_desc mesh;
    knurl_material_desc material;
    knurl_material_desc_init(&material, sizeof material);
    knurl_surface_desc_init(&surface, sizeof surface);
    knurl_mesh_desc_init(&mesh, sizeof mesh);
    mesh.positions = positions;
    mesh.vertex_count = vertices;
    mesh.indices = indices;
    mesh.index_count = corners;
    surface.mesh = &mesh;
    surface.material = &material;
    if (knurl_scene_create(NULL, &scene) || knurl_scene_add_surface(scene, &surface, NULL) ||
        knurl_scene_commit(scene)) {
        return NULL;
    }
    return scene;
}

PUBLIC void peer_knurl_free(knurl_scene *scene) {
    knurl_scene_destroy(scene);
}

/* Returns ns a query; distances: m. */
PUBLIC double peer_knurl_run(const knurl_scene *scene, const double *points, uint32_t count, double radius, int mode,
                             double *distances) {
    knurl_surface_point found;
    knurl_surface_point_init(&found, sizeof found);
    const double before = now_ns();
    for (uint32_t i = 0; i < count; i++) {
        if (mode == ALONE) {
            found.surface = 0;
        }
        (void)knurl_scene_find_closest(scene, points + 3 * (size_t)i, radius, &found);
        distances[i] = found.distance;
    }
    return (now_ns() - before) / count;
}

/* --- Embree 4: the part of its interface that is used (embree4/rtcore.h; Apache 2.0) --- */

typedef struct point_query {
    float x, y, z, time, radius;
} __attribute__((aligned(16))) point_query;

typedef struct query_context {
    float world2inst[16], inst2world[16];
    unsigned instance, instance_primitive, stack_size;
} __attribute__((aligned(16))) query_context;

typedef struct query_arguments {
    point_query *query;
    void *user;
    unsigned primitive, geometry;
    query_context *context;
    float similarity_scale;
} query_arguments;

typedef int query_function(query_arguments *);

static struct {
    void *(*new_device)(const char *);
    void *(*new_scene)(void *);
    void *(*new_geometry)(void *, int);
    void (*set_buffer)(void *, int, unsigned, int, const void *, size_t, size_t, size_t);
    void (*set_quality)(void *, int);
    void (*commit_geometry)(void *);
    unsigned (*attach)(void *, void *);
    void (*commit_scene)(void *);
    void (*release_scene)(void *);
    int (*query)(void *, point_query *, query_context *, query_function *, void *);
} rtc;

static const float *embree_positions;
static const uint32_t *embree_indices;

PUBLIC int peer_embree_load(const char *path) {
    void *library = dlopen(path, RTLD_NOW);
    static const char *const names[] = {"rtcNewDevice",
                                        "rtcNewScene",
                                        "rtcNewGeometry",
                                        "rtcSetSharedGeometryBuffer",
                                        "rtcSetSceneBuildQuality",
                                        "rtcCommitGeometry",
                                        "rtcAttachGeometry",
                                        "rtcCommitScene",
                                        "rtcReleaseScene",
                                        "rtcPointQuery"};
    void **to = (void **)&rtc;
    for (size_t i = 0; library && i < sizeof names / sizeof *names; i++) {
        to[i] = dlsym(library, names[i]);
        if (!to[i]) {
            return 1;
        }
    }
    return !library;
}

PUBLIC void *peer_embree_make(const float *positions, uint32_t vertices, const uint32_t *indices, uint64_t corners) {
    enum { TRIANGLE = 0, INDEX = 0, VERTEX = 1, FLOAT3 = 0x9003, UINT3 = 0x5003, HIGH = 2 };
    void *device = rtc.new_device("threads=1,set_affinity=0");
    void *scene = rtc.new_scene(device);
    void *geometry = rtc.new_geometry(device, TRIANGLE);
    rtc.set_buffer(geometry, VERTEX, 0, FLOAT3, positions, 0, 12, vertices);
    rtc.set_buffer(geometry, INDEX, 0, UINT3, indices, 0, 12, corners / 3);
    rtc.commit_geometry(geometry);
    (void)rtc.attach(scene, geometry);
    rtc.set_quality(scene, HIGH);
    rtc.commit_scene(scene);
    embree_positions = positions;
    embree_indices = indices;
    return scene;
}

PUBLIC void peer_embree_free(void *scene) {
    rtc.release_scene(scene);
}

static void sub(const float a[3], const float b[3], float out[3]) {
    for (int i = 0; i < 3; i++) {
        out[i] = a[i] - b[i];
    }
}

static float dot(const float a[3], const float b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void mix(const float a[3], const float ab[3], float v, const float ac[3], float w, float out[3]) {
    for (int i = 0; i < 3; i++) {
        out[i] = a[i] + v * ab[i] + w * ac[i];
    }
}

static void closest_on_triangle(const float p[3], const float a[3], const float b[3], const float c[3], float out[3]) {
    float ab[3], ac[3], ap[3], bp[3], cp[3];
    sub(b, a, ab);
    sub(c, a, ac);
    sub(p, a, ap);
    const float d1 = dot(ab, ap), d2 = dot(ac, ap);
    if (d1 <= 0.0F && d2 <= 0.0F) {
        mix(a, ab, 0.0F, ac, 0.0F, out);
        return;
    }
    sub(p, b, bp);
    const float d3 = dot(ab, bp), d4 = dot(ac, bp);
    if (d3 >= 0.0F && d4 <= d3) {
        mix(a, ab, 1.0F, ac, 0.0F, out);
        return;
    }
    sub(p, c, cp);
    const float d5 = dot(ab, cp), d6 = dot(ac, cp);
    if (d6 >= 0.0F && d5 <= d6) {
        mix(a, ab, 0.0F, ac, 1.0F, out);
        return;
    }
    const float vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
    if (vc <= 0.0F && d1 >= 0.0F && d3 <= 0.0F) {
        mix(a, ab, d1 / (d1 - d3), ac, 0.0F, out);
    } else if (vb <= 0.0F && d2 >= 0.0F && d6 <= 0.0F) {
        mix(a, ab, 0.0F, ac, d2 / (d2 - d6), out);
    } else if (va <= 0.0F && d4 - d3 >= 0.0F && d5 - d6 >= 0.0F) {
        const float w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        mix(a, ab, 1.0F - w, ac, w, out);
    } else {
        const float scale = 1.0F / (va + vb + vc);
        mix(a, ab, vb * scale, ac, vc * scale, out);
    }
}

static int visit(query_arguments *q) {
    const uint32_t *v = &embree_indices[3 * (size_t)q->primitive];
    const float p[3] = {q->query->x, q->query->y, q->query->z};
    float closest[3], off[3];
    closest_on_triangle(p, &embree_positions[3 * (size_t)v[0]], &embree_positions[3 * (size_t)v[1]],
                        &embree_positions[3 * (size_t)v[2]], closest);
    sub(p, closest, off);
    const float distance = sqrtf(dot(off, off));
    if (distance < q->query->radius) {
        q->query->radius = distance;
        memcpy(q->user, closest, sizeof closest);
        return 1;
    }
    return 0;
}

/* As peer_knurl_run(). A followed query has the distance of its point to the last answer as its radius. */
PUBLIC double peer_embree_run(void *scene, const double *points, uint32_t count, double radius, int mode,
                              double *distances) {
    float closest[3];
    const double before = now_ns();
    for (uint32_t i = 0; i < count; i++) {
        const double *at = points + 3 * (size_t)i;
        const float p[3] = {(float)at[0], (float)at[1], (float)at[2]};
        query_context context = {{0.0F}, {0.0F}, ~0U, ~0U, 0};
        float limit = (float)radius;
        if (mode == FOLLOWED && i > 0) {
            float off[3];
            sub(p, closest, off);
            limit = fminf(limit, sqrtf(dot(off, off)) * 1.00001F);
        }
        point_query query = {p[0], p[1], p[2], 0.0F, limit};
        (void)rtc.query(scene, &query, &context, visit, closest);
        distances[i] = (double)query.radius;
    }
    return (now_ns() - before) / count;
}
