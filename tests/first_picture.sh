#!/usr/bin/env bash
# first_picture.sh: what README.md says under "From a bare Debian to a picture", in a bare Debian and
# with a model that is not of this project; then whether what was built can be installed. As root; needs
# mmdebstrap. Fails if there is no picture.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Of its first block.
mapfile -t commands < <(awk '/^## From a bare Debian to a picture/ { on = 1 }
    on && /^    / { print substr($0, 5); seen = 1 }
    seen && !/^    / { exit }' README.md)
if ((${#commands[@]} != 3)); then
    echo "1 failed: README.md has ${#commands[@]} commands"
    exit 1
fi
mmdebstrap --quiet --variant=minbase bookworm "$work/root"
mkdir "$work/root/treeform"
git ls-files -z | tar -c --null -T - | tar -x -C "$work/root/treeform"
# A tetrahedron that another one passes through.
cat >"$work/root/mine.obj" <<'MODEL'
v 0 0 0
v 4 0 0
v 0 4 0
v 0 0 4
v 1 1 -1
v 3 1 -1
v 1 3 -1
v 1 1 3
f 1 3 2
f 1 2 4
f 2 3 4
f 3 1 4
f 5 7 6
f 5 6 8
f 6 7 8
f 7 5 8
MODEL
{
    echo 'cd /treeform'
    printf '%s\n' "${commands[@]}" | sed 's!YOUR_MODEL.stl!/mine.obj!'
} >"$work/root/commands"
cat "$work/root/commands"
status=0
# Of the environment, only how the network is reached.
mapfile -t reach < <(env | grep -i '^https\?_proxy=' || true)
in_there() {
    chroot "$work/root" env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin "${reach[@]}" "$@"
}
in_there bash -c '. /commands' || status=$?
picture=$work/root/treeform/picture.png
# 1: something was found.
if ((status == 1)) && [[ $(head -c 4 "$picture" | tail -c 3) == PNG ]]; then
    echo "1 passed in a bare system"
else
    echo "1 failed: status $status"
    exit 1
fi
# shellcheck disable=SC2016 # expanded in there
if in_there bash -e -c 'cmake --install /treeform/build/release --prefix /there >/dev/null
    cd /there/share/man/man1
    for page in *; do "../../../bin/${page%.1*}" --version >/dev/null; done
    test -f tf-weld.1 && find /there/lib -name libtreeform_mesh.a | grep -q .'; then
    echo "1 passed: installed"
else
    echo "1 failed: what the first command builds cannot be installed"
    exit 1
fi
