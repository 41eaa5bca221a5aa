#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "io/refused.h"

namespace probegi {

/// Bytes of numbers, in memory's order or in a file's: little-endian.
template <class T>
T littleEndian(T value) noexcept {
    static_assert(std::is_arithmetic_v<T>);
    if constexpr (std::endian::native == std::endian::little) return value;
    std::byte bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    for (std::size_t i = 0; i < sizeof(T) / 2; ++i) std::swap(bytes[i], bytes[sizeof(T) - 1 - i]);
    std::memcpy(&value, bytes, sizeof(T));
    return value;
}

/// Appends numbers, vectors and texts to bytes, without gaps.
class ByteWriter {
public:
    template <class T>
    void put(T value) {
        const T stored = littleEndian(value);
        append(std::as_bytes(std::span(&stored, 1)));
    }
    void put(glm::vec3 v) { put(v.x), put(v.y), put(v.z); }
    void put(glm::ivec3 v) { put(v.x), put(v.y), put(v.z); }
    void put(const glm::quat& q) { put(q.x), put(q.y), put(q.z), put(q.w); }
    void put(std::string_view text) {
        put(std::uint32_t(text.size()));
        append(std::as_bytes(std::span(text)));
    }
    std::span<const std::byte> bytes() const noexcept { return m_bytes; }

private:
    void append(std::span<const std::byte> more) {
        const std::size_t at = m_bytes.size();
        m_bytes.resize(at + more.size());
        if (!more.empty()) std::memcpy(m_bytes.data() + at, more.data(), more.size());
    }

    std::vector<std::byte> m_bytes;
};

/// Reads what ByteWriter wrote. Throws io::Refused beyond the end.
class ByteReader {
public:
    /// `what`: for messages.
    ByteReader(std::span<const std::byte> bytes, std::string_view what) : m_bytes(bytes), m_what(what) {}

    template <class T>
    T take() {
        if constexpr (std::is_same_v<T, glm::vec3> || std::is_same_v<T, glm::ivec3>) {
            T v;
            for (int i = 0; i < 3; ++i) v[i] = take<typename T::value_type>();
            return v;
        } else if constexpr (std::is_same_v<T, glm::quat>) {
            T q;
            q.x = take<float>(), q.y = take<float>(), q.z = take<float>(), q.w = take<float>();
            return q;
        } else if constexpr (std::is_same_v<T, std::string>) {
            const std::span<const std::byte> text = next(take<std::uint32_t>());
            return {reinterpret_cast<const char*>(text.data()), text.size()};
        } else {
            T value;
            std::memcpy(&value, next(sizeof(T)).data(), sizeof(T));
            return littleEndian(value);
        }
    }
    std::size_t left() const noexcept { return m_bytes.size(); }
    /// Refuses what is left over.
    void finish() const {
        if (!m_bytes.empty()) io::refuseMalformed("is damaged: its {} have {} bytes too many", m_what, m_bytes.size());
    }

private:
    std::span<const std::byte> next(std::size_t count) {
        if (count > m_bytes.size()) io::refuseMalformed("is damaged: its {} end too early", m_what);
        const auto taken = m_bytes.first(count);
        m_bytes = m_bytes.subspan(count);
        return taken;
    }

    std::span<const std::byte> m_bytes;
    std::string_view m_what;
};

}  // namespace probegi
