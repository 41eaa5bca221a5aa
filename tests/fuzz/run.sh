#!/usr/bin/env bash
# Runs every fuzzer for a while on seeds made for the occasion. Usage: run.sh BUILD_FOLDER [SECONDS]
# Exit code 1, and the offending input in BUILD_FOLDER/fuzz, if one crashes, hangs (10 s) or takes over 2 GB.
set -euo pipefail

build=${1:?name a build folder that was configured with PROBEGI_FUZZ=ON}
seconds=${2:-60}
export UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1
corpus=$build/fuzz
mkdir -p "$corpus"
"$build/tests/fuzz/fuzz_seeds" "$corpus"
status=0
for reader in gltf image; do
    echo "fuzz_$reader: $seconds s"
    "$build/tests/fuzz/fuzz_$reader" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 -malloc_limit_mb=2048 \
        -max_len=65536 -print_final_stats=1 -artifact_prefix="$corpus/$reader-" "$corpus/$reader" \
        >"$corpus/$reader.log" 2>&1 || status=1
    tail -n 12 "$corpus/$reader.log"
done
exit $status
