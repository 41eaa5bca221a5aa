#!/usr/bin/env bash
# The rules of docs/architecture.md that a compiler does not check. Usage: check.sh RULE [PROJECT_FOLDER]
# Rules: layers names public_headers kernel_tests examples sizes assets words links. Prints violations; exit code 1 if
# there are any.
set -euo pipefail
shopt -s nullglob globstar

rule=${1:?name a rule: layers, names, public_headers, kernel_tests, examples, sizes, assets, words or links}
cd "${2:-$(dirname "${BASH_SOURCE[0]}")/../..}"
complaints=0
complain() {
    echo "$*"
    complaints=1
}

# Files of the project; in an unpacked archive, without git, everything outside build folders.
project_files() {
    git ls-files 2>/dev/null || find . -type f -not -path './build*' -not -path './out/*' -printf '%P\n'
}

# Layers below each folder of src/, which it may include besides itself.
declare -A below=(
    [kernels]=""
    [core]="kernels"
    [scene]="core kernels"
    [io]="sdf scene core kernels"
    [geometry]="scene core kernels"
    [bvh]="scene core kernels"
    [sdf]="scene core kernels"
    [field]="geometry scene core kernels"
    [field_file]="io field sdf geometry scene core kernels"
    [mask]="field geometry scene core kernels"
    [cpu]="field sdf geometry scene core kernels"
    [vulkan]="bvh sdf field geometry scene core kernels"
    [reference]="field geometry scene core kernels"
    [render]="field geometry scene core kernels"
    [backend]=""
    [measure]="field sdf geometry scene core kernels"
)

# Prints "file folder" for each quoted include whose path begins with a folder name.
folder_includes() {
    grep -HoP '^\s*#\s*include\s+"\K[a-z_]+(?=/)' "$@" | tr ':' ' ' || true
}

check_layers() {
    local folder file included
    for folder in src/*/; do
        folder=$(basename "$folder")
        if [[ ! -v "below[$folder]" ]]; then
            complain "src/$folder is a layer that tests/structure/check.sh does not know; say there what it may include"
            continue
        fi
        while read -r file included; do
            [[ $included == probegi || $included == "$folder" || " ${below[$folder]} " == *" $included "* ]] ||
                complain "$file includes $included/, which is not below $folder"
            [[ $included != probegi || $folder != kernels ]] || complain "$file: a kernel includes the public API"
        done < <(folder_includes /dev/null src/"$folder"/**/*.{h,cpp,comp,glsl})
    done
    # The tool has folders of its own, which the accuracy program uses too.
    for folder in apps/*/*/; do
        folder=$(basename "$folder")
        [[ ! -v "below[$folder]" ]] || complain "apps has a folder '$folder', which is the name of a layer"
    done
    while read -r file included; do
        [[ $included == probegi || -d apps/probegi/$included ]] ||
            complain "$file: the tool may include public headers only, not $included/"
    done < <(folder_includes /dev/null apps/**/*.{h,cpp})
}

# No two files of src/ have the same name, so that a name identifies a file.
check_names() {
    local name
    while read -r name; do
        [[ $name == CMakeLists.txt ]] ||
            complain "src has more than one $name: $(find src -name "$name" | sort | tr '\n' ' ')"
    done < <(find src -type f -printf '%f\n' 2>/dev/null | sort | uniq -d)
}

check_public_headers() {
    local file header
    while IFS=: read -r file header; do
        # Engines pass Vulkan handles there.
        [[ "$file $header" != "include/probegi/vulkan/device.h <vulkan/vulkan_core.h>" ]] || continue
        case "$header" in
            \<*.h\> | \<embree* | \<tbb* | \<vulkan* | \<hwy* | \<fmt* | \<nlohmann*)
                complain "$file exposes $header to users"
                ;;
            \<*) ;;
            \"probegi/*) ;;
            *) complain "$file includes $header, which is not installed" ;;
        esac
    done < <(grep -HoP '^\s*#\s*include\s+\K[<"][^>"]+[>"]' include/probegi/**/*.h)
    for file in include/probegi/**/*.h; do
        local types='RTC[A-Z][A-Za-z]*|vk::|tbb::|hwy::|fmt::'
        [[ $file == include/probegi/vulkan/* ]] || types+='|Vk[A-Z][A-Za-z]*'
        if grep -nE "\\b($types)" "$file"; then
            complain "$file names a type of a library that users need not know"
        fi
    done
}

# Comparing backends cannot reveal an error that they share, so each kernel must have a direct test.
check_kernel_tests() {
    local header
    for header in src/kernels/**/*.h; do
        [[ $header != src/kernels/language.h ]] || continue
        grep -q "^#include \"${header#src/}\"" /dev/null tests/kernels/*_test.cpp ||
            complain "$header has no direct test: no file of tests/kernels includes it"
    done
}

check_examples() {
    local file header
    while IFS=: read -r file header; do
        complain "$file includes $header: examples use the public API only"
    done < <(grep -HoP '^\s*#\s*include\s+"\K(?!probegi/)[^"/]*/[^"]+' /dev/null examples/**/*.{h,cpp} || true)
}

check_sizes() {
    local file lines
    while read -r file; do
        [[ -f $file && $file =~ \.(h|cpp|comp|glsl|vert|frag|sh|cmake|js|in)$|CMakeLists\.txt$ ]] || continue
        lines=$(wc -l <"$file")
        ((lines <= 600)) || complain "$file has $lines lines; the limit is 600"
    done < <(project_files)
}

check_assets() {
    local file bytes
    while read -r file; do
        [[ -f $file ]] || continue
        bytes=$(stat -c %s "$file")
        ((bytes <= 1048576)) || complain "$file has $bytes bytes; the limit is 1 MB"
        [[ ! $file =~ \.(o|a|so|spv|exe|pyc)$ ]] || complain "$file is a build product"
        [[ $(head -c 4 "$file" | tr -d '\0') != $'\x7fELF' ]] || complain "$file is a compiled binary"
    done < <(project_files)
}

# Paths of one machine do not belong in a project.
check_words() {
    local file
    while read -r file; do
        [[ -f $file ]] || continue
        if grep -nIE '(^|[^A-Za-z0-9_.])/(work|home|root|Users)/[a-z]' "$file"; then complain "$file names a path of one machine"; fi
    done < <(project_files | grep -v '^tests/structure/')
}

# The anchors of a page's headings: lower case, - for spaces, no punctuation.
anchors() {
    sed -n 's/^##* *//p' "$1" | tr '[:upper:] ' '[:lower:]-' | sed 's/[^a-z0-9_-]//g'
}

# Links between pages and into the project must not be broken.
check_links() {
    local page target file anchor
    while IFS=: read -r page target; do
        [[ $target != *://* ]] || continue
        file=${target%%#*}
        anchor=${target#"$file"}
        file=${file:+$(dirname "$page")/$file}
        file=${file:-$page}
        if [[ ! -e $file ]]; then
            complain "$page links to $target, which is not there"
        elif [[ -n $anchor ]] && ! anchors "$file" | grep -qxF -- "${anchor#\#}"; then
            complain "$page links to $target, but $file has no such heading"
        fi
    done < <(grep -HoP '\]\(\K[^)\s]+' /dev/null ./*.md docs/**/*.md || true)
}

if ! declare -F "check_$rule" >/dev/null; then
    echo "check.sh: there is no rule '$rule'" >&2
    exit 2
fi
"check_$rule"
exit "$complaints"
