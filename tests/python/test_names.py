"""Every name has a docstring with an example that runs, annotations that mypy takes, and a test."""

import doctest
import importlib
import inspect
import os
import pathlib
import pkgutil
import re
import subprocess
import sys

import pytest

import treeform as tf

HERE = pathlib.Path(__file__).parent
NAMES = dict(line.split() for line in (HERE / "names.txt").read_text().splitlines()
             if line and not line.startswith("#"))
# What operations return or raise: documented, but without an example of their own.
RESULTS = {name for name in tf.__all__ if inspect.isclass(getattr(tf, name))} - set(NAMES)
VALUES = {"KINDS", "STANDINGS", "NONE", "MeshLike"}


def test_the_list_is_that_of_the_package():
    assert sorted(NAMES) == sorted(set(tf.__all__) - RESULTS - VALUES)


@pytest.mark.parametrize("name", sorted(NAMES))
def test_a_name_is_documented_annotated_and_tested(name):
    thing = getattr(tf, name)
    text = inspect.getdoc(thing)
    assert text and ">>> " in text, "no example"
    functions = [thing] if inspect.isfunction(thing) else [
        member for key, member in vars(thing).items()
        if inspect.isfunction(member) and (not key.startswith("_") or key == "__init__")]
    for function in functions:
        if function.__name__ != "__init__":
            assert function.__doc__, f"{function.__name__} has no docstring"
        signature = inspect.signature(function)
        assert signature.return_annotation is not inspect.Signature.empty
        for parameter in list(signature.parameters.values()):
            assert parameter.name == "self" or parameter.annotation is not inspect.Parameter.empty
    for key, member in vars(thing).items() if inspect.isclass(thing) else ():
        if isinstance(member, property):
            assert member.__doc__, f"{key} has no docstring"
    assert re.search(rf"\btf\.{name}\(", (HERE / NAMES[name]).read_text()), "no test"


@pytest.mark.parametrize("name", sorted(RESULTS))
def test_a_result_is_documented(name):
    assert inspect.getdoc(getattr(tf, name))


@pytest.mark.parametrize("name", [m.name for m in pkgutil.iter_modules(tf.__path__)
                                  if m.name != "_core"])
def test_examples_run(name):
    assert doctest.testmod(importlib.import_module(f"treeform.{name}")).failed == 0


def test_the_example_of_the_package_runs():
    assert doctest.testmod(tf).failed == 0


def test_the_package_is_typed():
    assert (pathlib.Path(tf.__file__).parent / "py.typed").exists()
    package = pathlib.Path("tools/python/treeform")
    done = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--cache-dir", os.devnull,
                           str(package)], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout


def test_the_stub_has_what_the_extension_has():
    stub = pathlib.Path("tools/python/treeform/_core.pyi").read_text()
    from treeform import _core
    there = {name for name in dir(_core) if not name.startswith("__")}
    named = set(re.findall(r"^(?:def|class) (\w+)|^(\w+): ", stub, re.MULTILINE))
    named = {a or b for a, b in named} - {"_Cloud"}
    assert there == named
