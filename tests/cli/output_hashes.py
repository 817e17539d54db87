"""Whether two builds of the tools write the same bytes: for changes that should change nothing.

    output_hashes.py BIN_DIR MODELS_DIR -o hashes.csv [-j N] [--only REGEX] [--keep DIR]
    output_hashes.py --compare old.csv new.csv
    output_hashes.py --diff-reports OLD_DIR NEW_DIR

The first runs the four tools of BIN_DIR (BIN_DIR/tf-weld, or BIN_DIR/tf-weld/tf-weld as in
build/release/tools) in all their modes over the models of MODELS_DIR (the folder with TRUTH.csv),
over those of data/, and over small ones that it makes: 10,000 short runs, some 10 minutes on two
cores. Each line of hashes.csv is a case: its name, the exit statuses, and the first digits of the
SHA-256 of every file written, of the reports and of what was said. With --keep all of that stays in
DIR/CASE. N cases run at a time, 2 unless told otherwise.

--compare names the cases that differ, and in what; the status is 1 if any does. --diff-reports
looks into two folders of --keep: which keys of the reports are in one of them only, and which have
other values, in how many reports, and an example.

What may differ between two runs is left out of reports: times, threads, memory, command, version.
All paths are relative to the folder of the case, in a copy of the models. A case that takes longer
than a minute is stopped; its status is "timeout". Its output cannot be compared: name it in SLOW.
"""

import argparse
import collections
import concurrent.futures
import csv
import dataclasses
import fnmatch
import hashlib
import json
import os
import pathlib
import random
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import time

DATA = pathlib.Path(__file__).resolve().parents[2] / "data"
SECONDS = 60
MEMORY = 6 << 30

# ---- what is run ----

# A line is: label, which models, command; ";" stands between commands that follow each other. A
# command is of the tool of its table where it does not name another one. {f} is a model; {a}, {b}
# are a pair and {m} the matrix that moves b; {a}, {b}, {c} are a triple. "<FILE" is standard input.
# Each command gets a report and two threads unless it asks for others.

SELFINTERSECT = """
detect                 all     {f} --pairs pairs.csv --curves curves.obj -o marked.ply
page                   small   {f} --touching --html page.html --png p.png --png-size 320x240
touching               all     {f} --touching --pairs pairs.csv --curves curves.ply -o marked.glb
vertices=file          all     {f} --vertices file --pairs pairs.csv
vertices=equal         all     {f} --vertices equal --pairs pairs.csv
no-overlap             small   {f} --no-coplanar --pairs pairs.csv --curves curves.obj
between                small   {f} --between --touching --pairs pairs.csv -o marked.ply
within                 small   {f} --within --touching --pairs pairs.csv -o marked.ply
tolerance=0.01%        all     {f} -t 0.01% --pairs pairs.csv
tolerance=1%           small   {f} -t 1% --pairs pairs.csv -o marked.ply
box                    small   {f} --box -1,-1,-1,1,1,1 --touching --pairs pairs.csv -o marked.ply
first                  small   {f} --first --exit-zero
limit                  few     {f} --touching --limit 3 -r - --units mm
marked/ascii           few     {f} -o marked.ply --ascii --precision double
marked/float           few     {f} -o marked.ply --precision float
verbose                few     {f} -v -v --log log.txt -o marked.ply
quiet                  few     {f} -q --touching -o out.ply
threads                few     {f} -j 1 -o one.ply --pairs one.csv ; {f} -j 5 -o five.ply --pairs \
                               five.csv
stdin                  few     - <{f} --pairs -
repair=outer/stl       all     {f} --repair=outer -o out.stl
repair=outer/ply       all     {f} --repair=outer -o out.ply --precision double --curves curves.obj
repair=outer/obj       small   {f} --repair -o out.obj
repair=outer/off       few     {f} --repair -o out.off
repair=outer/glb       few     {f} --repair -o out.glb
repair=outer/float     small   {f} --repair -o out.ply --precision float --vertices equal
repair=outer/ascii     few     {f} --repair -o out.stl --ascii
repair=outer/strict    small   {f} --repair -o out.ply --max-move 0 --keep-components
repair=outer/tolerance small   {f} --repair -o out.stl -t 0.1% --html page.html
repair=split/ply       all     {f} --repair=split -o out.ply --precision double
repair=split/stl       small   {f} --repair=split -o out.stl
repair=split/obj       small   {f} --repair=split -o out.obj --vertices equal
repair=remove/ply      all     {f} --repair=remove -o out.ply
repair=remove/stl      small   {f} --repair=remove -o out.stl --touching
repair=remove/obj      small   {f} --repair=remove -o out.obj --vertices equal
repair=remove/strict   small   {f} --repair=remove -o out.ply --max-move 0 --keep-components
repair/dry             few     {f} --repair -n -o out.stl
repair/threads         few     {f} --repair -j 1 -o one.ply ; {f} --repair -j 5 -o five.ply
in-place               few     tf-weld {f} -o in.obj ; in.obj --repair --in-place
output-dir             one     {f} made/open.obj models/coplanar/three_cubes.obj --output-dir . ; \
                               {f} models/coplanar/three_cubes.obj --repair --output-dir . \
                               --suffix +fixed
several                one     {f} models/coplanar/three_cubes.obj none.obj \
                               models/hostile/h_empty.stl -r all.json
hostile/detect         hostile {f} --touching --pairs pairs.csv --curves curves.obj -o marked.ply
hostile/repair         hostile {f} --repair --vertices equal -o out.ply
clouds                 clouds  {f}
"""

