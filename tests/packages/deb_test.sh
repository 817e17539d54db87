#!/usr/bin/env bash
# deb_test.sh [FOLDER]: installs the Debian packages of FOLDER, by default build/packages, in a bare
# Debian and uses each: tools, libraries in C++ and C, Python, mpirun; then removes them. As root; needs
# mmdebstrap.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
debs=$(realpath "${1:-build/packages}")
source tests/packages/support.sh
if ((EUID != 0)) || ! command -v mmdebstrap >/dev/null; then
    skip "Debian packages in a bare system" "needs root and mmdebstrap"
    count_up "Debian packages"
    exit
fi

root=$work/root
mmdebstrap --quiet --variant=minbase bookworm "$root"
mkdir "$root/debs" "$root/src"
cp "$debs"/*.deb "$root/debs"
git ls-files -z data tests/consumer | tar -c --null -T - | tar -x -C "$root/src"
multiarch=$(dpkg-architecture -qDEB_HOST_MULTIARCH)
inside() { in_root "$root" "$@"; }
in_sources() { in_root "$root" sh -c "cd /src && $*"; }
install() { inside apt-get install -y -qq --no-install-recommends "$@"; }
files_of() { (cd "$debs" && for name in "$@"; do echo "/debs/$(echo "$name"_*.deb)"; done); }
library=$(cd "$debs" && echo libtreeform[0-9]*.deb)
library=${library%%_*}
inside apt-get update -qq

# Tools, with nothing but what they depend on.
mapfile -t files < <(files_of "$library" treeform-tools)
check "tools are installed" install "${files[@]}"
for tool in boolean place repair selfintersect weld; do
    check "tf-$tool runs" inside "tf-$tool" --version
    check "tf-$tool has a manual page" inside test -s "/usr/share/man/man1/tf-$tool.1.gz"
done
check "self-intersections are found" found inside tf-selfintersect /src/data/two_spheres.stl \
    --png /root/picture.png
check "the picture is one" sh -c "head -c 4 '$root/root/picture.png' | grep -q PNG"
check "a solid is repaired" inside tf-selfintersect --repair /src/data/two_spheres.stl \
    -o /root/solid.3mf
check "the solid is read" inside tf-repair /root/solid.3mf -o /root/again.stl
check "manual and compiler are installed" \
    install man-db g++ make cmake pkg-config python3-numpy openmpi-bin
check "man finds tf-weld" inside man -w tf-weld

# Development.
mapfile -t files < <(files_of libtreeform-dev)
check "libtreeform-dev is installed" install "${files[@]}"
find_package() { # PROJECT
    in_sources "cmake -S tests/consumer/$1 -B /root/$1 -DCMAKE_BUILD_TYPE=Release &&
        cmake --build /root/$1 -j 2"
}
check "find_package in C++" find_package project
for program in consumer detect resolve boolean_of_three weld_cloud slide nearest_of_own_struct; do
    check "$program runs" in_sources "/root/project/$program"
done
check "find_package in C" find_package project_c
check "consumer_c runs" in_sources /root/project_c/consumer_c
check "pkg-config in C++" in_sources "g++ -std=c++20 tests/consumer/project/detect.cpp -o /root/detect \
    \$(pkg-config --cflags --libs treeform) && /root/detect"
check "pkg-config in C" in_sources "cc -std=c99 tests/consumer/project_c/main.c -o /root/main_c \
    \$(pkg-config --cflags --libs treeform-c) && /root/main_c"

# Python.
mapfile -t files < <(files_of python3-treeform)
check "python3-treeform is installed" install "${files[@]}"
check "a union in Python" in_sources "python3 -c '
import treeform
mesh = treeform.read(\"data/two_spheres.stl\")
assert len(treeform.self_intersections(mesh)) == 78
assert treeform.union(mesh, treeform.read(\"data/cube.stl\")).mesh.is_solid
assert treeform.plot(mesh).startswith(b\"\\x89PNG\")'"

# Many processes.
mapfile -t files < <(files_of treeform-tools-mpi)
check "treeform-tools-mpi is installed" install "${files[@]}"
# With /proc, which tells the loader where a program lies, and so where the plug-in is.
by_two() {
    # shellcheck disable=SC2016 # for the other shell
    unshare --mount sh -c 'mount -t proc proc "$0/proc" && exec chroot "$0" env -i HOME=/root \
        PATH=/usr/bin:/bin OMPI_MCA_plm=isolated mpirun --allow-run-as-root --oversubscribe -n 2 \
        tf-weld /src/data/sphere.ply -t 0.15 -o /root/by_two.ply' "$root"
}
check "two processes share the work" by_two
check "one process" in_sources "tf-weld data/sphere.ply -t 0.15 -o /root/by_one.ply"
check "both write the same" cmp "$root/root/by_one.ply" "$root/root/by_two.ply"

# Nothing is left behind.
check "the packages are removed" inside apt-get purge -y -qq "$library" libtreeform-dev treeform-tools \
    treeform-tools-mpi python3-treeform
check "nothing is left" sh -c "! find '$root/usr' '$root/etc' -name '*treeform*' -o -name 'tf-*' | grep ."
check "libraries are where Debian has them" \
    sh -c "dpkg-deb -c '$debs/$library'_*.deb | grep -q 'usr/lib/$multiarch/libtreeform_mesh.so'"
count_up "Debian packages in a bare Debian"
