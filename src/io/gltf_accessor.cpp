#include "io/gltf_accessor.h"

#include <algorithm>
#include <cstring>

#include "io/refused.h"

namespace probegi::io {

namespace {

template <class T>
T load(const std::uint8_t* at) {
    T value;
    std::memcpy(&value, at, sizeof(T));
    return value;
}

std::size_t sizeOfComponent(int type) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return 1;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return 2;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        case TINYGLTF_COMPONENT_TYPE_FLOAT:
            return 4;
        default:
            return 0;
    }
}

int componentsOf(int type) {
    switch (type) {
        case TINYGLTF_TYPE_SCALAR:
            return 1;
        case TINYGLTF_TYPE_VEC2:
            return 2;
        case TINYGLTF_TYPE_VEC3:
            return 3;
        case TINYGLTF_TYPE_VEC4:
            return 4;
        default:
            return 0;
    }
}

/// Refuses unless `count` elements of `size` bytes, `stride` apart, fit into `available` bytes from `offset` on.
void checkRange(const std::string& what, std::size_t available, std::size_t offset, std::size_t count,
                std::size_t stride, std::size_t size) {
    if (count == 0) return;
    if (offset > available || size > available - offset || (count - 1) > (available - offset - size) / stride) {
        refuseMalformed("{}: {} elements of {} bytes from offset {} do not fit into the {} bytes of their buffer view",
                        what, count, size, offset, available);
    }
}

std::size_t nonNegative(const std::string& what, int value) {
    if (value < 0) refuseMalformed("{}: the number {} may not be negative", what, value);
    return std::size_t(value);
}

std::uint32_t loadInteger(const std::uint8_t* at, int type) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return *at;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return load<std::uint16_t>(at);
        default:
            return load<std::uint32_t>(at);
    }
}

bool isUnsigned(int type) {
    return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
           type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

}  // namespace

std::span<const std::uint8_t> bytesOfView(const tinygltf::Model& model, int view) {
    if (view < 0 || std::size_t(view) >= model.bufferViews.size()) {
        refuseMalformed("buffer view {} is used, but there are {}", view, model.bufferViews.size());
    }
    const tinygltf::BufferView& v = model.bufferViews[std::size_t(view)];
    if (v.buffer < 0 || std::size_t(v.buffer) >= model.buffers.size()) {
        refuseMalformed("buffer view {} uses buffer {}, but there are {}", view, v.buffer, model.buffers.size());
    }
    const auto& data = model.buffers[std::size_t(v.buffer)].data;
    if (v.byteOffset > data.size() || v.byteLength > data.size() - v.byteOffset) {
        refuseMalformed("buffer view {} ({} bytes from {} on) reaches beyond the {} bytes of its buffer", view,
                        v.byteLength, v.byteOffset, data.size());
    }
    return std::span(data).subspan(v.byteOffset, v.byteLength);
}

AccessorView::AccessorView(const tinygltf::Model& model, int accessor) {
    const std::string what = fmt::format("accessor {}", accessor);
    if (accessor < 0 || std::size_t(accessor) >= model.accessors.size()) {
        refuseMalformed("{} is used, but there are {}", what, model.accessors.size());
    }
    const tinygltf::Accessor& a = model.accessors[std::size_t(accessor)];
    m_count = a.count;
    m_components = componentsOf(a.type);
    m_componentType = a.componentType;
    m_componentSize = sizeOfComponent(a.componentType);
    m_normalized = a.normalized;
    if (m_components == 0) refuseMalformed("{}: matrices are not allowed here", what);
    if (m_componentSize == 0) refuseMalformed("{}: component type {} is not part of glTF", what, a.componentType);
    if (m_count > 0xffffffffu) refuseMalformed("{}: {} elements are too many", what, m_count);
    const std::size_t size = m_componentSize * std::size_t(m_components);
    m_stride = size;
    if (a.bufferView >= 0) {
        const auto bytes = bytesOfView(model, a.bufferView);
        const std::size_t stride = model.bufferViews[std::size_t(a.bufferView)].byteStride;
        if (stride != 0) m_stride = stride;
        if (m_stride < size)
            refuseMalformed("{}: elements of {} bytes overlap at a stride of {}", what, size, m_stride);
        checkRange(what, bytes.size(), a.byteOffset, m_count, m_stride, size);
        if (m_count > 0) m_bytes = bytes.data() + a.byteOffset;
    }
    if (a.sparse.isSparse) addSparse(model, a, what);
}

