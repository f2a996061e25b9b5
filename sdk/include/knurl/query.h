/* Knurl: questions to a scene (scene.h): its surfaces by number, name and place, how each was built, and whether a
 * device can render it. SPDX-License-Identifier: MIT */
#ifndef KNURL_QUERY_H
#define KNURL_QUERY_H

#include <knurl/scene.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Surfaces in the scene. [any thread but the haptic] */
KNURL_API uint32_t knurl_scene_get_surface_count(const knurl_scene *scene);

/** The id of surface number `index`, 0 <= index < count, in the order of adding; else 0. [any thread but the haptic] */
KNURL_API knurl_surface_id knurl_scene_get_surface(const knurl_scene *scene, uint32_t index);

/** Finds a surface by its whole name; if several have it, the one added first. Errors: KNURL_ERROR_UNKNOWN, with the
 * existing names. [any thread but the haptic] */
KNURL_API knurl_result knurl_scene_find_surface(const knurl_scene *scene, const char *name, knurl_surface_id *surface);

/** Bytes of a surface's name as it is reported, with the final 0; longer names are cut between characters. */
#define KNURL_NAME_SIZE 256

/** Copies a surface's name to `name`, KNURL_NAME_SIZE bytes of the caller's. Errors: KNURL_ERROR_STALE_ID.
 * [any thread but the haptic] */
KNURL_API knurl_result knurl_scene_get_surface_name(const knurl_scene *scene, knurl_surface_id surface,
                                                    char name[KNURL_NAME_SIZE]);

/** A surface as built by the scene. An output: set struct_size with knurl_surface_info_init() first. */
typedef struct knurl_surface_info {
    uint32_t struct_size;
    uint32_t triangle_count;    /**< 0 for a plane */
    uint32_t dropped_triangles; /**< left out: without area, or duplicates */
    uint32_t double_sided;      /**< 1: as given, or because triangles with a reversed twin are more than a tenth of the
                                   mesh's area (fewer are taken for mistakes), or because mixed winding leaves it
                                   without a front (halves of the same area, a Moebius strip) */
    char name[KNURL_NAME_SIZE]; /**< as from knurl_scene_get_surface_name() */
    const char *shape;          /**< "plane" or "mesh", as given; static */
    const char *model;          /**< the model that ticks use: "plane", "plane+outline" or "mesh+bvh"; static */
    uint64_t bytes; /**< memory of this surface in the scene; if its shape is shared (knurl_surface_desc.shape_of), its
                       part of it */
    double bounds_min[3];    /**< scene axes, m */
    double bounds_max[3];    /**< scene axes, m */
    double anchor[3];        /**< a point on the surface near the middle of its bounds, scene, m */
    double anchor_x[3];      /**< unit, scene: the grating's x at the anchor */
    double anchor_normal[3]; /**< unit, scene: the outward normal at the anchor */
    double anchor_reach[4]; /**< m from the anchor in a straight line along +x, -x, +y, -y to the edge of the bounds: an
                               upper limit of a flat surface's extent. Not for curved surfaces; see
                               knurl_fake_lay_stroke() */
    double stretch[3];      /**< min, mean and max of d(surface coordinate)/d(distance on the surface) along x, before
                               `orientation`; 1: undistorted. S1 and BANDLIMITED render fs times it */
    const char *why;        /**< the reason for this model, a sentence; static */
    double model_error;     /**< m: an upper bound of the model's distance from the given surface */
    uint32_t reversed_twins;   /**< triangles left out because another one has the same corners and faces the opposite
                                    side */
    uint32_t turned_triangles; /**< mixed winding: triangles turned over to face like most of their connected component,
                                  by area. If other triangles touch too closely to decide, they stay as they are: see
                                  knurl_scene_check_surface() */
    double axis[3];            /**< unit, the surface's frame: the given axis; 0 if not given */
    double stretch_y[3];       /**< as stretch, along y */
    double seam;               /**< m: edges closer than this count as connected; from the mesh's size and float32's
                                    precision */
    uint64_t touching_pairs;   /**< pairs of the mesh's triangles that touch, but not at a shared edge: T-junctions,
                                    seams, intersecting parts. Ticks near them take longer; 0: a clean mesh. A lower
                                    bound: counting ends after 96 tests, or 4 pairs, for each triangle */
    uint32_t curved_triangles; /**< felt curved, by the mesh's normals; 0: the mesh is felt as its triangles */
    uint32_t bad_normals;      /**< triangles felt flat because their normals cannot be right (knurl_mesh_desc.normals);
                                  computed normals: because it is too sharp at a corner, such as a cone's tip */
    double bulge;              /**< m: a curved surface is felt at most this far from its triangles. Contacts' proxies,
                                  knurl_scene_find_closest() and knurl_scene_cast_ray() are on the triangles */
    const char *coordinates;   /**< where they come from: "plane", "axis", "uvs", "tangents" (a direction, but no
                                    position), "box", or "box, for its uvs have no area"; static */
    double uneven;             /**< share of the area, 0 to 1, where uvs have no area, or make ridges more than
                                    KNURL_STRETCH_MAX times finer or coarser than the material's */
    uint32_t projection_seams; /**< edges between triangles whose coordinates are projected along different axes */
    int32_t smooth;            /**< KNURL_SMOOTH_, as given */
    uint32_t edges;            /**< between two triangles of a mesh; 0 for a plane */
    uint32_t hard_edges;       /**< of these, felt as edges: the felt surface's normal turns by over 0.25 degrees */
    double facet_angle[2];     /**< rad: angle between the triangles at an edge: mean by the edges' lengths, largest */
    double felt_angle[2];      /**< rad: the same of the surface as it is felt; 0 if it is smooth */
    double uv_scale[2];        /**< m of the surface for each unit of u and of v: means by area, which make uvs the
                                    surface's coordinates; 0 if `coordinates` are not "uvs" */
} knurl_surface_info;

