"""What editors and type checkers know of the package: a user's file passes them, and help says what
fields are."""

import dataclasses
import inspect
import os
import pathlib
import pydoc
import re
import shutil
import subprocess
import sys

import pytest

import treeform as tf
from treeform import _core

USER = pathlib.Path(__file__).parent / "typed" / "user.py"
#: Where the package is.
FOLDER = pathlib.Path(tf.__file__).parents[1]
IS_INSTALLED = FOLDER.name.endswith("-packages")
RESULTS = [one for one in vars(tf).values() if inspect.isclass(one)
           and (dataclasses.is_dataclass(one) or hasattr(one, "_fields"))]


def test_a_users_file_passes_mypy():
    where = {} if IS_INSTALLED else {"MYPYPATH": str(FOLDER)}
    done = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--cache-dir", os.devnull,
                           str(USER)], capture_output=True, text=True, env={**os.environ, **where})
    assert done.returncode == 0, done.stdout + done.stderr


def test_a_users_file_passes_pyright(tmp_path):
    npm = shutil.which("npm")
    if npm is None:
        pytest.skip("pyright comes by npm, which is not there")
    if shutil.which("pyright") is None:
        words = [npm, "install", "--silent", "--prefix", str(tmp_path), "pyright"]
        try:
            subprocess.run(words, capture_output=True, check=True, timeout=60)
        except (subprocess.TimeoutExpired, subprocess.CalledProcessError):
            pytest.skip("npm has no pyright here")
    pyright = shutil.which("pyright", path=f"{tmp_path}/node_modules/.bin") or "pyright"
    paths = [] if IS_INSTALLED else [str(FOLDER)]
    (tmp_path / "pyrightconfig.json").write_text(
        f'{{"extraPaths": {paths}, "include": ["user.py"]}}'.replace("'", '"'))
    shutil.copy(USER, tmp_path)
    done = subprocess.run([pyright, "--pythonpath", sys.executable, "-p", str(tmp_path)],
                          capture_output=True, text=True)
    assert done.returncode == 0 and "0 errors" in done.stdout, done.stdout + done.stderr


def test_a_name_that_is_not_there_fails(tmp_path):
    wrong = tmp_path / "wrong.py"
    wrong.write_text("import treeform\ntreeform.no_such_verb()\ntreeform.union(3)\n")
    where = {} if IS_INSTALLED else {"MYPYPATH": str(FOLDER)}
    done = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--cache-dir", os.devnull,
                           str(wrong)], capture_output=True, text=True, env={**os.environ, **where})
    assert all(words in done.stdout for words in ("no_such_verb", "union", "Found 2 errors"))


def test_all_names_are_said_in_the_text():
    """Type checkers read no comprehension."""
    assert "__all__ = [\"" in pathlib.Path(tf.__file__).read_text()
    assert set(tf.__all__) == {name for name in dir(tf)
                               if not name.startswith("_")} | {"__version__"}


def options_of(function):
    """The options of the extension that a function makes of its arguments, if it does."""
    kinds = re.findall(r"options\(_core\.(\w+), (?:locals\(\)|arguments)",
                       inspect.getsource(function))
    return [getattr(_core, kind) for kind in kinds]


@pytest.mark.parametrize("name", [name for name in tf.__all__
                                  if inspect.isfunction(getattr(tf, name))
                                  and options_of(getattr(tf, name))])
def test_defaults_are_those_of_cpp(name):
    """None stands for a default that only C++ knows."""
    parameters = inspect.signature(getattr(tf, name)).parameters
    for kind in options_of(getattr(tf, name)):
        taken = [one for one in kind.names if one in parameters]
        assert taken, kind
        for one in taken:
            if one in kind.defaults and parameters[one].default is not None:
                assert parameters[one].default in (kind.defaults[one], inspect.Parameter.empty), one


@pytest.mark.parametrize("result", RESULTS, ids=lambda one: one.__name__)
def test_help_says_what_fields_are(result):
    text = pydoc.plain(pydoc.render_doc(result))
    own = [base for base in result.__mro__ if "__annotations__" in vars(base)]
    for base in own:
        for field in vars(base)["__annotations__"]:
            if not field.startswith("_") and base.__name__ != "MeshResult":
                assert f"{field}: " in (base.__doc__ or ""), field
                if base is result:
                    assert f"{field}: " in text