BOOLEAN = """
union/ply              pairs   union {a} {b} --matrix 2:{m} -o out.ply --source from --curves \
                               curves.obj
union/stl              pairs   union {a} {b} --matrix 2:{m} -o out.stl
intersection/obj       pairs   intersection {a} {b} --matrix 2:{m} -o out.obj
intersection/float     pairs   intersection {a} {b} --matrix 2:{m} -o out.ply --precision float \
                               --ascii
difference/stl         pairs   difference {a} {b} --matrix 2:{m} -o out.stl --ascii
difference/open        pairs   difference {a} {b} --matrix 2:{m} -o out.ply --accept-open
symmetric-difference/off pairs  symmetric-difference {a} {b} --matrix 2:{m} -o out.off
split/ply              pairs   split {a} {b} --matrix 2:{m} -o out.ply --curves curves.ply
expr=b-a/glb           pairs   --expr b-a {a} {b} --matrix 2:{m} -o out.glb --source s
simplify/obj           pairs   union {a} {b} --matrix 2:{m} --merge-coplanar -o out.obj
fill-rule=even-odd     pairs   union {a} {b} --matrix 2:{m} --fill-rule even-odd -o out.ply
fill-rule=positive     pairs   difference {a} {b} --matrix 2:{m} --fill-rule positive -o out.ply \
                               --max-move 0
check/pair             pairs   --check {a} {b} --matrix 2:{m}
page                   pairs   union {a} {b} --matrix 2:{m} -n --html page.html --png p.png --png-size \
                               320x240 --view all
dry                    pairs   symmetric-difference {a} {b} -n
self/stl               all     union {f} -o out.stl
self/ply               small   union {f} -o out.ply --precision double
self/obj               small   union {f} -o out.obj --max-move 0
self/check             all     --check {f}
self/check=even-odd    small   --check {f} --fill-rule even-odd
self/even-odd          small   union {f} --fill-rule even-odd -o out.ply
self/positive          small   union {f} --fill-rule positive -o out.ply
self/simplify          all     union {f} --merge-coplanar -o out.ply
self/split             small   split {f} -o out.ply
self/open              small   intersection {f} made/box.obj --accept-open -o out.ply
self/plain             few     union {f} --no-attributes -o out.ply --ascii
self/simplify-plain    few     union {f} --no-attributes --merge-coplanar -o out.obj
self/threads           few     union {f} -j 1 -o one.ply ; union {f} -j 5 -o five.ply
with-box/ply           made    difference {f} made/box.obj -o out.ply --ascii --source s
with-box/obj           made    union made/box.obj {f} -o out.obj
with-box/glb           made    symmetric-difference {f} made/box.obj -o out.glb
with-box/split         made    split {f} made/box.obj -o out.ply --ascii
with-box/simplify      made    difference {f} made/box.obj -o out.ply --ascii --merge-coplanar --source s
with-box/plain         made    difference {f} made/box.obj -o out.ply --ascii --no-attributes
union                  triples union {a} {b} {c} -o out.ply --source s
intersection           triples intersection {a} {b} {c} -o out.stl
difference             triples difference {a} {b} {c} -o out.obj --curves curves.ply
symmetric-difference   triples symmetric-difference {a} {b} {c} -o out.ply --precision double
split                  triples split {a} {b} {c} -o out.ply
expr=(a-b)*c           triples --expr (a-b)*c {a} {b} {c} -o out.stl --merge-coplanar
expr=(a+b)-c           triples --expr (a|b)-c {a} {b} {c} -o out.ply -v
expr=a^(b*c)           triples --expr a^(b&c) {a} {b} {c} -o out.glb
many                   one     union models/robot/franka_link0.stl models/robot/franka_link1.stl \
                               models/robot/franka_link2.stl models/robot/franka_link3.stl \
                               models/robot/franka_link4.stl models/robot/franka_hand.stl -o \
                               out.ply --source s
stdin                  one     union - {f} <models/pairs/ballA.off -o - --output-format ply
hostile/first          hostile union {f} made/box.obj -o out.ply
hostile/second         hostile split made/box.obj {f} -o out.obj
clouds                 clouds  union {f} made/box.obj -n
"""

