#!/usr/bin/env python3
"""generate.py [--check]: makes the parts of the C library and of the Python package that follow from
the headers of C++. With --check it changes nothing, and fails where a file is not what it would make.
"""

from __future__ import annotations

import argparse
import difflib
import pathlib
import shutil
import sys

import c_surface
import python_language
import python_surface
import python_write
from c_language import Language
from c_write import _BLOCK, INCLUDE, MADE, Writer, formatted, names_of
from headers import ROOT, read_all


def c_files() -> dict[pathlib.Path, str]:
    structs, enums = read_all()
    names = {cpp: c for cpp, (c, _) in c_surface.ENUMS.items()}
    writer = Writer(Language(structs, enums, c_surface.BOUND, names), c_surface.LISTS,
                    c_surface.ENUMS, c_surface.CALLS, c_surface.INCLUDES)
    made: dict[pathlib.Path, str] = {}
    for path in sorted(INCLUDE.glob("*.h")):
        made[path] = writer.header(path)
    for path, text in list(made.items()):
        blocks = [name for found in _BLOCK.finditer(text) for name in names_of(found)]
        if blocks:
            made[MADE / f"{path.stem}.cpp"] = writer.source(path.stem, blocks, text)
    made[MADE / "structs.hpp"] = formatted(writer.declarations(), "tools/c/made/structs.hpp")
    return made


def python_files() -> dict[pathlib.Path, str]:
    structs, enums = read_all()
    language = python_language.Language(structs, enums, python_surface.RESULTS,
                                        python_surface.WORDS)
    writer = python_write.Writer(language, python_surface.OPTIONS, python_surface.COUNTERS,
                                 python_surface.FUNCTIONS)
    made = writer.sources()
    for path in sorted([*python_write.PACKAGE.glob("*.py"), *python_write.PACKAGE.glob("*.pyi")]):
        made[path] = writer.package_file(path)
    return made


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--check", action="store_true")
    check = parser.parse_args().check
    if not shutil.which("clang-format"):
        print("skipped: no clang-format")
        return 77
    wrong = 0
    for path, text in (c_files() | python_files()).items():
        before = path.read_text() if path.exists() else ""
        if text == before:
            continue
        wrong += 1
        if check:
            name = str(path.relative_to(ROOT))
            sys.stdout.writelines(difflib.unified_diff(
                before.splitlines(True), text.splitlines(True), name, f"{name}, made anew"))
        else:
            path.parent.mkdir(exist_ok=True)
            path.write_text(text)
    if check and wrong:
        print(f"{wrong} files are not what the headers say: run tools/bindings/generate.py")
    return int(check and wrong > 0)


if __name__ == "__main__":
    sys.exit(main())
