#!/usr/bin/env bash
# translate.sh [MODEL...]: takes models through every format that tf-weld writes, and back, and says
# what differs without a word of the tools; and which of them treeform, assimp and MeshLab read.
# Without models: all that Debian's openscad-testing-data, assimp-testmodels and libcgal-demo have,
# and TREEFORM_MODELS_DIR.
#
# Installs these and the programs. Needs the release build; takes half an hour. Writes
# build/clients/table.csv and refused.txt; the status is 1 if something was lost without a word.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

if [[ ${1-} == -h ]]; then
    sed -n '2,/^set /{/^#/s/^# \{0,1\}//p}' tests/clients/translate.sh
    exit 0
fi
tools/install_packages.sh openscad-testing-data assimp-testmodels libcgal-demo assimp-utils meshlab \
    xvfb xauth libgl1-mesa-dri python3 python3-numpy
folder=build/clients
mkdir -p "$folder/cgal"
models=("$@")
if ((${#models[@]} == 0)); then
    tar -xzf /usr/share/doc/libcgal-dev/data.tar.gz -C "$folder/cgal"
    read_by_assimp=$(assimp listext | tail -n 1 | tr -d '*.' | tr ';' '|')
    mapfile -t models < <({
        dpkg -L openscad-testing-data assimp-testmodels
        find "$folder/cgal" ${TREEFORM_MODELS_DIR:+"$TREEFORM_MODELS_DIR"} -type f
    } | grep -iE "\.(pcd|las|laz|xyz|pts|$read_by_assimp)$" | sort)
fi
for model in "${models[@]}"; do
    [[ -f $model ]] && echo "$model"
done >"$folder/models.txt"
# Debian's own Python has Debian's NumPy.
xvfb-run -a /usr/bin/python3 -B tests/clients/translate.py build/release/tools "$folder" \
    "$folder/models.txt"
