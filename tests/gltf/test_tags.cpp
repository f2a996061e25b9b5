// Tags in extras: both forms, merging, and every mistake. Expected values: design.md, "Materials in glTF extras".
// SPDX-License-Identifier: MIT
#include "gltf/builder.hpp"

using namespace builder;

namespace {

knurl_material_desc material_of(const File &file) {
    return Loaded(file.glb()).material();
}

TEST(nested_form_is_read) {
    const knurl_material_desc m = material_of(
        quad_with(R"({"knurl":{"version":1,"spatial_frequency":[1000,500],"amplitude":0.0005,"stiffness":400,
                                  "damping":1.5,"friction":0.3,"orientation":0.25,"method":"S1"},"other":{"x":[1,null]}})"));
    assert_near(m.spatial_frequency, {1000, 500}, 1e-12);
    assert_number(m.amplitude, 0.0005);
    assert_number(m.stiffness, 400);
    assert_number(m.damping, 1.5);
    assert_number(m.friction, 0.3);
    assert_number(m.orientation, 0.25);
    assert_int_equal(m.method, KNURL_METHOD_S1);
}

TEST(flat_form_is_read) {
    const knurl_material_desc m = material_of(
        quad_with(R"({"knurl_spatial_frequency":[1000,0],"knurl_amplitude":0.33985769748687744,"knurl_stiffness":400,
                      "knurl_method":"S2","knurl_damping":0,"knurl_orientation":1,"knurl_version":1,"Prop":1})"));
    assert_near(m.spatial_frequency, {1000, 0}, 1e-12);
    assert_number(m.amplitude, 0.33985769748687744);
    assert_number(m.stiffness, 400);
    assert_int_equal(m.method, KNURL_METHOD_S2);
}

TEST(method_is_locked_and_the_rest_0_unless_said) {
    const knurl_material_desc m = material_of(quad());
    assert_int_equal(m.method, KNURL_METHOD_BANDLIMITED);
    assert_number(m.damping, 0);
    assert_number(m.friction, 0);
    assert_number(m.orientation, 0);
}

TEST(every_method_is_read_by_its_name) {
    for (const auto &[name, method] :
         {std::pair("S1", KNURL_METHOD_S1), {"S2", KNURL_METHOD_S2}, {"bandlimited", KNURL_METHOD_BANDLIMITED}}) {
        File file = quad();
        file.materials = "{" + tag(R"("method":")" + std::string(name) + '"') + "}";
        assert_int_equal(material_of(file).method, method);
    }
}

TEST(one_spatial_frequency_is_along_x) {
    const knurl_material_desc m =
        material_of(quad_with(R"({"knurl":{"version":1.0,"spatial_frequency":800,"amplitude":0,"stiffness":1e2}})"));
    assert_near(m.spatial_frequency, {800, 0}, 1e-12);
    assert_number(m.stiffness, 100);
}

TEST(mesh_overrides_material_and_node_overrides_mesh) {
    File file = quad();
    file.materials = "{" + tag(R"("damping":1)") + "}";
    file.meshes.insert(1, R"("extras":{"knurl_stiffness":500,"knurl_amplitude":0.001},)");
    file.nodes = R"({"mesh":0},{"mesh":0,"extras":{"knurl":{"version":1,"stiffness":600}}})";
    const Loaded loaded(file.glb());
    assert_int_equal(loaded.report.surfaces, 2);
    assert_number(loaded.material(0).stiffness, 500);
    assert_number(loaded.material(0).amplitude, 0.001);
    assert_number(loaded.material(0).damping, 1);
    assert_number(loaded.material(1).stiffness, 600);
    assert_number(loaded.material(1).amplitude, 0.001);
    assert_near(loaded.material(1).spatial_frequency, {1000, 0}, 1e-12);
}

