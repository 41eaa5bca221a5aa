#!/usr/bin/env bash
# Tests the tests: makes small changes to a copy of the code, one at a time, and checks that the fast tests fail.
set -euo pipefail

usage() {
    cat <<'TEXT'
Usage: scripts/mutate.sh [--seed N] [--count N] [--only PATH]... [--jobs N] [--list]

Makes small changes (mutants: + becomes -, < becomes <=, 0.5f is doubled, a term is dropped, ...) to src/kernels,
src/cpu, src/field, src/bvh and src/sdf, one at a time, and runs the fast unit tests on each. Prints the share of mutants that
were detected, how many each test detected, and all that survived. The exit code is 1 if the share is below 90 %.

  --seed N     chooses the mutants; the same seed, count and code give the same ones (default 1)
  --count N    number of mutants that compile (default 100)
  --only PATH  change only this file or folder; may be repeated
  --jobs N     mutants at a time, each in its own copy and build folder (default: number of processors)
  --list       print the mutants and exit

Works in build/mutate and touches nothing else. The first run builds for some minutes; later ones are incremental.
Ctrl-C prints the results so far.

Example: scripts/mutate.sh --seed 7 --count 300
Example: scripts/mutate.sh --only src/kernels/lookup/probe_query.h --count 1000     (all of its mutants)
TEXT
}

# Unit test programs that take seconds, fastest first. Left out: cli, io, report, vulkan and others that do not test
# these folders; analytic, backend, reference and render, which take minutes.
programs=(kernels sdf field geometry bvh cpu tracer)
# Tests to skip: those that take longer than all the others, or need scene files.
declare -A filter=(
    [bvh]='-EmbreeAgreement.*'
    [cpu]='-OwnEmitters.*:MovingScene.AMoveBuildsNoTriangles'
    [tracer]='-*Agreement*:*Scenes*:*Watertight*:*ManyAtOnce*:*TheBuildDoesNotDependOnThreads*'
)
# Files without formulas: the macros that make kernels GLSL and C++, and structs that only shaders read.
left_out='src/kernels/(language|abi/gpu_passes)\.h$'
goal=90  # per cent

die() {
    echo "mutate.sh: $*" >&2
    exit 2
}

seed=1 count=100 jobs=$(nproc) only=() list=
while (($# > 0)); do
    case $1 in
        -h | --help) usage && exit 0 ;;
        --list) list=yes && shift && continue ;;
        --seed | --count | --jobs) [[ ${2:-} =~ ^[0-9]+$ ]] || die "$1 needs a number" ;;
        --only) [[ -n ${2:-} ]] || die "--only needs a file or folder of the project" ;;
        *) die "unknown argument '$1'; see scripts/mutate.sh --help" ;;
    esac
    case $1 in
        --seed) seed=$2 ;;
        --count) count=$2 ;;
        --jobs) jobs=$2 ;;
        --only) only+=("$2") ;;
    esac
    shift 2
