// Tags written into files: they load, and every other byte stays.
// SPDX-License-Identifier: MIT
#include "gltf/builder.hpp"

#include <optional>

using namespace builder;

namespace {

knurl_result set_tag(const std::string &file, const char *array, uint32_t index, const char *tag,
                     std::optional<std::string> &written) {
    const std::vector<char> exact(file.begin(), file.end()); // so that a sanitizer sees each byte that is read too far
    return knurl_gltf_set_tag(
        exact.data(), exact.size(), "test.glb", array, index, tag,
        [](void *user, const void *data, uint64_t size) {
            static_cast<std::optional<std::string> *>(user)->emplace(static_cast<const char *>(data), size);
        },
        &written);
}

std::string tagged(const std::string &file, const char *tag, const char *array = "materials", uint32_t index = 0) {
    std::optional<std::string> written;
    if (set_tag(file, array, index, tag, written) != KNURL_OK)
        fail_msg("expected a file, found: %s", knurl_error_message());
    return written.value_or("");
}

void assert_refused(const std::string &file, const char *array, uint32_t index, const char *tag, knurl_result code,
                    std::initializer_list<const char *> parts) {
    std::optional<std::string> written;
    assert_int_equal(set_tag(file, array, index, tag, written), code);
    assert_message("test.glb", parts);
    assert_false(written.has_value());
}

const char whole_tag[] = R"({"spatial_frequency":[1000,0],"amplitude":0.0002,"stiffness":400})";

/// Text with all that could mislead a search for brackets: escapes, brackets in strings, members named like a tag.
const char awkward[] = R"( {
  "name" : "a \"{[\\",
  "pbrMetallicRoughness" : { "baseColorFactor" : [ 1.0, 0.50, 1e-2, 1 ] } ,
  "extensions":{"extras":{"knurl":{}}}
} )";

File awkward_file() {
    File file = quad();
    file.materials = awkward;
    return file;
}

TEST(a_tag_set_is_the_tag_loaded) {
    for (const std::string &file : {awkward_file().glb(), awkward_file().gltf()}) {
        const knurl_material_desc m = Loaded(tagged(file, whole_tag)).material();
        assert_near(m.spatial_frequency, {1000, 0}, 1e-12);
        assert_number(m.amplitude, 0.0002);
        assert_number(m.stiffness, 400);
    }
}

TEST(meshes_and_nodes_can_be_tagged) {
    for (const char *array : {"meshes", "nodes"})
        assert_number(Loaded(tagged(awkward_file().glb(), whole_tag, array)).material().stiffness, 400);
}

TEST(a_tag_set_and_removed_leaves_every_byte_as_it_was) {
    for (const char *material : {awkward, "{}", "{ }", R"({"name":"x"})", R"({"extras":{"a":[1,{}],"b":2}})"}) {
        File file = quad();
        file.materials = material;
        for (const std::string &bytes : {file.glb(), file.gltf()})
            assert_true(tagged(tagged(bytes, whole_tag), nullptr) == bytes);
    }
}

TEST(removing_a_tag_that_is_not_there_changes_nothing) {
    const std::string bytes = awkward_file().glb();
    assert_true(tagged(bytes, nullptr) == bytes);
}

TEST(text_before_and_after_the_object_stays) {
    const std::string json = awkward_file().gltf();
    const std::string after = tagged(json, whole_tag);
    const size_t inserted = after.size() - json.size();
    const size_t at = after.find(",\"extras\":{\"knurl\":{\"version\":1,");
    assert_true(at != std::string::npos);
    assert_true(after.substr(0, at) + after.substr(at + inserted) == json);
}

TEST(other_chunks_of_a_glb_stay) {
    std::string file = awkward_file().glb();
    std::string more;
    append_word(more, 8);
    more += "XTRAabcdefgh";
    file += more;
    std::string length;
    append_word(length, file.size());
    file.replace(8, 4, length);
    const std::string after = tagged(file, whole_tag);
    assert_int_equal(after.size() % 4, 0);
    assert_true(after.substr(after.size() - more.size()) == more);
    assert_true(after.find(awkward_file().bin) != std::string::npos);
    assert_int_equal(Loaded(after).report.surfaces, 1);
}

