// SPDX-License-Identifier: MIT
#include "accessor.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace knurl::gltf {
namespace {

/// `count` elements in a buffer, `stride` bytes apart, all inside the buffer.
struct Elements {
    const unsigned char *data = nullptr;
    size_t stride = 0;
    size_t count = 0;
    size_t components = 0;
    int component_type = 0;
    bool normalized = false;

    const unsigned char *component(size_t element, size_t i) const {
        return data + element * stride +
               i * static_cast<size_t>(tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(component_type)));
    }
};

template <typename T>
T value_at(const unsigned char *at) {
    T value;
    std::memcpy(&value, at, sizeof value); // the file may not be aligned
    return value;
}

/// Sets data and stride of `elements` from an offset into a bufferView. The sums and products cannot wrap, because
/// filter.cpp limits all numbers to 2^31.
void locate(const Model &model, int view_index, size_t offset, bool strided, Elements &elements,
            const std::string &where) {
    const tinygltf::BufferView &view = model.views.at(view_index);
    const Bytes &bytes = model.buffers.at(view.buffer).bytes;
    const std::string view_label = "bufferView " + std::to_string(view_index);
    if (uint64_t{view.byteOffset} + view.byteLength > bytes.size)
        refuse(where, view_label + " ends at byte " + std::to_string(uint64_t{view.byteOffset} + view.byteLength) +
                          " of a buffer of " + std::to_string(bytes.size) + " bytes");
    const uint64_t size =
        uint64_t{elements.components} *
        static_cast<uint64_t>(tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(elements.component_type)));
    const uint64_t stride = strided && view.byteStride != 0 ? view.byteStride : size;
    if (stride < size)
        refuse(where, view_label + ": byteStride: expected at least " + std::to_string(size) + ", found " +
                          std::to_string(stride));
    const uint64_t end = uint64_t{offset} + stride * (elements.count - 1) + size;
    if (end > view.byteLength)
        refuse(where, "expected " + std::to_string(elements.count) + " elements up to byte " + std::to_string(end) +
                          ", found a " + view_label + " of " + std::to_string(view.byteLength) + " bytes");
    elements.data = bytes.data + view.byteOffset + offset;
    elements.stride = static_cast<size_t>(stride);
}

/// An accessor's elements without the sparse ones. data is null if it has no bufferView: all elements are zero.
Elements dense_elements(const Model &model, const tinygltf::Accessor &accessor, size_t most, const std::string &where) {
    Elements elements;
    elements.count = accessor.count;
    elements.components = static_cast<size_t>(tinygltf::GetNumComponentsInType(static_cast<uint32_t>(accessor.type)));
    elements.component_type = accessor.componentType;
    elements.normalized = accessor.normalized;
    if (accessor.bufferView < 0)
        most = std::min(most, zeros_max);
    if (elements.count < 1 || elements.count > most)
        refuse(where, "count: expected 1 to " + std::to_string(most) +
                          (accessor.bufferView < 0 ? " without a bufferView" : "") + ", found " +
                          std::to_string(elements.count));
    if (accessor.bufferView >= 0)
        locate(model, accessor.bufferView, accessor.byteOffset, true, elements, where);
    return elements;
}

uint32_t whole_at(const Elements &elements, size_t i) {
    const unsigned char *at = elements.component(i, 0);
    if (elements.component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE)
        return *at;
    if (elements.component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT)
        return value_at<uint16_t>(at);
    return value_at<uint32_t>(at);
}

