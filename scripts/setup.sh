#!/usr/bin/env bash
# Installs the packages that a fresh Debian 12 needs to build ProbeGI: `scripts/setup.sh build` for the tool,
# `scripts/setup.sh test` for the tests and checks as well. If all are there, does nothing and needs no root rights.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source scripts/apt.sh

build_packages=(
    g++ cmake ninja-build ccache
    libembree-dev libtbb-dev        # ray tracing, threads
    libglm-dev libhwy-dev  # vectors, SIMD
    libtinygltf-dev libdraco-dev libstb-dev libopenexr-dev libpng-dev nlohmann-json3-dev  # files
    libzstd-dev libxxhash-dev  # fields in files
    libturbojpeg0-dev libjpeg62-turbo-dev  # the first one's CMake package asks for files of the second
    libcli11-dev libfmt-dev
    libvulkan-dev glslc  # headers and shader compiler; the loader is opened at run time
    spirv-cross          # the field's shader in other languages
)
test_packages=(
    libgtest-dev libgmock-dev libbenchmark-dev
    git  # scripts/mutate.sh copies what it lists
    vulkan-validationlayers vulkan-tools     # validation; vulkaninfo
    chromium chromium-driver nodejs          # opens report.html
    g++-mingw-w64-x86-64-posix wine64 wine   # builds and runs the own-rays engine for Windows
    clang-14 clang-format-14 libclang-rt-14-dev llvm-14  # sanitizers, fuzzing, format
)

setup_goal=${1:-build}
case $setup_goal in
    build) wanted=("${build_packages[@]}") ;;
    test) wanted=("${build_packages[@]}" "${test_packages[@]}") ;;
    *)
        echo "setup.sh: unknown argument '$setup_goal'; say 'build' or 'test'." >&2
        exit 2
        ;;
esac

if ! is_debian_like; then
    echo "setup.sh: this is not a Debian system, so nothing was installed; the build needs the equivalents of: ${wanted[*]}" >&2
    exit 0
fi

install_packages "${wanted[@]}"
if [[ $setup_goal == test ]]; then
    source scripts/software_vulkan.sh
    setup_software_vulkan
fi
