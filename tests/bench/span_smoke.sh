#!/usr/bin/env bash
# span_smoke.sh SPAN: runs P1 on tiny meshes, and checks that no span is longer than its work.
set -euo pipefail

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
"$1" --tiny --runs 1 --where 3 --cache "$scratch" --out "$scratch/span.csv"
awk -F, '
    NR == 1 && $0 != "verb,faces,work ms,span ms,parallelism" { print "not the header"; failed = 1 }
    NR > 1 && ($NF < 1 || $(NF - 2) <= 0 || $(NF - 1) <= 0) { print "line " NR ": " $0; failed = 1 }
    END { if (NR != 19) { print NR " lines"; failed = 1 }; exit failed }' "$scratch/span.csv"