AccessorView::AccessorView(std::span<const float> values, int components)
    : m_bytes(reinterpret_cast<const std::uint8_t*>(values.data())),
      m_stride(sizeof(float) * std::size_t(components)),
      m_count(values.size() / std::size_t(components)),
      m_components(components),
      m_componentType(TINYGLTF_COMPONENT_TYPE_FLOAT),
      m_componentSize(sizeof(float)) {}

void AccessorView::addSparse(const tinygltf::Model& model, const tinygltf::Accessor& a, const std::string& what) {
    const std::size_t count = nonNegative(what, a.sparse.count);
    const int type = a.sparse.indices.componentType;
    if (!isUnsigned(type)) refuseMalformed("{}: sparse indices may not have component type {}", what, type);
    if (count > m_count) refuseMalformed("{}: {} sparse elements among {}", what, count, m_count);
    const auto indices = bytesOfView(model, a.sparse.indices.bufferView);
    const std::size_t indicesFrom = nonNegative(what, a.sparse.indices.byteOffset);
    const std::size_t indexSize = sizeOfComponent(type);
    checkRange(what, indices.size(), indicesFrom, count, indexSize, indexSize);
    const auto values = bytesOfView(model, a.sparse.values.bufferView);
    const std::size_t valuesFrom = nonNegative(what, a.sparse.values.byteOffset);
    const std::size_t valueSize = m_componentSize * std::size_t(m_components);
    checkRange(what, values.size(), valuesFrom, count, valueSize, valueSize);
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t element = loadInteger(indices.data() + indicesFrom + i * indexSize, type);
        if (element >= m_count || (i > 0 && element <= m_sparseElements.back())) {
            refuseMalformed("{}: sparse index {} is out of range or out of order", what, element);
        }
        m_sparseElements.push_back(element);
    }
    if (count > 0) m_sparseBytes = values.data() + valuesFrom;
}

bool AccessorView::isFloat() const {
    return m_componentType == TINYGLTF_COMPONENT_TYPE_FLOAT;
}

const std::uint8_t* AccessorView::locate(std::size_t element) const {
    const auto found = std::lower_bound(m_sparseElements.begin(), m_sparseElements.end(), element);
    if (found != m_sparseElements.end() && *found == element) {
        const auto slot = std::size_t(found - m_sparseElements.begin());
        return m_sparseBytes + slot * m_componentSize * std::size_t(m_components);
    }
    return m_bytes ? m_bytes + element * m_stride : nullptr;
}

float AccessorView::component(const std::uint8_t* at) const {
    const auto scaled = [&](float value, float largest) {
        return m_normalized ? std::max(value / largest, -1.0f) : value;
    };
    switch (m_componentType) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return scaled(load<std::int8_t>(at), 127);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return scaled(*at, 255);
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return scaled(load<std::int16_t>(at), 32767);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return scaled(load<std::uint16_t>(at), 65535);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return float(load<std::uint32_t>(at));
        default:
            return load<float>(at);
    }
}

glm::vec4 AccessorView::vector(std::size_t element) const {
    glm::vec4 v(0.0f);
    const std::uint8_t* at = locate(element);
    if (!at) return v;
    for (int c = 0; c < m_components; ++c) v[c] = component(at + std::size_t(c) * m_componentSize);
    return v;
}

std::uint32_t AccessorView::integer(std::size_t element) const {
    const std::uint8_t* at = locate(element);
    return at ? loadInteger(at, m_componentType) : 0;
}

}  // namespace probegi::io
