#!/usr/bin/env python3
"""check_symbols.py SOURCE LIBRARY: every function of <treeform.h> is documented, shown by the
library under a version, named in exports.map and called by the C tests; and the library shows
nothing else."""

import pathlib
import re
import shutil
import subprocess
import sys

HEADERS = "tools/c/include"


def declared(text):
    """(name, whether a docstring stands above it) of each function of a header."""
    found = []
    for match in re.finditer(r"^TREEFORM_C_API\s[^(;]*?\b(treeform_\w+)\(", text, re.MULTILINE):
        above = text[:match.start()].rstrip("\n").rsplit("\n", 1)[-1]
        found.append((match[1], above.startswith("///") and match.start() > 0
                      and text[match.start() - 1] == "\n"))
    return found


def structs_without_words(text):
    """Names of structs, unions and sets of constants of a header that nothing is said about."""
    lines = text.splitlines()
    for number, line in enumerate(lines):
        match = re.match(r"typedef (?:struct|int32_t) (treeform_\w+)", line)
        if match and not lines[number - 1].startswith("///") \
                and not re.match(r"typedef|};|enum", lines[number - 1]):
            yield match[1]


def shown(library):
    """{name: version} of the symbols that the library defines for others."""
    names = subprocess.run(["nm", "-D", "--defined-only", "--with-symbol-versions", library],
                           capture_output=True, text=True, check=True).stdout
    symbols = [line.split()[-1] for line in names.splitlines()
               if line.split()[-2] != "A"]  # the version itself
    return dict((name.split("@")[0], name.rpartition("@")[2]) for name in symbols)


def faults(source, library):
    headers = sorted((source / HEADERS).rglob("*.h"))
    functions = {}
    for path in headers:
        text = path.read_text()
        for name, documented in declared(text):
            if name in functions:
                yield f"{name} is declared twice"
            functions[name] = path
            if not documented:
                yield f"{name} has no documentation in {path.name}"
        for name in structs_without_words(text):
            yield f"{name} has no documentation in {path.name}"
    script = (source / "tools/c/exports.map").read_text()
    listed = re.findall(r"^ +(treeform_\w+);$", script, re.MULTILINE)
    if listed != sorted(set(listed)):
        yield "exports.map is not in the order of letters"
    version = re.search(r"^(TREEFORM_\d+) \{", script, re.MULTILINE)[1]
    base = (source / HEADERS / "treeform/c/base.h").read_text()
    major = re.search(r"define TREEFORM_C_VERSION_MAJOR (\d+)", base)[1]
    if version != f"TREEFORM_{major}":
        yield f"exports.map has the version {version}, base.h the major version {major}"
    calls = "\n".join(path.read_text() for path in sorted((source / "tests/c").glob("*.c")))
    called = set(re.findall(r"\b(treeform_\w+)\(", calls))
    symbols = shown(library)
    for name in sorted(set(functions) | set(listed) | set(symbols)):
        if name not in functions:
            yield f"{name} is in no header"
        if name not in listed:
            yield f"{name} is not in exports.map"
        if symbols.get(name) != version:
            yield f"{name} is not shown as {version}"
        if name not in called:
            yield f"{name} is called by no test"
    if not functions:
        yield "no functions found"


def main():
    source, library = pathlib.Path(sys.argv[1]), sys.argv[2]
    if not shutil.which("nm") or pathlib.Path(library).read_bytes()[:4] != b"\x7fELF":
        print("skipped: no nm, or no ELF")
        return 77
    broken = list(faults(source, library))
    print("\n".join(broken) if broken else "every function is documented, shown and called")
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main())
