/* Knurl: surfaces from glTF 2.0 files, tagged in `extras` (library knurl_gltf). Meshes without a tag, and images, are
 * not loaded. Schema of the tags: assets/knurl_extras.schema.json.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_GLTF_H
#define KNURL_GLTF_H

#include <knurl/scene.h>

#ifdef __cplusplus
extern "C" {
#endif

/** The options of a load. Limits: 0 in a field is its default. They are checked before memory is taken, so that a small
 * file that asks for much fails at once: KNURL_ERROR_FULL, with a message that names the file and the limit
 * ("options.max_bytes"). */
typedef struct knurl_gltf_options {
    uint32_t struct_size;   /**< set by knurl_gltf_options_init() */
    uint32_t max_surfaces;  /**< default 2^16; at most 2^20. The scene's max_surfaces applies too */
    uint64_t max_bytes;     /**< of the file and its buffers, each file once; default and at most 2^30 */
    uint64_t max_vertices;  /**< elements of POSITION, NORMAL, TANGENT and TEXCOORD_0 read for all shapes; default 2^24
                               plus 16 per byte read */
    uint64_t max_triangles; /**< of all shapes (nodes that show one mesh with the same scale share one); default 2^20
                                 plus one per 2 bytes read; at most 2^26 */
    double max_seconds;     /**< s; checked between steps, the longest of which is the largest shape's (about 1 s per
                                 million triangles); default 60 */
    /** Called for every file that is read, the glTF file first, for example to watch it for changes; or null. path:
     * UTF-8, valid during the call. Also called if the load fails later. */
    void (*file_read)(void *user, const char *path);
    /** Called on the loading thread several times a second with the progress, 0 to 1, never decreasing; or null. A
     * return value other than 0 cancels the load (KNURL_ERROR_CANCELLED). */
    int32_t (*progress)(void *user, double done);
    void *user; /**< passed to the callbacks */
    /** Called for each wrong tag with its message, without the file's name, valid during the call. Surfaces with that
     * tag are left out, counted in knurl_gltf_report.skipped, and the rest is loaded. Null: the first wrong tag fails
     * the load. A skin or morph target on a tagged mesh counts as a wrong tag. */
    void (*wrong_tag)(void *user, const char *message);
} knurl_gltf_options;

/** Zeroes it and sets struct_size; `size` is the caller's sizeof. [any thread] */
KNURL_API void knurl_gltf_options_init(knurl_gltf_options *options, uint32_t size);

/** The result of a load. An output: set struct_size with knurl_gltf_report_init() first. */
typedef struct knurl_gltf_report {
    uint32_t struct_size;
    uint32_t surfaces; /**< added to the scene: one per node and tagged primitive */
    uint32_t skipped;  /**< primitives without a tag, or with a wrong one (knurl_gltf_options.wrong_tag), counted once
                          per node that shows them */
    uint32_t reserved; /**< 0 */
} knurl_gltf_report;

/** Zeroes it and sets struct_size; `size` is the caller's sizeof. [any thread] */
KNURL_API void knurl_gltf_report_init(knurl_gltf_report *report, uint32_t size);

/** Loads all tagged surfaces of a .gltf or .glb file into a scene, committed or not. If it fails, the scene is
 * unchanged. report: may be null.
 *
 * The format is detected by content; the name must end in .gltf or .glb. External buffers are read only from the file's
 * own folder or below it; symbolic links must not lead out of it. Nodes that show the same accessors with the same
 * scale and axis share one shape (knurl_surface_desc.shape_of). Limits: JSON nested 32 deep, node trees 1024 deep,
 * coordinates of KNURL_COORDINATE_MAX, with transforms; names are cut to 255 bytes.
 *
 * Errors: KNURL_ERROR_FULL (a limit of the options, named), KNURL_ERROR_CANCELLED, KNURL_ERROR_IO, KNURL_ERROR_FORMAT
 * (file, object and key are named), KNURL_ERROR_UNSUPPORTED (a required extension, another glTF version, a skin or
 * morph target on a tagged mesh), and those of knurl_scene_add_surface(). Needs under 128 KiB of stack. [any thread but
 * the haptic] */
KNURL_API knurl_result knurl_gltf_load_file(knurl_scene *scene, const char *path, const knurl_gltf_options *options,
                                            knurl_gltf_report *report);

/** Loads from memory, as knurl_gltf_load_file(). data: `size` bytes of a .gltf or .glb, the caller's, not needed
 * afterwards. name: used for the file in messages. folder: of external buffers, or null to refuse them. [any thread but
 * the haptic] */
