# shellcheck shell=bash
# To be sourced at the top of the tree: counts checks, and makes roots to make them in.
passed=0
failed=0
skipped=0
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# check NAME COMMAND...: the command succeeds. What it says is shown where it does not.
check() {
    local name=$1
    shift
    if "$@" >"$work/said" 2>&1; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAILED: $name: $*"
        sed 's/^/    /' "$work/said"
    fi
}

# skip NAME WHY: is said, and counted.
skip() {
    skipped=$((skipped + 1))
    echo "skipped: $1: $2"
}

# found COMMAND...: exit status 1, something was found.
found() {
    local status=0
    "$@" || status=$?
    ((status == 1))
}

# in_root ROOT COMMAND...: of the environment, only how the network is reached.
in_root() {
    local root=$1 reach
    shift
    mapfile -t reach < <(env | grep -i '^https\?_proxy=' || true)
    chroot "$root" env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LC_ALL=C.UTF-8 \
        DEBIAN_FRONTEND=noninteractive "${reach[@]}" "$@"
}

# count_up NAME: the closing lines; fails where something has.
count_up() {
    echo "$passed passed: $1"
    ((skipped == 0)) || echo "$skipped skipped"
    ((failed == 0)) || { echo "$failed failed"; return 1; }
}
