/* Files that are swapped between the check of their path and its opening, as by an attacker in the same folder: the
 * opened file is checked again. SPDX-License-Identifier: MIT */
#include "support/close.h"
#include "support/tool.h"

#include <knurl/device.h>
#include <knurl/gltf.h>
#include <knurl/query.h>

#include <fcntl.h>
#include <sys/syscall.h>

/* A swap, done once, just before a path with this end is opened. */
static const char *swapped_part;
static void (*swap)(void);

static void before_opening(const char *path) {
    const char *slash = strrchr(path, '/');
    if (swapped_part && strcmp(slash ? slash + 1 : path, swapped_part) == 0) {
        swapped_part = NULL;
        swap();
    }
}

/* Replacements of the C library's functions. No call here creates a file. */
int open(const char *path, int flags, ...) {
    before_opening(path);
    return (int)syscall(SYS_openat, AT_FDCWD, path, flags, 0);
}

int openat(int folder, const char *path, int flags, ...) {
    before_opening(path);
    return (int)syscall(SYS_openat, folder, path, flags, 0);
}

int __openat_2(int folder, const char *path, int flags); /* with _FORTIFY_SOURCE */
int __openat_2(int folder, const char *path, int flags) {
    return openat(folder, path, flags);
}

static void path_swaps(const char *part, void (*how)(void)) {
    swapped_part = part;
    swap = how;
}

/* Three vertices: a triangle in x, y with sides of 0.1 m. Outside of the scene's folder there are the same. */
static void write_buffer(const char *path) {
    static const float vertices[9] = {0.0F, 0.0F, 0.0F, 0.1F, 0.0F, 0.0F, 0.0F, 0.1F, 0.0F};
    write_file(path, vertices, sizeof vertices);
}

static void write_scene(void) {
    (void)mkdir(tool_path("in"), 0700);
    (void)mkdir(tool_path("in/below"), 0700);
    (void)mkdir(tool_path("outside"), 0700);
    write_buffer(tool_path("in/below/b.bin"));
    write_buffer(tool_path("outside/b.bin"));
    write_text(tool_path("in/a.gltf"),
               "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"mesh\":0}],"
               "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}],\"extras\":{\"knurl\":{\"version\":1,"
               "\"spatial_frequency\":[1000,0],\"amplitude\":0.0002,\"stiffness\":400,\"axis\":[1,0,0]}}}],"
               "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"type\":\"VEC3\",\"count\":3}],"
               "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
               "\"buffers\":[{\"byteLength\":36,\"uri\":\"below/b.bin\"}]}");
}

static void remove_scene(void) {
    static const char *const names[] = {
        "in/a.gltf", "in/below/b.bin", "in/moved/b.bin", "in/below", "in/moved", "outside/b.bin", "in", "outside"};
    for (size_t i = 0; i < COUNT_OF(names); i++) {
        (void)remove(tool_path(names[i]));
    }
}

static void file_becomes_link(void) {
    assert_int_equal(remove(tool_path("in/below/b.bin")), 0);
    assert_int_equal(symlink(tool_path("outside/b.bin"), tool_path("in/below/b.bin")), 0);
}

static void folder_becomes_link(void) {
    assert_int_equal(rename(tool_path("in/below"), tool_path("in/moved")), 0);
    assert_int_equal(symlink(tool_path("outside"), tool_path("in/below")), 0);
}

static void file_becomes_fifo(void) {
    assert_int_equal(remove(tool_path("in/below/b.bin")), 0);
    assert_int_equal(mkfifo(tool_path("in/below/b.bin"), 0600), 0);
}

static void stays(void) {}

static knurl_result load_while(const char *part, void (*how)(void)) {
    knurl_scene *scene = NULL;
    write_scene();
    assert_int_equal(knurl_scene_create(NULL, &scene), KNURL_OK);
    path_swaps(part, how);
    const knurl_result result = knurl_gltf_load_file(scene, tool_path("in/a.gltf"), NULL, NULL);
    assert_null(swapped_part); /* it was opened */
    assert_int_equal(knurl_scene_get_surface_count(scene), result == KNURL_OK);
    knurl_scene_destroy(scene);
    remove_scene();
    return result;
}

TEST(a_buffer_that_stays_is_read) {
    assert_int_equal(load_while("b.bin", stays), KNURL_OK);
}

TEST(a_buffer_that_becomes_a_link_is_not_followed) {
    assert_int_equal(load_while("b.bin", file_becomes_link), KNURL_ERROR_IO);
    check_message("expected a file, found a symbolic link");
}

TEST(a_folder_that_becomes_a_link_is_not_followed) {
    assert_int_equal(load_while("below", folder_becomes_link), KNURL_ERROR_IO);
    check_message("below/b.bin");
}

TEST(a_buffer_that_becomes_a_fifo_is_not_waited_for) {
    assert_int_equal(load_while("b.bin", file_becomes_fifo), KNURL_ERROR_IO);
    check_message("expected a regular file, found a special file");
}

static void geometry_becomes_fifo(void) {
    assert_int_equal(remove(tool_path("geometry")), 0);
    assert_int_equal(mkfifo(tool_path("geometry"), 0600), 0);
}

TEST(a_geometry_file_that_becomes_a_fifo_is_not_waited_for) {
    char uri[1200];
    knurl_device *device = NULL;
    write_text(tool_path("geometry"), "\n");
    (void)snprintf(uri, sizeof uri, "rawhid:?geometry=%s", tool_path("geometry"));
    path_swaps("geometry", geometry_becomes_fifo);
    assert_int_equal(knurl_device_open(uri, &device), KNURL_ERROR_IO);
    check_message("expected a regular file, found a special file");
    assert_null(swapped_part);
    assert_int_equal(remove(tool_path("geometry")), 0);
}

SUITE_FIXTURES(make_folder, remove_folder)
