#pragma once

#include <cstdint>
#include <glm/vec2.hpp>

namespace probegi {

/// SplitMix64 (Steele, Lea and Flood 2014, "Fast Splittable Pseudorandom Number Generators"). One stream per path,
/// seeded by the path's purpose, so that neither threads nor the order of work change a picture. 64 bits, since a
/// picture has 10^8 paths: streams of kernels/random.h (32 bits) would overlap.
class Random {
public:
    Random(std::uint64_t seed, std::uint64_t path) : m_state(mix(mix(seed) + path)) {}

    std::uint64_t bits() noexcept { return mix(m_state += 0x9e3779b97f4a7c15ull); }
    /// 0 <= result < 1, 24 bits.
    float next() noexcept { return float(bits() >> 40) * 0x1p-24f; }
    /// 0 <= result < 1, 53 bits: enough to choose among millions.
    double nextDouble() noexcept { return double(bits() >> 11) * 0x1p-53; }
    glm::vec2 nextPair() noexcept {
        const std::uint64_t b = bits();
        return {float(b >> 40) * 0x1p-24f, float(b >> 8 & 0xffffffu) * 0x1p-24f};
    }

private:
    static std::uint64_t mix(std::uint64_t x) noexcept {
        x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
        x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
        return x ^ (x >> 31);
    }

    std::uint64_t m_state;
};

}  // namespace probegi
