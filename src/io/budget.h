#pragma once

#include <cstdint>
#include <string>

#include "io/refused.h"
#include "probegi/image.h"

namespace probegi::io {

/// Memory that reading a file may use: proportional to its size, with a minimum for small files (ReadLimits). Without
/// it, a few kilobytes that claim a huge picture, or use the same vertices a thousand times, exhaust any machine.
class Budget {
public:
    /// `share`: divisor of the room in `limits`.
    Budget(const ReadLimits& limits, std::uint64_t fileBytes, std::uint64_t share = 1)
        : m_name(limits.name),
          m_megabytes(limits.megabytes),
          m_fileBytes(fileBytes),
          m_limit((limits.megabytes << 20) / share + kProportion * fileBytes) {}

    void charge(std::uint64_t bytes) {
        m_used = bytes > kEverything - m_used ? kEverything : m_used + bytes;
        if (m_used <= m_limit) return;
        refuse(ErrorCode::outOfMemory,
               "unpacks to over {} MB, out of proportion to its {} bytes; if it is meant to, raise {} (now {})",
               m_limit >> 20, m_fileBytes, m_name, m_megabytes);
    }

private:
    static constexpr std::uint64_t kProportion = 64;
    static constexpr std::uint64_t kEverything = ~std::uint64_t(0);

    std::string m_name;
    std::uint64_t m_megabytes;
    std::uint64_t m_fileBytes;
    std::uint64_t m_limit;
    std::uint64_t m_used = 0;
};

/// For geometry and text, which expand to many times their own size.
constexpr std::uint64_t kGeometryShare = 16;

}  // namespace probegi::io
