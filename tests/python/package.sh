#!/usr/bin/env bash
# package.sh [BUILD]: installs the Python package with the libraries of build/release, where they are
# there; makes a source distribution and a wheel of it, without a package index; installs the wheel in a
# virtual environment, runs the tests there, with the tools of the folder BUILD beside it; and as root,
# where there is mmdebstrap, in a bare Debian that has python3 and NumPy alone. Says what is skipped, and
# why, and how much of the processor it took. Fails if something does.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
python=${TREEFORM_PYTHON:-/usr/bin/python3}
for name in boolean place repair selfintersect weld; do
    tool=${1:+$1/tools/tf-$name/tf-$name}
    if [[ -x $tool ]]; then
        export "TF_${name^^}=$(realpath "$tool")"
    else
        echo "comparisons with tf-$name are skipped: ${tool:-no folder of a build is named}" \
            "${tool:+is not there}"
    fi
done
[[ -n ${TREEFORM_MODELS_DIR-} ]] || echo "real models are skipped: TREEFORM_MODELS_DIR is not set"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# taking NAME COMMAND...: runs it, and says the seconds of all cores that it took.
taking() {
    local name=$1 TIMEFORMAT="$1: %U s of the processor"
    shift
    { time "$@" >"$work/said" 2>&1; } 2>"$work/took" || { cat "$work/said"; echo "1 failed: $name"; exit 1; }
    tail -n 1 "$work/took"
}

# With what build/release holds, which stays as it was set up.
told=build/release/CMakeCache.txt
if [[ -f build/release/libmesh/libtreeform_mesh.a && -z ${CMAKE_ARGS-}${CXX-}${CXXFLAGS-} ]]; then
    before=$(sha256sum "$told")
    "$python" -m venv --system-site-packages "$work/fast"
    taking "pip install with the libraries of build/release" \
        "$work/fast/bin/pip" install -v --no-index --no-build-isolation ./tools/python
    grep -q "building the extension alone" "$work/said"
    [[ $(sha256sum "$told") == "$before" ]]
    (cd / && "$work/fast/bin/python" -c 'import treeform; assert "/fast/" in treeform.__file__')
    echo "1 passed: installed with the libraries of build/release"
else
    echo "1 skipped: no libraries in build/release"
fi

taking "source distribution" "$python" -m build --sdist --no-isolation --outdir "$work" tools/python
mkdir "$work/source"
tar -xzf "$work"/treeform-*.tar.gz -C "$work/source" --strip-components 1
cmp "$work/source/LICENSE" LICENSE
taking "wheel, with everything compiled" \
    "$python" -m build --wheel --no-isolation --outdir "$work" "$work/source"

# What is in the wheel has its license in it.
"$python" -m zipfile -e "$work"/treeform-*.whl "$work/unpacked"
find "$work/unpacked" -path '*.dist-info/*' -name LICENSE -exec cmp {} LICENSE \; -printf 'x' | grep -q x
libraries=0
for library in "$work"/unpacked/treeform/_libs/*.so*; do
    test -s "$work/unpacked/treeform/_libs/licenses/${library##*/}.txt"
    libraries=$((libraries + 1))
done
for name in eigen highway nlohmann-json pybind11 Apache-2.0; do
    test -s "$work/unpacked/treeform/_libs/licenses/$name.txt"
done
((libraries >= 5))
echo "1 passed: licenses of $libraries libraries"

# A Python that lacks what it takes is told what to do, in words.
mkdir "$work/lacks"
"$python" -m venv "$work/lacks/venv"
if "$work/lacks/venv/bin/pip" install --no-index --no-build-isolation ./tools/python \
    >"$work/said" 2>&1; then
    echo "1 failed: installed without pybind11"
    exit 1
fi
grep -q "lacks: .*pybind11" "$work/said"
grep -q -- "--system-site-packages" "$work/said"
if grep -q "Traceback" "$work/said"; then cat "$work/said"; exit 1; fi
echo "1 passed: what is missing is said"

"$python" -m venv --system-site-packages "$work/venv"
"$work/venv/bin/pip" install -q --no-index --no-deps "$work"/treeform-*.whl
"$work/venv/bin/python" -B -m pytest -q -rs -p no:cacheprovider tests/python

if ((EUID == 0)) && command -v mmdebstrap >/dev/null; then
    mmdebstrap --quiet --variant=minbase --include=python3-numpy bookworm "$work/root"
    "$work/venv/bin/python" -m zipfile -e "$work"/treeform-*.whl "$work/root/opt"
    cp data/two_spheres.stl "$work/root/opt"
    chroot "$work/root" env PYTHONPATH=/opt python3 -c '
import treeform
mesh = treeform.read("/opt/two_spheres.stl")
assert len(treeform.self_intersections(mesh)) == 78 and treeform.union(mesh).mesh.is_solid
assert treeform.plot(mesh).startswith(b"\x89PNG") and "iframe" in mesh.show()._repr_html_()
print("1 passed in a bare system")'
else
    echo "1 skipped: a bare system needs root and mmdebstrap"
fi
