#!/usr/bin/env bash
# run.sh [MODEL...]: asks the programs that people print with (admesh, PrusaSlicer, OpenSCAD,
# MeshLab) whether they find anything to mend in what tf-repair writes, and puts what they make of
# the same models themselves beside it. Without models: every kind of dirt on a clean ball, data/
# and, with TREEFORM_MODELS_DIR, the real ones that have something wrong.
#
# Installs the programs, some 1 GB with what they need. Needs the release build. Writes
# build/clients/table.csv; the status is 1 if a program objects to something that tf-repair wrote.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

if [[ ${1-} == -h ]]; then
    sed -n '2,/^set /{/^#/s/^# \{0,1\}//p}' tests/clients/run.sh
    exit 0
fi
tools/install_packages.sh admesh prusa-slicer openscad meshlab xvfb xauth libgl1-mesa-dri python3
mkdir -p build/clients/dirt
models=("$@")
if ((${#models[@]} == 0)); then
    build/release/tests/clients/dirty_models data/sphere.ply build/clients/dirt
    models=(build/clients/dirt/*.stl data/*.stl data/*.obj data/*.ply data/*.off)
    for kind in selfint nonmanifold open degenerate duplicates; do
        [[ -d ${TREEFORM_MODELS_DIR-}/$kind ]] || continue
        for model in "$TREEFORM_MODELS_DIR/$kind"/*.{stl,obj,ply,off}; do
            [[ -f $model ]] && models+=("$model")
        done
    done
fi
python3 -B tests/clients/ask.py build/release/tools build/clients "${models[@]}"
