# shellcheck shell=bash
# To be sourced at the top of the tree: sets up, builds and tests a preset, and counts. What the
# callers share is that they end by `count_up`.

export CMAKE_CXX_COMPILER_LAUNCHER=ccache CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1
export TREEFORM_MODELS_DIR=${TREEFORM_MODELS_DIR-} TREEFORM_CLOUDS_DIR=${TREEFORM_CLOUDS_DIR-}
jobs=$(nproc)
# Tests write many small files: in memory that takes a tenth of the time, where there is enough.
if [[ -z ${TMPDIR-} && -w /dev/shm ]] && (($(df --output=avail -k /dev/shm | tail -n 1) > 6000000)); then
    TMPDIR=$(mktemp -d /dev/shm/treeform-tests-XXXXXX)
    export TMPDIR
    trap 'rm -rf "$TMPDIR"' EXIT
fi
passed=0
failed=0
skipped=0
skipped_cases=0 # in tests that otherwise passed

packages=(g++ cmake ninja-build pkg-config ccache clang clang-format libclang-rt-14-dev
    libtbb-dev libhwy-dev libassimp-dev libcli11-dev nlohmann-json3-dev
    libpugixml-dev libminizip-dev libssl-dev zlib1g-dev
    libopenmpi-dev openmpi-bin
    admesh lib3mf-dev openscad-testing-data doctest-dev libfmt-dev libcgal-dev libgmp-dev libmpfr-dev libeigen3-dev python3
    python3-dev python3-pybind11 pybind11-dev python3-numpy python3-scipy python3-setuptools
    python3-pytest python3-hypothesis python3-tqdm python3-wheel python3-build python3-venv mypy
    patchelf chromium doxygen esbuild fish groff man-db zsh)

# step NAME FOLDER COMMAND...: what it takes is noted in build/steps.jsonl.
step() { python3 -B tests/house/steps.py run "$@"; }

# build PRESET [CONFIGURE OPTION...] [-- TARGET...]: in build/PRESET, everything where no target is
# named; what does not build counts as failed.
build() {
    local preset=$1 options=()
    shift
    while (($#)) && [[ $1 != -- ]]; do
        options+=("$1")
        shift
    done
    if ! cmake --preset "$preset" -DTREEFORM_WERROR="${TREEFORM_WERROR:-OFF}" "${options[@]}" \
        >/dev/null; then
        echo "$preset cannot be configured"
        failed=$((failed + 1))
        return 1
    fi
    # A test whose program does not build fails once more, as one that is not there; the rest is tested.
    if ! step "$preset: build" "build/$preset" ninja -C "build/$preset" -j "$jobs" -k 0 "${@:2}"; then
        echo "$preset does not build"
        failed=$((failed + 1))
    fi
}

# count FOLDER: counts the last tests there.
count() {
    local counts
    if counts=($(python3 -B tests/house/count_tests.py "$1/results.xml")) &&
        ((${#counts[@]} == 4)); then
        passed=$((passed + counts[0]))
        failed=$((failed + counts[1]))
        skipped=$((skipped + counts[2]))
        skipped_cases=$((skipped_cases + counts[3]))
    else
        echo "$1 ran no test"
        failed=$((failed + 1))
    fi
}

# test_build FOLDER [CTEST OPTION...]: its step is named after the folder, or ${test_step}.
test_build() {
    local folder=$1 results=$1/results.xml
    shift
    rm -f "$results"
    step "${test_step:-${folder#build/}: test}" "$folder" \
        ctest --test-dir "$folder" -j "$((2 * jobs))" --output-on-failure --no-tests=error \
        --output-junit "$PWD/$results" --test-output-size-passed 1000000 "$@"
    count "$folder"
}

# count_up: says how it went, and fails where something has.
count_up() {
    printf '\n%d passed, %d failed, %d skipped' "$passed" "$failed" "$skipped"
    ((skipped_cases == 0)) || printf '; %d cases skipped in tests that passed' "$skipped_cases"
    echo
    ((failed == 0))
}
