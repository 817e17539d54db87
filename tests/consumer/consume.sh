#!/usr/bin/env bash
# consume.sh STEP [static|shared]: one step of the install tests. CMakeLists.txt beside it says in
# what order they run and sets the upper-case variables.
set -euo pipefail
project=$SOURCE/tests/consumer/project
installed=$WORK/${2-static}
# Programs of one source, as the documents show them. They read models of data/.
programs=(detect resolve boolean_of_three weld_cloud slide any_mesh nearest_of_own_struct)

# Installs a build tree, then moves the installation, since a package must not know where it lies.
install_and_move() { # build tree, kind
    rm -rf "$WORK/first_place" "${WORK:?}/$2"
    cmake --install "$1" --prefix "$WORK/first_place" >/dev/null
    mv "$WORK/first_place" "$WORK/$2"
    test -x "$WORK/$2/bin/tf-selfintersect"
}

configure() { # build tree, source, options
    cmake -S "$2" -B "$1" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER="$CXX" \
        "${@:3}" >/dev/null
}

# Runs the consumer and the programs: each exits 0 when its answers are right.
run_all() { # folder with the programs
    local program
    "$1/consumer"
    for program in "${programs[@]}"; do
        (cd "$SOURCE" && "$1/$program" >"$1/$program.out") || {
            echo "$program failed; it said:" >&2
            cat "$1/$program.out" >&2
            return 1
        }
    done
}

install_static() { install_and_move "$BUILD" static; }

install_shared() { install_and_move "$OTHER_BUILDS/shared_library" shared; }

find_package() {
    rm -rf "$WORK/find_$1"
    configure "$WORK/find_$1" "$project" -DCMAKE_PREFIX_PATH="$installed"
    cmake --build "$WORK/find_$1"
    run_all "$WORK/find_$1"
}

pkg_config() {
    local flags folder=$WORK/pkg_$1 program
    command -v pkg-config >/dev/null || { echo "skipped: no pkg-config"; exit 77; }
    export PKG_CONFIG_PATH=$installed/$LIBDIR/pkgconfig
    pkg-config --exact-version="$(pkg-config --modversion treeform)" treeform
    flags=$(pkg-config --cflags --libs treeform)
    rm -rf "$folder"
    mkdir "$folder"
    compile() { # name, sources
        # shellcheck disable=SC2086 # the flags are words
        "$CXX" -std=c++20 -Wall -Wextra -Wpedantic -Werror "${@:2}" -o "$folder/$1" $flags \
            -Wl,-rpath,"$installed/$LIBDIR"
    }
    compile consumer "$project"/{main,other}.cpp
    for program in "${programs[@]}"; do compile "$program" "$project/$program.cpp"; done
    run_all "$folder"
}

# The library in C: the project has no C++, the compiler no C++ either.
find_package_c() {
    local folder=$WORK/find_c_$1
    rm -rf "$folder"
    cmake -S "$SOURCE/tests/consumer/project_c" -B "$folder" -G Ninja -DCMAKE_BUILD_TYPE=Release \
        -DCMAKE_PREFIX_PATH="$installed" >/dev/null
    cmake --build "$folder"
    "$folder/consumer_c"
}

pkg_config_c() {
    local flags folder=$WORK/pkg_c_$1
    command -v pkg-config >/dev/null || { echo "skipped: no pkg-config"; exit 77; }
    export PKG_CONFIG_PATH=$installed/$LIBDIR/pkgconfig
    flags=$(pkg-config --cflags --libs treeform-c)
    rm -rf "$folder"
    mkdir "$folder"
    # shellcheck disable=SC2086 # the flags are words
    cc -std=c99 -pedantic -Wall -Wextra -Werror -o "$folder/consumer_c" \
        "$SOURCE/tests/consumer/project_c/main.c" $flags -Wl,-rpath,"$installed/$LIBDIR"
    "$folder/consumer_c"
}

run_tool() {
    "$installed/bin/tf-selfintersect" "$SOURCE/data/cube.stl"
    local status=0
    "$installed/bin/tf-selfintersect" "$SOURCE/data/two_spheres.stl" || status=$?
    test $status -eq 1
    local tool share=$installed/share
    for tool in tf-boolean tf-cut tf-place tf-repair tf-selfintersect tf-weld; do
        test -s "$share/man/man1/$tool.1"
        test -s "$share/bash-completion/completions/$tool"
        test -s "$share/zsh/site-functions/_$tool"
        test -s "$share/fish/vendor_completions.d/$tool.fish"
    done
    # Moved or not, the shared tool takes the library beside it. (Not through a pipe into grep -q:
    # that stops reading at the first match, and what writes into it then fails.)
    [[ $1 == static ]] ||
        grep -q "libtreeform_mesh.* => $WORK/" <<<"$(ldd "$installed/bin/tf-selfintersect")"
}

check_exports() {
    "$SOURCE/tests/house/check_exports.sh" "$installed/$LIBDIR"/libtreeform_{tree,mesh}.so
}

# Every header of the door is installed, and what the installed ones include is.
check_headers() {
    local include=$installed/include header status=0
    while read -r header; do
        [[ -f $include/$header ]] || { echo "not installed: $header"; status=1; }
    done < <(cd "$SOURCE" && find lib*/include tools/c/include -name '*.h*' | sed 's|.*/include/||')
    while read -r header; do
        [[ -f $include/$header ]] || { echo "included, not installed: $header"; status=1; }
    done < <(grep -rhoE '#include <(treeform|lib(tree|mesh))/[^>]+' "$include" | sed 's/.*<//' | sort -u)
    return $status
}

subdirectory() {
    local folder=$OTHER_BUILDS/as_subdirectory
    configure "$folder" "$project" -DTREEFORM_SUBDIRECTORY="$SOURCE" \
        -DTREEFORM_WERROR="$WERROR"
    cmake --build "$folder"
    run_all "$folder"
}

"$@"
