"""Builds the extension with CMake, from the source tree that contains this folder, or from the copy
in native/ of a source distribution. With patchelf, the libraries that it needs are copied next to
it, with their licenses.

If the tree has been built in build/release (by tools/quickstart.sh or tests/run.sh), only the
extension is compiled. The environment variable CMAKE_ARGS has options for CMake, such as
-DTREEFORM_WITH_ASSIMP=OFF; with options, everything is compiled."""

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

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import build_needs
import licenses

HERE = pathlib.Path(__file__).resolve().parent
TREE = HERE.parents[1] if (HERE.parents[1] / "libmesh").is_dir() else HERE / "native"
CARRIED = ["CMakeLists.txt", "LICENSE", "libtree", "libmesh", "tools/bindings", "tools/picture",
           "tools/python/CMakeLists.txt", "tools/python/find_python.cmake", "tools/python/src"]
# Libraries that every Linux system has, as other wheels assume.
OF_SYSTEM = re.compile(r"(linux-vdso|ld-linux.*|lib(c|m|dl|rt|pthread|util|stdc\+\+|gcc_s))\.so")
BYTES_A_JOB = 3 << 30  # memory of a compiler, at most
MINUTES_OF_ALL, MINUTES_OF_EXTENSION = 6, 1  # on one core, on a machine of 2023


def version():
    text = (TREE / "libtree/include/treeform/tree/version.hpp").read_text()
    return ".".join(re.findall(r"(?m)^#define TREEFORM_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)$", text))


# ---- the extension ----

def jobs():
    if given := os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL"):
        return int(given)
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    return max(1, min(len(os.sched_getaffinity(0)), memory // BYTES_A_JOB))


def announce(what, minutes):
    """Tells what is built, also on the terminal if pip hides the output."""
    cores = jobs()
    most = -(-minutes // cores)
    text = (f"treeform: building {what}: about {most} minute{'s'[:most > 1]} on {cores} "
            f"core{'s'[:cores > 1]}; pip install -v shows the progress")
    print(text, flush=True)
    if not os.isatty(1):
        try:
            pathlib.Path("/dev/tty").write_text(f"\n{text}\n")
        except OSError:  # there is no terminal
            pass


def cache_of(build):
    """The CMake variables of a build folder."""
    path = build / "CMakeCache.txt"
    text = path.read_text(errors="replace") if path.is_file() else ""
    return dict(re.findall(r"^(\w+):\w+=(.*)$", text, re.M))


def built_tree():
    """The build folder of the tree, if it has suitable libraries, or None."""
    build = TREE / "build/release"
    told = cache_of(build)
    asked_for = any(os.environ.get(name) for name in ("CMAKE_ARGS", "CXX", "CXXFLAGS", "LDFLAGS"))
    here = all(os.path.realpath(told.get(name, "/")) == str(folder) for name, folder in
               (("CMAKE_HOME_DIRECTORY", TREE), ("CMAKE_CACHEFILE_DIR", build)))
    fits = (here and told.get("CMAKE_BUILD_TYPE") == "Release" and not told.get("TREEFORM_SANITIZE")
            and not any(told.get(name, "").upper() in ("ON", "TRUE", "YES", "1")
                        for name in ("BUILD_SHARED_LIBS", "TREEFORM_PLAIN_THREADS")))
    made = all((build / f"lib{name}/libtreeform_{name}.a").is_file() for name in ("tree", "mesh"))
    return build if fits and made and not asked_for and os.access(build, os.W_OK) else None


def configure(build, *options):
    subprocess.run(["cmake", "-S", str(TREE), "-B", str(build), *options,
                    "-DTREEFORM_BUILD_PYTHON=ON", f"-DTREEFORM_PYTHON={sys.executable}"],
                   check=True)


def compile_extension(build):
    subprocess.run(["cmake", "--build", str(build), "--target", "treeform_python", "--parallel",
                    str(jobs())], check=True)


def build_in_tree(build):
    """Builds in a folder that others use as well, and restores its CMake variables."""
    cache = build / "CMakeCache.txt"
    before = cache.read_bytes()
    announce(f"the extension alone, with the libraries of {build}", MINUTES_OF_EXTENSION)
    try:
        # Forget what was found for another Python.
        configure(build, "-U", "*Python*", "-U", "pybind11*")
        compile_extension(build)
    finally:
        cache.write_bytes(before)
        subprocess.run(["cmake", str(build)], stdout=subprocess.DEVNULL, check=True)


def build_all(build):
    announce("treeform", MINUTES_OF_ALL)
    build.mkdir(parents=True, exist_ok=True)
    generator = ["-G", "Ninja"] if shutil.which("ninja") else []
    configure(build, *generator, "-DCMAKE_BUILD_TYPE=Release",
              "-DTREEFORM_BUILD_TOOLS=OFF", "-DTREEFORM_BUILD_C=OFF", "-DTREEFORM_INSTALL=OFF",
              *shlex.split(os.environ.get("CMAKE_ARGS", "")))
    compile_extension(build)


# ---- libraries and licenses ----

def needed_by(library):
    """Names and paths of the libraries that `library` loads, except those of the system."""
    lines = subprocess.run(["ldd", str(library)], capture_output=True, text=True, check=True).stdout
    for name, path in re.findall(r"^\s*(\S+) => (/\S+)", lines, re.M):
        if not OF_SYSTEM.match(name):
            yield name, pathlib.Path(path)


def bundle(extension):
    """Copies the libraries that `extension` needs into _libs/ next to it."""
    if not shutil.which("patchelf"):
        print("patchelf not found: the libraries of the extension are not copied next to it")
        return
    folder = extension.parent / "_libs"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    needed = dict(needed_by(extension))
    for name, path in needed.items():
        copy = folder / name
        shutil.copy(path.resolve(), copy)
        copy.chmod(0o755)
        subprocess.run(["patchelf", "--set-rpath", "$ORIGIN", str(copy)], check=True)
    subprocess.run(["patchelf", "--set-rpath", "$ORIGIN/_libs", str(extension)], check=True)
    licenses.collect(needed, folder / "licenses")


class BuildByCMake(build_ext):
    def build_extension(self, extension):
        made = pathlib.Path(self.get_ext_fullpath(extension.name)).resolve()
        if build := built_tree():
            build_in_tree(build)
        else:
            # Next to the other builds of the tree, so that a compiler cache finds the objects.
            build = pathlib.Path(self.build_temp).resolve() if TREE.parent == HERE else \
                TREE / "build" / f"python-{sys.implementation.cache_tag}"
            build_all(build)
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


if not {"sdist", "egg_info"} & set(sys.argv):
    build_needs.check(HERE)
if TREE.parent != HERE:  # setuptools expects it here
    shutil.copy(TREE / "LICENSE", HERE / "LICENSE")
setup(version=version(), ext_modules=[Extension("treeform._core", sources=[])],
      cmdclass={"build_ext": BuildByCMake, "sdist": CarryTree})
