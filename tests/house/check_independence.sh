#!/usr/bin/env bash
# check_independence.sh SOURCE WORK CXX [CONFIGURE OPTION...]: the libraries and tools need neither
# CGAL nor GMP nor MPFR.
#
# They are configured with these packages out of CMake's sight and built. A compiler that opened
# none of their headers, and a linker that took none of their libraries, would have done the same
# with the packages absent: both lists are read from what the compiler and linker wrote down.
set -euo pipefail
source=$1 work=$2 cxx=$3

hidden=()
for package in CGAL GMP GMPXX MPFR doctest benchmark; do
    hidden+=("-DCMAKE_DISABLE_FIND_PACKAGE_$package=ON")
done
cmake -S "$source" -B "$work" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER="$cxx" \
    -DBUILD_SHARED_LIBS=ON "${hidden[@]}" "${@:4}" >/dev/null
cmake --build "$work"

status=0
read_headers=$(ninja -C "$work" -t deps)
grep -q 'treeform/mesh/predicates.hpp' <<<"$read_headers" || {
    echo "the list of headers read is not what it should be"
    exit 1
}
if grep -E '/(CGAL|boost/multiprecision)/|/(gmp|gmpxx|mpfr)[^/]*\.h$' <<<"$read_headers"; then
    echo "^ headers that libraries and tools must not read"
    status=1
fi

binaries=0
while read -r binary; do
    binaries=$((binaries + 1))
    if ldd "$binary" | grep -E 'lib(CGAL|gmp|gmpxx|mpfr)\b'; then
        echo "^ loaded by $binary"
        status=1
    fi
done < <(find "$work" -type f \( -name 'libtreeform_*.so.*' -o -path '*/tools/*' -perm -u+x \
    -name 'tf-*' \))
((binaries >= 3)) || {
    echo "two libraries and a tool were to be looked at, found $binaries"
    status=1
}
exit $status
