#pragma once

#include <sys/resource.h>

#include <cstddef>

namespace probegi::test {

/// The most memory that this process has filled so far, bytes.
inline std::size_t peakMemory() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return std::size_t(usage.ru_maxrss) * 1024;
}

}  // namespace probegi::test