TEST(bytes_after_a_glbs_declared_length_stay_after_it) {
    const std::string file = awkward_file().glb() + "trailing";
    const std::string after = tagged(file, whole_tag);
    assert_true(after.substr(after.size() - 8) == "trailing");
    assert_int_equal(Loaded(after).report.surfaces, 1);
    assert_true(tagged(after, nullptr) == file);
}

TEST(keys_replace_keys_and_null_removes_one) {
    const std::string file = quad_with(R"({"mine":{"knurl":1},"knurl":{"version":1,"spatial_frequency":[700,0],
        "amplitude":1e-4, "stiffness" :  3.50e2,"friction":0.5},"yours":"}"})")
                                 .gltf();
    const std::string after = tagged(file, R"( {"amplitude":0.0002,"friction":null,"damping":1,"method":"S2"} )");
    const knurl_material_desc m = Loaded(after).material();
    assert_near(m.spatial_frequency, {700, 0}, 1e-12);
    assert_number(m.amplitude, 0.0002);
    assert_number(m.friction, 0);
    assert_number(m.damping, 1);
    assert_int_equal(m.method, KNURL_METHOD_S2);
    for (const char *kept : {R"("mine":{"knurl":1})", R"("yours":"}")", R"("stiffness":3.50e2)"})
        assert_true(after.find(kept) != std::string::npos);
}

TEST(a_flat_tag_becomes_nested) {
    const std::string file =
        quad_with(R"({"knurl_spatial_frequency":900,"a":1,"knurl_amplitude":1e-4,"knurl_stiffness":300})").gltf();
    const std::string after = tagged(file, R"({"stiffness":350})");
    assert_true(after.find("knurl_") == std::string::npos);
    assert_true(after.find(R"("a":1)") != std::string::npos);
    const knurl_material_desc m = Loaded(after).material();
    assert_near(m.spatial_frequency, {900, 0}, 1e-12);
    assert_number(m.stiffness, 350);
    assert_true(Loaded(tagged(file, nullptr)).report.surfaces == 0);
}

TEST(a_tag_that_is_wrong_can_be_removed) {
    for (const char *extras :
         {R"({"knurl":5})", R"({"knurl":{"depth":1},"knurl_amplitude":-1})", R"({"knurl_x\"y":1})"})
        assert_int_equal(Loaded(tagged(quad_with(extras).glb(), nullptr)).report.skipped, 1);
}

TEST(a_tag_of_another_version_is_not_taken_for_version_1) {
    const std::string file = quad_with(R"({"knurl":{"version":2,"stiffness":5}})").gltf();
    assert_refused(file, "materials", 0, whole_tag, KNURL_ERROR_FORMAT,
                   {"knurl.version: expected 1, the version that this library reads, found 2"});
    assert_refused(awkward_file().gltf(), "materials", 0, R"({"version":2})", KNURL_ERROR_FORMAT, {"found 2"});
    assert_number(Loaded(tagged(file, R"({"version":1,"amplitude":0,"spatial_frequency":0})")).material().stiffness, 5);
}

TEST(a_tag_of_many_keys_is_removed_in_one_pass) {
    std::string extras = R"({"a":1)";
    for (int i = 0; i < 20000; ++i) // one pass per key takes 17 s
        extras += ", \"knurl_" + std::to_string(i) + "\":0";
    const std::string file = quad_with(extras + R"( , "b":2})").gltf();
    assert_true(tagged(file, nullptr) == quad_with(R"({"a":1 , "b":2})").gltf());
}

TEST(a_tag_of_many_keys_is_listed_in_one_pass) {
    std::string extras = R"({"a":1)";
    for (int i = 0; i < 100000; ++i) // comparing each key with all before it takes minutes
        extras += ",\"knurl_" + std::to_string(i) + "\":0";
    const std::string file = quad_with(extras + "}").gltf();
    size_t length = 0;
    assert_int_equal(knurl_gltf_list_tags(
                         file.data(), file.size(), "test.gltf",
                         [](void *user, const char *, uint32_t, const char *, const char *tag) {
                             *static_cast<size_t *>(user) += tag != nullptr ? std::strlen(tag) : 0;
                         },
                         &length),
                     KNURL_OK);
    assert_int_equal(length, std::strlen(R"({"version":1})") + 488890 + 100000 * std::strlen(R"(,"":0)"));
}

