#!/bin/sh
# extract_snippets.sh README OUT...: writes the n-th ```cpp block of README to the n-th OUT; fails
# unless there are as many of one as of the other.
set -eu
readme=$1
shift
n=0
for out in "$@"; do
    n=$((n + 1))
    awk -v wanted=$n '/^```cpp$/ {++block; inside = 1; next} /^```$/ {inside = 0}
        inside && block == wanted' "$readme" >"$out"
done
blocks=$(grep -c '^```cpp$' "$readme")
[ "$blocks" -eq $n ] || { echo "$readme has $blocks programs, $n are built" >&2; exit 1; }
