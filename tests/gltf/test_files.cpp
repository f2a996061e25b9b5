// Files, .glb containers, JSON text, external and embedded buffers.
// SPDX-License-Identifier: MIT
#include <filesystem>
#include <fstream> // before cmocka, whose macro is called fail

#include <sys/stat.h>

#include "gltf/builder.hpp"

namespace fs = std::filesystem;
using namespace builder;

namespace {

/// A new folder with a folder `in` for the glTF files.
class Folder {
  public:
    Folder() : root(fs::path(KNURL_TEST_TMP) / "gltf_files") {
        fs::remove_all(root);
        fs::create_directories(root / "in");
    }
    ~Folder() {
        std::error_code error;
        fs::remove_all(root, error);
    }
    Folder(const Folder &) = delete;
    Folder &operator=(const Folder &) = delete;

    std::string write(const std::string &name, const std::string &bytes) const {
        std::ofstream(root / name, std::ios::binary) << bytes;
        return (root / name).string();
    }
    std::string path(const std::string &name) const {
        return (root / name).string();
    }

    fs::path root;
};

knurl_result load_file(const std::string &path, knurl_gltf_report *report = nullptr) {
    Loaded loaded;
    const knurl_result result = knurl_gltf_load_file(loaded.scene, path.c_str(), &loaded.options, &loaded.report);
    assert_int_equal(loaded.report.surfaces, result == KNURL_OK ? knurl_scene_get_surface_count(loaded.scene) : 0);
    if (report != nullptr)
        *report = loaded.report;
    return result;
}

void assert_file_fails(const std::string &path, knurl_result code, std::initializer_list<const char *> parts) {
    const knurl_result result = load_file(path);
    if (result != code)
        fail_msg("expected result %d, found %d: %s", code, result, knurl_error_message());
    assert_message(path.c_str(), parts);
}

void assert_uri_loads(const Folder &folder, const std::string &uri) {
    if (load_file(folder.write("in/a.gltf", quad().json(uri))) != KNURL_OK)
        fail_msg("%s: expected a load, found: %s", uri.c_str(), knurl_error_message());
}

void assert_uri_fails(const Folder &folder, const std::string &uri, knurl_result code,
                      std::initializer_list<const char *> parts) {
    assert_file_fails(folder.write("in/a.gltf", quad().json(uri)), code, parts);
}

TEST(both_containers_and_both_endings) {
    const Folder folder;
    knurl_gltf_report report;
    knurl_gltf_report_init(&report, sizeof report);
    for (const char *name : {"a.glb", "a.GLB", "a.gltf", "b.gLtF"}) { // the content decides
        assert_int_equal(load_file(folder.write(name, quad().glb()), &report), KNURL_OK);
        assert_int_equal(report.surfaces, 1);
        assert_int_equal(load_file(folder.write(name, quad().gltf()), &report), KNURL_OK);
    }
    Loaded both(quad().glb());
    both.assert_loads(quad().gltf());
    assert_int_equal(knurl_scene_get_surface_count(both.scene), 2);
}

TEST(names_and_kinds_of_files) {
    const Folder folder;
    assert_file_fails(folder.path("none.glb"), KNURL_ERROR_IO, {"no such file"});
    assert_file_fails(folder.write("a.obj", quad().glb()), KNURL_ERROR_FORMAT,
                      {"expected a name that ends in .gltf or .glb"});
    assert_file_fails(folder.write("glb", quad().glb()), KNURL_ERROR_FORMAT, {"ends in .gltf or .glb"});
    fs::create_directory(folder.root / "d.glb");
    assert_file_fails(folder.path("d.glb"), KNURL_ERROR_IO, {"expected a regular file, found a directory"});
    assert_int_equal(mkfifo(folder.path("f.glb").c_str(), 0600), 0);
    assert_file_fails(folder.path("f.glb"), KNURL_ERROR_IO, {"expected a regular file, found a special file"});
    fs::create_symlink("/dev/zero", folder.root / "z.glb");
    assert_file_fails(folder.path("z.glb"), KNURL_ERROR_IO, {"expected a regular file"});
    assert_file_fails(folder.write("e.glb", ""), KNURL_ERROR_FORMAT, {"found nothing"});
    assert_file_fails(folder.write("t.gltf", "mesh"), KNURL_ERROR_FORMAT, {"expected a JSON object or a .glb"});
    folder.write("big.glb", "glTF");
    fs::resize_file(folder.root / "big.glb", (uint64_t{1} << 30U) + 1); // a hole: it takes no space
    assert_file_fails(folder.path("big.glb"), KNURL_ERROR_FULL,
                      {"options.max_bytes: expected at most 1073741824, found 1073741825"});
}

TEST(arguments_are_checked) {
    Loaded loaded;
    assert_int_equal(knurl_gltf_load_file(nullptr, "a.glb", nullptr, nullptr), KNURL_ERROR_ARGUMENT);
    assert_int_equal(knurl_gltf_load_file(loaded.scene, nullptr, nullptr, nullptr), KNURL_ERROR_ARGUMENT);
    assert_int_equal(knurl_gltf_load_file(loaded.scene, "", nullptr, nullptr), KNURL_ERROR_FORMAT);
    assert_int_equal(knurl_gltf_load_memory(nullptr, "", 0, "m", nullptr, nullptr, nullptr), KNURL_ERROR_ARGUMENT);
    assert_int_equal(knurl_gltf_load_memory(loaded.scene, nullptr, 5, "m", nullptr, nullptr, nullptr),
                     KNURL_ERROR_ARGUMENT);
    assert_int_equal(knurl_gltf_load_memory(loaded.scene, nullptr, 0, nullptr, nullptr, nullptr, nullptr),
                     KNURL_ERROR_FORMAT);
    assert_int_equal(knurl_gltf_load_memory(loaded.scene, "", uint64_t{1} << 31U, "m", nullptr, nullptr, nullptr),
                     KNURL_ERROR_FULL);
    assert_message("m", {"options.max_bytes"});
    const std::string bytes = quad().glb();
    loaded.report.struct_size = 0;
    assert_int_equal(loaded.load(bytes), KNURL_ERROR_ARGUMENT);
    assert_int_equal(knurl_scene_get_surface_count(loaded.scene), 0);
    assert_int_equal(
        knurl_gltf_load_memory(loaded.scene, bytes.data(), bytes.size(), nullptr, nullptr, nullptr, nullptr), KNURL_OK);
    assert_int_equal(knurl_scene_get_surface_count(loaded.scene), 1);
}

TEST(external_buffers) {
    const Folder folder;
    const std::string bin = quad().bin;
    fs::create_directory(folder.root / "in/sub");
    folder.write("in/a.bin", bin);
    folder.write("in/sub/a b+c%.bin", bin + "and more");
    folder.write("a.bin", bin);
    assert_uri_loads(folder, "a.bin");
    assert_uri_loads(folder, "./sub/../a.bin");
    assert_uri_loads(folder, "%61.bin");
    assert_uri_loads(folder, "sub/a%20b+c%25.bin");
    assert_uri_loads(folder, "sub/a b+c%.bin"); // as exporters that do not encode write it
    // A path without a folder means the working directory.
    const fs::path before = fs::current_path();
    fs::current_path(folder.root / "in");
    const knurl_result result = load_file("a.gltf");
    fs::current_path(before);
    assert_int_equal(result, KNURL_OK);
}

TEST(external_buffers_that_are_out_of_reach) {
    const Folder folder;
    folder.write("secret.bin", quad().bin);
    folder.write("in/short.bin", "abc");
    fs::create_symlink(folder.root / "secret.bin", folder.root / "in/link.bin");
    fs::create_symlink(folder.root, folder.root / "in/up");
    fs::create_symlink("/dev/zero", folder.root / "in/zero.bin");
    fs::create_directory(folder.root / "in2");
    folder.write("in2/a.bin", quad().bin);
    assert_int_equal(mkfifo(folder.path("in/fifo.bin").c_str(), 0600), 0);
    const char *outside = "expected a file in the glTF file's folder or below it";
    assert_uri_fails(folder, "../secret.bin", KNURL_ERROR_FORMAT, {"buffer 0: uri '../secret.bin': ", outside});
    assert_uri_fails(folder, "%2e%2e%2fsecret.bin", KNURL_ERROR_FORMAT, {"buffer 0: uri '%2e%2e", outside});
    assert_uri_fails(folder, "../in2/a.bin", KNURL_ERROR_FORMAT, {outside}); // "in" is a prefix of its name
    assert_uri_fails(folder, "link.bin", KNURL_ERROR_FORMAT, {outside});
    assert_uri_fails(folder, "up/secret.bin", KNURL_ERROR_FORMAT, {outside});
    assert_uri_fails(folder, "zero.bin", KNURL_ERROR_FORMAT, {outside});
    const char *relative = "expected a path relative to the glTF file, without a scheme";
    assert_uri_fails(folder, folder.path("secret.bin"), KNURL_ERROR_FORMAT, {relative});
    assert_uri_fails(folder, "file:///etc/passwd", KNURL_ERROR_FORMAT, {relative});
    assert_uri_fails(folder, "https://example.org/a.bin", KNURL_ERROR_FORMAT, {relative});
    assert_uri_fails(folder, "a.bin%00.png", KNURL_ERROR_FORMAT, {relative});
    assert_uri_fails(folder, "none.bin", KNURL_ERROR_IO, {"buffer 0: uri 'none.bin': no such file in "});
    assert_uri_fails(folder, ".", KNURL_ERROR_IO, {"buffer 0: uri '.': expected a regular file, found a directory"});
    assert_uri_fails(folder, "fifo.bin", KNURL_ERROR_IO, {"expected a regular file, found a special file"});
    assert_uri_fails(folder, "short.bin", KNURL_ERROR_FORMAT, {"expected 92 bytes (byteLength), found 3"});
}

TEST(buffers_that_nothing_tagged_needs_are_not_read) {
    File file = quad();
    file.buffers = R"({"byteLength":)" + std::to_string(file.bin.size()) +
                   R"(},{"byteLength":9,"uri":"none.bin"},{"byteLength":-1,"uri":5},7)";
    File::append(file.views, R"({"buffer":1,"byteLength":9,"byteStride":3})");
    file.more = R"(,"images":[{"uri":"none.png"},{"bufferView":99}],"textures":[{"source":7}],"animations":[1],
                   "samplers":0,"cameras":[{}],"skins":[null])";
    const Loaded loaded(file.glb());
    assert_int_equal(loaded.report.surfaces, 1);
    file.materials = "{}";
    file.buffers = R"({"byteLength":1e300,"uri":"none.bin"})";
    assert_int_equal(Loaded(file.json()).report.skipped, 1);
}

