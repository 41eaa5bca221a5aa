#include "bake/primitives_hash.h"

#include <cstddef>
#include <span>
#include <vector>
#define XXH_INLINE_ALL
#include <xxhash.h>

namespace probegi::tool {

namespace {

using Bytes = std::vector<std::byte>;

template <class List>
void append(Bytes& bytes, const List& list) {
    const auto added = std::as_bytes(std::span(list));
    bytes.insert(bytes.end(), added.begin(), added.end());
}
template <class T>
void appendValue(Bytes& bytes, const T& value) {
    append(bytes, std::span(&value, 1));
}
template <class List>
void appendCounted(Bytes& bytes, const List& list) {
    appendValue(bytes, std::uint64_t(list.size()));
    append(bytes, list);
}

}  // namespace

std::uint64_t hashOf(const SdfScene& sdf) {
    Bytes bytes;
    for (const SdfPrimitive& primitive : sdf.primitives) {
        const auto& [name, shape, centre, rotation, halfSize, rounding, albedo, faces, emission, node, pinned] =
            primitive;
        (void)name, (void)pinned;
        appendValue(bytes, shape);
        for (const glm::vec3& v : {centre, halfSize, albedo, emission}) appendValue(bytes, v);
        appendValue(bytes, rotation);
        appendValue(bytes, rounding);
        appendCounted(bytes, faces);
        appendCounted(bytes, node);
    }
    return XXH64(bytes.data(), bytes.size(), 0);
}

}  // namespace probegi::tool