KNURL_API knurl_result knurl_gltf_load_memory(knurl_scene *scene, const void *data, uint64_t size, const char *name,
                                              const char *folder, const knurl_gltf_options *options,
                                              knurl_gltf_report *report);

/** Called for each object that can carry a tag. array: "materials", "meshes" or "nodes". index: in that array. object:
 * its name, UTF-8, or "". tag: its tag in the nested form, JSON, as the file has it, not checked; or null if it has
 * none. The strings are valid during the call. */
typedef void (*knurl_gltf_list_callback)(void *user, const char *array, uint32_t index, const char *object,
                                         const char *tag);

/** Takes a file's bytes, valid during the call. */
typedef void (*knurl_gltf_write_callback)(void *user, const void *data, uint64_t size);

/** Lists the objects of a .gltf or .glb file that can carry a tag, in the file's order.
 * data: `size` bytes of the file, the caller's. name: of the file in messages, or null. user: passed to each.
 * Errors: as knurl_gltf_load_memory(); the JSON is checked, buffers are not read. [any thread but the haptic] */
KNURL_API knurl_result knurl_gltf_list_tags(const void *data, uint64_t size, const char *name,
                                            knurl_gltf_list_callback each, void *user);

/** Makes a copy of a .gltf or .glb file in which one object's tag is set, changed or removed. Only that object's
 * `extras` change; every other byte stays, in a .glb but for the lengths and padding. Other keys of the extras stay.
 * data, size, name: as knurl_gltf_list_tags(). array, index: the object, as that function lists it.
 * tag: a JSON object with keys of the schema (assets/knurl_extras.schema.json, nested form): they replace those of the
 * object's tag, the rest of which stays; a key whose value is null is removed (a JSON merge patch, RFC 7396). The tag
 * is written in the nested form, even if it was flat. Null removes the whole tag.
 * write: called once, last, with the new file; not called if anything fails. user: passed to write.
 * Errors: KNURL_ERROR_ARGUMENT (array or index), KNURL_ERROR_FORMAT (the file's JSON, or a key or value of the
 * resulting tag), KNURL_ERROR_FULL. Whether required keys are there is not checked: another object may have them.
 * [any thread but the haptic] */
KNURL_API knurl_result knurl_gltf_set_tag(const void *data, uint64_t size, const char *name, const char *array,
                                          uint32_t index, const char *tag, knurl_gltf_write_callback write, void *user);

/** A picture that a material uses. An output, valid during the call. */
typedef struct knurl_gltf_texture {
    uint32_t struct_size; /**< the library's sizeof */
    uint32_t texcoord;    /**< n of the UVs TEXCOORD_n that lay it out; surfaces' ridges use 0 */
    const char *use;      /**< "normal", "occlusion" or "base colour"; static */
    const char *name;     /**< for messages, UTF-8: the image's name, its file's, or "image 3" */
    const void *data;     /**< the image file as it is (PNG and JPEG in plain glTF, or KTX2, WebP); null: see problem */
    uint64_t size;        /**< bytes */
    const char *problem;  /**< the reason that it cannot be read, such as a missing file; or null */
    double from_uv[2][2]; /**< place in the picture (1 is its width, its height) = from_uv (u, v) + an offset; the unit
                             matrix without KHR_texture_transform */
    double scale;         /**< of a normal texture's x and y; otherwise 1 */
} knurl_gltf_texture;

/** Takes a texture. */
typedef void (*knurl_gltf_texture_callback)(void *user, const knurl_gltf_texture *texture);

/** Reads the pictures that can show an object's ridges, without decoding them: its material's normal, occlusion and
 * base colour textures, in this order.
 * data, size, name, array, index: as knurl_gltf_set_tag(); a mesh or a node must have one material. folder: of external
 * images, read from it or below it only; null: they have a problem. each: called for each texture; one that cannot be
 * read is not an error of the call. user: passed to each.
 * Errors: KNURL_ERROR_ARGUMENT (array or index), KNURL_ERROR_FORMAT (the file's JSON, or not one material),
 * KNURL_ERROR_FULL. [any thread but the haptic] */
KNURL_API knurl_result knurl_gltf_read_textures(const void *data, uint64_t size, const char *name, const char *folder,
                                                const char *array, uint32_t index, knurl_gltf_texture_callback each,
                                                void *user);

#ifdef __cplusplus
}
#endif
#endif
