#!/usr/bin/env bash
# deb.sh [OUT [BUILD]]: makes Debian packages of this tree in the folder OUT, by default
# build/packages, and has lintian look at them; builds in BUILD, by default build/deb. As root or
# with sudo where packages that it needs are not installed. Fails if lintian finds an error.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
out=$(realpath -m "${1:-build/packages}")
build=$(realpath -m "${2:-build/deb}")
source tools/packages/needs.sh
tools/install_packages.sh "${to_build[@]}" "${for_debs[@]}"
source tools/packages/flags.sh

# Where libraries are in the folder of the build is said relative to the programs, so that no trace of
# that folder is left. No path to libraries is in what is installed where Debian has them, but for the plug-in.
cmake -S . -B "$build" -G Ninja "${flags[@]}" -DBUILD_SHARED_LIBS=ON -DCMAKE_INSTALL_PREFIX=/usr \
    "-DCMAKE_INSTALL_LIBDIR=lib/$(dpkg-architecture -qDEB_HOST_MULTIARCH)" -DCMAKE_INSTALL_RPATH= \
    -DCMAKE_BUILD_RPATH_USE_ORIGIN=ON \
    -DTREEFORM_BUILD_PYTHON=ON -DTREEFORM_PYTHON=/usr/bin/python3 -DTREEFORM_BUILD_TESTS=OFF \
    -DTREEFORM_PACKAGES=ON >/dev/null
cmake --build "$build" -j "$jobs"
mkdir -p "$out"
rm -f "$out"/*.deb
(umask 022 && cd "$build" && cpack -B "$out" >cpack.log 2>&1) || { cat "$build/cpack.log"; exit 1; }
rm -rf "$out/_CPack_Packages"
lintian --allow-root --fail-on error --tag-display-limit 0 "$out"/*.deb
ls -l "$out"/*.deb
