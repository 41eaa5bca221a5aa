#!/usr/bin/env bash
# ctest where a skipped test is a failed one: every test of this project can run on every machine that ran setup.sh.
# Usage: run_ctest.sh BUILD_FOLDER [ctest options]
set -uo pipefail

build=$1
shift
log=$(mktemp)
trap 'rm -f "$log"' EXIT
ctest --test-dir "$build" -j2 --output-on-failure --no-tests=error "$@" | tee "$log"
verdict=${PIPESTATUS[0]}
# ctest's own word for GTEST_SKIP(), a disabled test and a test whose program is missing.
if grep -E '\*\*\*(Skipped|Not Run)|\((Skipped|Disabled|Not Run)\)' "$log" >/dev/null; then
    echo "run_ctest.sh: tests were skipped or not run, see above; none may be." >&2
    exit 1
fi
exit "$verdict"
