#!/usr/bin/env bash
# smoke.sh BENCH: runs every workload on tiny models and checks that bench.csv is well formed. How
# long anything took is not looked at.
set -euo pipefail

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
"$1" --tiny --cache "$scratch/cache" --out "$scratch/out"
[[ -s $scratch/out/machine.txt ]]
[[ -s $scratch/out/index.html ]]
for picture in "$scratch"/out/*.svg; do
    [[ $(tail -n 1 "$picture") == "</svg>" ]]
    grep -q '<rect class="paper"' "$picture" # it is legible on any page
done
# Dots of two methods do not cover each other.
python3 - "$scratch"/out/*.svg <<'CHECK'
import re
import sys

for name in sys.argv[1:]:
    with open(name) as file:
        marks = re.findall(r'<path transform="translate\((\S+) (\S+)\)" d="(\S+)[^"]*" class="mark (f\d)"',
                           file.read())
    for i, (x, y, *who) in enumerate(marks):
        for u, v, *other in marks[:i]:
            near = (float(x) - float(u)) ** 2 + (float(y) - float(v)) ** 2 < 36
            if who != other and near:
                sys.exit(f"{name}: dots of two methods at {x}, {y}")
CHECK

awk -F, '
    function bad(why) { printf "bench.csv, line %d: %s: %s\n", NR, why, $0; failed = 1 }
    NR == 1 && $0 != "id,case,size,threads,who,value,unit,peak_mb,error" { bad("not the header") }
    NR == 1 { next }
    NF != 9 { bad("not nine fields") }
    $3 !~ /^[1-9][0-9]*$/ || $4 !~ /^[1-9][0-9]*$/ { bad("size or threads is not a number") }
    $6 !~ /^[0-9.]+(e[-+]?[0-9]+)?$/ { bad("value is not a number") }
    $2 == "" || $5 == "" || $7 == "" { bad("empty field") }
    $8 !~ /^([0-9.]+)?$/ { bad("peak_mb is not a number") }
    $1 == "E8" && $8 == "" { bad("no peak") }
    $5 ~ /^treeform( integers only)?$/ && $9 != "" && $9 != 0 { bad("treeform is wrong") }
    { ids[$1] = 1 }
    $1 == "E8" { split($5, words, " "); tools[words[1]] = 1 }
    END {
        split("B1 B2 B3 B4 B5 B8 B9 C1 C2 C3 C4 E1 E2 E3 E4 E5 E6 E7 E8 E9 F2 F5 F6 F7 F8 S1 S2 T1 W1 W2", wanted, " ")
        for (i in wanted) if (!(wanted[i] in ids)) { print "no row of " wanted[i]; failed = 1 }
        split("boolean place repair selfintersect weld", all, " ")
        for (i in all) if (!(("tf-" all[i]) in tools)) { print "E8 has no tf-" all[i]; failed = 1 }
        exit failed
    }' "$scratch/out/bench.csv"