WELD = """
equal/obj              all     {f} -o out.obj --map map.csv
equal/stl              few     {f} -o out.stl --ascii
equal/glb              few     {f} -o out.glb
equal/off              few     {f} -o out.off
equal/ply-ascii        few     {f} -o out.ply --ascii
equal/ply-float        few     {f} -o out.ply --precision float
equal/ply-double       few     {f} -o out.ply --precision double
first=0.01%            all     {f} -t 0.01% -o out.ply --map map.bin --removed gone.ply
first=1%               all     {f} -t 1% -o out.stl
chain=0.01%            all     {f} -t 0.01% --rule chain -o out.ply --map map.csv
chain=1%               all     {f} -t 1% --rule chain -o out.off
keep=last              small   {f} -t 0.5% --keep last -o out.ply
keep=mean              small   {f} -t 0.5% --keep mean -o out.obj --map map.csv
keep=mean/chain        small   {f} -t 0.5% --rule chain --keep mean -o out.ply
keep=max:z             small   {f} -t 0.5% --keep max:z -o out.ply --removed gone.xyz
ignore-seams           small   {f} -t 0.01% --ignore-seams normal,uv,color -o out.ply
ignore-seams/obj       few     {f} -t 1% --ignore-seams normal,uv -o out.obj
same                   small   {f} -t 1% --same z=0.001 -o out.ply
borders                small   {f} -t 1% --borders -o out.ply
keep-manifold          small   {f} -t 1% --keep-manifold -o out.ply
keep-manifold/chain    small   {f} -t 1% --rule chain --keep-manifold --borders -o out.obj
keep-degenerate        small   {f} -t 1% --keep-degenerate -o out.ply
label                  small   {f} -t 1% --label group -o out.ply
check                  all     {f} --check -t 0.1%
picture                small   {f} -t 1% -n --html page.html --png p.png --png-size 320x240
dry                    few     {f} -n -t 1% -v
threads                few     {f} -t 1% -j 1 -o one.ply ; {f} -t 1% -j 5 -o five.ply
in-place               few     {f} -o in.ply ; in.ply -t 1% --in-place
join                   pairs   --join {a} {b} -t 0.1% -o out.ply --map map.csv
join/obj               pairs   --join {b} {a} --rule chain -o out.obj
join/three             triples --join {a} {b} {c} -t 1% --keep mean -o out.glb
join/clouds            one     --join models/cloud/las_color_1k.xyz made/points.ply \
                               made/points.csv -t 0.1 --keep min:x -o out.ply --map map.csv \
                               --removed gone.csv
join/made              made    --join {f} made/box.obj made/points.ply -o out.ply --ascii
output-dir             one     {f} made/points.csv none.ply --output-dir . -t 1%
stdin                  few     - <{f} -t 1% -o - --output-format ply
cloud/equal            clouds  {f} -o out.ply --map map.bin --removed gone.ply
cloud/equal/xyz        clouds  {f} -o out.xyz
cloud/equal/pcd        clouds  {f} -o out.pcd
cloud/equal/csv        clouds  {f} -o out.csv
cloud/float            clouds  {f} -o out.ply --precision float
cloud/ascii            points  {f} -o out.ply --ascii --precision double
cloud/pcd-ascii        points  {f} -o out.pcd --ascii ; out.pcd -o again.xyz
cloud/pcd-float        points  {f} -o out.pcd --precision float ; out.pcd -o again.csv
cloud/first=0.01%      clouds  {f} -t 0.01% -o out.ply --map map.csv
cloud/first=1%         clouds  {f} -t 1% -o out.pcd --removed gone.pcd
cloud/chain=0.01%      clouds  {f} -t 0.01% --rule chain -o out.ply --map map.bin
cloud/chain=1%         clouds  {f} -t 1% --rule chain -o out.xyz --removed gone.csv
cloud/keep=last        clouds  {f} -t 0.5% --keep last -o out.ply
cloud/keep=mean        clouds  {f} -t 0.5% --keep mean -o out.ply
cloud/keep=min:x       clouds  {f} -t 0.5% --keep min:x -o out.ply
cloud/same             clouds  {f} -t 1% --same y=0.01 -o out.ply
cloud/same-kind        points  {f} -t 0.2 --same classification,nx=0.5 --keep max:range -o \
                               out.ply --ascii
cloud/label            clouds  {f} -t 0.5% --label group -o out.ply --ascii
cloud/label/chain      clouds  {f} -t 0.5% --rule chain --label group -o out.csv
cloud/check            clouds  {f} --check
tiles/equal            clouds  {f} --tile-points 2000 -o out.ply --map map.csv --removed gone.ply
tiles/first            clouds  {f} -t 0.3% --tile-points 3000 -o out.xyz --removed gone.csv --map \
                               map.bin
tiles/first/pcd        clouds  {f} -t 1% --tile-points 5000 -o out.pcd
tiles/chain            clouds  {f} -t 0.3% --rule chain --tile-points 3000 -o out.ply --map map.csv
tiles/chain/csv        clouds  {f} -t 0.05% --rule chain --tile-points 10000 -o out.csv
tiles/label            clouds  {f} -t 0.3% --tile-points 3000 --label group -o out.ply
tiles/check            clouds  {f} -t 0.3% --tile-points 3000 --check
tiles/threads          points  {f} -t 0.1 --tile-points 200 -j 1 -o out.ply
tiles/stopped          clouds  {f} -t 0.3% --tile-points 3000 --stop-at 2 --work work -o out.ply \
                               -j 1 ; {f} -t 0.3% --tile-points 3000 --stop-at 4 --work work -j 1 \
                               -o out.ply ; {f} -t 0.3% --tile-points 3000 --work work -o out.ply -f
tiles/stdin            points  - <{f} -t 0.1 --tile-points 200 -o out.ply
tiles/memory           clouds  {f} -t 0.3% --memory 48M -v -o out.ply
hostile/equal          hostile {f} -o out.ply --map map.csv
hostile/first          hostile {f} -t 1% -o out.obj
hostile/check          hostile {f} --check
"""

