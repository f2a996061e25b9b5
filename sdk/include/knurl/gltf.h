/* Knurl: surfaces from glTF 2.0 files, tagged in `extras` (library knurl_gltf). Meshes without a tag, and images, are
 * not loaded. Schema of the tags: assets/knurl_extras.schema.json.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_GLTF_H
#define KNURL_GLTF_H

#include <knurl/scene.h>

#ifdef __cplusplus
extern "C" {
#endif

/** What a load may cost; 0 in a field is its default. Checked before memory is taken, so that a small file that asks
 * for much fails at once: KNURL_ERROR_FULL, and the message begins with the file and names the field
 * ("budget.max_bytes"). */
typedef struct knurl_gltf_budget {
    uint32_t struct_size;   /**< set by knurl_gltf_budget_init() */
    uint32_t max_surfaces;  /**< default 2^16; at most 2^20. A scene has a limit of its own, too */
    uint64_t max_bytes;     /**< of the file and its buffers, each file once; default and at most 2^30 */
    uint64_t max_vertices;  /**< elements of POSITION, TANGENT and TEXCOORD_0 read for all shapes; default 2^24 and 16
                                 for each byte read */
    uint64_t max_triangles; /**< of all shapes; what several nodes show with one scale is one shape; default 2^20 and
                                 one for each 2 bytes read; at most 2^26 */
    double max_seconds;     /**< s, looked at between steps, the longest of which is the largest shape's (about a second
                                 a million triangles); default 60 */
} knurl_gltf_budget;

/** Zeroes it and sets struct_size; `size` is the caller's sizeof. [any thread] */
KNURL_API void knurl_gltf_budget_init(knurl_gltf_budget *budget, uint32_t size);

/** What a load came to. An output: set struct_size with knurl_gltf_report_init() first. */
typedef struct knurl_gltf_report {
    uint32_t struct_size;
    uint32_t surfaces; /**< added to the scene: one a node and tagged primitive */
    uint32_t skipped;  /**< primitives that carry no tag, one a node that shows them */
    uint32_t reserved; /**< 0 */
    /** The caller's, set after knurl_gltf_report_init(), or null: told of every file that was read, the glTF file
     * before its buffers, so that it can be watched, or kept from being written over. path: UTF-8, valid during the
     * call. Called also where the load fails later. */
    void (*file_read)(void *user, const char *path);
    void *user; /**< passed to file_read and progress */
    /** The caller's, set after knurl_gltf_report_init(), or null: called on the loading thread some times a second or
     * more often, with how much is done (0 to 1, never less than before). What is not 0 stops the load:
     * KNURL_ERROR_CANCELLED; a load on a worker thread is stopped by a flag of the caller's that this looks at. */
    int32_t (*progress)(void *user, double done);
    const knurl_gltf_budget *budget; /**< the caller's, set after knurl_gltf_report_init(); null: all defaults */
} knurl_gltf_report;

/** Sets struct_size; `size` is the caller's sizeof. [any thread] */
KNURL_API void knurl_gltf_report_init(knurl_gltf_report *report, uint32_t size);

/** Loads every tagged surface of a .gltf or .glb file (recognised by its content; its name must end so) into a
 * scene, committed or not: all of them or, on an error, none. External buffers are read from the file's own folder or
 * below it, symbolic links that lead out of it are refused. Primitives of the same accessors, shown with the same scale
 * and axis, are one shape (knurl_surface_desc.shape_of), however many nodes show them. JSON nested deeper than 32, node
 * trees deeper than 1024 and coordinates beyond 1.2e30 m are refused; names are cut to 255 bytes. report:
 * may be null. Errors: KNURL_ERROR_FULL (a limit of the budget, by name), KNURL_ERROR_CANCELLED, KNURL_ERROR_IO,
 * KNURL_ERROR_FORMAT (file, object and key are named), KNURL_ERROR_UNSUPPORTED (a required extension, another glTF
 * version, a skin or morph target on a tagged mesh), and those of knurl_scene_add_surface(). Needs under 128 KiB of
 * stack. [any thread but the haptic] */
KNURL_API knurl_result knurl_gltf_load_file(knurl_scene *scene, const char *path, knurl_gltf_report *report);

/** The same from memory. data: `size` bytes of a .gltf or .glb, the caller's, not needed afterwards. name: stands for
 * the file in messages. folder: where external buffers are read from, or null to refuse them. */
KNURL_API knurl_result knurl_gltf_load_memory(knurl_scene *scene, const void *data, uint64_t size, const char *name,
                                              const char *folder, knurl_gltf_report *report);

#ifdef __cplusplus
}
#endif
#endif