TEST(a_mesh_or_node_can_carry_the_whole_tag) {
    File file = quad("");
    file.materials.clear();
    file.meshes.insert(1, tag() + ",");
    assert_int_equal(Loaded(file.glb()).report.surfaces, 1);
    file = quad("");
    file.nodes = R"({"mesh":0},{"mesh":0,)" + tag() + "}";
    const Loaded loaded(file.glb());
    assert_int_equal(loaded.report.surfaces, 1);
    assert_int_equal(loaded.report.skipped, 1);
}

TEST(untagged_files_load_as_nothing) {
    File file = quad("");
    for (const char *extras : {"{}", "[1]", "\"text\"", "null", R"({"knurling":1,"Knurl":2})"}) {
        file.materials = R"({"extras":)" + std::string(extras) + "}";
        const Loaded loaded(file.glb());
        assert_int_equal(loaded.report.surfaces, 0);
        assert_int_equal(loaded.report.skipped, 1);
        assert_int_equal(knurl_scene_get_surface_count(loaded.scene), 0);
    }
}

void assert_tag_fails(const std::string &extras, std::initializer_list<const char *> parts,
                      knurl_result code = KNURL_ERROR_FORMAT) {
    assert_fails(quad_with(extras).glb(), code, parts);
}

std::string with(const std::string &key_and_value) {
    return R"({"knurl":{"version":1,)" + key_and_value + "}}";
}

TEST(wrong_values_name_key_expected_and_found) {
    const char *bars = "material 'bars' (0): ";
    assert_tag_fails(with(R"("stiffness":-400)"), {bars, "knurl.stiffness: expected a number > 0 (N/m), found -400"});
    assert_tag_fails(with(R"("stiffness":0)"), {bars, "knurl.stiffness: expected a number > 0", "found 0"});
    assert_tag_fails(with(R"("stiffness":"400")"), {bars, "knurl.stiffness: expected a number", "found '400'"});
    assert_tag_fails(with(R"("stiffness":true)"), {bars, "knurl.stiffness", "found true"});
    assert_tag_fails(with(R"("stiffness":null)"), {bars, "knurl.stiffness", "found null"});
    assert_tag_fails(with(R"("amplitude":-1e-3)"), {bars, "knurl.amplitude: expected a number >= 0 (m), found -0.001"});
    assert_tag_fails(with(R"("amplitude":[1])"), {bars, "knurl.amplitude", "found an array of 1"});
    assert_tag_fails(with(R"("damping":-1)"), {bars, "knurl.damping: expected a number >= 0 (N s/m), found -1"});
    assert_tag_fails(with(R"("friction":-0.1)"), {bars, "knurl.friction", "found -0.1"});
    assert_tag_fails(with(R"("orientation":{})"),
                     {bars, "knurl.orientation: expected a number (rad), found an object"});
    for (const char *value : {"-5", "[1]", "[1,2,3]", "[1,-2]", "[1,\"2\"]", "\"1000\"", "{}", "[]"})
        assert_tag_fails(with(R"("spatial_frequency":)" + std::string(value)),
                         {bars, "knurl.spatial_frequency: expected a number >= 0 or an array of 2", "found "});
    for (const char *value : {"1", "[1,0]", "[0,0,0]", "[1,0,0,0]", "[1,0,\"z\"]"})
        assert_tag_fails(with(R"("axis":)" + std::string(value)), {bars, "knurl.axis: expected an array of 3 numbers"});
    assert_tag_fails(with(R"("axis":[0,0,0])"), {bars, "(a direction in object space), found 0"});
    assert_tag_fails(with(R"("axis":[1,0,"z"])"), {bars, "(a direction in object space), found 'z'"});
    for (const char *value : {"1", "\"uvs\"", "[\"box\"]", "null"})
        assert_tag_fails(with(R"("coordinates":)" + std::string(value)),
                         {bars, "knurl.coordinates: expected 'auto' or 'box', found "});
    assert_tag_fails(with(R"("method":"S3")"), {bars, "knurl.method: expected 'S1', "});
    assert_tag_fails(with(R"("method":2)"), {bars, "knurl.method: expected a string", "found 2"});
}

