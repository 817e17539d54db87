#!/bin/sh
# compare.sh GENERATOR FOLDER: writes the models into FOLDER and compares them with those here,
# byte for byte and name for name.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
rm -rf "$2"
"$1" "$2"
status=0
for model in "$2"/*; do
    cmp "$model" "$here/$(basename "$model")" || status=1
done
for model in "$here"/*.stl "$here"/*.obj "$here"/*.ply "$here"/*.off; do
    [ -f "$2/$(basename "$model")" ] || { echo "not written by the generator: $model"; status=1; }
done
exit $status
