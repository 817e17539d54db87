#!/usr/bin/env bash
# check_programs.sh SOURCE: each short program that the consumers build is shown in a document, as
# it stands.
set -euo pipefail
cd "$1"
blocks=$(mktemp -d)
trap 'rm -rf "$blocks"' EXIT
for document in README.md libtree/README.md libmesh/README.md; do
    awk -v prefix="$blocks/${document//\//_}_" '
        /^```cpp$/ {++block; inside = 1; next}
        /^```$/ {inside = 0}
        inside {print > (prefix block ".cpp")}' "$document"
done
status=0
for program in tests/consumer/project/*.cpp; do
    case $(basename "$program") in main.cpp | other.cpp | any_mesh.cpp) continue ;; esac
    shown=0
    for block in "$blocks"/*.cpp; do cmp -s "$program" "$block" && shown=1; done
    ((shown)) || { echo "shown in no document: $program"; status=1; }
done
exit $status
