#!/usr/bin/env bash
# make_pictures.sh TOOLS: makes the pictures in tools/pictures that README.md and tools/README.md
# show, by the commands that stand there, with the tools in the folder TOOLS (build/release/tools).
# cli_pictures says when they are no longer what the tools draw.
set -euo pipefail
tools=$(realpath "${1?make_pictures.sh: name the folder of the tools, build/release/tools}")
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
grep -hE '^    (\$ )?tf-.* --png [a-z_]+\.png --png-size ' README.md tools/README.md |
    while read -r line; do
        read -ra words <<<"${line#\$ }"
        tool=${words[0]} status=0
        for i in "${!words[@]}"; do
            [[ ${words[i]} != *.png ]] || words[i]=tools/pictures/${words[i]}
        done
        "$tools/$tool/$tool" "${words[@]:1}" -f || status=$?
        ((status < 2)) || { echo "$tool ended with status $status" >&2; exit 1; }
    done
