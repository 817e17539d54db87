# shellcheck shell=bash disable=SC2034 # what it sets is for others
# To be sourced at the top of the tree: how packages are compiled, and of which time they are.

# As Debian compiles: hardened. No folder of the machine is named in what is made.
export DEB_BUILD_MAINT_OPTIONS="hardening=+all reproducible=-fixfilepath"
export DEB_CXXFLAGS_MAINT_STRIP=-g
compile_flags="$(dpkg-buildflags --get CXXFLAGS) $(dpkg-buildflags --get CPPFLAGS)"
link_flags=$(dpkg-buildflags --get LDFLAGS)
flags=(-DCMAKE_BUILD_TYPE=Release
    "-DCMAKE_CXX_FLAGS=$compile_flags"
    "-DCMAKE_EXE_LINKER_FLAGS=$link_flags"
    "-DCMAKE_SHARED_LINKER_FLAGS=$link_flags"
    "-DCMAKE_MODULE_LINKER_FLAGS=$link_flags")

jobs=${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}
if command -v ccache >/dev/null; then
    export CMAKE_CXX_COMPILER_LAUNCHER=ccache CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1
fi

# The time of what is packed is that of the commit, so that the same commit gives the same bytes.
if [[ -z ${SOURCE_DATE_EPOCH-} ]]; then
    SOURCE_DATE_EPOCH=$(git log -1 --format=%ct 2>/dev/null || date +%s)
fi
export SOURCE_DATE_EPOCH
version=$(sed -n 's/^#define TREEFORM_VERSION_\(MAJOR\|MINOR\|PATCH\) //p' \
    libtree/include/treeform/tree/version.hpp | paste -sd.)
