#!/usr/bin/env bash
# From a bare Debian 12 to the tools and what they do with real models. As root or with sudo; safe to
# repeat, quick the second time. Writes only into build/ and data/real/ here; the tools are in build/bin.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

packages=(g++ cmake ninja-build
    libeigen3-dev libtbb-dev libhwy-dev libassimp-dev libcli11-dev nlohmann-json3-dev
    libpugixml-dev libminizip-dev libssl-dev zlib1g-dev)

step() { printf '\n== %s\n' "$*"; }

step "packages"
tools/install_packages.sh "${packages[@]}"

step "build"
if command -v ccache >/dev/null; then
    export CMAKE_CXX_COMPILER_LAUNCHER=ccache CCACHE_BASEDIR=$PWD
fi
# A build folder that the tests have set up serves as it is.
[[ -f build/release/build.ninja ]] || cmake --preset release -DTREEFORM_BUILD_TESTS=OFF \
    -DTREEFORM_BUILD_C=OFF >/dev/null
cmake --build build/release # with manual pages, and what mpirun needs: all that is installed
tools=()
for main in tools/*/main.cpp; do
    tools+=("$(basename "$(dirname "$main")")")
done
mkdir -p build/bin
for tool in "${tools[@]}"; do
    ln -sf "../release/tools/$tool/$tool" "build/bin/$tool"
done
at() { echo "build/bin/$1"; }

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
    "$(at tf-selfintersect)" "$model" || found=$?
    ((found <= 1)) || status=$found
done

step "what tf-boolean makes of small ones"
"$(at tf-boolean)" union data/two_spheres.stl -f -o build/one_solid.stl || status=$?
"$(at tf-boolean)" difference data/cube.stl data/sphere.ply -f -o build/difference.ply || status=$?

step "what tf-weld and tf-place do with the first"
"$(at tf-weld)" "${models[0]}" -f -o build/welded.ply || status=$?
"$(at tf-place)" lay "${models[0]}" -f -o build/laid.ply || status=$?

cat <<MSG

== next: --help of each is its manual
  export PATH=$PWD/build/bin:\$PATH
  tf-selfintersect YOUR_MODEL.stl --png picture.png --html page.html
  tf-boolean difference YOUR_MODEL.stl YOUR_OTHER.stl -o cut.ply
  tf-weld YOUR_SCAN.ply -t 0.5 -o thin.ply
  tf-place drop YOUR_MODEL.stl -o on_bed.stl
  cmake --install build/release
  tests/run.sh
MSG
exit $status
