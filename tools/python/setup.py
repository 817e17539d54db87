"""Builds the extension by CMake, from the tree around this folder or from the sources that a source
distribution carries in native/; puts the libraries that it needs beside it, where patchelf is
there, with their licenses.

Where the tree has been built (build/release, by tools/quickstart.sh or tests/run.sh), only the
extension is compiled. Options for CMake: the environment variable CMAKE_ARGS, such as
-DTREEFORM_WITH_ASSIMP=OFF; with any, everything is compiled."""

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
# What every system has that runs Python, as other wheels expect it, too.
OF_SYSTEM = re.compile(r"(linux-vdso|ld-linux.*|lib(c|m|dl|rt|pthread|util|stdc\+\+|gcc_s))\.so")
# What a compiler of a room of the library takes, at most.
BYTES_A_JOB = 3 << 30
# On one core, of a machine of 2023.
MINUTES_OF_ALL, MINUTES_OF_EXTENSION = 6, 1


def version():
    text = (TREE / "libtree/include/treeform/tree/version.hpp").read_text()
    return ".".join(re.findall(r"^#define TREEFORM_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)$", text,
                               re.MULTILINE))


# ---- the extension ----

def jobs():
    if given := os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL"):
        return int(given)
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    return max(1, min(len(os.sched_getaffinity(0)), memory // BYTES_A_JOB))


def say(text):
    """To the terminal, too, where pip keeps what is printed to itself."""
    print(text, flush=True)
    if not os.isatty(1):
        try:
            with open("/dev/tty", "w") as terminal:
                terminal.write(f"\n{text}\n")
        except OSError:  # there is none
            pass


def say_how_long(what, minutes):
    cores = jobs()
    most = -(-minutes // cores)
    say(f"treeform: building {what}: some {most} minute{'s'[:most > 1]} on {cores} "
        f"core{'s'[:cores > 1]}; pip install -v shows the progress")


def cache_of(build):
    """What CMake was told of a folder, by name."""
    path = build / "CMakeCache.txt"
    text = path.read_text(errors="replace") if path.is_file() else ""
    return dict(re.findall(r"^(\w+):\w+=(.*)$", text, re.MULTILINE))


def is_on(value):
    return value.upper() in ("ON", "TRUE", "YES", "1")


def built_tree():
    """The folder of the tree where the libraries are, as they are wanted here; None if there is
    none."""
    build = TREE / "build/release"
    told = cache_of(build)
    asked_for = any(os.environ.get(name) for name in ("CMAKE_ARGS", "CXX", "CXXFLAGS", "LDFLAGS"))
    here = all(os.path.realpath(told.get(name, "/")) == str(folder) for name, folder in
               (("CMAKE_HOME_DIRECTORY", TREE), ("CMAKE_CACHEFILE_DIR", build)))
    fits = (here and told.get("CMAKE_BUILD_TYPE") == "Release" and not told.get("TREEFORM_SANITIZE")
            and not any(is_on(told.get(name, "")) for name in
                        ("BUILD_SHARED_LIBS", "TREEFORM_PLAIN_THREADS")))
    made = all((build / name).is_file() for name in
               ("libtree/libtreeform_tree.a", "libmesh/libtreeform_mesh.a"))
    return build if fits and made and not asked_for and os.access(build, os.W_OK) else None


def configure(build, *options):
    subprocess.run(["cmake", "-S", str(TREE), "-B", str(build), *options,
                    "-DTREEFORM_BUILD_PYTHON=ON", f"-DTREEFORM_PYTHON={sys.executable}"],
                   check=True)


def compile_extension(build):
    subprocess.run(["cmake", "--build", str(build), "--target", "treeform_python", "--parallel",
                    str(jobs())], check=True)


def build_in_tree(build):
    """What else the folder was told stays as it was: others build there, too."""
    cache = build / "CMakeCache.txt"
    before = cache.read_bytes()
    say_how_long(f"the extension alone, with the libraries of {build}", MINUTES_OF_EXTENSION)
    try:
        # What was found for another Python is looked for again.
        configure(build, "-U", "*Python*", "-U", "pybind11*")
        compile_extension(build)
    finally:
        cache.write_bytes(before)
        subprocess.run(["cmake", str(build)], stdout=subprocess.DEVNULL, check=True)


def build_all(build):
    say_how_long("treeform", MINUTES_OF_ALL)
    build.mkdir(parents=True, exist_ok=True)
    generator = ["-G", "Ninja"] if shutil.which("ninja") else []
    configure(build, *generator, "-DCMAKE_BUILD_TYPE=Release",
              "-DTREEFORM_BUILD_TOOLS=OFF", "-DTREEFORM_BUILD_C=OFF", "-DTREEFORM_INSTALL=OFF",
              *shlex.split(os.environ.get("CMAKE_ARGS", "")))
    compile_extension(build)


# ---- what goes with it ----

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
            # Beside the builds of the tree, so that a compiler cache finds its objects.
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
if TREE.parent != HERE:  # which setuptools looks for here
    shutil.copy(TREE / "LICENSE", HERE / "LICENSE")
setup(version=version(), ext_modules=[Extension("treeform._core", sources=[])],
      cmdclass={"build_ext": BuildByCMake, "sdist": CarryTree})