done
((count > 0 && jobs > 0)) || die "--count and --jobs must be at least 1"
cd "$(dirname "${BASH_SOURCE[0]}")/.."
((${#only[@]})) || only=(src/kernels src/cpu src/field src/bvh src/sdf)
scratch=$PWD/build/mutate
results=$scratch/results
unset PROBEGI_SCENES
export CCACHE_NOHASHDIR=1 LC_ALL=C

# All mutants of the requested files, shuffled by the seed.
shuffled_mutants() {
    local files
    files=$(git ls-files -- "${only[@]}" | grep -E '^src/.*\.(h|cpp)$' | grep -vE "$left_out") ||
        die "there are no files to change in ${only[*]}"
    # shellcheck disable=SC2086  # names of the project's sources have no blanks
    awk -f scripts/mutants.awk $files | sort --random-sort --random-source=<(yes "$seed" | head -c 4096)
}

# sync_copy FOLDER: copies the project's current files; unchanged ones keep their timestamps.
sync_copy() {
    local files
    files=$(git ls-files --cached --others --exclude-standard | sort)
    mkdir -p "$1"
    while read -r file; do
        [[ ! -e $file ]] || cmp -s "$file" "$1/$file" || cp --parents "$file" "$1"
    done <<<"$files"
    (cd "$1" && find . -type f -printf '%P\n' | sort | comm -23 - <(echo "$files") | xargs -r rm)
}

# in_copy NUMBER COMMAND...: runs the command so that ccache ignores the copy's absolute paths.
in_copy() {
    CCACHE_BASEDIR=$scratch/$1 "${@:2}"
}

targets() { printf 'test_%s ' "${programs[@]}"; }
program_path() { echo "$scratch/$1/build/tests/$2/test_$2"; }

build_copy() {
    rm -rf "$scratch/$1/unchanged"
    sync_copy "$scratch/$1/tree"
    in_copy "$1" cmake -S "$scratch/$1/tree" -B "$scratch/$1/build" -G Ninja -DCMAKE_BUILD_TYPE=Release \
        -DCMAKE_CXX_FLAGS='-DHWY_COMPILE_ONLY_STATIC' -DCMAKE_CXX_FLAGS_RELEASE='-O1 -DNDEBUG' \
        -DCMAKE_GTEST_DISCOVER_TESTS_DISCOVERY_MODE=PRE_TEST -DPROBEGI_VULKAN=OFF -DPROBEGI_BENCH=OFF \
        --log-level=WARNING
    # shellcheck disable=SC2046  # a word for each target
    in_copy "$1" ninja -C "$scratch/$1/build" -j "$jobs" $(targets) ||
        die "the unchanged project does not build"
}

# run_tests COPY PROGRAM SECONDS: returns the program's exit code; its output goes to test.log of the copy. Memory is
# limited, since a mutated loop may allocate forever.
run_tests() {
    (
        ulimit -v 16777216 -c 0
        timeout "$3" "$(program_path "$1" "$2")" --gtest_filter="${filter[$2]:-*}" --gtest_fail_fast
    ) >"$scratch/$1/test.log" 2>&1
}

# Runs the unchanged programs, to set the seconds after which a mutant counts as one that never ends, and keeps copies.
declare -A limit=()
measure_unchanged() {
    local program begin
    for program in "${programs[@]}"; do
        begin=$SECONDS
        run_tests 1 "$program" 600 || die "test_$program fails without any change; see $scratch/1/test.log"
        limit[$program]=$((10 + 5 * (SECONDS - begin)))
    done
    for ((copy = 1; copy <= jobs; ++copy)); do
        mkdir -p "$scratch/$copy/unchanged"
        for program in "${programs[@]}"; do cp "$(program_path "$copy" "$program")" "$scratch/$copy/unchanged"; done
    done
}

# programs_of FILE: programs that could detect a change of the file, the most likely first.
programs_of() {
    local own=${1#src/}
    own=${own%%/*}
    if ! grep -q "^tests/kernels/.* $1\$" "$scratch/includes"; then programs=("${programs[@]:1}"); fi
    for program in "${programs[@]}"; do [[ $program != "$own" ]] || echo "$program"; done
    for program in "${programs[@]}"; do [[ $program == "$own" ]] || echo "$program"; done
}

# Prints lines "object file" for each file that an object depends on.
list_includes() {
    ninja -C "$scratch/1/build" -t deps 2>/dev/null |
        awk '/^[^ ].*: #deps/ { object = $1; sub(/:$/, "", object) } /^ / && sub(/^.*tree\//, "") { print object, $0 }'
}

# change FILE LINE COLUMN LENGTH TEXT: applies a mutant.
change() {
    TEXT=$5 awk -v line="$2" -v column="$3" -v span="$4" '
        NR == line {
            $0 = substr($0 " ", 1, column - 1) ENVIRON["TEXT"] substr($0 " ", column + span)
            sub(/ +$/, "")
        }
        { print }
    ' "$1"
}

# Whether all of a kernel's functions compile to the same instructions as before, so that no test could fail.
same_code() {
    [[ $2 == src/kernels/*.h ]] || return 1
    local folder
    for folder in unchanged tree; do
        printf '#include "%s"\n' "${2#src/}" |
            g++ -std=c++20 -O1 -fkeep-inline-functions -I"$scratch/$1/$folder/src" -I"$scratch/$1/tree/src" \
                -x c++ -c - -o "$scratch/$1/$folder.o" 2>/dev/null || return 1
    done
    cmp -s "$scratch/$1/unchanged.o" "$scratch/$1/tree.o"
}

# The test that failed, or that was running when the program crashed or timed out.
first_failure() {
    local failed
    failed=$(sed -n 's/^\[  FAILED  \] \([^ ,]*\).*/\1/p' "$1" | head -n 1)
    echo "${failed:-$(sed -n 's/^\[ RUN      \] //p' "$1" | tail -n 1)}"
}

# verdict_on COPY FILE: "killed PROGRAM.TEST", "survived", "broken" (does not compile), "same" (no instruction differs).
verdict_on() {
    local program rc touched=
    for program in $(programs_of "$2"); do
        if ! in_copy "$1" ninja -C "$scratch/$1/build" -j 1 "test_$program" >"$scratch/$1/build.log" 2>&1; then
            echo broken
            return
        fi
        ! cmp -s "$(program_path "$1" "$program")" "$scratch/$1/unchanged/test_$program" || continue
        touched=yes
        rc=0
        run_tests "$1" "$program" "${limit[$program]}" || rc=$?
        if ((rc != 0)); then
            echo "killed $program.$(first_failure "$scratch/$1/test.log")"
            return
        fi
    done
    if [[ -z $touched ]] && same_code "$1" "$2"; then echo same; else echo survived; fi
}

# The number of results with one of these verdicts.
count_of() {
    cut -f 2 "$results" | grep -cE "^($(IFS='|' && echo "$*"))\b" || true
}

tell_progress() {
    local done survived seconds=$((SECONDS - began))
    done=$(count_of killed survived) survived=$(count_of survived)
    ((done > 0)) || return 0
    printf '%s[%d/%d] %d unnoticed, about %d min left%s' "$line_start" "$done" "$count" "$survived" \
        $(((seconds * (count - done) / done + 59) / 60)) "$line_end"
}

# Takes the number of the next mutant from the shared list, so that each goes to one worker.
next_number() {
    flock "$scratch/next" sh -c 'n=$(cat "$0"); echo $((n + 1)) >"$0"; echo "$n"' "$scratch/next"
}

# work COPY: tries mutants until there are enough.
work() {
    local number=0 file line column span text verdict saved=$scratch/$1/unchanged
    while (($(count_of killed survived) < count)); do
        number=$(next_number)
        IFS=$'\t' read -r file line column span text < <(sed -n "${number}p" "$scratch/mutants") || return 0
        mkdir -p "$saved/${file%/*}"
        cp "$scratch/$1/tree/$file" "$saved/$file"
        change "$saved/$file" "$line" "$column" "$span" "$text" >"$scratch/$1/tree/$file"
        verdict=$(verdict_on "$1" "$file")
        printf '%s\t%s\t%s\t%s\t%s\t%s\t%s\n' "$number" "$verdict" "$file" "$line" "$column" "$span" "$text" \
            >>"$results"
        cp "$saved/$file" "$scratch/$1/tree/$file"
        tell_progress
    done
}

# The first $count that compile, in the order of the list, so that results do not depend on the workers' speed.
counted_results() {
    sort -n "$results" | awk -F '\t' -v count="$count" '{ n += $2 ~ /^killed|^survived/ } n <= count'
}

report() {
    trap - EXIT
    kill_workers
    counted_results >"$results.counted"
    mv "$results.counted" "$results"
    local file line column span text original
    printf '\n\nSurvivors\n'
    while IFS=$'\t' read -r _ _ file line column span text; do
        printf '\n%s:%d\n' "$file" "$line"
        original=$(for ((copy = 1; copy <= jobs; ++copy)); do ls "$scratch/$copy/unchanged/$file" 2>/dev/null || true; done | head -n 1)
        sed -n "${line}s/^ */- /p" "$original"
        change "$original" "$line" "$column" "$span" "$text" | sed -n "${line}s/^ */+ /p"
    done < <(awk -F '\t' '$2 == "survived"' "$results" | sort -t $'\t' -k 3,3 -k 4,4n)
    printf '\nNoticed by (program, test suite)\n'
    cut -f 2 "$results" | sed -nE 's/^killed ([a-z]+\.)([^.]*\/)?([A-Za-z0-9_]+)\..*/\1\3/p' | sort | uniq -c | sort -rn
    printf '\nSeed %d. Left out: %d that do not compile, %d whose code is the same.\n\n' "$seed" \
        "$(count_of broken)" "$(count_of same)"
    printf '| folder | mutants | noticed | share |\n|---|---|---|---|\n'
    awk -F '\t' -v goal="$goal" '
        function row(name, of, noticed) { printf "| %s | %d | %d | %.0f %% |\n", name, of, noticed, 100 * noticed / of }
        $2 ~ /^broken|^same/ { next }
        { sub(/\/[^\/]*$/, "", $3); ++all[$3]; ++total }
        $2 ~ /^killed/ { ++killed[$3]; ++noticed }
        END {
            for (folder in all) row(folder, all[folder], killed[folder])
            if (total > 0) row("all", total, noticed)
            exit 100 * noticed < goal * total
        }' "$results" || exit 1
}

workers=()
kill_workers() {
    local worker
    for worker in "${workers[@]}"; do kill -- "-$worker" 2>/dev/null || true; done
    wait
}

main() {
    local tool copy
    if [[ -n $list ]]; then
        shuffled_mutants | awk -v count="$count" 'NR <= count'
        return
    fi
    for tool in cmake ninja g++ git flock; do
        command -v "$tool" >/dev/null || die "there is no $tool; run scripts/setup.sh test"
    done
    mkdir -p "$scratch"
    exec 9>"$scratch/lock"
    flock -n 9 || die "another run is using $scratch"
    for ((copy = 1; copy <= jobs; ++copy)); do build_copy "$copy"; done
    measure_unchanged
    list_includes >"$scratch/includes"
    # Only mutants of files that are compiled.
    shuffled_mutants | awk -F '\t' 'NR == FNR { sub(/^[^ ]* /, ""); compiled[$0] = 1; next } $1 in compiled' \
        "$scratch/includes" - >"$scratch/mutants"
    : >"$results"
    echo 1 >"$scratch/next"
    began=$SECONDS line_start='' line_end=$'\n'
    [[ ! -t 1 ]] || line_start=$'\r' line_end='   '
    set -m  # workers are process groups of their own, so that Ctrl-C ends what they started too
    trap report EXIT
    trap 'exit 130' INT TERM
    for ((copy = 1; copy <= jobs; ++copy)); do
        work "$copy" &
        workers+=($!)
    done
    wait
}

main
exit  # nothing after a run is read from this file, which may have changed by then
