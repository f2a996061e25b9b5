// Small glTF files that demand much: each of about 1 MB or less, and valid.
// SPDX-License-Identifier: MIT
#ifndef KNURL_TESTS_GLTF_BOMBS_HPP
#define KNURL_TESTS_GLTF_BOMBS_HPP

#include "gltf/builder.hpp"

#include <cmath>
#include <numeric>

namespace builder {

inline std::string repeated(const std::string &text, size_t count) {
    std::string all;
    all.reserve(text.size() * count);
    for (size_t i = 0; i < count; ++i)
        all += text;
    return all;
}

/** "item,item,...,item" */
inline std::string listed(const std::string &item, size_t count) {
    return repeated(item + ",", count - 1) + item;
}

/** Nodes that show mesh 0, each with a slightly different scale if `scaled`. */
inline std::string showing(size_t count, bool scaled) {
    std::string nodes;
    for (size_t i = 0; i < count; ++i)
        nodes += std::string(i ? "," : "") + R"({"mesh":0)" +
                 (scaled ? R"(,"scale":[1.)" + std::to_string(1000 + i) + ",1,1]" : "") + "}";
    return nodes;
}

/** A bent strip of `points` byte-sized vertices and as many triangles, quantised: some 5 bytes a triangle. */
inline File dense_mesh(size_t points) {
    File file;
    std::vector<int16_t> positions;
    for (size_t i = 0; i < points; ++i) {
        const double turn = 0.01 * static_cast<double>(i);
        positions.insert(positions.end(),
                         {static_cast<int16_t>(300.0 * std::cos(turn) + (i % 2 ? 40.0 : 0.0)),
                          static_cast<int16_t>(300.0 * std::sin(turn)), static_cast<int16_t>(i / 8), int16_t{0}});
    }
    const int view = file.view(positions, R"(,"byteStride":8)");
    const int accessor =
        file.accessor(R"("bufferView":)" + std::to_string(view) + "," + File::element(SHORT, "VEC3", points));
    return plain(std::move(file), accessor, R"(,"mode":5)");
}

/** A mesh whose one accessor has no bufferView, 2^22 vertices and three that are not 0. */
inline File sparse_mesh(size_t count) {
    File file;
    const int indices = file.view(std::vector<uint8_t>{0, 1, 2, 0});
    const int values = file.view(std::vector<float>{0, 0, 0, 0.1F, 0, 0, 0, 0.1F, 0});
    const int positions = file.accessor(File::element(FLOAT, "VEC3", count) + R"(,"sparse":{"count":3,"indices":{)" +
                                        R"("componentType":5121,"bufferView":)" + std::to_string(indices) +
                                        R"(},"values":{"bufferView":)" + std::to_string(values) + "}}");
    const int corners = file.shorts({0, 1, 2});
    return plain(std::move(file), positions, R"(,"indices":)" + std::to_string(corners));
}

/** The hash that tables of positions went by before it was seeded. */
inline uint64_t unseeded_hash(const float *p) {
    uint64_t hash = 0xcbf29ce484222325U;
    for (int axis = 0; axis < 3; ++axis) {
        uint32_t bits = 0;
        std::memcpy(&bits, &p[axis], sizeof bits);
        hash = (hash ^ bits) * 0x9e3779b97f4a7c15U;
        hash ^= hash >> 29U;
    }
    return hash;
}

/** Triangles whose positions all come to the first few of that hash's 2^18 slots. */
inline std::vector<float> colliding_positions(size_t count) {
    std::vector<float> positions;
    uint32_t state = 1;
    const auto random = [&state] {
        state = state * 1664525U + 1013904223U;
        return static_cast<float>(state >> 8U) * 0x1p-24F;
    };
    while (positions.size() < 3 * count) {
        const float p[3] = {random(), random(), random()};
        if ((unseeded_hash(p) & 0x3FFFFU) < 256)
            positions.insert(positions.end(), {p[0], p[1], p[2]});
    }
    return positions;
}

/** Flat triangles: each in a square of its own, or all about one place. */
inline std::vector<float> scattered_triangles(size_t count, bool heaped) {
    std::vector<float> positions;
    for (size_t i = 0; i < count; ++i) {
        const auto x = heaped ? 1e-4F * static_cast<float>(i) : static_cast<float>(i % 160);
        const auto y = heaped ? 0.0F : static_cast<float>(i) / 160.0F;
        positions.insert(positions.end(), {x, y, 0, x + 0.9F, y, 0, x, y + 0.9F, 0});
    }
    return positions;
}

/** Tagged by its mesh, whose primitives are as given. */
inline File tagged_mesh(File file, const std::string &primitives) {
    file.materials.clear();
    file.meshes = "{" + tag(R"("axis":[1,0,0])") + R"(,"primitives":[)" + primitives + "]}";
    return file;
}

struct Bomb {
    const char *name;
    std::string bytes;
};

/** Meshes that many nodes or primitives show. */
inline void add_crowds(std::vector<Bomb> &all) {
    File file = sparse_mesh(size_t{1} << 22U);
    file.nodes = showing(4000, false);
    all.push_back({"4,000 nodes show one accessor without a bufferView", file.glb()});
    file.nodes = showing(4000, true);
    all.push_back({"the same, each node scaled", file.glb()});

    file = quad();
    file.nodes = R"({"mesh":0,"name":")" + std::string(65000, 'n') + R"("})";
    all.push_back({"a name of 65,000 bytes, 150,000 primitives", tagged_mesh(file, listed(R"({})", 150000)).glb()});
    File named = quad();
    named.nodes = R"({"mesh":0,"name":")" + std::string(500000, 'n') + R"("})";
    all.push_back({"a name of 500,000 bytes, 8,000 good primitives",
                   tagged_mesh(named, listed(R"({"attributes":{"POSITION":0},"indices":2})", 8000)).glb()});

    file = dense_mesh(105000);
    file.nodes = showing(900, false);
    all.push_back({"one mesh of 105,000 triangles, 900 nodes", file.glb()});
    file.nodes = showing(900, true);
    all.push_back({"the same, each node scaled", file.glb()});
    File twins = dense_mesh(100000);
    twins.meshes = R"({"primitives":[)" + listed(R"({"material":0,"mode":5,"attributes":{"POSITION":0}})", 2000) + "]}";
    all.push_back({"one mesh as 2,000 primitives", twins.glb()});
    File parts = dense_mesh(100000);
    std::string primitives;
    for (int i = 0; i < 3000; ++i) {
        const int corners = parts.accessor(R"("bufferView":1,"byteOffset":)" + std::to_string(2 * i) + "," +
                                           File::element(USHORT, "SCALAR", 3));
        primitives += std::string(i ? "," : "") + R"({"material":0,"attributes":{"POSITION":0},"indices":)" +
                      std::to_string(corners) + "}";
    }
    std::vector<uint16_t> order(3002);
    std::iota(order.begin(), order.end(), uint16_t{0});
    parts.view(order);
    parts.meshes = R"({"primitives":[)" + primitives + "]}";
    all.push_back({"3,000 primitives with a triangle each out of 100,000 vertices", parts.glb()});
}

/** Long lists of unused objects, and lists that just fit. */
inline void add_lists(std::vector<Bomb> &all) {
    File file = quad();
    file.accessors += repeated(",0", 500000);
    all.push_back({"500,000 unused accessors", file.glb()});
    file = quad();
    file.nodes += repeated(",{}", 330000);
    all.push_back({"330,000 unused nodes", file.glb()});
    file = quad();
    file.views += repeated(",0", 500000);
    all.push_back({"500,000 unused bufferViews", file.glb()});
    file = quad();
    file.buffers = R"({"byteLength":)" + std::to_string(file.bin.size()) + "}" + repeated(",0", 500000);
    all.push_back({"500,000 unused buffers", file.glb()});
    file = quad();
    file.meshes += repeated(",{}", 330000);
    all.push_back({"330,000 unused meshes", file.glb()});
    file = quad();
    file.meshes = R"({"primitives":[)" + file.meshes.substr(std::strlen(R"({"primitives":[)"));
    file.meshes.resize(file.meshes.size() - 2);
    file.meshes += repeated(",{}", 330000) + "]}";
    all.push_back({"330,000 untagged primitives beside a tagged one", file.glb()});
    file = quad();
    file.nodes = listed(R"({"mesh":0})", 90000);
    all.push_back({"90,000 nodes show a quad", file.glb()});
    file.nodes = listed(R"({"mesh":0,"name":"n"})", 45000);
    all.push_back({"45,000 nodes of one name show a quad", file.glb()});
    file = quad();
    file.nodes += R"(,{"name":")" + std::string(900000, 'n') + R"("})";
    all.push_back({"an unused name of 900,000 bytes", file.glb()});
    all.push_back({"80,000 colliding positions", plain(colliding_positions(79998)).glb()});
    const std::string text = quad().gltf();
    all.push_back({"130,000 objects of one number",
                   text.substr(0, text.size() - 1) + R"(,"x":[)" + listed(R"({"":0})", 130000) + "]}"});
    all.push_back({"24,000 flat triangles apart from each other", plain(scattered_triangles(24000, false)).glb()});
    all.push_back({"24,000 flat triangles over each other", plain(scattered_triangles(24000, true)).glb()});
}

inline std::vector<Bomb> bombs() {
    std::vector<Bomb> all;
    add_crowds(all);
    add_lists(all);
    return all;
}

} // namespace builder
#endif
