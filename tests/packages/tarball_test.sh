#!/usr/bin/env bash
# tarball_test.sh [FOLDER [BUILD]]: the tarball of static tools in FOLDER, by default build/packages, in a
# root that is empty but for it and models, in the oldest Debian that is to be had, as by an old kernel,
# and on a CPU with nothing but what every x86-64 has; what is written is compared with what the tools
# of the folder BUILD write, by default build/deb, if they are there. As root.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
packages=$(realpath "${1:-build/packages}")
build=$(realpath -m "${2:-build/deb}")
source tests/packages/support.sh
if ((EUID != 0)); then
    skip "static tools in an empty root" "needs root"
    count_up "static tools"
    exit
fi
tarball=$(echo "$packages"/treeform-*-x86_64-linux.tar.gz)
folder=$(basename "$tarball" .tar.gz)
tools=(tf-boolean tf-cut tf-place tf-repair tf-selfintersect tf-weld)

# What is done everywhere: a job or two for each tool, many formats written and read, a picture, a page;
# in the folder that is the current one, which has data/ and cloud.xyz.
outputs=(pairs.csv picture.png page.html solid.3mf mended.obj cut.ply thin.ply cloud.laz high.3mf)
jobs=$work/jobs
cat >"$jobs" <<'JOBS'
1 tf-selfintersect data/two_spheres.stl --pairs pairs.csv --png picture.png --html page.html
0 tf-selfintersect --repair data/two_spheres.stl -o solid.3mf
0 tf-repair data/dirty.stl -o mended.obj
0 tf-boolean difference solid.3mf data/cube.stl -o cut.ply
0 tf-weld data/sphere.ply -t 0.15 -o thin.ply
0 tf-weld cloud.xyz -t 0.5 -o cloud.laz
0 tf-place drop cut.ply --bed 5 -o high.3mf
JOBS
awk 'BEGIN { for (i = 0; i < 20000; i++) print (i * 7919) % 1009 / 8, (i * 104729) % 997 / 8, i % 13 }' \
    >"$work/cloud.xyz"

lay_models() { # FOLDER
    mkdir -p "$1/data"
    cp data/{two_spheres,dirty,cube}.stl data/sphere.ply "$1/data"
    cp "$work/cloud.xyz" "$1"
}
in_folder() { # FOLDER COMMAND...
    (cd "$1" && "${@:2}")
}
# run_jobs NAME FOLDER BIN COMMAND...: runs the jobs by the tools of BIN, each after COMMAND, which sees to
# it that FOLDER is the current one.
run_jobs() {
    local name=$1 folder=$2 bin=$3 status tool arguments output
    shift 3
    lay_models "$folder"
    while read -r status tool arguments; do
        # shellcheck disable=SC2086 # the arguments are words
        check "$name: $tool $arguments" ends_with "$status" "$@" "$bin/$tool" -q $arguments
    done <"$jobs"
    for output in "${outputs[@]}"; do
        check "$name: $output is written" test -s "$folder/$output"
        # A page names the command.
        [[ $output == page.html || ! -d $work/reference ]] ||
            check "$name: $output is the same" cmp "$folder/$output" "$work/reference/$output"
    done
}
ends_with() { # STATUS COMMAND...
    local status=0
    "${@:2}" || status=$?
    ((status == $1))
}

mkdir "$work/unpacked"
tar -xzf "$tarball" -C "$work/unpacked"
unpacked=$work/unpacked/$folder

# What the tools write that are linked as usual.
if [[ -x $build/tools/tf-weld/tf-weld ]]; then
    mkdir "$work/usual" "$work/reference.new"
    for tool in "${tools[@]}"; do ln -s "$build/tools/$tool/$tool" "$work/usual/$tool"; done
    run_jobs "linked as usual" "$work/reference.new" "$work/usual" in_folder "$work/reference.new"
    mv "$work/reference.new" "$work/reference"
else
    skip "the same bytes as of tools that are linked as usual" "none in $build"
fi

# The tarball itself.
listed=$(tar -tvzf "$tarball")
check "owned by nobody" sh -c "! echo '$listed' | grep -v ' 0/0 '"
for file in LICENSE README licenses share/man/man1/tf-weld.1 \
    share/bash-completion/completions/tf-weld share/zsh/site-functions/_tf-weld \
    share/fish/vendor_completions.d/tf-weld.fish; do
    check "$file is there" test -s "$unpacked/$file"
