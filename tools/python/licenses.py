"""The licenses of what is put beside the extension and of what is compiled into it, as Debian has
them."""

import importlib.metadata
import pathlib
import re
import shutil
import subprocess

# Of these, headers are compiled into the extension.
COMPILED_IN = {"eigen": "/usr/include/eigen3/Eigen/Dense", "highway": "/usr/include/hwy/highway.h",
               "nlohmann-json": "/usr/include/nlohmann/json.hpp"}
COMMON = re.compile(r"/usr/share/common-licenses/([\w.-]*\w)")


def copyright_of(path):
    """Where the package that `path` is of says under what license it is; None if no package has
    it."""
    path = pathlib.Path(path)
    real = path.resolve()
    # Of a folder that is a link to another one, packages may name either.
    names = {str(path), str(real), *(str(p).removeprefix("/usr") for p in (path, real))}
    if not shutil.which("dpkg-query"):
        return None
    for name in sorted(names):
        done = subprocess.run(["dpkg-query", "-S", name], capture_output=True, text=True)
        if done.returncode == 0:
            package = re.split("[:,]", done.stdout)[0]
            found = pathlib.Path("/usr/share/doc", package, "copyright")
            return found if found.is_file() else None
    return None


def of_distribution(name):
    """The license that a package of a Python index brings; None if there is none."""
    try:
        files = importlib.metadata.files(name) or []
    except importlib.metadata.PackageNotFoundError:
        return None
    return next((file.locate() for file in files if "LICEN" in file.name.upper()), None)


def collect(libraries, folder):
    """Writes the license of each of `libraries`, paths by name, as NAME.txt into `folder`; with
    those that are compiled in, and texts that are only named in them. Says which are not found."""
    folder.mkdir(parents=True, exist_ok=True)
    found = {name: copyright_of(path) for name, path in (libraries | COMPILED_IN).items()}
    import pybind11
    found["pybind11"] = copyright_of(pybind11.__file__) or of_distribution("pybind11")
    named = set()
    for name, path in found.items():
        if path is None:
            print(f"no license found of {name}: add it to {folder}")
            continue
        shutil.copy(path, folder / f"{name}.txt")
        named |= set(COMMON.findall(pathlib.Path(path).read_text(errors="replace")))
    for name in sorted(named):
        text = pathlib.Path("/usr/share/common-licenses", name)
        if text.is_file():
            shutil.copy(text, folder / f"{name}.txt")
