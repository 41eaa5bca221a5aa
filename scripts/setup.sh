#!/usr/bin/env bash
# Installs what a fresh Debian 12 lacks to build ProbeGI: `scripts/setup.sh build` for the tool, `scripts/setup.sh test`
# for the tests and checks as well. Does nothing, and needs no rights, when everything is there.
set -euo pipefail

build_packages=(
    g++ cmake ninja-build ccache
    libembree-dev libtbb-dev        # ray tracing, threads
    libglm-dev libeigen3-dev      # vectors, matrix product
    libtinygltf-dev libdraco-dev libstb-dev libopenexr-dev nlohmann-json3-dev  # files
    libturbojpeg0-dev libjpeg62-turbo-dev  # the first one's CMake package asks for files of the second
    libcli11-dev libfmt-dev libexpected-dev
)
test_packages=(
    libgtest-dev libgmock-dev libbenchmark-dev
    libvulkan-dev mesa-vulkan-drivers glslc  # the kernels as GLSL, on software Vulkan
    chromium chromium-driver nodejs          # opens report.html
    clang-14 clang-format-14 libclang-rt-14-dev llvm-14  # sanitizers, fuzzing, format
)

case "${1:-build}" in
    build) wanted=("${build_packages[@]}") ;;
    test) wanted=("${build_packages[@]}" "${test_packages[@]}") ;;
    *)
        echo "setup.sh: unknown argument '$1'; say 'build' or 'test'." >&2
        exit 2
        ;;
esac

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    echo "setup.sh: this is not a Debian system, so nothing was installed; the build needs the equivalents of: ${wanted[*]}" >&2
    exit 0
fi

missing=()
for package in "${wanted[@]}"; do
    status=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)
    [[ $status == installed ]] || missing+=("$package")
done
((${#missing[@]})) || exit 0

echo "Installing ${#missing[@]} packages: ${missing[*]}"
as_root=()
if ((EUID != 0)); then
    if ! command -v sudo >/dev/null; then
        echo "setup.sh: these packages are missing and installing them needs root or sudo; as root, run: apt-get install ${missing[*]}" >&2
        exit 1
    fi
    as_root=(sudo)
fi
apt() {
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -o DPkg::Lock::Timeout=600 -o Dpkg::Use-Pty=0 "$@" </dev/null
}
# Quiet unless it fails: what apt has to say interests nobody otherwise.
log=$(mktemp)
trap 'rm -f "$log"' EXIT
if ! apt update >"$log" 2>&1 || ! apt install -y --no-install-recommends "${missing[@]}" >>"$log" 2>&1; then
    tail -n 30 "$log" >&2
    echo "setup.sh: apt-get could not install the packages above; see its message, then run this again." >&2
    exit 1
fi
