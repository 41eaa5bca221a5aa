#pragma once

#if defined(__SSE2__) || defined(_M_X64)
#include <xmmintrin.h>
#define PROBEGI_HAS_MXCSR 1
#endif

namespace probegi {

/// Flushes denormals to zero on this thread (FTZ and DAZ) during its lifetime: on some processors each costs more than
/// a hundred cycles, and they make no visible difference. Embree's manual recommends it too. Restores the caller's
/// mode. No effect on processors without MXCSR.
class FloatMode {
public:
    FloatMode(const FloatMode&) = delete;
    FloatMode& operator=(const FloatMode&) = delete;
#ifdef PROBEGI_HAS_MXCSR
    FloatMode() : m_before(_mm_getcsr()) {
        _mm_setcsr(m_before | kFlushToZero | kDenormalsAreZero);
    }
    ~FloatMode() {
        _mm_setcsr(m_before);
    }

private:
    static constexpr unsigned kFlushToZero = 1u << 15;
    static constexpr unsigned kDenormalsAreZero = 1u << 6;
    unsigned m_before;
#else
    FloatMode() {}  // not defaulted: an unused variable of a trivial type is a warning
    ~FloatMode() {}
#endif
};

}  // namespace probegi
