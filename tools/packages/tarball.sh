#!/usr/bin/env bash
# tarball.sh [OUT [BUILD]]: makes a tarball of the tools for any x86-64 Linux in the folder OUT, by
# default build/packages; builds in BUILD, by default build/static. They are linked -static: with plain
# threads, without assimp and MPI, which their --version says. As root or with sudo where packages
# that it needs are not installed. The same commit gives the same bytes.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
out=$(realpath -m "${1:-build/packages}")
build=$(realpath -m "${2:-build/static}")
source tools/packages/needs.sh
tools/install_packages.sh "${to_build[@]}"
source tools/packages/flags.sh

# Debian has a static archive of every library that the tools need but Highway: this one is made of
# the source of Debian's package, of the version whose headers are installed.
make_highway() { # FOLDER
    local folder=$1 version source
    version=$(dpkg-query -W -f='${source:Version}' libhwy-dev)
    [[ $(cat "$folder/version" 2>/dev/null) != "$version" ]] || return 0
    rm -rf "$folder"
    mkdir -p "$folder/lists/partial" "$folder/cache/archives/partial"
    echo "deb-src [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg]" \
        "${TREEFORM_DEBIAN_MIRROR:-http://deb.debian.org/debian} bookworm main" \
        >"$folder/sources.list"
    (
        cd "$folder"
        apt_options=(-qq -o "Dir::Etc::SourceList=$folder/sources.list" -o Dir::Etc::SourceParts=-
            -o "Dir::State::Lists=$folder/lists" -o "Dir::Cache=$folder/cache"
            -o APT::Sandbox::User=root)
        apt-get "${apt_options[@]}" update
        apt-get "${apt_options[@]}" source --download-only "highway=$version"
        # apt has checked what it has got against the signed lists.
        dpkg-source --no-check -x highway_*.dsc source >/dev/null
    )
    source=$folder/source
    # shellcheck disable=SC2086 # the flags are words
    (cd "$source" && for name in aligned_allocator per_target targets; do
        g++ -std=c++17 -O3 -DNDEBUG $compile_flags -DHWY_SHARED_DEFINE -I. -c "hwy/$name.cc" -o "$folder/$name.o"
    done)
    ar rcsD "$folder/libhwy.a" "$folder"/*.o
    cat >"$folder/hwy-config.cmake" <<CONFIG
add_library(hwy::hwy STATIC IMPORTED)
set_target_properties(hwy::hwy PROPERTIES
    IMPORTED_LOCATION "$folder/libhwy.a"
    INTERFACE_COMPILE_DEFINITIONS HWY_SHARED_DEFINE
    INTERFACE_INCLUDE_DIRECTORIES /usr/include)
CONFIG
    rm -rf "$folder/lists" "$folder/cache" "$source" "$folder"/*.o "$folder"/highway_*
    echo "$version" >"$folder/version"
}

make_highway "$build/highway"
cmake -S . -B "$build" -G Ninja "${flags[@]}" -DTREEFORM_STATIC_TOOLS=ON -DTREEFORM_BUILD_TESTS=OFF \
    "-Dhwy_DIR=$build/highway" >/dev/null
cmake --build "$build" -j "$jobs"

name=treeform-$version-x86_64-linux
stage=$build/stage/$name
rm -rf "$build/stage"
(umask 022 && cmake --install "$build" --strip --component tools --prefix "$stage" >/dev/null)
for tool in "$stage"/bin/*; do
    if readelf -lW "$tool" | grep -q -E "INTERP|\(NEEDED\)"; then
        echo "$tool is not static" >&2
        exit 1
    fi
done
cp LICENSE "$stage"
mkdir "$stage/licenses"
# Of what is linked in: libraries, and those that are headers alone.
for package in libc6 libstdc++6 libgcc-s1 zlib1g libhwy1 libminizip1 libpugixml1v5 libssl3 \
    libcli11-dev libeigen3-dev nlohmann-json3-dev; do
    cp -L "/usr/share/doc/$package/copyright" "$stage/licenses/$package"
done
for license in Apache-2.0 GPL-3 LGPL-2.1 LGPL-3 MPL-2.0; do
    cp -L "/usr/share/common-licenses/$license" "$stage/licenses"
done
cat >"$stage/README" <<README
treeform $version: exact tools for triangle meshes, for any x86-64 Linux.

Nothing has to be installed. Put bin/ on the PATH, or copy this folder's bin/ and share/ to /usr/local:

    export PATH=\$PWD/bin:\$PATH
    tf-selfintersect MODEL.stl --png picture.png

--help of each tool is its manual; so is share/man/man1. The tools are linked statically, with plain
threads, without assimp (no DAE and FBX are read) and without MPI.

LICENSE is that of treeform; licenses/ has those of what is linked in. The sources of treeform make
these files by tools/packages/tarball.sh, with any version of those libraries.
README
chmod -R u=rwX,go=rX "$stage"
mkdir -p "$out"
tar -C "$build/stage" --sort=name --mtime="@$SOURCE_DATE_EPOCH" --owner=0 --group=0 --numeric-owner \
    --format=gnu -c "$name" | gzip -9n >"$out/$name.tar.gz"
ls -l "$out/$name.tar.gz"
