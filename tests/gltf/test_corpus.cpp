// Real and hostile files of others, unchanged and again with a tag on every mesh, so that their geometry is read. They
// are outside of the repository (KNURL_CORPUS); without them this program is skipped with a message.
// SPDX-License-Identifier: MIT
#include <nlohmann/json.hpp> // before cmocka, whose macros are called fail and skip

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "gltf/builder.hpp"

namespace fs = std::filesystem;
using namespace builder;
using nlohmann::json;

namespace {

fs::path corpus() {
    return KNURL_TEST_CORPUS;
}

std::vector<fs::path> files_below(const fs::path &folder) {
    std::vector<fs::path> files;
    for (const auto &entry : fs::recursive_directory_iterator(folder))
        if (entry.path().extension() == ".gltf" || entry.path().extension() == ".glb")
            files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

std::string bytes_of(const fs::path &path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// The same file with a tag and an axis on every mesh; "" if it is too broken for that. show: also with a node for each
/// of them and no scene, because most of the validator's files show no mesh.
std::string tagged(const std::string &bytes, bool show) {
    const bool binary = bytes.compare(0, 4, "glTF") == 0;
    uint32_t length = 0;
    if (binary && bytes.size() >= 20)
        std::memcpy(&length, &bytes[12], sizeof length);
    if (binary && (length == 0 || length > bytes.size() - 20))
        return "";
    json root = json::parse(binary ? bytes.substr(20, length) : bytes, nullptr, false);
    if (!root.is_object() || !root.contains("meshes") || !root["meshes"].is_array())
        return "";
    for (json &mesh : root["meshes"])
        if (mesh.is_object())
            mesh["extras"] = json::parse("{" + tag(R"("axis":[1,0.5,0.25])") + "}")["extras"];
    if (show) {
        root.erase("scene");
        root.erase("scenes");
        root["nodes"] = json::array();
        for (size_t i = 0; i < root["meshes"].size(); ++i)
            root["nodes"].push_back({{"mesh", i}});
    }
    const size_t rest = 20 + length + 8;
    return binary ? glb(root.dump(), rest < bytes.size() ? bytes.substr(rest) : "") : root.dump();
}

struct Counts {
    unsigned loaded = 0;
    unsigned failed = 0;
    unsigned surfaces = 0;
};

void count(Counts &counts, const fs::path &path, knurl_result result, const Loaded &loaded, const std::string &name) {
    if (result == KNURL_OK) {
        ++counts.loaded;
        counts.surfaces += loaded.report.surfaces;
        assert_int_equal(knurl_scene_get_surface_count(loaded.scene), loaded.report.surfaces);
        return;
    }
    ++counts.failed;
    assert_true(result < 0);
    assert_message(name.c_str(), {});
    assert_int_equal(knurl_scene_get_surface_count(loaded.scene), 0);
    if (std::getenv("KNURL_VERBOSE") != nullptr)
        std::printf("%s: %s\n", path.filename().c_str(), knurl_error_message());
}

TEST(validator_files_load_or_fail_cleanly) {
    Counts plain_counts;
    Counts tagged_counts[2];
    for (const fs::path &path : files_below(corpus() / "validator")) {
        Loaded as_it_is;
        const knurl_result result =
            knurl_gltf_load_file(as_it_is.scene, path.string().c_str(), nullptr, &as_it_is.report);
        assert_int_equal(as_it_is.report.surfaces, 0);
        count(plain_counts, path, result, as_it_is, path.string());
        for (const bool show : {false, true}) {
            const std::string bytes = tagged(bytes_of(path), show);
            if (bytes.empty())
                continue;
            Loaded with_tags;
            const knurl_result tags_result = with_tags.load(bytes, path.parent_path().string().c_str());
            count(tagged_counts[show ? 1 : 0], path, tags_result, with_tags, "test.glb");
        }
    }
    const auto tell = [](const char *how, const Counts &counts) {
        std::printf("validator, %s: %u load with %u surfaces, %u fail\n", how, counts.loaded, counts.surfaces,
                    counts.failed);
    };
    tell("as it is", plain_counts);
    tell("tagged", tagged_counts[0]);
    tell("tagged, each mesh shown", tagged_counts[1]);
    assert_true(plain_counts.loaded + plain_counts.failed > 300);
    assert_true(tagged_counts[1].loaded + tagged_counts[1].failed > 50); // their positions are all 0: without area
}

TEST(a_real_untagged_file_loads_as_nothing) {
    Loaded loaded;
    const std::string path = (corpus() / "moon/moon_petavius_crater.gltf").string();
    assert_int_equal(knurl_gltf_load_file(loaded.scene, path.c_str(), nullptr, &loaded.report), KNURL_OK);
    assert_int_equal(loaded.report.surfaces, 0);
    assert_true(loaded.report.skipped > 0);
}

TEST(a_real_file_with_tags_loads_with_its_geometry) {
    const fs::path path = corpus() / "moon/moon_petavius_crater.gltf";
    Loaded loaded;
    loaded.assert_loads(tagged(bytes_of(path), false), path.parent_path().string().c_str());
    assert_int_equal(loaded.report.skipped, 0);
    assert_int_equal(loaded.report.surfaces, 11);
    uint64_t triangles = 0;
    for (uint32_t i = 0; i < loaded.report.surfaces; ++i)
        triangles += loaded.info(i).triangle_count + loaded.info(i).dropped_triangles;
    assert_int_equal(triangles, 39505); // the sum of the counts of all nodes' index accessors, by 3
}

} // namespace

int main() {
    if (!fs::is_directory(corpus() / "validator") || !fs::is_directory(corpus() / "moon")) {
        std::printf("SKIPPED: no corpus of glTF files in %s (set KNURL_CORPUS)\n", corpus().c_str());
        return 77;
    }
    return suite_run("corpus");
}
