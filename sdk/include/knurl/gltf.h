/* Knurl: surfaces from glTF 2.0 files, tagged in `extras` (library knurl_gltf). Meshes without a tag, and images, are
 * not loaded. Schema of the tags: assets/knurl_extras.schema.json.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_GLTF_H
#define KNURL_GLTF_H

#include <knurl/scene.h>

#ifdef __cplusplus
extern "C" {
#endif

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
    void *user; /**< passed to file_read */
} knurl_gltf_report;

/** Sets struct_size; `size` is the caller's sizeof. [any thread] */
KNURL_API void knurl_gltf_report_init(knurl_gltf_report *report, uint32_t size);

/** Loads every tagged surface of a .gltf or .glb file (recognised by its content; its name must end so) into a
 * scene, committed or not: all of them or, on an error, none. External buffers are read from the file's own folder or
 * below it. Files above 1 GiB, JSON nested deeper than 32 and node trees deeper than 1024 are refused,
 * as are more than 2^26 triangles in all. report: may be null.
 * Errors: KNURL_ERROR_IO, KNURL_ERROR_FORMAT (file, object and key are named), KNURL_ERROR_UNSUPPORTED (a required
 * extension, another glTF version, a skin or morph target on a tagged mesh), and those of knurl_scene_add_surface().
 * Needs under 128 KiB of stack. [any thread but the haptic] */
KNURL_API knurl_result knurl_gltf_load_file(knurl_scene *scene, const char *path, knurl_gltf_report *report);

/** The same from memory. data: `size` bytes of a .gltf or .glb, the caller's, not needed afterwards. name: stands for
 * the file in messages. folder: where external buffers are read from, or null to refuse them. */
KNURL_API knurl_result knurl_gltf_load_memory(knurl_scene *scene, const void *data, uint64_t size, const char *name,
                                              const char *folder, knurl_gltf_report *report);

#ifdef __cplusplus
}
#endif
#endif
