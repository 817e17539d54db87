#!/bin/sh
# extract_snippets.sh DOCUMENT OUT...: writes the n-th ```cpp block of DOCUMENT (```c where the
# outputs end in .c) to the n-th OUT; fails unless there are as many of one as of the other.
set -eu
document=$1
shift
language=${1##*.}
n=0
for out in "$@"; do
    n=$((n + 1))
    awk -v wanted=$n -v begin="\`\`\`$language" '$0 == begin {++block; inside = 1; next}
        /^```$/ {inside = 0} inside && block == wanted' "$document" >"$out"
done
blocks=$(grep -c "^\`\`\`$language\$" "$document")
[ "$blocks" -eq $n ] || { echo "$document has $blocks programs, $n are built" >&2; exit 1; }
