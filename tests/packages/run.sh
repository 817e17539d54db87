#!/usr/bin/env bash
# run.sh [COMMIT]: makes a release of COMMIT, by default of what is checked out, and uses all that is in
# it: Debian packages and static tools in bare roots, the recipes, the bill of materials; and makes Debian
# packages and tarball once more, elsewhere, which gives the same bytes. As root. Prints how many checks passed, failed
# and were skipped, and why.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.." || exit 1
source tools/packages/needs.sh
tools/install_packages.sh git python3 binutils unzip "${to_build[@]}" "${for_debs[@]}" \
    "${for_wheels[@]}" "${for_tests[@]}" || exit 1
status=0
commit=$(git rev-parse --verify "${1:-HEAD}^{commit}") || exit 2

python3 -B tests/packages/recipes_test.py || status=1

release=$PWD/build/release-test
rm -rf "$release"
if tools/packages/release.sh "$commit" "$release"; then
    echo "1 passed: a release is made of $commit"
else
    echo "1 failed: no release can be made of $commit"
    exit 1
fi
tests/packages/deb_test.sh "$release" || status=1

# Builds in this tree: what static tools are compared with, and the linker's word on what it has used.
if [[ $(git rev-parse HEAD) == "$commit" ]] && git diff --quiet HEAD; then
    rm -rf build/packages
    tools/packages/deb.sh build/packages >/dev/null || status=1
    tools/packages/tarball.sh build/packages || status=1
    for made in build/packages/*; do
        if cmp "$made" "$release/$(basename "$made")"; then
            echo "1 passed: made elsewhere, $(basename "$made") has the same bytes"
        else
            echo "1 failed: made elsewhere, $(basename "$made") has other bytes"
            status=1
        fi
    done
else
    echo "1 skipped: the working tree is not $commit, so that nothing is made again and compared"
fi
tests/packages/tarball_test.sh "$release" build/deb || status=1
python3 -B tests/packages/sbom_test.py "$release" build/static || status=1
exit $status
