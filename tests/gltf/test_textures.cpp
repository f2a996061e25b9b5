// The pictures of a material, as the bytes of their files. SPDX-License-Identifier: MIT
#include <filesystem>
#include <fstream>
#include <string_view>

#include "gltf/builder.hpp"

using namespace builder;

namespace {

struct Picture {
    std::string use, name, data, problem;
    uint32_t texcoord;
    double from_uv[2][2];
    double scale;
};

constexpr std::string_view png = "\x89PNG, not decoded";
constexpr std::string_view jpeg = "\xFF\xD8, not decoded either";

knurl_result read(const std::string &file, const char *array, uint32_t index, std::vector<Picture> &pictures,
                  const char *folder = nullptr) {
    const std::vector<char> exact(file.begin(), file.end()); // so that a sanitizer sees each byte that is read too far
    return knurl_gltf_read_textures(
        exact.data(), exact.size(), "test.glb", folder, array, index,
        [](void *user, const knurl_gltf_texture *t) {
            assert_int_equal(t->struct_size, sizeof *t);
            assert_true((t->data == nullptr) == (t->problem != nullptr));
            Picture picture{t->use,
                            t->name,
                            t->data ? std::string(static_cast<const char *>(t->data), t->size) : "",
                            t->problem ? t->problem : "",
                            t->texcoord,
                            {{t->from_uv[0][0], t->from_uv[0][1]}, {t->from_uv[1][0], t->from_uv[1][1]}},
                            t->scale};
            static_cast<std::vector<Picture> *>(user)->push_back(picture);
        },
        &pictures);
}

std::vector<Picture> pictures_of(const std::string &file, const char *array = "materials", uint32_t index = 0,
                                 const char *folder = nullptr) {
    std::vector<Picture> pictures;
    if (read(file, array, index, pictures, folder) != KNURL_OK)
        fail_msg("expected pictures, found: %s", knurl_error_message());
    return pictures;
}

/// A quad with a picture of PNG within the file, for its normals; `how`: further members of that use of the picture.
File with_normals(const std::string &how = "", const std::string &image_more = "") {
    File file = quad();
    const int view = file.view(std::vector<char>(png.begin(), png.end()));
    file.materials = R"({"normalTexture":{"index":0)" + how + "}}";
    file.more = R"(,"textures":[{"source":0}],"images":[{"mimeType":"image/png","bufferView":)" + std::to_string(view) +
                image_more + "}]";
    return file;
}

/// A quad with a picture at a URI, as its colours.
File with_colours(const std::string &uri) {
    File file = quad();
    file.materials = R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}})";
    file.more = R"(,"textures":[{"source":0}],"images":[{"uri":")" + uri + R"("}])";
    return file;
}

TEST(a_picture_in_the_file_is_its_bytes) {
    for (const std::string &file : {with_normals().glb(), with_normals().gltf()}) {
        const std::vector<Picture> found = pictures_of(file);
        assert_int_equal(found.size(), 1);
        assert_string_equal(found[0].use.c_str(), "normal");
        assert_string_equal(found[0].name.c_str(), "image 0");
        assert_true(found[0].data == png);
        assert_int_equal(found[0].texcoord, 0);
        assert_number(found[0].scale, 1.0);
        assert_near(&found[0].from_uv[0][0], {1, 0, 0, 1});
    }
}

TEST(pictures_come_in_the_order_of_their_use) {
    File file = with_normals(R"(,"scale":0.25,"texCoord":1)", R"(,"name":"bumps")");
    file.materials =
        R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":1}},"occlusionTexture":{"index":0,"strength":0.5},)" +
        file.materials.substr(1);
    file.more = file.more.substr(0, file.more.size() - 1) + R"(,{"uri":"data:image/jpeg;base64,)" +
                base64(std::string(jpeg)) + R"("}])";
    file.more.replace(file.more.find(R"([{"source":0}])"), 14, R"([{"source":0},{"source":1}])");
    const std::vector<Picture> found = pictures_of(file.glb());
    assert_int_equal(found.size(), 3);
    const char *const uses[] = {"normal", "occlusion", "base colour"};
    const char *const names[] = {"bumps", "bumps", "image 1"};
    for (size_t i = 0; i < 3; ++i) {
        assert_string_equal(found[i].use.c_str(), uses[i]);
        assert_string_equal(found[i].name.c_str(), names[i]);
        assert_true(found[i].data == (i < 2 ? png : jpeg));
        assert_number(found[i].scale, i == 0 ? 0.25 : 1.0);
        assert_int_equal(found[i].texcoord, i == 0);
    }
}