PLACE = """
drop/stl               all     drop {f} -o out.stl --matrix m.txt
drop/ply               small   drop {f} --bed 10.1 -o out.ply --precision double
drop/obj               small   drop {f} --clearance 1% -o out.obj
drop/float             small   drop {f} --bed -1e6 -o out.ply --precision float
drop/direction         small   drop {f} -d 1,0.3,-2 -o out.off --matrix m.txt
drop/glb               few     drop {f} -o out.glb
drop/ascii             few     drop {f} -o out.stl --ascii
drop/start             small   drop {f} --start made/turn.txt -o out.ply --matrix m.txt
drop/in-place          few     tf-weld {f} -o in.obj ; drop in.obj --in-place
drop/threads           few     drop {f} --fixed made/box.obj -j 1 -o one.ply ; drop {f} --fixed \
                               made/box.obj -j 5 -o five.ply
drop/stdin             few     drop - <{f} -o - --output-format obj --bed 3
drop/output-dir        one     drop {f} models/coplanar/three_cubes.obj none.stl --output-dir . \
                               --fixed made/plate.obj --scene
drop/fixed             pairs   drop {b} --start {m} --fixed {a} -o out.ply --matrix m.txt
drop/fixed-from-above  pairs   drop {b} --start made/up.txt --fixed {a} -o out.obj
drop/fixed-bed         pairs   drop {b} --start made/up.txt --fixed {a} --bed 0 --clearance 0.1% \
                               -o out.stl --scene
drop/plate             all     drop {f} --start made/up.txt --fixed made/plate.obj -o out.ply
lay/stl                all     lay {f} -o out.stl --matrix m.txt
lay/ply                small   lay {f} -o out.ply --precision double --bed 2.5
lay/normal             small   lay {f} --face-normal 1,0.2,-0.3 -o out.obj
lay/point              small   lay {f} --face-point 0,0,0 -o out.ply
lay/spin               small   lay {f} --keep-spin --face-normal 0,1,0 -o out.stl
lay/exact              small   lay {f} -t 0 -o out.ply
lay/wide               small   lay {f} -t 1% --largest-face -o out.ply
slide/ply              pairs   slide {b} --start {m} --fixed {a} -d 1,0.5,-2 -o out.ply --matrix \
                               m.txt
slide/stl              pairs   slide {b} --start {m} --fixed {a} -d -1,0,0 --clearance 0.5% -o \
                               out.stl
slide/max-travel       pairs   slide {b} --start made/up.txt --fixed {a} --max-travel 500 -o out.obj
slide/scene            pairs   slide {b} --start made/up.txt --fixed {a} --scene -o out.glb
mate/ply               pairs   mate {b} --start {m} --fixed {a} -o out.ply --matrix m.txt
mate/clearance         pairs   mate {b} --start made/up.txt --fixed {a} --clearance 0.5% -o out.stl
clear/ply              pairs   separate {b} --start {m} --fixed {a} -o out.ply --matrix m.txt
clear/clearance        pairs   separate {b} --start {m} --fixed {a} --clearance 1% -o out.stl
clear/max-travel       pairs   separate {b} --start {m} --fixed {a} --max-travel 0.5% --scene -o \
                               out.obj
measure/ply            pairs   measure {b} --start {m} --fixed {a} -o out.ply
measure/clearance      pairs   measure {b} --start {m} --fixed {a} --clearance 5% --scene -o \
                               out.ply --ascii
measure/there          pairs   measure {a} --fixed {b} -v
measure/self           small   measure {f} --fixed {f} --start made/turn.txt -o out.glb
measure/box            all     measure {f} --fixed made/box.obj --clearance 10%
measure/picture        small   measure {f} --fixed made/box.obj --html page.html --png p.png \
                               --png-size 320x240 --view iso,top
clash/picture          pairs   clash {a} {b} --clearance 1% --html page.html --png p.png \
                               --png-size 320x240
fit                    pairs   align {b} --start made/turn.txt --fixed {b} -o out.ply --matrix m.txt
fit/scale              pairs   align {b} --start {m} --fixed {a} --scale --overlap 0.5 -o out.obj
fit/far                small   align {f} --fixed {f} --start made/turn.txt --max-distance 20% -o \
                               out.stl --matrix -
fit/starts             small   align {f} --fixed {f} --start made/turn.txt --starts 9 \
                               -o out.ply --matrix m.txt
fit/trim               small   align {f} --fixed {f} --start made/turn.txt --trim 0.2 --metric point \
                               --align-tolerance 1e-4 --iterations 30 -o out.ply --matrix m.txt
two-fixed              triples drop {a} --start made/up.txt --fixed {b} --fixed {c} -o out.ply \
                               --scene
two-fixed/measure      triples measure {a} --fixed {b} --fixed {c} --clearance 5% -o out.ply
two-fixed/clear        triples separate {a} --fixed {b} --fixed {c} --clearance 0.5% -o out.stl
two-fixed/slide        triples slide {a} --start made/up.txt --fixed {b} --fixed {c} -o out.glb \
                               --scene
arrange/none           triples pack {a} {b} {c} --size 100,100 --rotate none -o out.stl \
                               --matrix m.txt
arrange/90             triples pack {a} {b} {c} --size 2.5,2.5 --spacing 0.1 -o out.ply
arrange/45             triples pack {a} {b} {c} --size 3,3,2 --spacing 0.1 --rotate 45 --seed \
                               7 -o out.obj
arrange/any            triples pack {a} {b} {c} {a} --size 4,3 --spacing 0.05 --rotate any \
                               --seed 3 --bed 1 -o out.glb
arrange/robot          one     pack models/robot/franka_link0.stl \
                               models/robot/franka_link1.stl models/robot/franka_link2.stl \
                               models/robot/franka_link3.stl models/robot/franka_link4.stl \
                               models/robot/franka_hand.stl --size 0.5,0.4 --spacing 0.01 \
                               --rotate any -o out.stl
scene/drop             scenes  drop made/box.obj --start made/up.txt --fixed {f} -o out.ply --scene
scene/slide            scenes  slide made/box.obj --start made/up.txt -d 0.1,0,-1 --fixed {f} -o \
                               out.obj --scene
scene/clear            scenes  separate made/box.obj --fixed {f} --clearance 1 -o out.glb --scene
scene/measure          scenes  measure made/box.obj --fixed {f} --clearance 50% -o out.ply
scene/paint/ply        one     drop made/paint.obj --start made/up.txt --fixed made/seams.ply \
                               --fixed made/coloured.obj -o out.ply --scene --ascii
scene/paint/obj        one     drop made/paint.obj --start made/up.txt --fixed made/seams.ply \
                               --fixed made/coloured.obj -o out.obj --scene
scene/paint/glb        one     drop made/seams.ply --start made/up.txt --fixed made/paint.obj \
                               --fixed made/coloured.obj -o out.glb --scene
scene/moving           scenes  drop {f} --fixed made/plate.obj -o out.obj
cloud/drop             clouds  drop {f} -o out.ply --matrix m.txt
cloud/drop/xyz         clouds  drop {f} --fixed made/box.obj --bed 5 -o out.xyz
cloud/lay              points  lay {f} -o out.ply
cloud/slide            points  slide {f} --start made/up.txt --fixed models/pairs/ballA.off -o \
                               out.ply --scene
cloud/measure          clouds  measure {f} --fixed made/points.ply -o out.ply
cloud/measure-mesh     clouds  measure {f} --fixed models/pairs/ballA.off --clearance 1
cloud/mate             points  mate {f} --fixed models/pairs/ballA.off --clearance 1 -o out.xyz
cloud/clear            points  separate {f} --fixed models/pairs/ballA.off --clearance 0.5 -o out.ply
cloud/fixed            small   drop {f} --start made/up.txt --fixed made/points.ply -o out.ply \
                               --scene
cloud/fit              points  align {f} --start made/turn.txt --fixed {f} -o out.ply --matrix m.txt
cloud/fit-ocean        one     align models/cloud/ocean_r_15k.xyz --start made/turn.txt --fixed \
                               models/cloud/ocean_r_15k.xyz --overlap 0.8 -o out.ply --matrix m.txt
hostile/drop           hostile drop {f} -o out.obj
hostile/fixed          hostile measure made/box.obj --fixed {f} -o out.ply
hostile/lay            hostile lay {f} -o out.ply
"""

