#!/usr/bin/env bash
# bundle.sh [FILE]: makes viewer.min.js, the script of pages, of the modules beside it. FILE is
# where to, if not there. Needs esbuild (apt-get install esbuild). Run it when a module changes:
# tests/viewer compares.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
esbuild viewer.js --bundle --format=iife --minify --target=es2022 --log-level=warning \
    --banner:js='/* The viewer of treeform pages, Apache-2.0: tools/picture/viewer, put together by esbuild. */' \
    --outfile="${1:-viewer.min.js}"
