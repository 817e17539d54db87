"""Checks that everything needed for building is installed, and otherwise says what to install."""

import importlib.util
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import sysconfig

CMAKE = (3, 25)
# Debian packages and their headers; Eigen is not in the default include path.
HEADERS = {"libtbb-dev": "<tbb/parallel_for.h>", "libhwy-dev": "<hwy/highway.h>",
           "libeigen3-dev": "<Eigen/Dense>) || __has_include(<eigen3/Eigen/Dense>",
           "libassimp-dev": "<assimp/Importer.hpp>", "nlohmann-json3-dev": "<nlohmann/json.hpp>",
           "libpugixml-dev": "<pugixml.hpp>", "libminizip-dev": "<minizip/unzip.h>",
           "zlib1g-dev": "<zlib.h>"}
# With one of these, headers may be elsewhere.
ELSEWHERE = ("CMAKE_ARGS", "CMAKE_PREFIX_PATH", "CONDA_PREFIX")


def compiler_and_headers():
    """Missing packages, as the preprocessor finds them."""
    named = shlex.split(os.environ.get("CXX", ""))
    compiler = named or [name for name in ("c++", "g++", "clang++") if shutil.which(name)][:1]
    if not compiler or not shutil.which(compiler[0]):
        return ["g++"]
    text = "#if __cplusplus < 202002L\ng++\n#endif\n"
    if not any(os.environ.get(name) for name in ELSEWHERE):
        text += "".join(f"#if !(__has_include({header}))\n{package}\n#endif\n"
                        for package, header in HEADERS.items())
    done = subprocess.run([*compiler, "-std=c++20", "-E", "-P", "-x", "c++", "-"], input=text,
                          capture_output=True, text=True)
    return done.stdout.split() if done.returncode == 0 else ["g++"]


def programs():
    missing = [] if shutil.which("ninja") or shutil.which("make") else ["ninja-build"]
    if not shutil.which("cmake"):
        return ["cmake", *missing]
    said = subprocess.run(["cmake", "--version"], capture_output=True, text=True).stdout
    numbers = re.search(r"(\d+)\.(\d+)", said)
    old = not numbers or tuple(map(int, numbers.groups())) < CMAKE
    return ["cmake (3.25 or later)"] * old + missing


def of_python():
    """Missing modules of this Python."""
    import setuptools
    modules = ["pybind11"]
    if int(setuptools.__version__.split(".")[0]) < 70:
        modules.append("wheel")
    lacks = [name for name in modules if importlib.util.find_spec(name) is None]
    if not (pathlib.Path(sysconfig.get_path("include")) / "Python.h").is_file():
        lacks.append("Python.h")
    # pip usually installs NumPy; if the others are missing, it may not.
    if lacks and importlib.util.find_spec("numpy") is None:
        lacks.append("numpy")
    return lacks


def check(folder):
    """Exits with a message if something is missing for building `folder`."""
    packages, lacks = [*programs(), *compiler_and_headers()], of_python()
    if not packages and not lacks:
        return
    of_debian = {"pybind11": "python3-pybind11", "wheel": "python3-wheel", "numpy": "python3-numpy",
                 "Python.h": "python3-dev"}
    said = ["treeform cannot be built yet."]
    if lacks:
        said.append(f"{sys.executable} lacks: {', '.join(lacks)}.")
    if packages:
        said.append(f"Not installed: {', '.join(packages)}.")
    of_other = {"python3-setuptools", "python3-venv"} if lacks else set()
    names = sorted({*packages, *(of_debian[name] for name in lacks)} | of_other)
    said += ["On Debian 12, as root:",
             f"    apt-get install {' '.join(n.split()[0] for n in names)}"]
    if lacks:
        said += ["Then, with Debian's Python, in a virtual environment:",
                 "    /usr/bin/python3 -m venv --system-site-packages venv",
                 f"    venv/bin/pip install --no-index --no-build-isolation {folder}",
                 "or for all users:",
                 "    /usr/bin/python3 -m pip install --break-system-packages --no-index "
                 f"--no-build-isolation {folder}",
                 "Another Python with access to a package index installs what it needs:",
                 f"    {sys.executable} -m pip install {folder}"]
    sys.exit("\n".join(said))
