#include "bake/primitives_hash.h"

#include <cstddef>
#include <span>
#include <type_traits>

namespace probegi::tool {

namespace {

class Hash {
public:
    void add(std::span<const std::byte> bytes) noexcept {
        for (const std::byte byte : bytes) m_value = (m_value ^ std::uint64_t(byte)) * 0x100000001b3;
    }
    template <class T>
    void add(const T& value) noexcept {
        static_assert(std::is_trivially_copyable_v<T>);
        add(std::as_bytes(std::span(&value, 1)));
    }
    template <class List>
    void addList(const List& list) noexcept {
        add(std::uint64_t(list.size()));
        add(std::as_bytes(std::span(list)));
    }
    std::uint64_t value() const noexcept { return m_value; }

private:
    std::uint64_t m_value = 0xcbf29ce484222325;
};

}  // namespace

std::uint64_t hashOf(const SdfScene& sdf) noexcept {
    Hash hash;
    for (const SdfPrimitive& primitive : sdf.primitives) {
        const auto& [name, shape, centre, rotation, halfSize, rounding, albedo, faces, emission, node, pinned] =
            primitive;
        (void)name, (void)pinned;
        hash.add(shape);
        for (const glm::vec3& v : {centre, halfSize, albedo, emission}) hash.add(v);
        hash.add(rotation);
        hash.add(rounding);
        hash.addList(faces);
        hash.addList(node);
    }
    return hash.value();
}

}  // namespace probegi::tool
