# shellcheck shell=bash disable=SC2034 # what it sets is for others
# To be sourced: the Debian packages that it takes to build, and to pack.
to_build=(g++ cmake ninja-build pkg-config dpkg-dev
    libeigen3-dev libtbb-dev libhwy-dev libassimp-dev libcli11-dev nlohmann-json3-dev
    libpugixml-dev libminizip-dev libssl-dev zlib1g-dev)
for_debs=(python3-dev python3-pybind11 pybind11-dev python3-numpy libopenmpi-dev file lintian)
for_wheels=(python3-dev python3-pybind11 pybind11-dev python3-numpy python3-setuptools python3-wheel
    python3-build patchelf)
for_tests=(mmdebstrap strace qemu-user)
