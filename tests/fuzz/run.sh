#!/usr/bin/env bash
# Runs every fuzzer on generated seeds. Usage: run.sh BUILD_FOLDER [SECONDS]
# Without SECONDS, for CI: a fixed number of inputs from one seed, ignoring what earlier runs have found, so that runs
# are reproducible, except for libFuzzer's own randomness (the glTF run varies by 1 %).
# With SECONDS, by hand after changing a reader: each fuzzer runs that long on new inputs, continuing from what earlier
# runs have found.
# Exit code 1, and the offending input in BUILD_FOLDER/fuzz, if one crashes, hangs or takes over 2 GB. To run one again:
# BUILD_FOLDER/tests/fuzz/fuzz_gltf INPUT.
set -euo pipefail

build=${1:?name a build folder that was configured with PROBEGI_FUZZ=ON}
seconds=${2:-}
export UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1
if [[ -n $seconds ]]; then
    corpus=$build/fuzz
    length=(-max_total_time="$seconds" -timeout=10)
    words="$seconds s from any seed"
else
    corpus=$build/fuzz/fixed
    rm -rf "$corpus"
    # A generous timeout, since the machine may be busy.
    length=(-seed=1 -timeout=60)
    words="a fixed number of inputs from seed 1"
fi
declare -A runs=([gltf]=40000 [image]=8000 [sdf]=200000 [field]=40000)  # at most about a minute each, side by side
mkdir -p "$corpus"
"$build/tests/fuzz/fuzz_seeds" "$corpus"
status=0
declare -A running
count=()
same_addresses=()  # on which the choice of inputs depends
[[ -n $seconds ]] || ! setarch -R true 2>/dev/null || same_addresses=(setarch -R)
for reader in gltf image sdf field; do
    echo "fuzz_$reader: $words"
    [[ -n $seconds ]] || count=(-runs="${runs[$reader]}")
    "${same_addresses[@]}" "$build/tests/fuzz/fuzz_$reader" "${length[@]}" "${count[@]}" -rss_limit_mb=2048 -malloc_limit_mb=2048 \
        -max_len=65536 -print_final_stats=1 -artifact_prefix="$build/fuzz/$reader-" "$corpus/$reader" \
        >"$corpus/$reader.log" 2>&1 &
    running[$reader]=$!
done
for reader in gltf image sdf field; do
    wait "${running[$reader]}" || status=1
    tail -n 12 "$corpus/$reader.log"
done
exit $status
