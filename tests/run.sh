#!/usr/bin/env bash
# Sets up a bare Debian 12 (as root or with sudo), builds what people install, and tests it: unit
# tests, tests against CGAL, command lines, C, Python, installations, documents. Closes with how many
# passed, failed and were skipped. Safe to repeat, quick the second time.
#
#   TREEFORM_MODELS_DIR=DIR  real models with TRUTH.csv, for the tests that need them
#   TREEFORM_CLOUDS_DIR=DIR  real point clouds, likewise
#   TREEFORM_WERROR=ON       a warning fails the build
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 1
source tests/house/check_preset.sh
tools/install_packages.sh "${packages[@]}" || exit 1

# All of it, whatever tools/quickstart.sh has left out.
build release -DTREEFORM_BUILD_TESTS=ON -DTREEFORM_BUILD_C=ON -DTREEFORM_BUILD_ORACLE_TESTS=ON \
    -U TREEFORM_BUILD_PYTHON &&
    test_build build/release -LE slow
python3 -B tests/house/steps.py slowest build/release
for kind in skipped failed; do
    names=$(python3 -B tests/house/count_tests.py --$kind build/release/results.xml)
    [[ $kind == failed ]] || kind="skipped, as a whole or in part"
    [[ -z $names ]] || printf '\n%s:\n%s\n' "$kind" "$names"
done
count_up