TEST(memory_reads_from_a_folder_only_where_one_is_given) {
    const Folder folder;
    folder.write("in/a.bin", quad().bin);
    const std::string json = quad().json("a.bin");
    assert_fails(json, KNURL_ERROR_IO, {"buffer 0: uri 'a.bin': ", "no folder was given"});
    Loaded loaded;
    loaded.assert_loads(json, folder.path("in").c_str());
    assert_fails(json, KNURL_ERROR_IO, {"no folder '"}, folder.path("nowhere").c_str());
}

TEST(data_uris) {
    const std::string text = base64(quad().bin); // 92 bytes: ends in one "="
    const auto load = [&](const std::string &uri) { return Loaded().load(quad().json(uri)); };
    assert_int_equal(load("data:application/gltf-buffer;base64," + text), KNURL_OK);
    assert_int_equal(load("data:;base64," + text), KNURL_OK);
    assert_int_equal(load("DATA:application/octet-stream;charset=x;base64," + text), KNURL_OK);
    assert_int_equal(load("data:;base64," + text.substr(0, text.size() - 1)), KNURL_OK); // unpadded
    assert_int_equal(load("data:;base64," + text.substr(0, text.size() - 1) + "%3D"), KNURL_OK);
    const auto fails = [](const std::string &uri, std::initializer_list<const char *> parts) {
        assert_fails(quad().json(uri), KNURL_ERROR_FORMAT, parts);
    };
    fails("data:;base64," + text.substr(4),
          {"buffer 0: uri 'data:;base64,", "expected 92 bytes (byteLength), found 89"});
    fails("data:;base64,*" + text, {"expected base64 digits, found '*'"});
    fails("data:;base64," + text + "A", {"base64"});
    fails("data:application/octet-stream," + text, {"expected data:TYPE;base64,TEXT"});
    fails("data:", {"expected data:TYPE;base64,TEXT"});
}

