#!/usr/bin/env bash
# run.sh [FOLDER]: tests the Blender add-on in Blender without a window, with the package treeform of
# FOLDER, that of the release build if none is named. Both lie where its README says. Fails if a test
# does; without Blender, or without that package, says so and ends with 77.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
package=$(realpath "${1:-build/release/tools/python}")/treeform
command -v blender >/dev/null || { echo "1 skipped: no blender"; exit 77; }
compgen -G "$package/_core.*.so" >/dev/null || { echo "1 skipped: no package in $package"; exit 77; }

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work/addons/modules"
ln -s "$package" "$work/addons/modules/"
cp tools/blender/treeform_blender.py "$work/addons/"
BLENDER_USER_SCRIPTS=$work PYTHONDONTWRITEBYTECODE=1 blender -b --factory-startup -noaudio \
    --python-exit-code 1 --python tests/blender/in_blender.py
