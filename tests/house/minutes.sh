#!/usr/bin/env bash
# minutes.sh: what a newcomer does first, in a bare Debian and without a compiler cache: the quickstart,
# then in a second copy the tests, with an empty environment, and the Python package. Says what each
# takes, and whether it is within its share of the first quickstart of all (which took as long as 71
# times the yardstick of steps.py). As root; needs mmdebstrap.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.." || exit 1
work=$(mktemp -d)
root=$work/root
trap 'rm -rf --one-file-system "$work"' EXIT
mmdebstrap --quiet --variant=minbase --include=git bookworm "$root" || exit 1
for copy in first second third; do git clone -q . "$root/$copy"; done

mapfile -t reach < <(env | grep -i '^https\?_proxy=' || true)
# in_root COMMAND: sets status, cpu and wall, in seconds. What it says is kept. What is mounted goes
# with the command, and nothing of this system is: devices are those that mmdebstrap makes.
in_root() {
    local times
    # shellcheck disable=SC2016 # expanded inside
    unshare --mount sh -c 'mount -t proc proc "$0/proc" && exec chroot "$0" "$@"' "$root" \
        env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin CCACHE_DISABLE=1 "${reach[@]}" \
        bash -c 'TIMEFORMAT="%U %S %R"; { time eval "$1" >/said 2>&1; } 2>/times' - "$1"
    status=$?
    times=$(cat "$root/times")
    read -r cpu wall < <(awk '{ printf "%.0f %.0f\n", $1 + $2, $3 }' <<<"$times")
    tail -n 3 "$root/said"
}

unit=$(python3 -B tests/house/steps.py yardstick)
# within NAME SHARE [STATUS]: of the first quickstart.
within() {
    local most
    most=$(awk -v unit="$unit" -v share="$2" 'BEGIN { printf "%.0f", 71 * unit * share }')
    if ((status == ${3:-0} && cpu <= most)); then
        echo "1 passed: $1: $cpu s of CPU, $wall s; at most $most of CPU"
    else
        echo "1 failed: $1: status $status, $cpu s of CPU, $wall s; at most $most of CPU"
        ((status == ${3:-0})) || tail -n 40 "$root/said"
    fi
}

in_root "cd /first && tools/quickstart.sh"
within quickstart 0.75
in_root "cd /first && cmake --install build/release --prefix /installed && /installed/bin/tf-weld --version"
within "installing what it has built" 0.1
in_root "cd /second && tests/run.sh"
within "tests/run.sh" 3.5
in_root "apt-get install -y --no-install-recommends patchelf python3-dev python3-venv \
    python3-setuptools python3-wheel python3-pybind11 python3-numpy"
in_root "cd /second && python3 -m venv --system-site-packages /venv && /venv/bin/pip install --no-index --no-build-isolation ./tools/python"
within "pip install, with build/release" 0.1
in_root "cd /third && /venv/bin/pip install --no-index --no-build-isolation --force-reinstall --no-deps ./tools/python"
within "pip install" 0.7
