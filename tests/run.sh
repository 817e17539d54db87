#!/usr/bin/env bash
# Sets up a bare Debian 12 (as root or with sudo), builds, runs every test, and closes with how many
# passed, failed and were skipped. Safe to repeat, quick the second time.
#
#   TREEFORM_MODELS_DIR=DIR  real models with TRUTH.csv, for the tests that need them
#   TREEFORM_CLOUDS_DIR=DIR  real point clouds, likewise
#   TREEFORM_WERROR=ON       a warning fails the build
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 1
source tests/house/check_preset.sh
tools/install_packages.sh "${packages[@]}" || exit 1

# check PRESET "CONFIGURE OPTIONS" [CTEST OPTION...]
check() {
    printf '\n== %s\n' "$1"
    # shellcheck disable=SC2086 # the options are words
    build "$1" $2 && test_build "build/$1" "${@:3}"
}

# What people install, with everything there is to test.
check release "-DTREEFORM_BUILD_ORACLE_TESTS=ON"
# Memory and undefined behavior, of the libraries and of the tools; two minutes of damaged inputs.
check asan "-DTREEFORM_BUILD_FUZZERS=ON" -L "unit|cli|fuzz"
# Races; with the other compiler, so that its warnings are seen too.
check tsan "-DCMAKE_CXX_COMPILER=clang++" -L unit

count_up
