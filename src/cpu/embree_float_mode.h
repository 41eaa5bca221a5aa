#pragma once

#if defined(__SSE2__) || defined(_M_X64)
#include <xmmintrin.h>
#define PROBEGI_HAS_MXCSR 1
#endif

namespace probegi {

/// While it lives, denormal numbers count as zero on this thread (FTZ and DAZ), as Embree's manual recommends:
/// they cost a hundred cycles each. The caller's mode comes back afterwards.
class EmbreeFloatMode {
public:
    EmbreeFloatMode(const EmbreeFloatMode&) = delete;
    EmbreeFloatMode& operator=(const EmbreeFloatMode&) = delete;
#ifdef PROBEGI_HAS_MXCSR
    EmbreeFloatMode() : m_before(_mm_getcsr()) {
        _mm_setcsr(m_before | kFlushToZero | kDenormalsAreZero);
    }
    ~EmbreeFloatMode() {
        _mm_setcsr(m_before);
    }

private:
    static constexpr unsigned kFlushToZero = 1u << 15;
    static constexpr unsigned kDenormalsAreZero = 1u << 6;
    unsigned m_before;
#else
    EmbreeFloatMode() = default;
#endif
};

}  // namespace probegi
