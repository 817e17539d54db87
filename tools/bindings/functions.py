"""Reads the functions of C++ headers: results, parameters and docstrings."""

from __future__ import annotations

import pathlib
import re
from dataclasses import dataclass

from headers import FOLDERS, ROOT, _words, plain


@dataclass(frozen=True)
class Function:
    name: str
    header: str  #: "mesh/cut.hpp", or "tools/c/cuts.hpp" for functions of C only
    doc: str
    returns: str
    parameters: list[tuple[str, str, bool]]  #: type, name, whether there is a default

    @property
    def space(self) -> str:
        return "glue" if self.header.startswith("tools/") else "tf"


#: A declaration at file scope, with its docstring, or that of the declaration before it.
_DECLARED = re.compile(r"(?:((?:^///[^\n]*\n)+)|^(?=\[\[nodis|TREEFORM_API |inline ))"
                       r"(?:\[\[nodiscard\]\] |TREEFORM_API |inline )*"
                       r"((?:const )?[\w:]+(?:<[^;{}()]*>)?[ *&\n]+?)(\w+)(\()", re.M)


def _inside(text: str, at: int) -> str:
    """The text from `at` to the parenthesis that closes the one before `at`."""
    depth = 1
    for i in range(at, len(text)):
        depth += {"(": 1, ")": -1}.get(text[i], 0)
        if depth == 0:
            return text[at:i]
    return ""


def _parameters(text: str) -> list[tuple[str, str, bool]]:
    parts, depth = [""], 0
    for letter in " ".join(text.split()):
        depth += {"<": 1, "(": 1, "{": 1, ">": -1, ")": -1, "}": -1}.get(letter, 0)
        if letter == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += letter
    found = []
    for part in parts:
        declared, _, default = part.partition(" = ")
        match = re.fullmatch(r"\s*(.+?)\s*\b(\w+)((?:\[\d+\])?)", declared)
        if match:
            type = re.sub(r"\[\[[^\]]*\]\]\s*", "", match[1])
            found.append((plain(type).replace("tf::", "") + match[3], match[2], bool(default)))
    return found


def read(path: pathlib.Path, header: str) -> list[Function]:
    text = path.read_text()
    found: list[Function] = []
    for one in _DECLARED.finditer(text):
        doc, returns, name, _ = one.groups()
        if doc:  # items of a list are paragraphs
            said = _words(re.sub(r"^/// ?", "", doc.replace("\n/// - ", "\n\n- "), flags=re.M)
                          .splitlines())
        else:
            said = found[-1].doc if found and text[one.start() - 2] == ";" else ""
        found.append(Function(name, header, said, plain(returns).replace("tf::", ""),
                              _parameters(_inside(text, one.end()))))
    return found


def read_all() -> dict[str, list[Function]]:
    """All functions by name, those of C first."""
    all: dict[str, list[Function]] = {}
    for path in sorted((ROOT / "tools/c").glob("*.hpp")):
        for one in read(path, f"tools/c/{path.name}"):
            all.setdefault(one.name, []).append(one)
    for folder in FOLDERS:
        for path in sorted((ROOT / folder).glob("*.hpp")):
            for one in read(path, f"{path.parent.name}/{path.name}"):
                all.setdefault(one.name, []).append(one)
    return all