# Command lines that are refused, or nearly so, between "|"; without a report.
USAGE = """
tf-selfintersect | tf-selfintersect --help | tf-selfintersect --no-such | tf-selfintersect none.stl
tf-selfintersect made/box.obj --repair | tf-selfintersect made/box.obj --repair=all -o out.stl
tf-selfintersect made/box.obj -o out.stl | tf-selfintersect made/box.obj -o out.docx
tf-selfintersect made/box.obj --box 1,2 | tf-selfintersect made/box.obj -t -1
tf-selfintersect made/box.obj -t 1mm | tf-selfintersect made/box.obj --limit x
tf-selfintersect made/box.obj --vertices all | tf-selfintersect made/box.obj -j 0
tf-selfintersect made/box.obj --between --within | tf-selfintersect made/box.obj --curves out.stl
tf-selfintersect made/box.obj --pairs - -r - | tf-selfintersect made/box.obj --pairs no/such.csv
tf-selfintersect made/box.obj --pairs made/box.obj -f | tf-selfintersect made/box.obj --in-place
tf-selfintersect made/box.obj --units furlong | tf-selfintersect made/box.obj --format docx
tf-selfintersect made/box.obj -q -v | tf-selfintersect models/clean/koala_100k.obj --memory 1M
tf-selfintersect models/clean/koala_100k.obj --timeout 0.000001
tf-boolean | tf-boolean --help | tf-boolean unite made/box.obj | tf-boolean union
tf-boolean --expr a-c made/box.obj made/box.obj -n | tf-boolean --expr a) made/box.obj -n
tf-boolean union made/box.obj made/box.obj | tf-boolean union made/box.obj none.obj -n
tf-boolean union made/box.obj --fill-rule even -n | tf-boolean union made/box.obj --matrix m.txt -n
tf-boolean union made/box.obj --matrix 2:m.txt -n
tf-boolean union made/box.obj --matrix 1:none.txt -n
tf-boolean union made/box.obj --matrix 1:made/flat.txt -n
tf-boolean --check made/box.obj -o out.obj | tf-boolean split made/box.obj --merge-coplanar -n
tf-boolean union made/box.obj --source s -o out.stl
tf-boolean union made/box.obj --in-place | tf-boolean union made/box.obj -o no/out.stl
tf-boolean union made/box.obj --curves out.stl -n | tf-boolean union - - -n
tf-boolean union made/open.obj -o out.stl
tf-boolean union made/open.obj made/open.obj --accept-open -o out.stl
tf-boolean difference made/box.obj made/box.obj -o out.stl
tf-weld | tf-weld --help | tf-weld made/box.obj | tf-weld made/box.obj -o out.docx
tf-weld made/box.obj -t x -n | tf-weld made/box.obj --rule any -n
tf-weld made/box.obj --keep some -n | tf-weld made/box.obj --keep min:mass -n
tf-weld made/box.obj --same mass -n | tf-weld made/box.obj --same x --ignore-seams x -n
tf-weld made/box.obj --label g | tf-weld made/box.obj --label x -o out.ply
tf-weld made/box.obj --check -o out.ply | tf-weld made/box.obj --borders -o out.xyz
tf-weld made/points.ply -o out.stl | tf-weld made/points.ply -o out.obj
tf-weld made/points.ply made/box.obj -o out.ply | tf-weld made/points.ply --removed gone.stl -n
tf-weld none.xyz -n | tf-weld made/points.ply --memory 1k -n
tf-weld made/points.ply --tile-points 100 --keep mean -o out.ply
tf-weld made/points.ply --borders -o out.ply
tf-weld made/box.obj -o a.obj ; tf-weld made/box.obj -o a.obj ; tf-weld made/box.obj -t 5 -f -o \
    a.obj
tf-place | tf-place --help | tf-place fly made/box.obj | tf-place drop | tf-place drop made/box.obj
tf-place drop none.obj -n | tf-place mate made/box.obj -n
tf-place slide made/box.obj --fixed made/box.obj -d 0,0,0 -n
tf-place drop made/box.obj -d 0,0,1 -n | tf-place lay made/box.obj --fixed made/box.obj -n
tf-place lay made/box.obj --largest-face --face-point 0,0,0 -n | tf-place pack made/box.obj -n
tf-place pack made/box.obj --size 9,-9 -n | tf-place pack made/box.obj --size 1,1 -o out.stl
tf-place pack made/points.ply --size 9,9 -n | tf-place drop made/box.obj --seed 1 -n
tf-place drop made/box.obj --scale -n
tf-place align made/box.obj --fixed made/box.obj --overlap 2 -n
tf-place measure made/box.obj --fixed made/box.obj --matrix m.txt
tf-place drop made/box.obj --start made/flat.txt -n
tf-place drop made/box.obj --start made/box.obj -n
tf-place slide made/box.obj --fixed made/plate.obj -d 0,0,1 -o out.stl
tf-place slide made/box.obj --start made/up.txt --fixed made/plate.obj --max-travel 1 -o out.stl
"""

TABLES = {"tf-selfintersect": SELFINTERSECT, "tf-boolean": BOOLEAN, "tf-weld": WELD,
          "tf-place": PLACE}

# Models for options that do little that is new from one model to the next.
FEW = """models/selfint/cow_6k.obj models/selfint/two_cubes_intersecting.ply
    models/selfint/two_boxes_bad_union.ply models/selfint/ht90_actuator_4k.stl
    models/coplanar/three_cylinders.obj models/coplanar/cubes_touching.stl
    models/degenerate/spider_ascii_1k.stl models/nonmanifold/hour_glass.off
    models/open/moebius.obj models/scene/boolean.glb models/scene/dodeca_chain_loop.3mf
    made/paint.obj made/seams.ply""".split()

TRIPLES = {
    "cylinders": "models/pairs/xcylinder.obj models/pairs/ycylinder.obj models/pairs/zcylinder.obj",
    "balls_box": "models/pairs/ballA.off models/pairs/ballB.off made/box.obj",
    "cubes": "models/pairs/boolean_minus_cube.obj models/pairs/boolean_minus_green.obj "
             "made/box.obj",
    "robot": "models/robot/franka_link0.stl models/robot/franka_link1.stl "
             "models/robot/franka_hand.stl",
    "overlapping": "models/coplanar/three_cubes.obj models/selfint/two_cubes_intersecting.ply "
                   "models/pairs/center_cylinder.obj",
    "coloured": "made/paint.obj made/seams.ply made/box.obj",
    "torus_cow": "models/clean/torus_5k.obj models/selfint/cow_6k.obj models/clean/fish_2k.obj",
}