/** Zeroes it and sets struct_size; `size` is the caller's sizeof. [any thread] */
KNURL_API void knurl_surface_info_init(knurl_surface_info *info, uint32_t size);

/** Describes a surface as built by the scene. It searches for the anchor: too slow for every frame. Errors:
 * KNURL_ERROR_STALE_ID. [any thread but the haptic] */
KNURL_API knurl_result knurl_scene_get_surface_info(const knurl_scene *scene, knurl_surface_id surface,
                                                    knurl_surface_info *info);

/** A point on a surface. An output: set struct_size with knurl_surface_point_init() first. */
typedef struct knurl_surface_point {
    uint32_t struct_size;
    uint32_t hint;            /**< for the next search, which begins at it and `surface`; no other use */
    knurl_surface_id surface; /**< 0: no point was found, and all other fields are 0 */
    double distance;          /**< m */
    double position[3];       /**< scene axes, m */
    double normal[3];         /**< unit, scene axes: outward from the front of the triangle or plane */
} knurl_surface_point;

/** Sets struct_size; `size` is the caller's sizeof. [any thread] */
KNURL_API void knurl_surface_point_init(knurl_surface_point *point, uint32_t size);

/** Finds the closest point of all surfaces in their current poses to `position` (scene axes, m, within
 * KNURL_COORDINATE_MAX), up to `radius` (m, > 0) away. Ignores gratings. If `point` holds an earlier answer, of any
 * scene, the search begins there: the answer is the same, and sooner found if it is near. Other editing threads wait,
 * ticks do not. Errors: KNURL_ERROR_ARGUMENT. [any thread but the haptic] */
KNURL_API knurl_result knurl_scene_find_closest(const knurl_scene *scene, const double position[3], double radius,
                                                knurl_surface_point *point);

/** The same for `count` positions (three numbers each): each search begins at the last one's answer, the first at
 * points[0]. points: `count`, the caller's, struct_size set in each. Errors: as above, and then no point is changed.
 * [any thread but the haptic] */
KNURL_API knurl_result knurl_scene_find_closest_batch(const knurl_scene *scene, const double *positions, uint64_t count,
                                                      double radius, knurl_surface_point *points);

