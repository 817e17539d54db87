#!/usr/bin/env bash
# package.sh [BUILD]: makes a source distribution of the Python package and a wheel of it, without a
# package index; installs the wheel in a virtual environment, runs the tests there, with the tools of the
# folder BUILD beside it; and as root, where there is mmdebstrap, in a bare Debian that has python3 and
# NumPy alone. Says what is skipped, and why. Fails if something does.
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

(cd tools/python && "$python" -m build --sdist --no-isolation --outdir "$work" .) | tail -n 1
mkdir "$work/source"
tar -xzf "$work"/treeform-*.tar.gz -C "$work/source" --strip-components 1
(cd "$work/source" && "$python" -m build --wheel --no-isolation --outdir "$work" .) | tail -n 1

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
