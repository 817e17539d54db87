#!/bin/sh
# extract_snippets.sh DOCUMENT OUT...: writes the n-th ```cpp block of DOCUMENT to the n-th OUT;
# fails unless there are as many of one as of the other.
set -eu
document=$1
shift
n=0
for out in "$@"; do
    n=$((n + 1))
    awk -v wanted=$n '/^```cpp$/ {++block; inside = 1; next} /^```$/ {inside = 0}
        inside && block == wanted' "$document" >"$out"
done
blocks=$(grep -c '^```cpp$' "$document")
[ "$blocks" -eq $n ] || { echo "$document has $blocks programs, $n are built" >&2; exit 1; }