/** Finds the first point at which the straight line from `from` to `to` (scene axes, m, within KNURL_COORDINATE_MAX)
 * passes through a surface in its current pose: through its front or, if it is double-sided, through either side.
 * Ignores gratings. point->distance is measured from `from`. A line that ends on a surface does not pass through it.
 * The time grows with the number of surfaces; other editing threads wait, ticks do not. Errors: KNURL_ERROR_ARGUMENT.
 * [any thread but the haptic] */
KNURL_API knurl_result knurl_scene_cast_ray(const knurl_scene *scene, const double from[3], const double to[3],
                                            knurl_surface_point *point);

/** The limits of a device that a surface can exceed. K s is its stiffness in device metres. */
enum {
    KNURL_LIMIT_STABILITY = 1, /**< K s above the closed-form bound for the HIP's rate, delay and damping */
    KNURL_LIMIT_STIFFNESS = 2, /**< K s above the device's max_stiffness */
    KNURL_LIMIT_AMPLITUDE = 4, /**< the texture's highest force swing, K A times the method's peaks, above max_force */
    KNURL_LIMIT_HEAT = 8,      /**< the texture's rms force K A above the device's continuous_force */
    KNURL_LIMIT_PERIOD = 16,   /**< ridges narrower than two of the device's position quanta */
    KNURL_LIMIT_STRETCH = 32, /**< uneven uvs: somewhere S1 and BANDLIMITED render more than KNURL_STRETCH_MAX times the
                                 material's ridges per metre, or fewer than 1 / KNURL_STRETCH_MAX */
    KNURL_LIMIT_FAR = 64, /**< farther than KNURL_FAR from the scene's origin: float32 positions are centimetres apart
                               there */
    KNURL_LIMIT_VISITS = 128,  /**< contact reaches KNURL_VISITS_MAX at one of 65 places of the mesh; or, once
                                  committed, 15 other meshes are within 1 mm of its anchor */
    KNURL_LIMIT_WINDING = 256, /**< mixed winding, turned over (knurl_surface_info.turned_triangles) or not; or reversed
                                  twins of some triangles, but not of all */
    KNURL_LIMIT_NORMALS = 512  /**< normals that cannot be right: their triangles are felt flat
                                  (knurl_surface_info.bad_normals) */
};

/** m: beyond this distance from the origin, the float32 coordinates of meshes and engines are 6 cm apart or more. */
#define KNURL_FAR 1000000.0

/** The stretch that causes a warning: an octave. Hands feel it, and a good unwrapping of uvs stays below it. */
#define KNURL_STRETCH_MAX 2.0

/** A surface's limits on a device. An output: set struct_size with knurl_surface_check_init() first. */
typedef struct knurl_surface_check {
    uint32_t struct_size;
    uint32_t exceeded;      /**< KNURL_LIMIT_ bits; 0: the surface is within all limits */
    double stiffness;       /**< N/m at the device: K times the workspace's scale */
    double stiffness_limit; /**< N/m: the lowest of its bounds */
    double amplitude;       /**< m */
    double amplitude_limit; /**< m: at the device's stiffness */
    char message[1024];     /**< a sentence for each exceeded limit: its name, the excess, the remedy; "" if there is
                                 none */
    double lowest_gain; /**< of knurl_scene_set_gains(): the weakest ridges have this share of the amplitude; 1: off */
    double lowered_hz[2]; /**< Hz: the amplitude is lowered from here to here: the range in which
                             knurl_gains_from_response() makes ridges even. 0, 0: nowhere */
} knurl_surface_check;

/** Fills in defaults; `size` is the caller's sizeof. [any thread] */
KNURL_API void knurl_surface_check_init(knurl_surface_check *check, uint32_t size);

/** Compares a surface's stiffness and amplitude with the limits of the HIP's device. Call it at load time and show the
 * message; knurl_hip_desc.clamp enforces the limits. Errors: KNURL_ERROR_ARGUMENT (hip), KNURL_ERROR_STALE_ID. [any
 * thread but the haptic] */
KNURL_API knurl_result knurl_scene_check_surface(const knurl_scene *scene, uint32_t hip, knurl_surface_id surface,
                                                 knurl_surface_check *check);

#ifdef __cplusplus
}
#endif
#endif
