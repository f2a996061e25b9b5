// Paths in the glTF loader on Windows: UTF-8 with any code page, drives, backslashes, names of devices.
// SPDX-License-Identifier: MIT
#include <filesystem>
#include <fstream> // before cmocka, whose macro is called fail

#include "gltf/builder.hpp"

namespace fs = std::filesystem;
using namespace builder;

namespace {

const char *const odd_name = "Gr\xC3\xB6\xC3\x9F"
                             "e-\xE8\xA7\xA6"; // in no one code page

/// A fresh folder of that name.
class Folder {
  public:
    Folder() : root(fs::path(KNURL_TEST_TMP) / fs::u8path(odd_name)) {
        fs::remove_all(root);
        fs::create_directories(root / "in" / "sub");
    }
    ~Folder() {
        std::error_code error;
        fs::remove_all(root, error);
    }
    Folder(const Folder &) = delete;
    Folder &operator=(const Folder &) = delete;

    std::string write(const std::string &name, const std::string &bytes) const {
        const fs::path path = root / fs::u8path(name);
        std::ofstream(path, std::ios::binary) << bytes;
        return path.u8string();
    }

    fs::path root;
};

knurl_result load_uri(const Folder &folder, const std::string &uri) {
    const Loaded loaded;
    return knurl_gltf_load_file(loaded.scene, folder.write("in/a.gltf", quad().json(uri)).c_str(), nullptr, nullptr);
}

void assert_uri_loads(const Folder &folder, const std::string &uri) {
    if (load_uri(folder, uri) != KNURL_OK)
        fail_msg("%s: expected a load, found: %s", uri.c_str(), knurl_error_message());
}

void assert_uri_fails(const Folder &folder, const std::string &uri, knurl_result code, const char *part) {
    const knurl_result result = load_uri(folder, uri);
    if (result != code || std::strstr(knurl_error_message(), part) == nullptr)
        fail_msg("%s: expected %d and '%s', found %d: %s", uri.c_str(), code, part, result, knurl_error_message());
}

TEST(paths_are_utf8) {
    const Folder folder;
    const Loaded loaded;
    const std::string there = folder.write(std::string(odd_name) + ".glb", quad().glb());
    assert_int_equal(knurl_gltf_load_file(loaded.scene, there.c_str(), nullptr, nullptr), KNURL_OK);
    const std::string none = (folder.root / fs::u8path("no-" + std::string(odd_name) + ".glb")).u8string();
    assert_int_equal(knurl_gltf_load_file(loaded.scene, none.c_str(), nullptr, nullptr), KNURL_ERROR_IO);
    assert_message(none.c_str(), {"no such file"});
    assert_int_not_equal(knurl_gltf_load_file(loaded.scene, "bad \xC3\x28.glb", nullptr, nullptr), KNURL_OK);
}

TEST(a_buffer_of_any_name_lies_in_the_files_folder_or_below_it) {
    const Folder folder;
    folder.write(std::string("in/") + odd_name + ".bin", quad().bin);
    folder.write("in/sub/a.bin", quad().bin);
    folder.write("secret.bin", quad().bin);
    assert_uri_loads(folder, std::string(odd_name) + ".bin");
    assert_uri_loads(folder, "Gr%C3%B6%C3%9Fe-%E8%A7%A6.bin");
    assert_uri_loads(folder, "sub/a.bin");
    assert_uri_loads(folder, "sub%5Ca.bin");
    const char *outside = "expected a file in the glTF file's folder or below it";
    assert_uri_fails(folder, "../secret.bin", KNURL_ERROR_FORMAT, outside);
    assert_uri_fails(folder, "..%5Csecret.bin", KNURL_ERROR_FORMAT, outside);
    assert_uri_fails(folder, "sub%5C..%5C..%5Csecret.bin", KNURL_ERROR_FORMAT, outside);
}

TEST(drives_and_shares_are_no_relative_paths) {
    const Folder folder;
    folder.write("secret.bin", quad().bin);
    const char *relative = "expected a path relative to the glTF file, without a scheme";
    for (const char *uri : {"C:/a.bin", "C:a.bin", "%43%3Aa.bin", "%5Ca.bin", "//server/share/a.bin",
                            "%5C%5Cserver%5Cshare%5Ca.bin", "%5C%5C%3F%5CC:%5Ca.bin"})
        assert_uri_fails(folder, uri, KNURL_ERROR_FORMAT, relative);
}

TEST(names_of_devices_are_no_files) {
    const Folder folder;
    for (const char *name : {"NUL", "CON", "COM1", "sub/NUL"})
        assert_int_not_equal(load_uri(folder, name), KNURL_OK);
    const Loaded loaded;
    for (const char *path : {"NUL.glb", "CON.glb", "COM1.glb"})
        assert_int_not_equal(knurl_gltf_load_file(loaded.scene, path, nullptr, nullptr), KNURL_OK);
}

} // namespace