# Cases of ten seconds and more that bring little, as patterns of their names.
SLOW = ["selfintersect/repair=split/ply/scene/2CylinderEngine.glb",
        "place/measure/clearance/bunny_bunny_shift", "place/cloud/fixed/made/huge.obj"]


@dataclasses.dataclass(frozen=True)
class Case:
    name: str
    commands: tuple  # of tuples of words, the tool first


def pair_rows(root):
    with open(root / "models/TRUTH_PAIRS.csv", newline="") as file:
        rows = csv.DictReader(line for line in file if not line.startswith("#"))
        return {row["pair"]: row for row in rows if row["matrix_a"] == "identity"}


def groups(root):
    """Of each word for models, their names, and what stands for {f}, {a}, ... in commands."""
    def files(*patterns):
        found = sorted(p.relative_to(root).as_posix() for s in patterns for p in root.glob(s))
        return [name for name in found if not name.endswith((".md", ".mtl", ".txt"))]

    small = lambda names, size: [n for n in names if (root / n).stat().st_size <= size]
    points, clouds, data = files("made/points*"), files("models/cloud/*"), files("data/*")
    hostile = files("models/hostile/*")
    made = [n for n in files("made/*") if n not in points and n != "made/plate.obj"]
    meshes = [n for n in files("models/*/*") if n not in clouds + hostile]
    of_one = {"all": meshes + made + data, "small": small(meshes, 300_000) + made + data,
              "few": FEW, "one": FEW[:1], "made": made, "hostile": hostile,
              "clouds": clouds + points, "points": points + small(clouds, 50_000),
              "scenes": files("models/scene/*", "models/coplanar/*.obj")}
    found = {group: [(n.removeprefix("models/"), {"f": n}) for n in names]
             for group, names in of_one.items()}
    found["pairs"] = [(name, {"a": "models/" + row["file_a"], "b": "models/" + row["file_b"],
                              "m": f"made/{name}.txt"}) for name, row in pair_rows(root).items()]
    found["triples"] = [(name, dict(zip("abc", words.split()))) for name, words in TRIPLES.items()]
    return found


def commands_of(text, tool, names):
    commands = []
    for part in text.split(" ; "):
        words = [word.format_map(names) for word in part.split()]
        commands.append(tuple(words if words[0] in TABLES else [tool, *words]))
    return tuple(commands)


def all_cases(root):
    of_group, cases = groups(root), []
    for tool, table in TABLES.items():
        for line in table.strip().splitlines():
            label, group, text = line.split(None, 2)
            cases += [Case(f"{tool[3:]}/{label}/{name}", commands_of(text, tool, names))
                      for name, names in of_group[group]]
    for text in USAGE.strip().replace("\n", " | ").split(" | "):
        name = re.sub(r"[ /|<>]+", "_", text)
        cases.append(Case(f"usage/{name}", commands_of(text, "", {})))
    doubled = [n for n, count in collections.Counter(c.name for c in cases).items() if count > 1]
    assert not doubled, doubled
    return [c for c in cases if not any(fnmatch.fnmatch(c.name, pattern) for pattern in SLOW)]


# ---- models that are made ----

def box(low, high):
    """Points and quads, outward."""
    points = [tuple((low, high)[i >> k & 1][k] for k in range(3)) for i in range(8)]
    return points, [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2),
                    (1, 3, 7, 5)]


def obj_text(*meshes):
    lines, first = [], 1
    for number, (points, faces) in enumerate(meshes):
        lines.append(f"o part{number}")
        lines += ["v %r %r %r" % tuple(map(float, p)) for p in points]
        lines += ["f " + " ".join(str(first + c) for c in face) for face in faces]
        first += len(points)
    return "\n".join(lines) + "\n"


def painted_obj(meshes):
    """With normals, texture coordinates, groups and materials of the corners and faces."""
    head = ["mtllib paint.mtl"]
    head += ["vt %r %r" % uv for uv in ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0))]
    head += ["vn 0 0 -1", "vn 0 0 1", "vn 0 -1 0", "vn 0 1 0", "vn -1 0 0", "vn 1 0 0"]
    lines = []
    for line in obj_text(*meshes).splitlines():
        words = line.split()
        if words[0] == "f":
            side = sum(other.startswith("f ") for other in lines) % 6
            lines += [f"g side{side}", f"usemtl {'red' if side % 2 else 'wood'}"]
            line = "f " + " ".join(f"{c}/{i + 1}/{side + 1}" for i, c in enumerate(words[1:]))
        lines.append(line)
    return "\n".join(head + lines) + "\n"


def ply_text(columns, rows, face_columns=(), faces=(), comments=()):
    lines = ["ply", "format ascii 1.0", *(f"comment {c}" for c in comments),
             f"element vertex {len(rows)}", *(f"property {c}" for c in columns)]
    if faces:
        lines += [f"element face {len(faces)}", "property list uchar int vertex_indices",
                  *(f"property {c}" for c in face_columns)]
    lines.append("end_header")
    lines += [" ".join(map(str, row)) for row in [*rows, *faces]]
    return "\n".join(lines) + "\n"


XYZ = ["double x", "double y", "double z"]


def seams_ply():
    """Two boxes with colours, a weight, and of the faces a number and texture coordinates."""
    rows, faces = [], []
    for points, quads in (box((0, 0, 0), (1.5, 1, 1)), box((1, 0.5, 0.25), (2, 2, 2))):
        for quad in quads:
            uv = [x for i in range(4) for x in (i & 1, i >> 1)]
            faces.append((4, *range(len(rows), len(rows) + 4), len(faces), 8, *uv, len(faces) % 2))
            rows += [(*points[c], 40 * c, 255 - 20 * len(faces), 7, c / 8) for c in quad]
    colours = ["uchar red", "uchar green", "uchar blue", "float weight"]
    return ply_text(XYZ + colours, rows, ["int number", "list uchar float texcoord",
                                          "int texnumber"], faces,
                    ["TextureFile a.png", "TextureFile b.png", "made by hand"])


