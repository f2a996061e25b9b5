/* Messages in a host that writes decimal commas. SPDX-License-Identifier: MIT */
#include "support/suite.h"

#include <knurl/knurl.h>

#include <locale.h>
#include <stdio.h>
#include <string.h>

/* 0 if there is no locale with decimal commas; tests/base/CMakeLists.txt makes one if localedef is installed. */
static int use_commas(void) {
    char text[16];
    if (!setlocale(LC_ALL, "de_DE.UTF-8")) {
        print_message("skipped: no locale with decimal commas could be made\n");
        return 0;
    }
    (void)snprintf(text, sizeof text, "%g", 0.5);
    assert_string_equal(text, "0,5");
    return 1;
}

TEST(messages_have_decimal_points_and_the_hosts_locale_stays) {
    knurl_material_desc material;
    knurl_plane_desc plane;
    knurl_surface_desc desc;
    knurl_surface_check check;
    knurl_surface_id surface;
    knurl_scene *scene;
    if (!use_commas()) {
        skip();
    }
    knurl_material_desc_init(&material, sizeof material);
    knurl_plane_desc_init(&plane, sizeof plane);
    knurl_surface_desc_init(&desc, sizeof desc);
    knurl_surface_check_init(&check, sizeof check);
    desc.plane = &plane;
    desc.material = &material;
    material.stiffness = -0.5;
    assert_int_equal(knurl_scene_create(NULL, &scene), KNURL_OK);
    assert_int_equal(knurl_scene_add_surface(scene, &desc, &surface), KNURL_ERROR_ARGUMENT);
    assert_non_null(strstr(knurl_error_message(), "found -0.5"));

    material.stiffness = 12345.0;
    material.amplitude = 0.0125;
    material.spatial_frequency[0] = 1000.0;
    assert_int_equal(knurl_scene_add_surface(scene, &desc, &surface), KNURL_OK);
    assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
    assert_int_equal(knurl_scene_check_surface(scene, 0, surface, &check), KNURL_OK);
    assert_non_null(strstr(check.message, "0.0125 m"));
    assert_string_equal(localeconv()->decimal_point, ",");
    knurl_scene_destroy(scene);
    (void)setlocale(LC_ALL, "C");
}

TEST(messages_of_the_gltf_loader_have_decimal_points) {
    knurl_gltf_options options;
    knurl_scene *scene;
    if (!use_commas()) {
        skip();
    }
    knurl_gltf_options_init(&options, sizeof options);
    options.max_seconds = -0.5;
    assert_int_equal(knurl_scene_create(NULL, &scene), KNURL_OK);
    assert_int_equal(knurl_gltf_load_memory(scene, "", 0, NULL, NULL, &options, NULL), KNURL_ERROR_ARGUMENT);
    assert_non_null(strstr(knurl_error_message(), "found -0.5"));
    knurl_scene_destroy(scene);
    (void)setlocale(LC_ALL, "C");
}
