#!/usr/bin/env bash
# Measures on this machine and puts the tables between the marks <!-- bench:begin --> and <!-- bench:end --> of
# docs/performance.md, which has a section for each family of processors, and the most important rows into README.md.
# Run it only while the machine does nothing else.
set -euo pipefail

usage() {
    cat <<'TEXT'
Usage: scripts/bench.sh [SCENE [options of probegi bench]]

Without arguments: Sponza from PROBEGI_SCENES (default ../shared/scenes) with sun and sky, 22x14x32 probes of 144 rays, on
2 threads, and volumes of up to a million probes (2 GB of memory); without Sponza, builtin:atrium. Builds the
tool (Release) in build/demo first.

Example: scripts/bench.sh
Example: scripts/bench.sh builtin:house --threads 4 --growth-million
TEXT
}

if [[ ${1:-} == -h || ${1:-} == --help ]]; then
    usage
    exit 0
fi
if (($# > 0)) && [[ $1 != builtin:* ]]; then
    [[ -f $1 ]] || { echo "bench.sh: '$1' is not a file; give a .glb or .gltf scene." >&2; exit 1; }
    set -- "$(realpath "$1")" "${@:2}"
fi
cd "$(dirname "${BASH_SOURCE[0]}")/.."
scripts/setup.sh build
cmake -S . -B build/demo -G Ninja -DCMAKE_BUILD_TYPE=Release -DPROBEGI_TESTS=OFF -DPROBEGI_BENCH=OFF --log-level=WARNING
cmake --build build/demo

sponza=${PROBEGI_SCENES:-../shared/scenes}/sponza/sponza.glb
if (($# == 0)) && [[ -f $sponza ]]; then
    set -- "$sponza" --sky 0.6,0.8,1.2 --probes 22x14x32 --rays 144 --threads 2 --growth-million
fi
table=$(mktemp)
trap 'rm -f "$table" "$table".*' EXIT
build/demo/apps/probegi/probegi bench "$@" | tee "$table"

# The most important rows of the table: times of an update, a query and a picture, and memory.
short_table() {
    awk -F ' *[|] *' '
        !/^[|]/ && !told { print; told = /./ }
        /^$/ && told == 1 { print; told = 2 }
        $2 == "measured" || $2 ~ /^(update: all|query of|picture: |memory a probe)/ { printf "| %s | %s |\n", $2, $3 }
        $2 == "measured" { print "|---|---|" }
    ' "$1"
}

family() {
    case $(awk '/^vendor_id/ { print $3; exit }' /proc/cpuinfo) in
        GenuineIntel) echo Intel ;;
        AuthenticAMD) echo AMD ;;
        *) uname -m ;;
    esac
}

# marked PAGE: prints the text between the page's marks.
marked() {
    awk '$0 == "<!-- bench:end -->" { exit } inside { print } $0 == "<!-- bench:begin -->" { inside = 1 }' "$1"
}

# sections TABLE PAGE: prints the page's sections on other families, then a section with the new table.
sections() {
    marked "$2" | awk -v own="### $(family)" '
        /^### / { kept = $0 != own }
        kept { print; last = $0 }
        END { if (last != "") print "" }
    '
    printf '### %s\n\n' "$(family)"
    cat "$1"
}

# A table of ratios with a column per family, from the output of `sections`.
columns() {
    awk -F ' *[|] *' '
        /^### / { family[++families] = substr($0, 5); next }
        match($0, /[0-9]+-[0-9]+-[0-9]+: /) { date[families] = substr($0, RSTART, RLENGTH - 2) }
        $2 == "measured" { split("", at); for (i = 2; i < NF; ++i) at[$i] = i; next }
        $2 == "probes" || /^$/ { split("", at) }
        !("ratio" in at) || $at["ratio"] !~ /^[0-9.]+$/ { next }
        !($2 in row) { row[$2] = ++rows; name[rows] = $2 }
        { ratio[row[$2], families] = $at["ratio"]; if ($at["goal"] != "") goal[row[$2]] = $at["goal"] }
        END {
            head = "| ratios | goal |"; rule = "|---|---|"
            for (f = 1; f <= families; ++f) { head = head " " family[f] ", " date[f] " |"; rule = rule "---|" }
            print head; print rule
            for (r = 1; r <= rows; ++r) {
                line = "| " name[r] " | " goal[r] " |"
                for (f = 1; f <= families; ++f) line = line " " ratio[r, f] " |"
                print line
            }
            print ""
        }
    ' "$1"
}

# put TABLE PAGE: replaces the text between the page's marks by the table.
put() {
    if ! grep -q '^<!-- bench:begin -->$' "$2" || ! grep -q '^<!-- bench:end -->$' "$2"; then
        echo "bench.sh: $2 has no lines <!-- bench:begin --> and <!-- bench:end -->; add them where the table belongs." >&2
        exit 1
    fi
    awk -v table="$1" '
        $0 == "<!-- bench:end -->" { inside = 0 }
        !inside { print }
        $0 == "<!-- bench:begin -->" { inside = 1; while ((getline line < table) > 0) print line; close(table) }
    ' "$2" >"$2.new"
    mv "$2.new" "$2"
}

sections "$table" docs/performance.md >"$table.sections"
{ columns "$table.sections"; cat "$table.sections"; } >"$table.all"
put "$table.all" docs/performance.md
short_table "$table" >"$table.short"
put "$table.short" README.md
