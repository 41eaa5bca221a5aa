#!/usr/bin/env bash
# Runs ctest and fails if any test was skipped: all tests can run on every machine where setup.sh has run.
# Usage: run_ctest.sh BUILD_FOLDER [ctest options]
set -uo pipefail

build=$1
shift
log=$(mktemp)
trap 'rm -f "$log"' EXIT
ctest --test-dir "$build" -j2 --output-on-failure --no-tests=error "$@" | tee "$log"
verdict=${PIPESTATUS[0]}
# ctest prints this for GTEST_SKIP(), disabled tests and missing programs.
if grep -E '\*\*\*(Skipped|Not Run)|\((Skipped|Disabled|Not Run)\)' "$log" >/dev/null; then
    echo "run_ctest.sh: tests were skipped or not run, see above; none may be." >&2
    exit 1
fi
exit "$verdict"