def point_rows():
    """x y z nx ny nz range classification, some points near others or equal to them."""
    rng, rows = random.Random(5), []
    for i in range(3000):
        if i % 3 == 2:
            p = [x + rng.choice((0, 0.01, 0.1)) * rng.random() for x in rng.choice(rows)[:3]]
        else:
            p = [8 * rng.random(), 4 * rng.random(), 2 * rng.random()]
        rows.append((*p, *(rng.randrange(-4, 5) / 4 for _ in range(3)), rng.randrange(100), i % 4))
    return rows


def make_models(root):
    """Writes what commands call made/..."""
    bar, block = box((-0.25, 0, 0), (3, 0.5, 0.5)), box((0, 0, 0), (1, 1, 1))
    scaled = lambda mesh, s, d=0.0: ([tuple(d + s * x for x in p) for p in mesh[0]], mesh[1])
    rows = point_rows()
    names = ["nx", "ny", "nz", "range", "classification"]
    texts = {
        "box.obj": obj_text(box((0.1, 0.2, 0.3), (1.1, 1.2, 1.7))),
        "plate.obj": obj_text(*(box((x, y, -2), (x + 9, y + 9, -1)) for x in (-20, -10, 0, 10)
                                for y in (-20, -10, 0, 10))),
        "open.obj": obj_text((block[0], block[1][1:])),
        "inside_out.obj": obj_text((block[0], [face[::-1] for face in block[1]])),
        "nested.obj": obj_text(block, scaled(block, 0.5, 0.25)),
        "far.obj": obj_text(scaled(block, 3, 1e8), scaled(bar, 0.7, 1e8 + 1.1)),
        "tiny.obj": obj_text(scaled(block, 1e-310), scaled(bar, 7e-311)),
        "huge.obj": obj_text(scaled(block, 1e300), scaled(bar, 7e299)),
        "coloured.obj": "".join(f"{line} 0.5 {i % 2} 0.25\n" if line[0] == "v" else line + "\n"
                                for i, line in enumerate(obj_text(bar, block).splitlines())),
        "paint.obj": painted_obj([bar, block]),
        "paint.mtl": "newmtl red\nKd 1 0 0\nnewmtl wood\nKd 0.5 0.4 0.1\nmap_Kd wood.png\n",
        "seams.ply": seams_ply(),
        "points.ply": ply_text(XYZ + ["float " + n for n in names[:4]] + ["uchar " + names[4]],
                               rows),
        "points_single.ply": ply_text([c.replace("double", "float") for c in XYZ],
                                      [tuple(round(64 * x) / 64 for x in r[:3]) for r in rows]),
        "points.csv": "\n".join([",".join(["x", "y", "z"] + names),
                                 *(",".join(map(str, r)) for r in rows)]) + "\n",
        "turn.txt": "0.96 -0.28 0 0.05\n0.28 0.96 0 -0.02\n0 0 1 0.03\n0 0 0 1\n",
        "up.txt": "1 0 0 0\n0 1 0 0\n0 0 1 400\n0 0 0 1\n",
        "flat.txt": "1 0 0 0\n0 1 0 0\n0 0 0 0\n0 0 0 1\n"}
    for name, row in pair_rows(root).items():
        texts[f"{name}.txt"] = row["matrix_b"] + "\n"
    (root / "made").mkdir()
    for name, text in texts.items():
        (root / "made" / name).write_text(text)


def collect_models(root, models):
    """Copies the models: an OBJ names its materials relative to where it really is."""
    shutil.copytree(models, root / "models")
    (root / "data").mkdir()
    for path in DATA.iterdir():
        if path.suffix in (".stl", ".obj", ".ply", ".off"):
            shutil.copy(path, root / "data")
    make_models(root)


# ---- running ----

def digest(data):
    return hashlib.sha256(data).hexdigest()[:16]


def normal_report(text):
    """The report without what may differ between two runs."""
    try:
        report = json.loads(text, parse_float=str)
    except ValueError:
        return text
    return json.dumps({k: v for k, v in report.items() if k not in
                       ("seconds", "threads", "peak_rss", "command", "version")}, indent=1)


def run_case(case, tools, root, folder):
    """Runs the commands in `folder`, which then holds all they wrote; the statuses."""
    links = [folder / name for name in ("models", "made", "data")]
    for link in links:
        link.symlink_to(root / link.name)
    statuses, said = [], b""
    for number, (tool, *words) in enumerate(case.commands, 1):
        report = f"report{number}.json"
        stdin = next((w[1:] for w in words if w.startswith("<")), os.devnull)
        words = [w for w in words if not w.startswith("<")]
        if "-j" not in words:
            words += ["-j", "2"]
        if "-r" not in words and not case.name.startswith("usage/"):
            words += ["-r", report]
        try:
            with open(folder / stdin, "rb") as file:
                done = subprocess.run([tools[tool], *words], cwd=folder, stdin=file,
                                      capture_output=True, timeout=SECONDS)
        except subprocess.TimeoutExpired:
            statuses.append("timeout")
            break
        statuses.append(str(done.returncode))
        if "-r -" in " ".join(words):
            (folder / report).write_bytes(done.stdout)
        else:
            said += done.stdout
        said += b"\n-- stderr:\n" + done.stderr
    (folder / "console").write_bytes(said)
    for link in links:
        link.unlink()
    return "+".join(statuses)


def is_report(path):
    return path.suffix == ".json"


def hashes_of(folder):
    """Of the files, of the reports, of what was said."""
    files = sorted(p for p in folder.rglob("*") if p.is_file())
    reports = "".join(normal_report(p.read_text(errors="replace")) for p in files if is_report(p))
    outputs = [f"{p.relative_to(folder).as_posix()}={digest(p.read_bytes())}" for p in files
               if not is_report(p) and p != folder / "console"]
    return ";".join(outputs), digest(reports.encode()), digest((folder / "console").read_bytes())


def run_and_hash(case, tools, root, keep):
    start = time.monotonic()
    folder = root / "cases" / case.name
    folder.mkdir(parents=True)
    row = [case.name, run_case(case, tools, root, folder), *hashes_of(folder)]
    if keep:
        shutil.rmtree(keep / case.name, ignore_errors=True)
        shutil.copytree(folder, keep / case.name)
    shutil.rmtree(folder)
    return row, time.monotonic() - start