TEST(buffers_without_a_uri) {
    assert_fails(quad().json(), KNURL_ERROR_FORMAT, {"buffer 0: uri: missing"});
    assert_fails(builder::glb(quad().json(), ""), KNURL_ERROR_FORMAT, {"buffer 0: uri: missing"});
    assert_fails(builder::glb(quad().json(), "1234"), KNURL_ERROR_FORMAT,
                 {"buffer 0: byteLength: expected at most 4 (the BIN chunk), found 92"});
    File file = quad();
    file.buffers = R"({"byteLength":1},{"byteLength":92})";
    for (size_t at = 0; (at = file.views.find(R"("buffer":0)", at)) != std::string::npos;)
        file.views.replace(at, 10, R"("buffer":1)");
    assert_fails(file.glb(), KNURL_ERROR_FORMAT, {"buffer 1: uri: missing"});
}

TEST(required_extensions) {
    const auto with = [](const std::string &names) {
        File file = quad();
        file.more = R"(,"extensionsRequired":)" + names;
        return file;
    };
    assert_int_equal(
        Loaded(with(R"(["KHR_materials_unlit","KHR_texture_transform","KHR_texture_basisu"])").glb()).report.surfaces,
        1);
    for (const char *name : {"KHR_draco_mesh_compression", "EXT_meshopt_compression", "EXT_mesh_gpu_instancing", "X"}) {
        File file = with("[\"" + std::string(name) + "\"]");
        assert_fails(file.glb(), KNURL_ERROR_UNSUPPORTED,
                     {"extensionsRequired: the extension '", name, "is not supported"});
        file.materials = "{}";
        assert_fails(file.glb(), KNURL_ERROR_UNSUPPORTED, {name});
    }
    assert_fails(with("\"X\"").glb(), KNURL_ERROR_FORMAT, {"extensionsRequired: expected an array, found 'X'"});
    assert_fails(with("[1]").glb(), KNURL_ERROR_FORMAT, {"extensionsRequired: expected an array of strings, found 1"});
}

