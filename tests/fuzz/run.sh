#!/usr/bin/env bash
# run.sh [-s SECONDS | -n RUNS] [TARGET...]: fuzzes for longer, one target after the other (all when
# none is named, such as read_obj or boolean), and prints a line for each: how often it ran, how
# often a second, how many inputs it keeps, and whether it came through.
#
# Builds what it needs in build/fuzz with clang and sanitizers. Starts from tests/fuzz/seeds.cpp,
# data/ and, with TREEFORM_MODELS_DIR, the models up to 64 kB; what a run finds is kept in
# build/fuzz/tests/fuzz/seeds/new and begins the next one. An input that fails is written to
# build/fuzz/failed-TARGET-*; run the target with it to see it again.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

limit=-max_total_time=600
while getopts "s:n:h" option; do
    case $option in
        s) limit=-max_total_time=$OPTARG ;;
        n) limit=-runs=$OPTARG ;;
        *)
            sed -n '2,/^set /{/^#/s/^# \{0,1\}//p}' tests/fuzz/run.sh
            exit $([[ $option == h ]] && echo 0 || echo 2)
            ;;
    esac
done
shift $((OPTIND - 1))
targets=("$@")
((${#targets[@]})) || targets=(
    read_stl read_obj read_ply read_off read_pcd read_las read_xyz read_csv read_glb read_3mf
    read_urdf read_blocks predicates implicit_points triangle_triangle self_intersections boolean cut
    repair weld
    tool_selfintersect tool_weld tool_boolean tool_place tool_repair)

build=build/fuzz
[[ -f $build/build.ninja ]] || cmake --preset fuzz >/dev/null
cmake --build "$build" -- fuzz_seeds "${targets[@]/#/fuzz_}" >/dev/null
seeds=$build/tests/fuzz/seeds
"$build/tests/fuzz/fuzz_seeds" "$seeds"

# A tool that crashes in a process of its own, too, ends as by nothing else.
export ASAN_OPTIONS=abort_on_error=1 UBSAN_OPTIONS=abort_on_error=1

failed=0
printf '%-20s %12s %9s %8s  %s\n' target runs runs/s inputs outcome
for target in "${targets[@]}"; do
    formats=()
    [[ $target == read_* ]] && formats=("${target#read_}")
    [[ $target == read_blocks ]] && formats=(ply pcd)
    [[ $target == tool_* ]] && formats=(stl obj ply off pcd las laz xyz csv glb 3mf)
    more=()
    for format in "${formats[@]}"; do
        files=$seeds/files-$format
        mkdir -p "$files"
        find data ${TREEFORM_MODELS_DIR:+"$TREEFORM_MODELS_DIR"} \
            ${TREEFORM_CLOUDS_DIR:+"$TREEFORM_CLOUDS_DIR"} -type f -size -64k \
            -iname "*.$format" -exec cp -t "$files" {} +
        more+=("$files")
        [[ $target == read_blocks ]] && formats=(ply pcd)
    [[ $target == tool_* ]] && more+=("$seeds/read_$format")
    done
    mkdir -p "$seeds/$target" "$seeds/new/$target"
    log=$build/fuzz-$target.log
    outcome=passed
    "$build/tests/fuzz/fuzz_$target" "$limit" -max_len=65536 -rss_limit_mb=4096 -timeout=60 \
        -print_final_stats=1 -artifact_prefix="$build/failed-$target-" \
        "$seeds/new/$target" "$seeds/$target" "${more[@]}" >"$log" 2>&1 || {
        outcome="FAILED, see $log"
        failed=1
    }
    stat() { sed -n "s/^stat::$1: *//p" "$log"; }
    printf '%-20s %12s %9s %8s  %s\n' "$target" "$(stat number_of_executed_units)" \
        "$(stat average_exec_per_sec)" "$(find "$seeds/new/$target" -type f | wc -l)" "$outcome"
done
exit "$failed"
