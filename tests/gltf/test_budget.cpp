// Budgets of a load, and stopping it: limits by name, progress, one shape for all nodes that show it.
// SPDX-License-Identifier: MIT
#include <cmath>

#include "gltf/bombs.hpp"

using namespace builder;

namespace {

/// Loads with a budget; the result.
knurl_result load_with(Loaded &loaded, const knurl_gltf_options &budget, const std::string &bytes) {
    loaded.options = budget;
    return loaded.load(bytes);
}

knurl_gltf_options empty_budget() {
    knurl_gltf_options budget;
    knurl_gltf_options_init(&budget, sizeof budget);
    return budget;
}

void assert_limit(const knurl_gltf_options &budget, const char *message) {
    Loaded loaded;
    File file = quad();
    file.nodes = showing(3, true);
    assert_int_equal(load_with(loaded, budget, file.glb()), KNURL_ERROR_FULL);
    assert_message("test.glb", {message});
    assert_int_equal(knurl_scene_get_surface_count(loaded.scene), 0);
}

TEST(each_limit_is_told_by_its_name) {
    knurl_gltf_options budget = empty_budget();
    budget.max_surfaces = 2;
    assert_limit(budget, "options.max_surfaces: expected at most 2, found 3");
    budget = empty_budget();
    budget.max_bytes = 500;
    assert_limit(budget, "options.max_bytes: expected at most 500, found ");
    budget = empty_budget();
    budget.max_vertices = 23; // 4 positions and 4 uvs, three times
    assert_limit(budget, "node 2, mesh 0, primitive 0: options.max_vertices: expected at most 23, found 24");
    budget = empty_budget();
    budget.max_triangles = 5;
    assert_limit(budget, "node 2, mesh 0, primitive 0: options.max_triangles: expected at most 5, found 6");
    budget = empty_budget();
    budget.max_seconds = 1e-9;
    assert_limit(budget, "options.max_seconds: expected at most");
}

TEST(a_file_at_the_limit_loads) {
    knurl_gltf_options budget = empty_budget();
    budget.max_surfaces = 3;
    budget.max_vertices = 24;
    budget.max_triangles = 6;
    budget.max_bytes = 100000;
    Loaded loaded;
    File file = quad();
    file.nodes = showing(3, true);
    assert_int_equal(load_with(loaded, budget, file.glb()), KNURL_OK);
    assert_int_equal(loaded.report.surfaces, 3);
}

TEST(budgets_out_of_their_ranges_are_refused) {
    const auto refuses = [](const knurl_gltf_options &budget, const char *message) {
        Loaded loaded;
        assert_int_equal(load_with(loaded, budget, quad().glb()), KNURL_ERROR_ARGUMENT);
        assert_message("test.glb", {message});
    };
    knurl_gltf_options budget = empty_budget();
    budget.max_bytes = (uint64_t{1} << 30U) + 1;
    refuses(budget, "options.max_bytes: expected 0 to 1073741824");
    budget = empty_budget();
    budget.max_seconds = std::nan("");
    refuses(budget, "options.max_seconds: expected >= 0");
    budget = empty_budget();
    budget.struct_size = 0;
    refuses(budget, "knurl_gltf_options.struct_size");
}

struct Watch {
    int calls = 0;
    int stop_at = 0; ///< this call ends the load; 0: no call
    double done = 0.0;
};

int32_t on_progress(void *user, double done) {
    auto *watch = static_cast<Watch *>(user);
    assert_true(done >= watch->done && done <= 1.0);
    watch->done = done;
    return ++watch->calls == watch->stop_at ? 1 : 0;
}

TEST(progress_is_reported_and_never_goes_back) {
    Loaded loaded;
    Watch watch;
    File file = quad();
    file.nodes = showing(50, true);
    loaded.options.user = &watch;
    loaded.options.progress = on_progress;
    loaded.assert_loads(file.glb());
    assert_true(watch.calls > 50);
    assert_number(watch.done, 1.0);
}

TEST(a_load_ends_wherever_it_is_stopped_and_leaves_nothing) {
    File file = quad();
    file.nodes = showing(20, true);
    Watch all;
    Loaded whole;
    whole.options.user = &all;
    whole.options.progress = on_progress;
    whole.assert_loads(file.glb());
    for (int call = 1; call <= all.calls; ++call) {
        Loaded loaded;
        Watch watch;
        watch.stop_at = call;
        loaded.options.user = &watch;
        loaded.options.progress = on_progress;
        const uint64_t before = knurl_scene_get_bytes(loaded.scene);
        assert_int_equal(loaded.load(file.glb()), KNURL_ERROR_CANCELLED);
        assert_int_equal(watch.calls, call);
        assert_int_equal(knurl_scene_get_surface_count(loaded.scene), 0);
        knurl_scene_collect(loaded.scene);
        assert_true(knurl_scene_get_bytes(loaded.scene) <= before + 4096); // the list of surfaces has grown
    }
}

uint64_t bytes_of(const std::string &bytes) {
    Loaded loaded(bytes);
    return knurl_scene_get_bytes(loaded.scene);
}

TEST(nodes_that_show_one_mesh_have_one_shape_however_they_stand) {
    File file = dense_mesh(20000);
    const uint64_t one = bytes_of(file.glb());
    file.nodes.clear();
    for (int i = 0; i < 100; ++i) {
        const double half = 0.03 * i;
        char node[200];
        (void)snprintf(node, sizeof node, R"(%s{"mesh":0,"translation":[%d,0,0],"rotation":[0,%.9g,0,%.9g]})",
                       i ? "," : "", i, std::sin(half), std::cos(half));
        file.nodes += node;
    }
    const uint64_t hundred = bytes_of(file.glb());
    assert_true(one > 500000 && hundred < one + 100 * 4096);
    Loaded loaded(file.glb());
    assert_int_equal(loaded.report.surfaces, 100);
    const knurl_surface_info info = loaded.info(57);
    assert_true(info.bytes < one / 50);
    assert_true(info.triangle_count > 10000);
    // 0.03 rad of half an angle a node: the bounds' middle has gone round with it.
    assert_true(info.bounds_min[0] > 57.0 - 1e4 && info.bounds_max[0] < 57.0 + 1e4);
}

TEST(scaled_mirrored_and_otherwise_tagged_nodes_have_shapes_of_their_own) {
    File file = quad();
    file.nodes = R"({"mesh":0},{"mesh":0,"scale":[2,2,2]},{"mesh":0,"scale":[-1,1,1]},{"mesh":0,)" +
                 tag(R"("axis":[0,1,0])") + "}";
    Loaded loaded(file.glb());
    assert_int_equal(loaded.report.surfaces, 4);
    assert_near(loaded.info(0).bounds_max, {0.1, 0.1, 0});
    assert_near(loaded.info(1).bounds_max, {0.2, 0.2, 0});
    assert_near(loaded.info(2).bounds_min, {-0.1, 0, 0});
    assert_near(loaded.info(2).anchor_normal, {0, 0, 1});
    assert_near(loaded.info(3).anchor_x, {0, 1, 0});
}

TEST(buffers_that_name_one_file_are_read_once) {
    File file = quad();
    knurl_gltf_options budget = empty_budget();
    const std::string uri = "data:;base64," + base64(file.bin);
    budget.max_bytes = 4000; // the text and 92 bytes
    file.buffers = R"({"byteLength":92,"uri":")" + uri + "\"}";
    Loaded loaded;
    assert_int_equal(load_with(loaded, budget, file.json()), KNURL_OK);
}

