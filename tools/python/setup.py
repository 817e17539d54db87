"""Builds the extension by CMake, from the tree around this folder or from the sources that a source
distribution carries in native/; puts the libraries that it needs beside it, where patchelf is there.

Options for CMake: the environment variable CMAKE_ARGS, such as -DTREEFORM_WITH_ASSIMP=OFF."""

import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext
from setuptools.command.sdist import sdist

HERE = pathlib.Path(__file__).resolve().parent
TREE = HERE.parents[1] if (HERE.parents[1] / "libmesh").is_dir() else HERE / "native"
CARRIED = ["CMakeLists.txt", "LICENSE", "libtree", "libmesh", "tools/bindings",
           "tools/page", "tools/picture", "tools/python/CMakeLists.txt",
           "tools/python/find_python.cmake", "tools/python/src", "tools/viewer/viewer.css",
           "tools/viewer/viewer.min.js"]
# What every system has that runs Python, as other wheels expect it, too.
OF_SYSTEM = re.compile(r"(linux-vdso|ld-linux.*|lib(c|m|dl|rt|pthread|util|stdc\+\+|gcc_s))\.so")


def version():
    text = (TREE / "libtree/include/treeform/tree/version.hpp").read_text()
    return ".".join(re.findall(r"^#define TREEFORM_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)$", text,
                               re.MULTILINE))


def needed_by(library):
    """Paths of the libraries that `library` loads, those of the system left out."""
    lines = subprocess.run(["ldd", str(library)], capture_output=True, text=True, check=True).stdout
    for name, path in re.findall(r"^\s*(\S+) => (/\S+)", lines, re.MULTILINE):
        if not OF_SYSTEM.match(name):
            yield name, pathlib.Path(path)


def bundle(extension):
    """Puts what `extension` needs into _libs/ beside it."""
    if not shutil.which("patchelf"):
        print("no patchelf: the libraries that the extension needs are not put beside it")
        return
    folder = extension.parent / "_libs"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    for name, path in needed_by(extension):
        copy = folder / name
        shutil.copy(path.resolve(), copy)
        copy.chmod(0o755)
        subprocess.run(["patchelf", "--set-rpath", "$ORIGIN", str(copy)], check=True)
    subprocess.run(["patchelf", "--set-rpath", "$ORIGIN/_libs", str(extension)], check=True)


class BuildByCMake(build_ext):
    def build_extension(self, extension):
        made = pathlib.Path(self.get_ext_fullpath(extension.name)).resolve()
        # Beside the builds of the tree, so that a compiler cache finds its objects.
        build = pathlib.Path(self.build_temp).resolve() if TREE.parent == HERE else \
            TREE / "build" / f"python-{sys.implementation.cache_tag}"
        build.mkdir(parents=True, exist_ok=True)
        generator = ["-G", "Ninja"] if shutil.which("ninja") else []
        subprocess.run(["cmake", "-S", str(TREE), "-B", str(build), *generator,
                        "-DCMAKE_BUILD_TYPE=Release", "-DTREEFORM_BUILD_TOOLS=OFF",
                        "-DTREEFORM_BUILD_C=OFF", "-DTREEFORM_INSTALL=OFF",
                        "-DTREEFORM_BUILD_PYTHON=ON",
                        f"-DTREEFORM_PYTHON={sys.executable}",
                        *shlex.split(os.environ.get("CMAKE_ARGS", ""))], check=True)
        jobs = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL") or str(os.cpu_count() or 1)
        subprocess.run(["cmake", "--build", str(build), "--target", "treeform_python",
                        "--parallel", jobs], check=True)
        made.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(build / "tools/python/treeform" / made.name, made)
        bundle(made)


class CarryTree(sdist):
    def make_release_tree(self, base_dir, files):
        super().make_release_tree(base_dir, files)
        for name in CARRIED:
            to = pathlib.Path(base_dir) / "native" / name
            to.parent.mkdir(parents=True, exist_ok=True)
            if (TREE / name).is_dir():
                shutil.copytree(TREE / name, to, dirs_exist_ok=True)
            else:
                shutil.copy(TREE / name, to)


setup(version=version(), ext_modules=[Extension("treeform._core", sources=[])],
      cmdclass={"build_ext": BuildByCMake, "sdist": CarryTree})
