#include "field_file/content_hash.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace probegi {

struct ContentHash::State {
    XXH64_state_t xxh;
};

std::uint64_t hashOf(std::span<const std::byte> bytes) noexcept {
    return XXH64(bytes.data(), bytes.size(), 0);
}

ContentHash::ContentHash() : m_state(std::make_unique<State>()) {
    XXH64_reset(&m_state->xxh, 0);
}
ContentHash::~ContentHash() = default;

void ContentHash::add(std::span<const std::byte> bytes) noexcept {
    XXH64_update(&m_state->xxh, bytes.data(), bytes.size());
}

std::uint64_t ContentHash::value() const noexcept {
    return XXH64_digest(&m_state->xxh);
}

}  // namespace probegi
