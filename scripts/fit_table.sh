#!/usr/bin/env bash
# The table of docs/sdf.md: how well 64 fitted primitives stand for scenes. Usage: fit_table.sh TOOL [SCENE...]
# Without scenes: the built-in ones, and those of PROBEGI_SCENES (default ../shared/scenes) that are there.
set -euo pipefail

tool=${1:?name the tool, e.g. build/test/apps/probegi/probegi}
shift
scenes=("$@")
if [[ ${#scenes[@]} == 0 ]]; then
    folder=${PROBEGI_SCENES:-$(dirname "${BASH_SOURCE[0]}")/../../shared/scenes}
    scenes=(builtin:house builtin:atrium builtin:cornell builtin:dark-room builtin:terrain)
    for file in "$folder"/sponza/sponza.glb "$folder"/openarena/oa_dm1.glb; do
        [[ ! -f $file ]] || scenes+=("$file")
    done
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

echo "$(grep -m1 'model name' /proc/cpuinfo | cut -d: -f2- | xargs), $(nproc) threads"
echo
echo "| scene | primitives | to the primitives, cm | to the scene, cm | leaking | blocked sky | dim sky blocked | dim leaks | start inside | seconds |"
echo "|---|---|---|---|---|---|---|---|---|---|"
for scene in "${scenes[@]}"; do
    "$tool" fit "$scene" -o "$work/fit.sdf.json" --stats "$work/stats.json" >"$work/log" 2>&1 || {
        cat "$work/log" >&2
        exit 1
    }
    name=$(basename "$scene" .glb)
    awk -F'": ' -v name="${name#builtin:}" '
        { gsub(/[ ",]/, "", $1); value[$1] = $2 + 0 }
        function percent(share) { return sprintf("%.2g %%", 100 * share) }
        function ofSky(share, sky) { return sky > 0 ? percent(share) : "no sky" }
        END {
            printf "| %s | %d | %.3g | %.3g | %s | %s | %s | %s | %s | %.1f |\n", name, value["primitives"],
                100 * value["toPrimitives"], 100 * value["toScene"], percent(value["leaking"]),
                ofSky(value["blockedSky"], value["skyRays"]), ofSky(value["dimBlockedSky"], value["dimSkyRays"]),
                ofSky(value["dimLeaking"], value["dimSkyRays"]), percent(value["startInside"]),
                value["seconds"]
        }' "$work/stats.json"
    rm -f "$work/fit.sdf.json"
done
