#!/usr/bin/env bash
# release.sh TAG_OR_COMMIT [OUT]: makes all that a release has of a commit of this repository, in the
# folder OUT, by default build/release-VERSION: sources, Debian packages, a tarball of static tools,
# the Python package as a wheel and as sources, a bill of materials (SPDX) and SHA256SUMS. Builds in a
# clean copy of that commit; nothing of the working tree is in it. Fails if a tag vN.N.N is not the version
# that the sources name. As root or with sudo where packages that it needs are not installed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
if (($# < 1 || $# > 2)); then
    sed -n '2,/^set/s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" | sed '$d' >&2
    exit 2
fi
commit=$(git rev-parse --verify --quiet "$1^{commit}") || { echo "no commit $1" >&2; exit 2; }
version=$(git show "$commit:libtree/include/treeform/tree/version.hpp" |
    sed -n 's/^#define TREEFORM_VERSION_\(MAJOR\|MINOR\|PATCH\) //p' | paste -sd.)
if [[ $1 =~ ^v[0-9] && $1 != "v$version" ]]; then
    echo "the tag $1 is of version $version" >&2
    exit 2
fi
out=$(realpath -m "${2:-build/release-$version}")
if [[ -d $out && -n $(ls -A "$out") ]]; then
    echo "$out is not empty" >&2
    exit 2
fi
mkdir -p "$out"
SOURCE_DATE_EPOCH=$(git log -1 --format=%ct "$commit")
export SOURCE_DATE_EPOCH

# What is built is what is published as sources.
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
name=treeform-$version
git archive --format=tar --prefix="$name/" "$commit" | gzip -9n >"$out/$name-source.tar.gz"
tar -xzf "$out/$name-source.tar.gz" -C "$work"
cd "$work/$name"

source tools/packages/needs.sh
tools/install_packages.sh "${to_build[@]}" "${for_debs[@]}" "${for_wheels[@]}"
tools/packages/deb.sh "$out"
tools/packages/tarball.sh "$out"
# Compiled as the rest is. With both asked for by name, the wheel is made of this tree, too, not of the
# sources that were packed, so that a compiler cache has what it needs.
source tools/packages/flags.sh
CMAKE_ARGS=$(printf '%q ' "${flags[@]}")
export CMAKE_ARGS
(cd tools/python && /usr/bin/python3 -m build --sdist --wheel --no-isolation --outdir "$out" . \
    >"$work/wheel.log" 2>&1) ||
    { cat "$work/wheel.log"; exit 1; }

cd "$out"
artifacts=(*)
"$work/$name/tools/packages/sbom.py" "$out/$name.spdx.json" --version "$version" --commit "$commit" \
    --static "$work/$name/build/static" --headers "$work/$name/build/deb" "${artifacts[@]}"
sha256sum -- * >"$work/SHA256SUMS"
mv "$work/SHA256SUMS" .
ls -l