void check_whole_type(int type, const std::string &where) {
    if (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE && type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
        type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
        refuse(where, "componentType: expected 5121, 5123 or 5125 (unsigned), found " + std::to_string(type));
}

/// glTF 2.0, 3.6.2.2: a signed integer's least value and the next both mean -1.
template <typename T>
float normalised(T value) {
    return std::max(static_cast<float>(value) / static_cast<float>(std::numeric_limits<T>::max()), -1.0F);
}

template <typename T>
void widen(const Elements &elements, size_t i, float *out) {
    for (size_t c = 0; c < elements.components; ++c) {
        const T value = value_at<T>(elements.component(i, c));
        out[c] = elements.normalized ? normalised(value) : static_cast<float>(value);
    }
}

void element_to_floats(const Elements &elements, size_t i, float *out) {
    switch (elements.component_type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        return widen<int8_t>(elements, i, out);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return widen<uint8_t>(elements, i, out);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return widen<int16_t>(elements, i, out);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return widen<uint16_t>(elements, i, out);
    default:
        std::memcpy(out, elements.component(i, 0), elements.components * sizeof *out);
    }
}

/// Reads all elements, the sparse ones over the others: copy(elements, i, to) converts element i.
template <typename T, typename Copy>
std::vector<T> read_elements(const Model &model, const tinygltf::Accessor &accessor, const Elements &elements,
                             const std::string &where, const Copy &copy) {
    std::vector<T> out(elements.count * elements.components);
    for (size_t i = 0; elements.data != nullptr && i < elements.count; ++i)
        copy(elements, i, &out[i * elements.components]);
    if (!accessor.sparse.isSparse)
        return out;
    const std::string place = where + ": sparse";
    const auto count = static_cast<size_t>(accessor.sparse.count);
    if (count > elements.count)
        refuse(place, "count: expected at most " + std::to_string(elements.count) + ", found " + std::to_string(count));
    check_whole_type(accessor.sparse.indices.componentType, place + ".indices");
    Elements indices;
    indices.count = count;
    indices.components = 1;
    indices.component_type = accessor.sparse.indices.componentType;
    locate(model, accessor.sparse.indices.bufferView, static_cast<size_t>(accessor.sparse.indices.byteOffset), false,
           indices, place + ".indices");
    Elements values = elements;
    values.count = count;
    locate(model, accessor.sparse.values.bufferView, static_cast<size_t>(accessor.sparse.values.byteOffset), false,
           values, place + ".values");
    for (size_t j = 0; j < count; ++j) {
        const uint32_t i = whole_at(indices, j);
        if (i >= elements.count)
            refuse(place, "index " + std::to_string(j) + ": expected below " + std::to_string(elements.count) +
                              ", found " + std::to_string(i));
        copy(values, j, &out[i * elements.components]);
    }
    return out;
}

/// An accessor, and its name in messages.
struct Source {
    Source(const Model &model, int index, const std::string &where)
        : accessor(model.accessors.at(index)), place(where + " (accessor " + std::to_string(index) + ")") {}

    const tinygltf::Accessor &accessor;
    std::string place;
};

} // namespace

size_t count_elements(const Model &model, int index, size_t components, size_t most, const std::string &where) {
    const Source source(model, index, where);
    if (components == 1)
        check_whole_type(source.accessor.componentType, source.place);
    const Elements elements = dense_elements(model, source.accessor, most, source.place);
    if (elements.components != components)
        refuse(source.place, "type: expected " + (components == 1 ? "SCALAR" : "VEC" + std::to_string(components)) +
                                 ", found one of " + std::to_string(elements.components) + " components");
    return elements.count;
}

std::vector<float> read_floats(const Model &model, int index, const std::string &where, bool only_finite) {
    const Source source(model, index, where);
    const Elements elements = dense_elements(model, source.accessor, vertices_max, source.place);
    if (elements.component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
        refuse(source.place, "componentType: expected 5126 (float) or integers of 8 or 16 bits, found 5125");
    std::vector<float> out = read_elements<float>(model, source.accessor, elements, source.place, element_to_floats);
    for (size_t i = 0; only_finite && i < out.size(); ++i)
        if (!knurl_is_finite(out[i]))
            refuse(source.place, "element " + std::to_string(i / elements.components) +
                                     ": expected finite numbers, found " + (std::isnan(out[i]) ? "NaN" : "infinity"));
    return out;
}

std::vector<uint32_t> read_indices(const Model &model, int index, size_t vertex_count, const std::string &where) {
    const Source source(model, index, where);
    const Elements elements = dense_elements(model, source.accessor, 3 * triangles_max, source.place);
    std::vector<uint32_t> out =
        read_elements<uint32_t>(model, source.accessor, elements, source.place,
                                [](const Elements &from, size_t i, uint32_t *to) { *to = whole_at(from, i); });
    for (size_t i = 0; i < out.size(); ++i)
        if (out[i] >= vertex_count)
            refuse(source.place, "index " + std::to_string(i) + ": expected below " + std::to_string(vertex_count) +
                                     " (the vertices), found " + std::to_string(out[i]));
    return out;
}

} // namespace knurl::gltf
