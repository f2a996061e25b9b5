// The hostile files that tinygltf alone accepts or dies of, and every small damage to a good one.
// Rows about URIs, 1e999, duplicate keys and UTF-8 are in test_files.cpp, deep and long ones in test_limits.cpp.
// SPDX-License-Identifier: MIT
#include "gltf/builder.hpp"

using namespace builder;

namespace {

/// `text` with its one `from` replaced.
std::string swapped(std::string text, const std::string &from, const std::string &to) {
    const size_t at = text.find(from);
    if (at == std::string::npos)
        fail_msg("'%s' is not in: %s", from.c_str(), text.c_str());
    return text.replace(at, from.size(), to);
}

void assert_swap_fails(const std::string &from, const std::string &to, std::initializer_list<const char *> parts) {
    const File file = quad();
    assert_fails(builder::glb(swapped(file.json(), from, to), file.bin), KNURL_ERROR_FORMAT, parts);
}

TEST(accessor_numbers) {
    const std::string count = R"("type":"VEC3","count":4)";
    assert_swap_fails(count, R"("type":"VEC3","count":4611686018427387904)",
                      {"accessor 0: count: expected a whole number from 1 to 2147483647, found 4611686018427387904"});
    assert_swap_fails(count, R"("type":"VEC3","count":2147483647)",
                      {"POSITION (accessor 0): count", "found 2147483647"});
    assert_swap_fails(count, R"("type":"VEC3","count":200000000)", {"expected 200000000 elements", "of 48 bytes"});
    assert_swap_fails(count, R"("type":"VEC3","count":5)",
                      {"expected 5 elements up to byte 60, found a bufferView 0 of 48"});
    assert_swap_fails(count, R"("type":"VEC3","count":0)", {"accessor 0: count", "found 0"});
    assert_swap_fails(count, R"("type":"VEC3","count":-4)", {"accessor 0: count", "found -4"});
    assert_swap_fails(count, R"("type":"VEC3","count":3.5)", {"accessor 0: count", "found 3.5"});
    assert_swap_fails(count, R"("type":"VEC3","count":"4")", {"accessor 0: count", "found '4'"});
    assert_swap_fails(count, R"("type":"VEC3")", {"accessor 0: count: missing"});
    assert_swap_fails(count, R"("type":"VEC3","count":4,"byteOffset":9223372036854775808)",
                      {"accessor 0: byteOffset", "found 9223372036854775808"});
    assert_swap_fails(count, R"("type":"VEC3","count":4,"byteOffset":2147483647)",
                      {"POSITION (accessor 0)", "2147483695"});
    assert_swap_fails(count, R"("type":"VEC3","count":4,"byteOffset":-1)", {"accessor 0: byteOffset", "found -1"});
    assert_swap_fails(count, R"("type":"VEC3","count":4,"normalized":1)", {"accessor 0: normalized", "found 1"});
    assert_swap_fails(R"("VEC3")", R"("VEC9")", {"accessor 0: type", "found 'VEC9'"});
    assert_swap_fails(R"("VEC3")", R"("MAT4")", {"accessor 0: type", "found 'MAT4'"});
    assert_swap_fails(R"("VEC3")", "3", {"accessor 0: type: expected a string, found 3"});
    assert_swap_fails("5126", "5124", {"accessor 0: componentType: expected 5120", "found 5124"});
    assert_swap_fails("5126", "5130", {"accessor 0: componentType", "found 5130"});
    assert_swap_fails(R"("accessors":[)", R"("accessors":[7,)", {"accessor 0: expected an object, found 7"});
}

TEST(zeros_cost_no_memory) {
    const std::string dense = R"("bufferView":0,"componentType":5126,"type":"VEC3","count":4)";
    assert_swap_fails(dense, R"("componentType":5126,"type":"VEC3","count":268435456)",
                      {"POSITION (accessor 0): count: expected 1 to 4194304 without a bufferView, found 268435456"});
}

TEST(buffer_view_numbers) {
    const std::string view = R"("byteOffset":0,"byteLength":48)";
    assert_swap_fails(view, R"("byteOffset":0,"byteLength":93)",
                      {"bufferView 0 ends at byte 93 of a buffer of 92 bytes"});
    assert_swap_fails(view, R"("byteOffset":45,"byteLength":48)", {"bufferView 0 ends at byte 93"});
    assert_swap_fails(view, R"("byteOffset":2147483647,"byteLength":2147483647)", {"ends at byte 4294967294"});
    assert_swap_fails(view, R"("byteOffset":9223372036854775808,"byteLength":48)", {"bufferView 0: byteOffset"});
    assert_swap_fails(view, R"("byteOffset":-8,"byteLength":48)", {"bufferView 0: byteOffset", "found -8"});
    assert_swap_fails(view, R"("byteLength":0)", {"bufferView 0: byteLength", "found 0"});
    assert_swap_fails(view, R"("byteOffset":0)", {"bufferView 0: byteLength: missing"});
    assert_swap_fails(view, view + R"(,"byteStride":-4)", {"bufferView 0: byteStride", "found -4"});
    assert_swap_fails(view, view + R"(,"byteStride":0)", {"bufferView 0: byteStride: expected a whole number from 4"});
    assert_swap_fails(view, view + R"(,"byteStride":256)", {"bufferView 0: byteStride", "found 256"});
    assert_swap_fails(view, view + R"(,"byteStride":6)",
                      {"bufferView 0: byteStride: expected a multiple of 4, found 6"});
    assert_swap_fails(view, view + R"(,"byteStride":8)", {"bufferView 0: byteStride: expected at least 12, found 8"});
    assert_swap_fails(view, view + R"(,"byteStride":16)", {"expected 4 elements up to byte 60"});
    assert_swap_fails(R"({"buffer":0,"byteOffset":0)", R"({"buffer":1,"byteOffset":0)",
                      {"bufferView 0: buffer: expected an index below 1 (buffers), found 1"});
    assert_swap_fails(R"({"buffer":0,"byteOffset":0)", R"({"byteOffset":0)", {"bufferView 0: buffer: missing"});
    assert_swap_fails(R"("byteLength":92)", R"("byteLength":93)", {"buffer 0: byteLength", "found 93"});
    assert_swap_fails(R"("byteLength":92)", R"("byteLength":0)", {"buffer 0: byteLength", "found 0"});
    assert_swap_fails(R"({"byteLength":92})", "{}", {"buffer 0: byteLength: missing"});
}

TEST(indices_into_arrays) {
    assert_swap_fails(R"("POSITION":0)", R"("POSITION":-7)",
                      {"mesh 0: primitives[0].attributes.POSITION: expected an index below 3 (accessors), found -7"});
    assert_swap_fails(R"("POSITION":0)", R"("POSITION":77)", {"attributes.POSITION: ", "found 77"});
    assert_swap_fails(R"("TEXCOORD_0":1)", R"("TEXCOORD_0":4294967297)", {"attributes.TEXCOORD_0", "found 4294967297"});
    assert_swap_fails(R"("attributes":{)", R"("attributes":[],"x":{)",
                      {"mesh 0: primitives[0].attributes: expected an object"});
    assert_swap_fails(R"("indices":2)", R"("indices":-1)", {"mesh 0: primitives[0].indices", "found -1"});
    assert_swap_fails(R"("bufferView":0)", R"("bufferView":3)", {"accessor 0: bufferView", "found 3"});
    assert_swap_fails(R"({"mesh":0})", R"({"mesh":9999})",
                      {"node 0: mesh: expected an index below 1 (meshes), found 9999"});
    assert_swap_fails(R"({"mesh":0})", R"({"mesh":"0"})", {"node 0: mesh", "found '0'"});
    assert_swap_fails(R"("material":0)", R"("material":42)",
                      {"mesh 0: primitives[0].material: expected an index below 1 (materials), found 42"});
    assert_swap_fails(R"({"mesh":0})", R"({"mesh":0,"children":[5]})", {"node 0: children[0]", "found 5"});
    assert_swap_fails(R"({"mesh":0})", R"({"mesh":0,"children":{}})", {"node 0: children: expected an array"});
    assert_swap_fails(R"({"mesh":0})", "null", {"node 0: expected an object, found null"});
    assert_swap_fails(R"("nodes":[{"mesh":0}])", R"("nodes":{"mesh":0})",
                      {"nodes: expected an array, found an object"});
    assert_swap_fails(R"([{"attributes")", R"([5,{"attributes")",
                      {"mesh 0: primitives[0]: expected an object, found 5"});
}

TEST(nodes_that_are_no_trees) {
    const auto fails = [](const std::string &nodes, std::initializer_list<const char *> parts) {
        File file = quad();
        file.nodes = nodes;
        assert_fails(file.glb(), KNURL_ERROR_FORMAT, parts);
    };
    fails(R"({"mesh":0,"name":"me","children":[0]})", {"node 'me' (0): children: the node is its own child"});
    fails(R"({"mesh":0},{"children":[2]},{"children":[3]},{"children":[1,4]},{})", {"its own ancestor"});
    fails(R"({"children":[2]},{"children":[2]},{"mesh":0})", {"node 2: is a child of node 0 and again of node 1"});
    fails(R"({"children":[1,1]},{"mesh":0})", {"node 1: is a child of node 0 and again of node 0"});
    File file = quad();
    file.nodes = R"({"children":[1]},{"mesh":0})";
    file.more = R"(,"scenes":[{"nodes":[1]}])";
    assert_fails(file.glb(), KNURL_ERROR_FORMAT, {"scene 0: nodes: node 1 is a child of node 0"});
}

TEST(truncated_files_fail) {
    const std::string glb = quad().glb();
    const std::string gltf = quad().gltf();
    for (size_t size = 0; size < glb.size(); ++size)
        assert_int_not_equal(Loaded().load(glb.substr(0, size)), KNURL_OK);
    for (size_t size = 0; size < gltf.size(); ++size)
        assert_int_not_equal(Loaded().load(gltf.substr(0, size)), KNURL_OK);
}

/// Loads or fails, and is all or nothing.
void assert_clean(Loaded &loaded, const std::string &bytes) {
    const uint32_t before = knurl_scene_get_surface_count(loaded.scene);
    const knurl_result result = loaded.load(bytes);
    const uint32_t added = knurl_scene_get_surface_count(loaded.scene) - before;
    assert_int_equal(added, result == KNURL_OK ? loaded.report.surfaces : 0);
    while (knurl_scene_get_surface_count(loaded.scene) > 0)
        assert_int_equal(knurl_scene_remove_surface(loaded.scene, knurl_scene_get_surface(loaded.scene, 0)), KNURL_OK);
}

TEST(every_change_of_a_byte_of_the_headers_is_survived) {
    const std::string glb = quad().glb();
    const size_t json = 20;
    const size_t bin = glb.find(std::string("BIN\0", 4)) - 4;
    Loaded loaded;
    for (size_t i = 0; i < bin + 8; i = i + 1 == json ? bin : i + 1)
        for (int change = 1; change < 256; ++change) {
            std::string changed = glb;
            changed[i] = static_cast<char>(changed[i] ^ change);
            assert_clean(loaded, changed);
        }
}

TEST(changes_of_each_byte_of_the_json_are_survived) {
    const std::string glb = quad().glb();
    Loaded loaded;
    for (size_t i = 20; i < glb.find(std::string("BIN\0", 4)) - 4; ++i)
        for (const char value : {'\0', ' ', '"', '-', '9', '0', ',', '[', '}', 'e', '\\', '\xFF'}) {
            std::string changed = glb;
            changed[i] = value;
            assert_clean(loaded, changed);
        }
}

TEST(changes_of_each_byte_of_the_geometry_are_survived) {
    const std::string glb = quad().glb();
    Loaded loaded;
    for (size_t i = glb.find(std::string("BIN\0", 4)) + 4; i < glb.size(); ++i)
        for (const char value : {'\0', '\1', '\x7F', '\x80', '\xFF'}) {
            std::string changed = glb;
            changed[i] = value;
            assert_clean(loaded, changed);
        }
}

TEST(containers_that_lie) {
    const std::string glb = quad().glb();
    const auto with_word = [&](size_t at, uint64_t value) {
        std::string word;
        append_word(word, value);
        return std::string(glb).replace(at, 4, word);
    };
    assert_fails(with_word(4, 1), KNURL_ERROR_UNSUPPORTED, {".glb header: expected version 2, found 1"});
    assert_fails(with_word(8, glb.size() + 1), KNURL_ERROR_FORMAT, {".glb header: expected the file's length"});
    assert_fails(with_word(8, 11), KNURL_ERROR_FORMAT, {".glb header: expected the file's length", "found 11"});
    assert_fails(with_word(12, 0xFFFFFFFF), KNURL_ERROR_FORMAT, {".glb chunk 0: expected 4294967295 bytes"});
    assert_fails(with_word(12, 0), KNURL_ERROR_FORMAT, {".glb chunk 1: expected "}); // the text is taken for its header
    assert_fails(builder::glb("", "1234"), KNURL_ERROR_FORMAT, {"JSON: parse error"});
    assert_fails(with_word(16, 0), KNURL_ERROR_FORMAT, {".glb chunk 0: expected the type JSON"});
    assert_int_equal(Loaded(glb + "more than the header says").report.surfaces, 1);
    // A chunk of an unknown type is ignored (glTF 2.0, 4.4.3.1).
    const size_t bin = glb.find(std::string("BIN\0", 4)) - 4;
    std::string more = glb;
    more.insert(bin, std::string("\4\0\0\0ABCDxxxx", 12));
    std::string length;
    append_word(length, more.size());
    assert_int_equal(Loaded(more.replace(8, 4, length)).report.surfaces, 1);
}

} // namespace
