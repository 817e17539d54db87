#!/usr/bin/env bash
# run.sh [--quick] [--out DIR] [ID ...]: measures treeform beside its peers.
#
# Sets itself up on a bare Debian 12 (as root or with sudo), builds Release with default flags in
# build/bench, runs the workloads named by id, or by its letter (all when none is), prints a table,
# and writes DIR/bench.csv, DIR/machine.txt and, with pictures, DIR/index.html (default:
# build/bench/results).
# P1, which is a program of its own, prints a table and writes DIR/span.csv.
# --quick ends within a few minutes, once built. Close other programs first.
#
# run.sh --write DIR [--size N] [FAMILY ...]: writes the families of meshes that are hard to decide
# about (all when none is named) as PLY files of 100 to N faces (default 1000, up to 1000000), each
# in several places and in float and double, for other programs to be tried on; DIR/index.csv lists
# them.
#
#   TREEFORM_MODELS_DIR=DIR    real models; without it the bunny of a Debian package serves for all
#   TREEFORM_BENCH_CACHE=DIR   for the larger models made of them (default: a folder of your own in
#                              TMPDIR; about 1.5 GB, may be removed at any time)
set -euo pipefail
here=$(pwd)
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

out=build/bench/results
families=
options=()
while (($#)); do
    case $1 in
        --out | --write)
            [[ $# -ge 2 ]] || { echo "run.sh: $1 needs a folder" >&2; exit 2; }
            folder=$2
            [[ $folder == /* ]] || folder=$here/$folder
            if [[ $1 == --out ]]; then out=$folder; else families=$folder; fi
            shift
            ;;
        --size)
            size=(--size "${2?run.sh: --size needs a number}")
            shift
            ;;
        -h | --help)
            sed -n '2,/^set /{/^#/s/^# \{0,1\}//p}' tests/bench/run.sh
            exit 0
            ;;
        *) options+=("$1") ;;
    esac
    shift
done

tools/install_packages.sh g++ cmake ninja-build doctest-dev libbenchmark-dev libcgal-dev \
    libgmp-dev libmpfr-dev libassimp-dev libeigen3-dev libtbb-dev libhwy-dev libcli11-dev nlohmann-json3-dev \
    libpugixml-dev libminizip-dev libssl-dev zlib1g-dev libfmt-dev libfcl-dev libnanoflann-dev

if command -v ccache >/dev/null; then
    export CMAKE_CXX_COMPILER_LAUNCHER=ccache
fi
cmake -G Ninja -S . -B build/bench -DCMAKE_BUILD_TYPE=Release -DTREEFORM_BUILD_BENCH=ON \
    -DTREEFORM_BUILD_TOOLS=ON >/dev/null
if [[ -n $families ]]; then
    cmake --build build/bench --target stress_files
    exec build/bench/tests/bench/stress_files ${size+"${size[@]}"} "$families" "${options[@]}"
fi
spans= others=
ids=()
for option in "${options[@]}"; do
    if [[ $option == P1 ]]; then spans=1; else ids+=("$option"); fi
    [[ $option == P1 || $option == -* ]] || others=1
done
[[ -z $spans ]] || cmake --build build/bench --target treeform_span
[[ -n $spans && -z $others ]] || cmake --build build/bench --target treeform_bench

models=${TREEFORM_MODELS_DIR-}
[[ -z $models || $models == /* ]] || models=$here/$models
[[ -n $models ]] || data/fetch_real.sh || echo "no real models (no network?)" >&2
read -r load _ </proc/loadavg
awk -v load="$load" 'BEGIN { exit load < 0.7 }' &&
    echo "load average $load: other programs run; figures, those of two threads above all, suffer" >&2
given=(${models:+--models "$models"}
    --cache "${TREEFORM_BENCH_CACHE:-${TMPDIR:-/tmp}/treeform-bench-$(id -u)}")
if [[ -n $spans ]]; then
    mkdir -p "$out"
    build/bench/tests/bench/span "${given[@]}" --out "$out/span.csv"
    [[ -n $others ]] || exit 0
fi
exec build/bench/tests/bench/bench "${given[@]}" --out "$out" "${ids[@]}"
