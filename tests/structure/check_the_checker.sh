#!/usr/bin/env bash
# Breaks each rule of check.sh in a scratch project, and checks that it complains.
set -euo pipefail

check=$(realpath "$(dirname "${BASH_SOURCE[0]}")/check.sh")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
failed=0

# expect_complaint RULE FILES CONTENT: in a project of only these files, the rule must complain.
expect_complaint() {
    local project=$scratch/project file
    rm -rf "$project"
    mkdir -p "$project/include/probegi"
    echo '#include <vector>' >"$project/include/probegi/good.h"
    "$check" "$1" "$project" >/dev/null || { echo "rule $1 complains about a sound project" && failed=1; }
    for file in $2; do
        mkdir -p "$project/$(dirname "$file")"
        printf '%b' "$3" >"$project/$file"
    done
    if "$check" "$1" "$project" >/dev/null; then
        echo "rule $1 did not notice $2: $3"
        failed=1
    fi
}

expect_complaint layers src/scene/a.cpp '#include "cpu/b.h"\n'
expect_complaint layers src/cpu/a.h '#include "render/b.h"\n'
expect_complaint layers src/kernels/a.h '#include "probegi/field.h"\n'
expect_complaint layers src/vulkan/a.cpp '#include "cpu/b.h"\n'
expect_complaint layers src/vulkan/shaders/a.comp '#include "cpu/b.h"\n'
expect_complaint layers src/cpu/a.cpp '#include "vulkan/b.h"\n'
expect_complaint layers src/unheard_of/a.cpp 'int x;\n'
expect_complaint layers src/measure/a.cpp '#include "cpu/b.h"\n'
expect_complaint layers apps/tool/a.cpp '#include "field/b.h"\n'
expect_complaint layers apps/tool/field/a.cpp '#include "field/b.h"\n'
expect_complaint names 'src/core/a.h src/io/image/a.h' 'int x;\n'
expect_complaint public_headers include/probegi/a.h '#include <embree3/rtcore.h>\n'
expect_complaint public_headers include/probegi/a.h '#include "core/b.h"\n'
expect_complaint public_headers include/probegi/a.h 'RTCScene scene();\n'
expect_complaint public_headers include/probegi/a.h '#include <vulkan/vulkan_core.h>\n'
expect_complaint public_headers include/probegi/a.h 'VkDevice device();\n'
expect_complaint public_headers include/probegi/vulkan/device.h '#include <vulkan/vulkan_raii.hpp>\n'
expect_complaint public_headers include/probegi/vulkan/device.h 'vk::Device device();\n'
expect_complaint kernel_tests src/kernels/a.h 'int x;\n'
expect_complaint examples examples/a/main.cpp '#include "core/b.h"\n'
expect_complaint sizes src/core/a.cpp "$(printf '\\n%.0s' {1..601})"
expect_complaint sizes src/vulkan/shaders/a.glsl "$(printf '\\n%.0s' {1..601})"
expect_complaint assets a.bin "$(head -c 1100000 /dev/zero | tr '\0' y)"
expect_complaint assets a.bin '\0177ELF'
expect_complaint words src/core/a.cpp '// see /home/someone/notes\n'
expect_complaint links a.md 'See [there](docs/no.md).\n'
expect_complaint links docs/a.md '# Some words\n[above](#some-word)\n'
exit "$failed"
