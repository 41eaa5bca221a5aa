#!/usr/bin/env bash
# Runs every fuzzer on seeds made for the occasion. Usage: run.sh BUILD_FOLDER [SECONDS]
# Without SECONDS: a fixed number of inputs from one seed and nothing that earlier runs have found, so that what passes
# once passes again, but for what libFuzzer itself leaves to chance (the glTF run varies by a per cent): for CI. With SECONDS: so long each, other inputs each time, on from what earlier runs have found: by
# hand, for minutes or a night, after a reader has changed.
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
    # A generous timeout: a busy machine is no fault of a reader.
    length=(-seed=1 -timeout=60)
    words="a fixed number of inputs from seed 1"
fi
declare -A runs=([gltf]=40000 [image]=8000)  # about a minute each, side by side
mkdir -p "$corpus"
"$build/tests/fuzz/fuzz_seeds" "$corpus"
status=0
declare -A running
count=()
same_addresses=()  # on which the choice of inputs depends
[[ -n $seconds ]] || ! setarch -R true 2>/dev/null || same_addresses=(setarch -R)
for reader in gltf image; do
    echo "fuzz_$reader: $words"
    [[ -n $seconds ]] || count=(-runs="${runs[$reader]}")
    "${same_addresses[@]}" "$build/tests/fuzz/fuzz_$reader" "${length[@]}" "${count[@]}" -rss_limit_mb=2048 -malloc_limit_mb=2048 \
        -max_len=65536 -print_final_stats=1 -artifact_prefix="$build/fuzz/$reader-" "$corpus/$reader" \
        >"$corpus/$reader.log" 2>&1 &
    running[$reader]=$!
done
for reader in gltf image; do
    wait "${running[$reader]}" || status=1
    tail -n 12 "$corpus/$reader.log"
done
exit $status
