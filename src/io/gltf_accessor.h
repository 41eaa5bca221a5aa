#pragma once

#include <cstdint>
#include <glm/vec4.hpp>
#include <span>
#include <string>
#include <vector>

#include "io/tinygltf.h"

namespace probegi::io {

/// The bytes of a buffer view, after checking that it lies within its buffer.
std::span<const std::uint8_t> bytesOfView(const tinygltf::Model& model, int view);

/// Random access to the elements of an accessor. Construction checks every index, offset, stride and count against the
/// buffers; reading allocates nothing. The model must outlive it.
class AccessorView {
public:
    AccessorView(const tinygltf::Model& model, int accessor);
    /// Packed floats that are already in memory, e.g. decompressed.
    AccessorView(std::span<const float> values, int components);

    std::size_t count() const { return m_count; }
    int components() const { return m_components; }
    bool isFloat() const;
    bool normalized() const { return m_normalized; }
    int componentType() const { return m_componentType; }

    /// element < count(). Missing components are 0; normalised integers are 0..1 or -1..1 (glTF 2.0, section 3.6.2.2).
    glm::vec4 vector(std::size_t element) const;
    /// First component of an unsigned integer accessor.
    std::uint32_t integer(std::size_t element) const;

private:
    void addSparse(const tinygltf::Model& model, const tinygltf::Accessor& accessor, const std::string& what);
    const std::uint8_t* locate(std::size_t element) const;
    float component(const std::uint8_t* at) const;

    const std::uint8_t* m_bytes = nullptr;  ///< null: all zeros except sparse elements
    std::size_t m_stride = 0;
    std::size_t m_count = 0;
    int m_components = 0;
    int m_componentType = 0;
    std::size_t m_componentSize = 0;
    bool m_normalized = false;
    std::vector<std::uint32_t> m_sparseElements;  ///< strictly increasing
    const std::uint8_t* m_sparseBytes = nullptr;
};

}  // namespace probegi::io
