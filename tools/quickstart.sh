#!/usr/bin/env bash
# From a bare Debian 12 to tf-selfintersect and what it finds in real models. As root or with sudo;
# safe to repeat, quick the second time. Writes only into build/ and data/real/ here.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

packages=(g++ cmake ninja-build
    libeigen3-dev libtbb-dev libhwy-dev libassimp-dev libcli11-dev nlohmann-json3-dev)

step() { printf '\n== %s\n' "$*"; }

step "packages"
tools/install_packages.sh "${packages[@]}"

step "build"
if command -v ccache >/dev/null; then
    export CMAKE_CXX_COMPILER_LAUNCHER=ccache CCACHE_BASEDIR=$PWD
fi
# A build folder that the tests have set up serves as it is.
[[ -f build/release/build.ninja ]] || cmake --preset release -DTREEFORM_BUILD_TESTS=OFF >/dev/null
cmake --build build/release --target tf-selfintersect
tool=build/release/tools/tf-selfintersect/tf-selfintersect

step "models"
shopt -s nullglob
data/fetch_real.sh || echo "not all real models are to be had (no network?)"
models=(data/real/*)
((${#models[@]})) || models=(data/*.{stl,obj,ply,off})
echo "${models[*]}"

step "what tf-selfintersect finds"
# 1 says that something was found; only what is above it is a failure.
status=0
for model in "${models[@]}"; do
    found=0
    "$tool" "$model" || found=$?
    ((found <= 1)) || status=$found
done

cat <<MSG

== next
  $tool --help
  $tool YOUR_MODEL.stl -o marked.ply -r report.json
  tests/run.sh
MSG
exit $status
