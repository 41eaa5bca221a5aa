#!/usr/bin/env bash
# Runs every libFuzzer target of a build made with -DPROBEGI_FUZZ=ON: scripts/fuzz.sh BUILD_FOLDER SECONDS_EACH
set -euo pipefail

build=$(realpath "${1:?give the build folder}")
seconds=${2:-60}
cd "$(dirname "${BASH_SOURCE[0]}")/.."

mapfile -t targets < <(find "$build/tests/fuzz" -maxdepth 1 -type f -name 'fuzz_*' -perm -u+x | sort)
if ((${#targets[@]} == 0)); then
    echo "fuzz.sh: $build holds no fuzz targets; configure it with clang and -DPROBEGI_FUZZ=ON." >&2
    exit 1
fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
pids=()
run_target() {  # new inputs go to a scratch folder, the seeds stay as they are
    local name seeds=()
    name=$(basename "$1")
    mkdir -p "$work/$name"
    [[ -d tests/fuzz/corpus/${name#fuzz_} ]] && seeds=("tests/fuzz/corpus/${name#fuzz_}")
    "$1" -max_total_time="$seconds" -timeout=20 -rss_limit_mb=2048 -max_len=65536 -print_final_stats=1 \
        -artifact_prefix="$build/crash-$name-" "$work/$name" "${seeds[@]}" >"$work/$name.log" 2>&1
}

# Two at a time: one a core.
failed=0
for ((i = 0; i < ${#targets[@]}; i += 2)); do
    pids=()
    for target in "${targets[@]:i:2}"; do
        run_target "$target" &
        pids+=($!)
    done
    for k in "${!pids[@]}"; do
        name=$(basename "${targets[i + k]}")
        if wait "${pids[k]}"; then
            runs=$(grep -oP 'number_of_executed_units: \K[0-9]+' "$work/$name.log" || echo '?')
            echo "fuzz: $name ran $runs inputs in ${seconds} s without a finding"
        else
            failed=1
            tail -n 60 "$work/$name.log"
            echo "fuzz: $name FAILED; the input is $build/crash-$name-*" >&2
        fi
    done
done
exit "$failed"