TEST(flat_keys_are_named_as_they_stand) {
    assert_tag_fails(R"({"knurl_stiffness":-400})", {"material 'bars' (0): knurl_stiffness: expected", "found -400"});
    assert_tag_fails(R"({"knurl_stifness":400})",
                     {"material 'bars' (0): knurl_stifness: unknown key", "knurl_stiffness"});
    assert_tag_fails(R"({"knurl_":1})", {"knurl_: unknown key"});
    assert_tag_fails(R"({"knurl_version":2})", {"knurl_version: expected 1", "found 2"});
}

TEST(form_of_the_tag_is_checked) {
    assert_tag_fails(with(R"("stifness":1)"),
                     {"knurl.stifness: unknown key; known are knurl.version, knurl.spatial_freq",
                      "knurl.amplitude, knurl.stiffness", "knurl.axis, knurl.coordinates, knurl.method"});
    assert_tag_fails(R"({"knurl":{"stiffness":1}})", {"knurl.version: missing: expected 1"});
    assert_tag_fails(R"({"knurl":{"version":2}})", {"knurl.version: expected 1", "found 2"});
    assert_tag_fails(R"({"knurl":{"version":"1"}})", {"knurl.version: expected 1", "found '1'"});
    for (const char *value : {"1", "null", "[]", "\"yes\""})
        assert_tag_fails(R"({"knurl":)" + std::string(value) + "}",
                         {"material 'bars' (0): extras.knurl: expected an object"});
    assert_tag_fails(R"({"knurl":{"version":1},"knurl_amplitude":1})",
                     {"material 'bars' (0): extras: holds both", "'knurl_amplitude'"});
}

TEST(keys_missing_after_merging_are_named) {
    File file = quad_with(R"({"knurl":{"version":1,"spatial_frequency":1000,"amplitude":0.001}})");
    file.nodes = R"({"mesh":0,"name":"plate"})";
    assert_fails(file.glb(), KNURL_ERROR_FORMAT,
                 {"knurl.stiffness: missing", "material 'bars' (0), mesh 0 or node 'plate' (0)"});
    assert_tag_fails(R"({"knurl_amplitude":1,"knurl_stiffness":1})", {"knurl.spatial_frequency: missing"});
    assert_tag_fails(with(R"("spatial_frequency":0,"stiffness":1)"), {"knurl.amplitude: missing"});
    assert_tag_fails(R"({"knurl_version":1})", {"knurl.spatial_frequency: missing"});
}

TEST(a_tag_that_would_be_lost_is_refused) {
    File file = quad();
    file.nodes = R"({"mesh":0},{"name":"group",)" + tag() + "}";
    assert_fails(file.glb(), KNURL_ERROR_FORMAT, {"node 'group' (1): extras: a knurl tag would be lost", "no mesh"});
    file = quad();
    file.more = R"(,"scenes":[{"nodes":[0],"name":"S","extras":{"knurl_amplitude":1}}])";
    assert_fails(file.glb(), KNURL_ERROR_FORMAT, {"scene 'S' (0): extras: a knurl tag would be lost"});
    file = quad(R"(,"material":0,)" + tag());
    assert_fails(file.glb(), KNURL_ERROR_FORMAT, {"mesh 0: primitives[0].extras: a knurl tag would be lost"});
}

TEST(a_mistake_in_an_unused_material_is_reported_too) {
    File file = quad();
    file.materials += R"(,{"name":"spare","extras":{"knurl_amplitude":-1}})";
    assert_fails(file.glb(), KNURL_ERROR_FORMAT, {"material 'spare' (1): knurl_amplitude"});
}

TEST(the_axis_turns_the_grating) {
    File file = quad();
    file.materials = "{" + tag(R"("axis":[0,1e-200,0])") + "}";
    assert_near(Loaded(file.glb()).info().anchor_x, {0, 1, 0});
    assert_near(Loaded(quad().glb()).info().anchor_x, {1, 0, 0}); // u runs along x
}

