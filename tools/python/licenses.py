"""Collects the licenses of the libraries that are copied next to the extension or compiled into
it, from Debian's packages."""

import importlib.metadata
import pathlib
import re
import shutil
import subprocess

# Libraries whose headers are compiled into the extension.
COMPILED_IN = {"eigen": "/usr/include/eigen3/Eigen/Dense", "highway": "/usr/include/hwy/highway.h",
               "nlohmann-json": "/usr/include/nlohmann/json.hpp"}
COMMON = re.compile(r"/usr/share/common-licenses/([\w.-]*\w)")


def copyright_of(path):
    """The copyright file of the Debian package that contains `path`, or None."""
    # If a folder is a symbolic link, packages may list either path.
    paths = {str(path), str(pathlib.Path(path).resolve())}
    for name in sorted(paths | {one.removeprefix("/usr") for one in paths}):
        if not shutil.which("dpkg-query"):
            return None
        done = subprocess.run(["dpkg-query", "-S", name], capture_output=True, text=True)
        if done.returncode == 0:
            package = re.split("[:,]", done.stdout)[0]
            found = pathlib.Path("/usr/share/doc", package, "copyright")
            return found if found.is_file() else None
    return None


def of_distribution(name):
    """The license file of an installed Python package, or None."""
    try:
        files = importlib.metadata.files(name) or []
    except importlib.metadata.PackageNotFoundError:
        return None
    return next((file.locate() for file in files if "LICEN" in file.name.upper()), None)


def collect(libraries, folder):
    """Writes the license of each of `libraries` (paths by name) and of those compiled in to
    NAME.txt in `folder`, with the common licenses that they refer to. Prints those not found."""
    folder.mkdir(parents=True, exist_ok=True)
    found = {name: copyright_of(path) for name, path in (libraries | COMPILED_IN).items()}
    import pybind11
    found["pybind11"] = copyright_of(pybind11.__file__) or of_distribution("pybind11")
    named = set()
    for name, path in found.items():
        if path is None:
            print(f"no license found for {name}: add it to {folder}")
            continue
        shutil.copy(path, folder / f"{name}.txt")
        named |= set(COMMON.findall(pathlib.Path(path).read_text(errors="replace")))
    for name in sorted(named):
        text = pathlib.Path("/usr/share/common-licenses", name)
        if text.is_file():
            shutil.copy(text, folder / f"{name}.txt")
