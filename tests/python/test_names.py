"""Every name has a docstring with an example that runs, annotations that mypy takes, and a test."""

import ast
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
VALUES = {"KINDS", "RELATIONS", "NONE", "MeshLike", "__version__"}


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


def declared(body):
    """Functions of the stub, and how many arguments each has beside `self` and `progress`; other
    names with None."""
    made = {}
    for one in body:
        if isinstance(one, ast.FunctionDef):
            names = [arg.arg for arg in one.args.args if arg.arg not in ("self", "progress")]
            made[one.name] = None if one.decorator_list else len(names)
        elif isinstance(one, ast.AnnAssign):
            made[one.target.id] = None
        elif isinstance(one, ast.ClassDef):
            made[one.name] = declared(one.body)
    return made


def there(scope, names):
    """The same of the extension, whose docstrings list the arguments."""
    made = {}
    for name in names:
        one = getattr(scope, name)
        if inspect.isclass(one):
            made[name] = there(one, [n for n in vars(one) if not n.startswith("_") or n in KEPT])
        elif callable(one):
            line = [line for line in one.__doc__.splitlines() if line.startswith(f"{name}(")][-1]
            made[name] = len([one for one in re.findall(r"[(,] ?(\w+): ", line) if one != "self"])
        else:
            made[name] = None
    return made


#: Of special methods, those that the stub declares.
KEPT = ("__len__", "__bool__")


def test_the_stub_has_what_the_extension_has():
    stub = ast.parse(pathlib.Path("tools/python/treeform/_core.pyi").read_text())
    from treeform import _core
    mine = declared(stub.body)
    theirs = there(_core, [name for name in dir(_core) if not name.startswith("__")])
    bases = {one.name: [base.id for base in one.bases] for one in stub.body
             if isinstance(one, ast.ClassDef)}
    for name, names in bases.items():
        for base in names:
            if base in mine:
                mine[name] = {**mine[base], **mine[name]}
    for one in [name for name in mine if name.startswith("_")]:
        del mine[one]
    for members in mine.values():
        if isinstance(members, dict):
            members.pop("__init__", None)  # has overloads
    assert theirs == mine