def find_tools(folder):
    tools = {}
    for name in TABLES:
        paths = [folder / name, folder / name / name]
        tools[name] = next((str(p.resolve()) for p in paths if p.is_file()), None)
        if tools[name] is None:
            sys.exit(f"{name}: neither {paths[0]} nor {paths[1]}")
    return tools


HEADING = ["case", "status", "outputs", "report", "console"]


def run_all(options):
    tools = find_tools(options.bin_dir)
    os.nice(5)
    for limit, value in ((resource.RLIMIT_AS, MEMORY), (resource.RLIMIT_CORE, 0)):
        resource.setrlimit(limit, (value, value))  # the tools inherit them
    with tempfile.TemporaryDirectory(prefix="output-hashes-") as scratch, \
            open(options.output, "w", newline="") as file, \
            concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        root = pathlib.Path(scratch).resolve()
        collect_models(root, options.models_dir)
        cases = [c for c in all_cases(root) if re.search(options.only, c.name)]
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(HEADING)
        start, counts, seconds = time.monotonic(), collections.Counter(), {}
        for row, took in pool.map(lambda c: run_and_hash(c, tools, root, options.keep), cases):
            writer.writerow(row)
            seconds[row[0]] = took
            counts[row[0].split("/")[0], row[1]] += 1
            if len(seconds) % 1000 == 0:
                print(f"{len(seconds)} of {len(cases)} cases", file=sys.stderr)
    print(f"{len(cases)} cases in {time.monotonic() - start:.0f} s")
    for (tool, status), count in sorted(counts.items()):
        print(f"  {tool}, status {status}: {count}")
    for name in sorted(seconds, key=seconds.get)[:-11:-1]:
        print(f"  {seconds[name]:.1f} s: {name}")


# ---- comparing ----

def read_hashes(path):
    with open(path, newline="") as file:
        return {row["case"]: row for row in csv.DictReader(file)}


def differences(old, new):
    """What differs between two rows of a case."""
    found = []
    if old["status"] != new["status"]:
        found.append(f"status {old['status']} -> {new['status']}")
    before, after = (dict(part.rsplit("=", 1) for part in row["outputs"].split(";") if part)
                     for row in (old, new))
    for name in sorted(before.keys() | after.keys()):
        if before.get(name) != after.get(name):
            found.append(name + (" only in old" if name not in after else
                                 " only in new" if name not in before else ""))
    return found + [key for key in ("report", "console") if old[key] != new[key]]


def compare(old_path, new_path):
    old, new = read_hashes(old_path), read_hashes(new_path)
    found = {name: "only in " + ("old" if name in old else "new")
             for name in old.keys() ^ new.keys()}
    for name in old.keys() & new.keys():
        if old[name] != new[name]:
            found[name] = ", ".join(differences(old[name], new[name]))
    for name in sorted(found):
        print(f"{name}: {found[name]}")
    print(f"{len(found)} of {len(old.keys() | new.keys())} cases differ")
    return 1 if found else 0


def flatten(value, path, into):
    """Adds the values of every key, with [] for places in lists; of a list, also its length."""
    if isinstance(value, dict):
        for key, inner in value.items():
            flatten(inner, f"{path}.{key}" if path else key, into)
    elif isinstance(value, list):
        into[path].append(f"{len(value)} elements")
        for inner in value:
            flatten(inner, path + "[]", into)
    else:
        into[path].append(value)


def values_of(path):
    into = collections.defaultdict(list)
    try:
        flatten(json.loads(normal_report(path.read_text(errors="replace"))), "", into)
    except ValueError:
        into["(no JSON)"].append(path.read_text(errors="replace"))
    return into


def example(old, new):
    if len(old) != len(new):
        return f"{len(old)} -> {len(new)} values"
    return next(f"{a!r} -> {b!r}" for a, b in zip(old, new) if a != b)


def diff_reports(old_folder, new_folder):
    names = [{p.relative_to(folder) for p in folder.rglob("*.json")}
             for folder in (old_folder, new_folder)]
    cases, first = collections.Counter(), {}

    def count(what, text):
        cases[what] += 1
        first.setdefault(what, text)

    for name in sorted(names[0] ^ names[1]):
        count(f"report only in {'old' if name in names[0] else 'new'}", str(name))
    for name in sorted(names[0] & names[1]):
        old, new = values_of(old_folder / name), values_of(new_folder / name)
        for key in sorted(old.keys() | new.keys()):
            if key not in new or key not in old:
                count(f"only in {'old' if key in old else 'new'}: {key}", str(name))
            elif old[key] != new[key]:
                count(f"differs: {key}", f"{name}: {example(old[key], new[key])}")
        if list(old) != list(new) and old == new:
            count("differs: order of keys", str(name))
    for what in sorted(cases):
        print(f"{what}  ({cases[what]} reports, such as {first[what]})")
    print(f"{len(names[0] & names[1])} reports compared")
    return 1 if cases else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("bin_dir", nargs="?", type=pathlib.Path, metavar="BIN_DIR")
    parser.add_argument("models_dir", nargs="?", type=pathlib.Path, metavar="MODELS_DIR")
    parser.add_argument("-o", dest="output", metavar="FILE", help="the hashes, as CSV")
    parser.add_argument("-j", dest="jobs", type=int, default=2, metavar="N", help="cases at a time")
    parser.add_argument("--only", default="", metavar="REGEX", help="cases with such a name")
    parser.add_argument("--keep", type=pathlib.Path, metavar="DIR", help="keeps what is written")
    parser.add_argument("--compare", nargs=2, metavar=("OLD.csv", "NEW.csv"))
    parser.add_argument("--diff-reports", nargs=2, type=pathlib.Path, metavar=("OLD", "NEW"))
    options = parser.parse_args()
    if options.compare:
        return compare(*options.compare)
    if options.diff_reports:
        return diff_reports(*options.diff_reports)
    if not (options.bin_dir and options.models_dir and options.output):
        parser.error("expected BIN_DIR, MODELS_DIR and -o")
    return run_all(options)


if __name__ == "__main__":
    sys.exit(main())
