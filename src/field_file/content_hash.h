#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>

namespace probegi {

/// XXH64 with seed 0 (github.com/Cyan4973/xxHash has the specification).
std::uint64_t hashOf(std::span<const std::byte> bytes) noexcept;

/// The same of pieces one after the other. May throw std::bad_alloc.
class ContentHash {
public:
    ContentHash();
    ~ContentHash();
    ContentHash(const ContentHash&) = delete;
    ContentHash& operator=(const ContentHash&) = delete;

    void add(std::span<const std::byte> bytes) noexcept;
    /// A number, or a struct of them without gaps.
    template <class T>
    void add(const T& value) noexcept {
        static_assert(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>);
        add(std::as_bytes(std::span(&value, 1)));
    }
    /// All elements of an array, after their number.
    template <class List>
    void addList(const List& list) noexcept {
        add(std::uint64_t(list.size()));
        add(std::as_bytes(std::span(list)));
    }
    std::uint64_t value() const noexcept;

private:
    struct State;
    std::unique_ptr<State> m_state;
};

}  // namespace probegi