/// By KHR_texture_transform and as it is drawn, v down: u, twice as long, turns by a quarter to point up; v, three
/// times as long, to point right.
TEST(a_texture_transform_scales_and_then_turns) {
    const std::vector<Picture> found = pictures_of(with_normals(R"(,"extensions":{"KHR_texture_transform":{
        "offset":[0.5,0.5],"scale":[2,3],"rotation":1.5707963267948966,"texCoord":2}})")
                                                       .glb());
    assert_near(&found.at(0).from_uv[0][0], {0, 3, -2, 0}, 1e-12);
    assert_int_equal(found[0].texcoord, 2);
}

TEST(a_mesh_or_a_node_has_the_pictures_of_its_one_material) {
    File file = with_normals();
    file.materials = "{}," + file.materials;
    file.meshes += "," + file.meshes;
    file.meshes.replace(file.meshes.rfind(R"("material":0)"), 12, R"("material":1)");
    file.nodes = R"({},{"mesh":1})";
    assert_int_equal(pictures_of(file.glb(), "meshes", 0).size(), 0);
    assert_int_equal(pictures_of(file.glb(), "meshes", 1).size(), 1);
    assert_int_equal(pictures_of(file.glb(), "nodes", 1).size(), 1);
    std::vector<Picture> none;
    assert_int_equal(read(file.glb(), "nodes", 0, none), KNURL_ERROR_FORMAT);
    assert_message("test.glb", {"node 0", "mesh"});
    std::string two = file.meshes.substr(0, file.meshes.find("},{")) + "}";
    two.replace(two.rfind("]}"), 2, "," + two.substr(two.find('[') + 1));
    two.replace(two.rfind(R"("material":0)"), 12, R"("material":1)");
    file.meshes = two;
    assert_int_equal(read(file.glb(), "meshes", 0, none), KNURL_ERROR_FORMAT);
    assert_message("test.glb", {"mesh 0", "primitives", "name the material instead"});
    assert_true(none.empty());
}

TEST(a_missing_object_is_refused) {
    std::vector<Picture> none;
    assert_int_equal(read(with_normals().glb(), "materials", 1, none), KNURL_ERROR_ARGUMENT);
    assert_message("test.glb", {"materials: expected an index below 1, found 1"});
    assert_int_equal(read(with_normals().glb(), "images", 0, none), KNURL_ERROR_ARGUMENT);
    assert_message("test.glb", {"array: expected 'materials', 'meshes' or 'nodes', found 'images'"});
    assert_true(none.empty());
}

TEST(a_size_without_bytes_is_refused) {
    const auto each = [](void *, const knurl_gltf_texture *) {};
    assert_int_equal(knurl_gltf_read_textures(nullptr, 8, "test.glb", nullptr, "materials", 0, each, nullptr),
                     KNURL_ERROR_ARGUMENT);
    assert_message("data", {"expected a pointer, found null"});
}

TEST(a_picture_in_a_file_of_its_own_is_read_from_its_folder_alone) {
    std::ofstream(KNURL_TEST_TMP "/colours.jpg", std::ios::binary) << jpeg;
    const std::vector<Picture> found = pictures_of(with_colours("colours.jpg").glb(), "materials", 0, KNURL_TEST_TMP);
    assert_int_equal(found.size(), 1);
    assert_string_equal(found[0].name.c_str(), "colours.jpg");
    assert_true(found[0].data == jpeg);
    std::filesystem::create_directories(KNURL_TEST_TMP "/textures");
    for (const char *uri : {"colours.jpg", "missing.jpg", "../colours.jpg", "https://example.org/colours.jpg"}) {
        const char *folder = uri[0] == 'c' ? nullptr : KNURL_TEST_TMP "/textures";
        const std::vector<Picture> problem = pictures_of(with_colours(uri).glb(), "materials", 0, folder);
        assert_int_equal(problem.size(), 1); // told, not an error of the call
        if (problem[0].problem.find("image 0") == std::string::npos)
            fail_msg("%s: found the problem '%s'", uri, problem[0].problem.c_str());
    }
}

TEST(pictures_in_another_format_are_read_too) {
    for (const char *extension : {"KHR_texture_basisu", "EXT_texture_webp"}) {
        File file = with_normals();
        file.more.replace(file.more.find(R"("source":0)"), 10,
                          R"("extensions":{")" + std::string(extension) + R"(":{"source":0}})");
        assert_true(pictures_of(file.glb()).at(0).data == png);
    }
}

TEST(a_picture_beyond_its_buffer_is_a_problem) {
    File file = with_normals();
    const std::string length = R"("byteLength":)" + std::to_string(png.size());
    file.views.replace(file.views.rfind(length), length.size(), R"("byteLength":4000)");
    assert_true(pictures_of(file.glb()).at(0).problem.find("byteLength") != std::string::npos);
}

} // namespace
