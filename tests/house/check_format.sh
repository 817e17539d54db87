#!/usr/bin/env bash
# check_format.sh SOURCE CLANG_FORMAT: every C and C++ file of ours is as clang-format leaves it.
set -euo pipefail
command -v "$2" >/dev/null || { echo "skipped: no clang-format"; exit 77; }
cd "$1"
mapfile -t files < <(find libtree libmesh tools tests data \( -name '*.hpp' -o -name '*.cpp' \
    -o -name '*.h' -o -name '*.c' \) | sort)
"$2" --dry-run -Werror "${files[@]}"
