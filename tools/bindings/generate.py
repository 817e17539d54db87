#!/usr/bin/env python3
"""generate.py [--check | --self-test]: generates the parts of the C library, of the Python package
and of the reports of the tools that follow from the C++ headers. --check changes nothing, and fails
if a generated file is out of date."""

from __future__ import annotations

import argparse
import difflib
import pathlib
import shutil
import sys

import c_surface
import functions
import python_language
import python_surface
import python_verbs
import python_write
import report_write
from c_language import Language
from c_write import _BLOCK, INCLUDE, MADE, Writer, formatted, names_of
from headers import ROOT, Enum, Field, Struct, read_all


def c_files(structs: dict[str, Struct], enums: dict[str, Enum]) -> dict[pathlib.Path, str]:
    names = {cpp: c for cpp, (c, _) in c_surface.ENUMS.items()}
    writer = Writer(Language(structs, enums, c_surface.BOUND, names), c_surface.LISTS,
                    c_surface.ENUMS, functions.read_all())
    made: dict[pathlib.Path, str] = {}
    for path in sorted(INCLUDE.glob("*.h")):
        made[path] = writer.header(path)
    for path, text in list(made.items()):
        blocks = [name for found in _BLOCK.finditer(text) for name in names_of(found)]
        if blocks:
            made[MADE / f"{path.stem}.cpp"] = writer.source(path.stem, blocks, text)
    made[MADE / "structs.hpp"] = formatted(writer.declarations(), "tools/c/made/structs.hpp")
    return made


def python_files(structs: dict[str, Struct], enums: dict[str, Enum]) -> dict[pathlib.Path, str]:
    language = python_language.Language(structs, enums, python_surface.RESULTS,
                                        python_surface.WORDS)
    writer = python_write.Writer(language, python_surface.OPTIONS, python_surface.COUNTERS,
                                 python_surface.STATES, python_verbs.FUNCTIONS)
    made = writer.sources()
    for path in sorted(python_write.PACKAGE.glob("*.py")):
        made[path] = writer.package_file(path)
    return made | {python_write.PACKAGE / "_core.pyi": writer.stub()}


def all_files(structs: dict[str, Struct], enums: dict[str, Enum]) -> dict[pathlib.Path, str]:
    for name in [*(one.cpp for one in c_surface.BOUND), *python_surface.OPTIONS,
                 *(one.cpp for one in python_surface.RESULTS)]:
        if name in structs and structs[name].unclear:
            raise ValueError(f"{structs[name].header}: cannot parse {structs[name].unclear}")
    return c_files(structs, enums) | python_files(structs, enums) | report_write.Writer(
        structs, enums).files()


def self_test() -> None:
    """A new counter or option is one line of C++, and then appears everywhere."""
    structs, enums = read_all()
    structs["boolean_statistics"].fields.append(Field("unheard", "uint64_t", "0", "of nothing"))
    structs["repair_options"].fields.append(Field("unseen", "double", "2.5", "a length"))
    structs["search_effort"].fields.append(Field("unread", "uint64_t", "0", "of no one"))
    made = {path.relative_to(ROOT).as_posix(): text
            for path, text in all_files(structs, enums).items()}
    for path, words in {
            "tools/c/include/treeform/c/solids.h": ["uint64_t unheard;  ///< of nothing",
                                                    "double unseen;  ///< a length; default 2.5"],
            "tools/c/made/solids.cpp": ["to.unheard = from.statistics.unheard;",
                                        "how.unseen = o.unseen;", "to.unseen = from.unseen;"],
            "tools/python/src/made/results.cpp": ['made["unheard"] = from.unheard;'],
            "tools/python/src/made/options.cpp": ['visit("unseen", how.unseen);'],
            "tools/python/treeform/_core.pyi": ["unseen: float = ..."],
            "tools/shell/made/report_fields.cpp": ['{"unread", from.unread}'],
            "tools/REPORTS.md": ["`effort.unread` | count | of no one |"]}.items():
        text = " ".join(made[path].split())
        for word in words:
            assert " ".join(word.split()) in text, (path, word)
    print("new fields appear everywhere")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--check", action="store_true", help="print the differences")
    parser.add_argument("--self-test", action="store_true", help="add fields, and check the output")
    options = parser.parse_args()
    if not shutil.which("clang-format"):
        print("skipped: no clang-format")
        return 77
    if options.self_test:
        self_test()
        return 0
    made = all_files(*read_all())
    there = {path for folder in (MADE, python_write.MADE, report_write.MADE)
             for path in folder.glob("*.[ch]pp")}
    wrong = 0
    for path in sorted(there | set(made)):
        before, text = path.read_text() if path.exists() else "", made.get(path, "")
        if text == before:
            continue
        wrong += 1
        if options.check:
            name = str(path.relative_to(ROOT))
            sys.stdout.writelines(difflib.unified_diff(
                before.splitlines(True), text.splitlines(True), name, f"{name}, regenerated"))
        elif path in made:
            path.parent.mkdir(exist_ok=True)
            path.write_text(text)
        else:
            path.unlink()
    if options.check and wrong:
        print(f"{wrong} generated files are out of date: run tools/bindings/generate.py")
    return int(options.check and wrong > 0)


if __name__ == "__main__":
    sys.exit(main())
