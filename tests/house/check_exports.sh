#!/usr/bin/env bash
# check_exports.sh LIBRARY...: each shared library shows names of treeform and what the compiler
# makes of its types, and nothing of the libraries that it uses: that would replace, or be replaced
# by, another copy in the program.
set -euo pipefail
status=0
for library in "$@"; do
    [[ $(od -An -tx1 -N4 "$library") == " 7f 45 4c 46" ]] || { echo "skipped: not ELF"; exit 77; }
    names=$(nm -D --defined-only "$library" | awk '{print $NF}')
    grep -q '^_ZN8treeform' <<<"$names" || { echo "$library shows nothing"; status=1; }
    if grep -vE '^_Z(NK?[RO]?|T[ISTV]N)8treeform' <<<"$names" | c++filt | grep .; then
        echo "^ shown by $library"
        status=1
    fi
done
exit $status
