#!/usr/bin/env bash
# What each leak guard lets through a thin wall: the light in builtin:dark-room's dark room over that in its lit one, as a
# table for docs/accuracy.md.
set -euo pipefail

usage() {
    cat <<'TEXT'
Usage: scripts/guard_table.sh [TOOL]

TOOL: a built `probegi` (default build/demo/apps/probegi/probegi, which ./demo builds). Takes a few minutes.

Example: scripts/guard_table.sh build/demo/apps/probegi/probegi
TEXT
}

if [[ ${1:-} == -h || ${1:-} == --help ]]; then
    usage
    exit 0
fi
cd "$(dirname "${BASH_SOURCE[0]}")/.."
tool=${1:-build/demo/apps/probegi/probegi}
[[ -x $tool ]] || { echo "guard_table.sh: '$tool' is not there; run ./demo, or name a built probegi." >&2; exit 1; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# light CAMERA OPTIONS...: a picture of the irradiance there after 20 updates.
light() {
    "$tool" render builtin:dark-room --camera "$1" -o "$folder/$1.exr" --aov irradiance --size 160x90 --antialias 1 \
        --frames 20 "${@:2}" >/dev/null
}

# leak OPTIONS...: prints how much of the lit room's light is in the dark one.
leak() {
    light dark "$@"
    light lit "$@"
    "$tool" compare "$folder/dark.exr" "$folder/lit.exr" --json | awk -F': ' '/"mean"/ { print 100 * $2 }'
}

echo "| wall, cm | probes | none | moments | masks, K = 4 | masks, K = 6, strict | sdf-shadow | sdfddgi |"
echo "|---|---|---|---|---|---|---|---|"
for wall in 0.02 0.1; do
    "$tool" fit builtin:dark-room --wall "$wall" -o "$folder/$wall.sdf.json" >/dev/null
    for probes in 12x4x10 18x6x15; do
        row="| $(awk -v wall="$wall" 'BEGIN { print wall * 100 }') | $probes |"
        for guard in "--method leaky" "--leak-guard moments" "--leak-guard masks" "--leak-guard masks --mask-strict" \
            "--sdf $folder/$wall.sdf.json --probe-rays mesh --leak-guard sdf-shadow" \
            "--sdf $folder/$wall.sdf.json --method sdfddgi"; do
            read -ra options <<<"$guard"
            row+=" $(leak --wall "$wall" --probes "$probes" "${options[@]}" | awk '{ if ($1 < 0.001) print "< 0.001 %"; else printf "%.3g %%", $1 }') |"
        done
        echo "$row"
    done
done
