#!/usr/bin/env bash
# Sets up a bare Debian 12 (as root or with sudo), builds, runs every test, and closes with how many
# passed and failed. Safe to repeat, quick the second time.
#
#   TREEFORM_MODELS_DIR=DIR  real models with TRUTH.csv, for the tests that need them
#   TREEFORM_WERROR=ON       a warning fails the build
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 1

packages=(g++ cmake ninja-build pkg-config ccache clang clang-format libclang-rt-14-dev
    libtbb-dev libhwy-dev libassimp-dev libcli11-dev nlohmann-json3-dev
    doctest-dev libfmt-dev libcgal-dev libgmp-dev libmpfr-dev libeigen3-dev python3)
tools/install_packages.sh "${packages[@]}" || exit 1

export CMAKE_CXX_COMPILER_LAUNCHER=ccache CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1
export TREEFORM_MODELS_DIR=${TREEFORM_MODELS_DIR-}
jobs=$(nproc)
passed=0
failed=0

# check PRESET "CONFIGURE OPTIONS" [CTEST OPTION...]: configures, builds and tests in build/PRESET.
check() {
    local preset=$1 options=$2 log summary
    shift 2
    printf '\n== %s\n' "$preset"
    # shellcheck disable=SC2086 # the options are words
    if ! cmake --preset "$preset" -DTREEFORM_WERROR="${TREEFORM_WERROR:-OFF}" $options >/dev/null; then
        echo "$preset cannot be configured"
        failed=$((failed + 1))
        return
    fi
    # What does not build fails here and once more as a test that is not there; the rest is tested.
    if ! cmake --build "build/$preset" -j "$jobs" -- -k 0; then
        echo "$preset does not build"
        failed=$((failed + 1))
    fi
    log=$(mktemp)
    ctest --test-dir "build/$preset" -j "$jobs" --output-on-failure "$@" | tee "$log"
    summary=$(grep -E 'tests passed, [0-9]+ tests failed out of [0-9]+' "$log")
    rm -f "$log"
    if [[ $summary =~ ([0-9]+)\ tests\ failed\ out\ of\ ([0-9]+) ]]; then
        failed=$((failed + BASH_REMATCH[1]))
        passed=$((passed + BASH_REMATCH[2] - BASH_REMATCH[1]))
    else
        echo "$preset ran no test"
        failed=$((failed + 1))
    fi
}

# What people install, with everything there is to test.
check release "-DTREEFORM_BUILD_ORACLE_TESTS=ON"
# Memory and undefined behavior, of the libraries and of the tools; two minutes of damaged inputs.
check asan "-DTREEFORM_BUILD_FUZZERS=ON" -L "unit|cli|fuzz"
# Races; with the other compiler, so that its warnings are seen too.
check tsan "-DCMAKE_CXX_COMPILER=clang++" -L unit

printf '\n%d passed, %d failed\n' "$passed" "$failed"
((failed == 0))
