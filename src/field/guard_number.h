#pragma once

#include <string_view>

#include "kernels/guards/list.h"
#include "probegi/field.h"

namespace probegi {

/// The number by which kernels know a guard: its row in the list of kernels/guards/list.h.
constexpr int guardNumber(LeakGuard guard) {
    return int(guard);
}

#define GUARD(number, point, seen, between, origin, farther) std::string_view(#seen),
inline constexpr std::string_view kGuardRows[] = {PROBEGI_GUARDS(GUARD)};
#undef GUARD
static_assert(kGuardRows[guardNumber(LeakGuard::none)] == "noneSeen");
static_assert(kGuardRows[guardNumber(LeakGuard::moments)] == "momentsSeen");
static_assert(kGuardRows[guardNumber(LeakGuard::masks)] == "masksSeen");
static_assert(kGuardRows[guardNumber(LeakGuard::sdfShadow)] == "sdfShadowSeen");

}  // namespace probegi
