#!/usr/bin/env bash
# Measures the Vulkan backend on this machine's GPU, or on software Vulkan, and puts the tables between the marks
# <!-- bench-vulkan:begin --> and <!-- bench-vulkan:end --> of docs/performance.md.
set -euo pipefail

usage() {
    cat <<'TEXT'
Usage: scripts/bench_vulkan.sh [SCENE [options of probegi bench]]

Without arguments: Sponza from PROBEGI_SCENES (default ../shared/scenes) with sun and sky, 22x14x32 probes of 144 rays, by
the library's own BVH; without Sponza, builtin:atrium. Then the blend and the query against their baselines.
Builds the tool and the benchmarks (Release) in build/bench first.

Example: scripts/bench_vulkan.sh
Example: scripts/bench_vulkan.sh builtin:house --tracer ray-query --device 0
TEXT
}

if [[ ${1:-} == -h || ${1:-} == --help ]]; then
    usage
    exit 0
fi
if (($# > 0)) && [[ $1 != builtin:* ]]; then
    [[ -f $1 ]] || { echo "bench_vulkan.sh: '$1' is not a file; give a .glb or .gltf scene." >&2; exit 1; }
    set -- "$(realpath "$1")" "${@:2}"
fi
cd "$(dirname "${BASH_SOURCE[0]}")/.."
scripts/setup.sh build
cmake -S . -B build/bench -G Ninja -DCMAKE_BUILD_TYPE=Release -DPROBEGI_TESTS=OFF --log-level=WARNING
cmake --build build/bench

sponza=${PROBEGI_SCENES:-../shared/scenes}/sponza/sponza.glb
if (($# == 0)) && [[ -f $sponza ]]; then
    set -- "$sponza" --sky 0.6,0.8,1.2 --probes 22x14x32 --rays 144 --tracer bvh
fi
table=$(mktemp)
trap 'rm -f "$table"' EXIT
sed -n 's/^model name[^:]*: *\(.*\)/Host: \1, /p' /proc/cpuinfo | head -n 1 | tr -d '\n' | tee "$table"
echo "$(nproc) threads, load $(cut -d ' ' -f 1 /proc/loadavg) at the start" | tee -a "$table"
build/bench/apps/probegi/probegi bench --backend vulkan "$@" | tee -a "$table"

# The counters of the benchmarks as rows of a table.
{
    echo
    echo "| against its baselines, room of 22x14x32 x 144 rays | median |"
    echo "|---|---|"
    build/bench/bench/probegi_bench --benchmark_filter=vulkan --benchmark_format=json 2>/dev/null |
        sed -n 's/^ *"name": "\([A-Za-z]*\).*/name \1/p; s/^ *"\([a-z/]*\(_ms\)\{0,1\}\)": \([0-9.e+-]*\),\{0,1\}$/\1 \3/p' |
        awk '$1 == "name" { name = $2 }
             $1 ~ /_ms$/ { sub(/_ms$/, "", $1); printf "| %s: %s | %.4g ms |\n", name, $1, $2 }
             $1 ~ /\// { printf "| %s: %s | %.3g to 1 |\n", name, $1, $2 }'
} | tee -a "$table"

page=docs/performance.md
if ! grep -q '^<!-- bench-vulkan:begin -->$' "$page" || ! grep -q '^<!-- bench-vulkan:end -->$' "$page"; then
    echo "bench_vulkan.sh: $page has no lines <!-- bench-vulkan:begin --> and <!-- bench-vulkan:end -->; add them where the tables belong." >&2
    exit 1
fi
awk -v table="$table" '
    $0 == "<!-- bench-vulkan:end -->" { inside = 0 }
    !inside { print }
    $0 == "<!-- bench-vulkan:begin -->" { inside = 1; while ((getline line < table) > 0) print line; close(table) }
' "$page" >"$page.new"
mv "$page.new" "$page"
