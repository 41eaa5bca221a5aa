#pragma once

#include <ostream>
#include <span>

#include "kernels_gpu/lane.h"

namespace probegi::test {

/// A kernel header and its test: shaders/NAME.comp as C++ and as SPIR-V.
struct KernelCase {
    const char* name;
    void (*evaluate)(kernels::Lane&);
    const char* spirvPath;

    friend std::ostream& operator<<(std::ostream& out, const KernelCase& kernel) { return out << kernel.name; }
};

/// All kernel tests; CMake generates the table from the files in shaders/.
std::span<const KernelCase> kernelCases();

}  // namespace probegi::test