/// Loads a quad whose u runs along y; its projection's runs along x.
std::string coordinates_of(const std::string &of_material, const std::string &of_node) {
    File file = quad();
    const int uvs = file.vec2({0, 0, 0, 1, 1, 1, 1, 0});
    file.meshes.replace(file.meshes.find("\"TEXCOORD_0\":") + 13, 1, std::to_string(uvs));
    file.materials = "{" + tag(of_material) + "}";
    file.nodes = R"({"mesh":0,"extras":{"knurl":{"version":1)" + of_node + "}}}";
    const Loaded loaded(file.glb());
    const knurl_surface_info info = loaded.info();
    return info.coordinates + std::string(info.anchor_x[0] > 0.999 ? " along x" : " along y");
}

TEST(a_box_leaves_uvs_out_and_of_a_box_and_an_axis_the_later_one_wins) {
    assert_string_equal(coordinates_of("", "").c_str(), "uvs along y");
    assert_string_equal(coordinates_of(R"("coordinates":"box")", "").c_str(), "box along x");
    assert_string_equal(coordinates_of(R"("coordinates":"box")", R"(,"coordinates":"auto")").c_str(), "uvs along y");
    assert_string_equal(coordinates_of(R"("axis":[0,1,0])", R"(,"coordinates":"box")").c_str(), "box along x");
    assert_string_equal(coordinates_of(R"("coordinates":"box")", R"(,"axis":[0,1,0])").c_str(), "axis along y");
}

TEST(wrong_tags_are_told_and_left_out_if_asked_for) {
    File file = quad();
    file.nodes = R"({"mesh":0},{"name":"hard","mesh":0,"extras":{"knurl_stiffness":-1}},)"
                 R"({"name":"empty","extras":{"knurl_stiffness":1}},{"mesh":0,"extras":{"knurl_friction":0.5}})";
    std::vector<std::string> told;
    Loaded loaded;
    loaded.options.user = &told;
    loaded.options.wrong_tag = [](void *user, const char *message) {
        static_cast<std::vector<std::string> *>(user)->emplace_back(message);
    };
    loaded.assert_loads(file.glb());
    assert_int_equal(loaded.report.surfaces, 2);
    assert_int_equal(loaded.report.skipped, 1);
    assert_int_equal(told.size(), 2);
    assert_non_null(strstr(told[0].c_str(), "node 'hard' (1): knurl_stiffness: expected a number > 0 (N/m), found -1"));
    assert_non_null(strstr(told[1].c_str(), "node 'empty' (2): extras: a knurl tag would be lost here"));
    assert_fails(file.glb(), KNURL_ERROR_FORMAT, {told[0].c_str()});

    told.clear();
    file.nodes = R"({"mesh":0},{"mesh":0,"extras":{"knurl":{"version":1,"friction":0.5}}})";
    file.materials = "{}";
    loaded.assert_loads(file.glb());
    assert_int_equal(loaded.report.surfaces, 0);
    assert_int_equal(loaded.report.skipped, 2);
    assert_int_equal(told.size(), 1);
    assert_non_null(strstr(told[0].c_str(), "knurl.spatial_frequency: missing"));
    assert_int_equal(knurl_scene_get_surface_count(loaded.scene), 2);
}

TEST(long_and_odd_names_keep_the_message_readable) {
    for (const char *start : {"", "x", "xx"}) { // 64 bytes end after, in or before a character of three
        File odd = quad();
        odd.materials = R"({"name":")" + std::string(start);
        for (int i = 0; i < 40; ++i)
            odd.materials += "\xe2\x82\xac";
        odd.materials += R"(","extras":{"knurl_stiffness":-1}})";
        assert_fails(odd.glb(), KNURL_ERROR_FORMAT, {"\xe2\x82\xac...' (0): knurl_stiffness: expected"});
    }
    File file = quad();
    file.materials = R"({"name":"a\nb)" + std::string(5000, 'x') + R"(","extras":{"knurl_stiffness":-1}})";
    assert_fails(file.glb(), KNURL_ERROR_FORMAT,
                 {"material 'a bxxx", "...' (0): knurl_stiffness: expected", "found -1"});
}

} // namespace
