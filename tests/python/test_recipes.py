"""The programs of tools/python/README.md run, and print what stands below them."""

import contextlib
import io
import os
import pathlib
import re

import pytest

pytest.importorskip("tqdm")
README = pathlib.Path("tools/python/README.md").resolve()
RECIPES = re.findall(r"^```python\n(.*?)^```\n```text\n(.*?)^```$", README.read_text(),
                     re.MULTILINE | re.DOTALL)


def printed(program, folder):
    """What a program prints, in a folder with the models of the tree."""
    (folder / "data").symlink_to(README.parents[2] / "data")
    (folder / "out").mkdir()
    home, text = os.getcwd(), io.StringIO()
    os.chdir(folder)
    try:
        with contextlib.redirect_stdout(text):
            exec(compile(program, str(README), "exec"), {"__name__": "__main__"})
    finally:
        os.chdir(home)
    return text.getvalue()


def test_there_are_ten():
    assert len(RECIPES) >= 10


@pytest.mark.parametrize("program, text", RECIPES)
def test_a_recipe_prints_what_stands_there(program, text, tmp_path):
    assert printed(program, tmp_path) == text