TEST(a_refused_edit_writes_nothing) {
    const std::string file = awkward_file().glb();
    const char *object = "material 'a \"{[\\' (0): ";
    assert_refused(file, "lights", 0, "{}", KNURL_ERROR_ARGUMENT,
                   {"expected 'materials', 'meshes' or 'nodes', found 'lights'"});
    assert_refused(file, "materials", 1, "{}", KNURL_ERROR_ARGUMENT, {"materials: expected an index below 1, found 1"});
    assert_refused(file, "materials", 0, "[1]", KNURL_ERROR_FORMAT, {"tag: expected a JSON object, found an array"});
    assert_refused(file, "materials", 0, "{\"amplitude\":", KNURL_ERROR_FORMAT, {"JSON: "});
    assert_refused(file, "materials", 0, R"({"stiffness":-1})", KNURL_ERROR_FORMAT,
                   {object, "knurl.stiffness: expected a number > 0 (N/m), found -1"});
    assert_refused(file, "materials", 0, R"({"st\"iff":1})", KNURL_ERROR_FORMAT, {object, "unknown key"});
    assert_refused(quad_with("[1]").glb(), "materials", 0, whole_tag, KNURL_ERROR_FORMAT,
                   {"material 'bars' (0): extras: expected an object, which can hold a tag, found an array of 1"});
    assert_refused("{\"materials\":[{}", "materials", 0, "{}", KNURL_ERROR_FORMAT, {"JSON: parse error"});
    assert_refused("glTF", "materials", 0, "{}", KNURL_ERROR_FORMAT, {".glb header: expected 12 bytes"});
    assert_refused(R"({"materials":[5]})", "materials", 0, "{}", KNURL_ERROR_FORMAT, {"expected an object"});
}

TEST(null_arguments_are_refused) {
    const auto write = [](void *, const void *, uint64_t) {};
    const auto each = [](void *, const char *, uint32_t, const char *, const char *) {};
    assert_int_equal(knurl_gltf_set_tag(nullptr, 4, "", "nodes", 0, nullptr, write, nullptr), KNURL_ERROR_ARGUMENT);
    assert_int_equal(knurl_gltf_set_tag("{}", 2, "", nullptr, 0, nullptr, write, nullptr), KNURL_ERROR_ARGUMENT);
    assert_int_equal(knurl_gltf_set_tag("{}", 2, "", "nodes", 0, nullptr, nullptr, nullptr), KNURL_ERROR_ARGUMENT);
    assert_int_equal(knurl_gltf_list_tags(nullptr, 4, "", each, nullptr), KNURL_ERROR_ARGUMENT);
    assert_int_equal(knurl_gltf_list_tags("{}", 2, "", nullptr, nullptr), KNURL_ERROR_ARGUMENT);
}

TEST(a_list_names_every_object_and_its_tag) {
    File file = quad_with(R"({"knurl_amplitude":1.50e-4,"other":1,"knurl_stiffness":300})");
    file.materials += R"(,{"name":"caf\u00e9"},{"extras":{"knurl":{"version":1,"method":"S1"}}})";
    file.nodes = R"({"name":"plate","mesh":0})";
    const std::string bytes = file.glb();
    std::string list;
    assert_int_equal(knurl_gltf_list_tags(
                         bytes.data(), bytes.size(), "test.glb",
                         [](void *user, const char *array, uint32_t index, const char *name, const char *tag) {
                             *static_cast<std::string *>(user) += std::string(array) + " " + std::to_string(index) +
                                                                  " '" + name + "' " + (tag ? tag : "-") + "\n";
                         },
                         &list),
                     KNURL_OK);
    assert_string_equal(list.c_str(), "materials 0 'bars' {\"version\":1,\"amplitude\":1.50e-4,\"stiffness\":300}\n"
                                      "materials 1 'caf\xC3\xA9' -\n"
                                      "materials 2 '' {\"version\":1,\"method\":\"S1\"}\n"
                                      "meshes 0 '' -\n"
                                      "nodes 0 'plate' -\n");
}

} // namespace