TEST(names_are_cut_to_255_bytes_between_characters) {
    File file = quad();
    std::string name;
    for (int i = 0; i < 300; ++i)
        name += "\xC3\xA4"; // ä
    file.nodes = R"({"mesh":0,"name":")" + name + R"("},{"mesh":0,"name":")" + name + R"("})";
    file.materials = R"({"name":")" + name + "\"," + tag() + "}";
    Loaded loaded(file.glb());
    assert_true(std::strlen(loaded.info(0).name) <= 255);
    assert_true(std::strlen(loaded.info(1).name) <= 255);
    assert_string_not_equal(loaded.info(0).name, loaded.info(1).name);
    assert_int_equal(static_cast<unsigned char>(loaded.info(0).name[113]), 0xA4);
}

TEST(an_accessor_beyond_all_measure_is_named) {
    for (const float far : {1.001e9F, -1.7e19F, 3.4e38F})
        assert_fails(
            plain({0, 0, 0, 1, 0, 0, 0, far, 0}).glb(), KNURL_ERROR_FORMAT,
            {"node 0, mesh 0, primitive 0: POSITION (accessor 0): its used vertex 2: expected within 1e+09 m"});
}

TEST(a_surface_farther_than_floats_tell_apart_is_warned_of) {
    Loaded loaded(plain({0, 0, 0, 2e6F, 0, 0, 0, 2e6F, 0}).glb());
    assert_int_equal(knurl_scene_commit(loaded.scene), KNURL_OK);
    knurl_surface_check check;
    knurl_surface_check_init(&check, sizeof check);
    assert_int_equal(knurl_scene_check_surface(loaded.scene, 0, knurl_scene_get_surface(loaded.scene, 0), &check),
                     KNURL_OK);
    assert_int_equal(check.exceeded & KNURL_LIMIT_FAR, KNURL_LIMIT_FAR);
    assert_non_null(std::strstr(check.message, "2e+06 m from the origin"));
}

} // namespace
