#!/usr/bin/env bash
# make_pictures.sh TOOLS: makes the pictures that README.md and tools/README.md show, with the tools
# in the folder TOOLS, build/release/tools. First those in tools/pictures, by the commands that stand
# there; cli_pictures says when they are no longer what the tools draw. Then
# data/pictures/self_intersections.png: the page that `tf-selfintersect --html` writes for
# data/two_spheres.stl, as a browser draws it. That needs chromium (apt-get install chromium). Run it
# again when the page changes.
set -euo pipefail
tools=$(realpath "${1?make_pictures.sh: name the folder of the tools, build/release/tools}")
tool=$tools/tf-selfintersect/tf-selfintersect
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
picture=data/pictures/self_intersections.png
mkdir -p data/pictures

grep -hE '^    (\$ )?tf-.* --png [a-z_]+\.png --png-size ' README.md tools/README.md |
    while read -r line; do
        read -ra words <<<"${line#\$ }"
        name=${words[0]} status=0
        for i in "${!words[@]}"; do
            [[ ${words[i]} != *.png ]] || words[i]=tools/pictures/${words[i]}
        done
        "$tools/$name/$name" "${words[@]:1}" -f || status=$?
        ((status < 2)) || { echo "$name ended with status $status" >&2; exit 1; }
    done

# 1: the tool has found something, which it should.
status=0
"$tool" data/two_spheres.stl --html "$work/page.html" || status=$?
((status == 1)) || { echo "tf-selfintersect ended with status $status, not 1" >&2; exit 1; }

# Software drawing: the same picture on machines without a graphics card. The virtual time lets the
# page unpack and draw its model before the picture is taken.
chromium --headless --no-sandbox --user-data-dir="$work/profile" --use-gl=angle \
    --use-angle=swiftshader --enable-unsafe-swiftshader --hide-scrollbars --window-size=1000,620 \
    --virtual-time-budget=8000 --screenshot="$work/picture.png" "file://$work/page.html" \
    2>"$work/chromium.log" || { cat "$work/chromium.log" >&2; exit 1; }

size=$(stat -c %s "$work/picture.png")
((size < 200000)) || { echo "the picture has $size bytes, more than 200000" >&2; exit 1; }
mv "$work/picture.png" "$picture"
echo "$picture: $size bytes"
