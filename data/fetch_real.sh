#!/usr/bin/env bash
# Fetches real models from Debian packages into data/real, which git ignores. Nothing is installed:
# the packages are downloaded, checked by apt and unpacked. A second run finds them there.
# Exit status: 0 all models are there, 1 some are not (no network, no apt).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

# package, path in it, name here
models=(
    "glmark2-data usr/share/glmark2/models/bunny.obj bunny.obj"
    "openscad-testing-data usr/share/openscad/testdata/scad/misc/bad-stl-pcbvicebar.stl pcbvicebar.stl"
    "openscad-testing-data usr/share/openscad/testdata/scad/misc/bad-stl-tardis.stl tardis.stl"
    "openscad-testing-data usr/share/openscad/testdata/scad/misc/bad-stl-wing.stl wing.stl"
)

quick=(-o Acquire::Retries=0 -o Acquire::http::Timeout=20) # no network is no reason to wait

missing=()
for entry in "${models[@]}"; do
    read -r package _ name <<<"$entry"
    [[ -s real/$name || " ${missing[*]-} " == *" $package "* ]] || missing+=("$package")
done
((${#missing[@]})) || exit 0

mkdir -p real
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
chmod 755 "$scratch" # apt drops its privileges while it downloads

download() { (cd "$scratch" && apt-get download -qq "${quick[@]}" -o APT::Sandbox::User=root "$1"); }
for package in "${missing[@]}"; do
    if ! download "$package" 2>/dev/null; then
        # A bare system has no package lists yet; a user's own run cannot update them.
        ((EUID)) || apt-get update -qq "${quick[@]}" 2>/dev/null || true
        download "$package" || { echo "fetch_real.sh: cannot download $package" >&2; continue; }
    fi
    dpkg-deb -x "$scratch/$package"_*.deb "$scratch/root"
done

status=0
for entry in "${models[@]}"; do
    read -r _ path name <<<"$entry"
    [[ -s real/$name ]] && continue
    if [[ -s $scratch/root/$path ]]; then
        cp "$scratch/root/$path" "real/.$name" && mv "real/.$name" "real/$name"
    else
        status=1
    fi
done
exit $status