done
for tool in "${tools[@]}"; do
    check "$tool asks for no interpreter" sh -c "! readelf -lW '$unpacked/bin/$tool' | grep INTERP"
    check "$tool says what it is" grep -q "static build: plain threads, no assimp, no MPI" \
        <("$unpacked/bin/$tool" --version)
done

# A root with nothing else: no /dev, /proc, /tmp or /etc, no shell.
root=$work/empty
in_empty=(env -i "$(command -v chroot)" "$root")
mkdir "$root"
cp -r "$unpacked" "$root/treeform"
run_jobs "empty root" "$root" /treeform/bin "${in_empty[@]}"
for tool in "${tools[@]}"; do
    check "empty root: $tool --version" "${in_empty[@]}" "/treeform/bin/$tool" --version
    check "empty root: $tool --help" "${in_empty[@]}" "/treeform/bin/$tool" --help
done
for threads in 1 2 7; do
    check "empty root: $threads threads" "${in_empty[@]}" /treeform/bin/tf-boolean union \
        data/two_spheres.stl data/cube.stl -j "$threads" -f -o "threads_$threads.ply"
    check "empty root: $threads threads, the same" cmp "$root/threads_1.ply" "$root/threads_$threads.ply"
done

# The oldest that is to be had: Debian 9 is of 2017.
make_old() { # SUITE MIRROR
    mmdebstrap --quiet --variant=minbase --aptopt='Acquire::http::Timeout "10"' \
        --aptopt='Acquire::Retries "0"' --aptopt='Acquire::Check-Valid-Until "false"' \
        --keyring=/usr/share/keyrings/debian-archive-removed-keys.gpg \
        --keyring=/usr/share/keyrings/debian-archive-keyring.gpg \
        "$1" "$work/old" "$2" >"$work/mmdebstrap.log" 2>&1 && return
    rm -rf "$work/old"
    return 1
}
old=""
if command -v mmdebstrap >/dev/null; then
    mirror=${TREEFORM_DEBIAN_MIRROR:-http://deb.debian.org/debian}
    archive=${TREEFORM_DEBIAN_ARCHIVE:-http://archive.debian.org/debian}
    for where in "stretch $archive" "buster $archive" "buster $mirror" "bullseye $mirror"; do
        # shellcheck disable=SC2086 # two words
        if make_old $where; then
            old=${where%% *}
            break
        fi
        echo "no ${where%% *} from ${where#* }: $(grep -m 1 -E 'Err|404|Could not|E:' "$work/mmdebstrap.log")"
    done
fi
if [[ $old ]]; then
    cp -r "$unpacked" "$work/old/treeform"
    run_jobs "$old" "$work/old" /treeform/bin in_root "$work/old"
else
    skip "in an old Debian" "needs mmdebstrap and a mirror"
fi

# What came to Linux after 4.14, of 2017, is not there: every call that a library may try is refused.
newer=(io_pgetevents rseq pidfd_send_signal io_uring_setup io_uring_enter io_uring_register open_tree
    move_mount fsopen fsconfig fsmount fspick pidfd_open clone3 close_range openat2 pidfd_getfd
    faccessat2 process_madvise epoll_pwait2 mount_setattr landlock_create_ruleset memfd_secret
    process_mrelease)
if command -v strace >/dev/null && strace -o /dev/null -e inject=clone3:error=ENOSYS true; then
    refused=$(IFS=,; echo "${newer[*]}")
    mkdir "$work/kernel"
    run_jobs "Linux 4.14" "$work/kernel" "$unpacked/bin" in_folder "$work/kernel" \
        strace -f -qq -A -o "$work/refused" -e "trace=$refused" -e "inject=$refused:error=ENOSYS"
    check "Linux 4.14: refused is what newer kernels would do" grep -q ENOSYS "$work/refused"
else
    skip "Linux 4.14" "needs strace, and leave to trace"
fi

# The first x86-64 CPUs: SSE2, and of what came later SSE3 alone.
if command -v qemu-x86_64 >/dev/null; then
    mkdir "$work/cpu"
    run_jobs "x86-64 without AVX" "$work/cpu" "$unpacked/bin" in_folder "$work/cpu" \
        qemu-x86_64 -cpu qemu64
else
    skip "x86-64 without AVX" "needs qemu-user"
fi

# What is named by those who build alike.
check "no path of the machine" sh -c "! grep -l -r -F '$PWD' '$unpacked'"
count_up "static tools in an empty root, in Debian ${old:-(none)}, as by Linux 4.14, without AVX"