TEST(versions_of_the_asset) {
    const auto with = [](const std::string &asset) {
        File file = quad();
        file.asset = R"("asset":)" + asset;
        return file.glb();
    };
    assert_int_equal(Loaded(with(R"({"version":"2.1","minVersion":"2.0"})")).report.surfaces, 1);
    assert_fails(with(R"({"version":"1.0"})"), KNURL_ERROR_UNSUPPORTED, {"asset.version: expected '2.0', found '1.0'"});
    assert_fails(with(R"({"version":"2.1","minVersion":"2.1"})"), KNURL_ERROR_UNSUPPORTED, {"asset.minVersion"});
    assert_fails(with(R"({"version":2.0})"), KNURL_ERROR_FORMAT, {"asset.version: expected a string, found 2.0"});
    assert_fails(with("{}"), KNURL_ERROR_FORMAT, {"asset.version: missing"});
    assert_fails(with("[]"), KNURL_ERROR_FORMAT, {"asset: expected an object, found an array of 0"});
    assert_fails("{}", KNURL_ERROR_FORMAT, {"asset: missing"});
}

TEST(json_mistakes_say_where) {
    assert_fails("{\n  \"asset\": {,}}", KNURL_ERROR_FORMAT, {"JSON: parse error at line 2, column 13"});
    assert_fails(quad_with(R"({"knurl":{"version":1,"stiffness":NaN}})").glb(), KNURL_ERROR_FORMAT,
                 {"JSON: parse error"});
    assert_fails(quad_with(R"({"knurl_stiffness":1e999})").glb(), KNURL_ERROR_FORMAT, {"JSON: ", "1e999"});
    assert_fails(quad_with(R"({"knurl":{"version":1,"stiffness":1,"stiffness":2}})").glb(), KNURL_ERROR_FORMAT,
                 {"JSON: the key 'stiffness' appears twice in materials[0].extras.knurl"});
    assert_fails(R"({"asset":{"version":"2.0"},"asset":{}})", KNURL_ERROR_FORMAT,
                 {"'asset' appears twice in the file's root"});
    assert_fails("{\"asset\":\"\xC3\x28\"}", KNURL_ERROR_FORMAT, {"JSON: parse error", "UTF-8"});
    Loaded loaded;
    loaded.assert_loads("\xEF\xBB\xBF" + quad().gltf());
    loaded.assert_loads(" \r\n" + quad().gltf() + "\n");
}

} // namespace
