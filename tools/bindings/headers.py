"""The structs and enumerations of the public C++ headers: fields with their types, defaults and
sentences. It reads what clang-format leaves, plain declarations alone, and ends with a message
where it does not understand one."""

from __future__ import annotations

import pathlib
import re
from dataclasses import dataclass, field

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDERS = ["libmesh/include/treeform/mesh", "libtree/include/treeform/tree"]


@dataclass(frozen=True)
class Field:
    name: str
    type: str  #: without `std::`, `treeform::` and blanks
    default: str  #: of C++; "" for that of the type
    doc: str  #: with the shape in front: "[F] ..."

    @property
    def shape(self) -> str:
        """"F" of "[F] the face ..."; "" where there is none."""
        found = re.match(r"\[([^\]]+)\]", self.doc)
        return found.group(1) if found else ""

    @property
    def sentence(self) -> str:
        return re.sub(r"^\[[^\]]+\](\[\d\])?\s*", "", self.doc)


@dataclass
class Struct:
    name: str
    header: str  #: "mesh/cut.hpp"
    doc: str
    fields: list[Field] = field(default_factory=list)
    unclear: list[str] = field(default_factory=list)  #: statements that are not understood

    def __getitem__(self, name: str) -> Field:
        for one in self.fields:
            if one.name == name:
                return one
        raise KeyError(f"{self.name} has no field {name}")


@dataclass
class Enum:
    name: str
    header: str
    doc: str
    values: list[tuple[str, str]] = field(default_factory=list)  #: names and sentences


_START = re.compile(r"^(?:struct|class)(?: TREEFORM_API| \[\[nodiscard\]\])* (\w+)(?: final)?"
                    r"(?: : [^{;]*)? \{(\};)?$")
_ENUM = re.compile(r"^enum class (\w+) : [\w:]+ \{(.*)$")


_NO_FIELD = re.compile(r"(static|friend|using|public|private|protected|template|explicit|constexpr"
                       r"|enum|struct|class|union)\b|\[\[|~|$")


def plain(type: str) -> str:
    """A type without blanks, `std::` and `treeform::`."""
    type = re.sub(r"\bstd::|\btreeform::", "", type.strip())
    return re.sub(r"\s*([<>,*&])\s*", r"\1", re.sub(r"\s+", " ", type))


def _words(comments: list[str]) -> str:
    """Comment lines as one text; paragraphs of commands (\\pre, \\throws, ...) are left out."""
    text = "\n".join(comments)
    text = re.split(r"\n\\(?:pre|throws|cost|same|source)\b", text)[0]
    return "\n\n".join(" ".join(part.split()) for part in text.split("\n\n")).strip()


def _declared(text: str) -> tuple[str, str, str] | None:
    """Type, name and default of a field; None for what is none."""
    found = re.match(r"(?P<type>(?:const )?[\w:]+(?:<.*>)?[ *&]*?)\s+(?P<name>\w+)"
                     r"(?:\s*=\s*(?P<value>.+)|\{(?P<braces>.*)\})?$", text, re.S)
    if not found:
        return None
    return (plain(found["type"]), found["name"],
            re.sub(r"\s+", " ", found["value"] or found["braces"] or "").strip())


class _Body:
    """Goes through the lines of a struct."""

    def __init__(self, struct: Struct) -> None:
        self.struct = struct
        self.before: list[str] = []  #: comment lines ahead of a declaration
        self.text = ""

    def line(self, line: str) -> None:
        code, _, after = line.partition("///<")
        code = code.strip()
        if not code and after:  # goes on with the comment of the field above
            last = self.struct.fields.pop()
            self.struct.fields.append(Field(last.name, last.type, last.default,
                                            f"{last.doc} {after.strip()}".strip()))
            return
        if code.startswith("///"):
            self.before.append(code[3:].strip())
            return
        code = re.sub(r"\s*//.*$", "", code)
        if not code and not self.text:
            self.before = []
            return
        self.text = f"{self.text} {code}".strip()
        if re.fullmatch(r"(public|private|protected):", self.text):
            self.text, self.before = "", []
            return
        if self.text.count("{") != self.text.count("}") or self.text.count("(") != self.text.count(
                ")") or not self.text.endswith((";", "}")):
            return
        text = self.text.rstrip(";").strip()
        several = re.fullmatch(r"(.+?) (\w+(?:\{\})?(?:, \w+(?:\{\})?)+)", text)  # of one type
        for one in ([f"{several[1]} {name}" for name in several[2].replace("{}", "").split(", ")]
                    if several else [text]):
            if not self.text.endswith(";") or _NO_FIELD.match(one):
                continue
            declared = _declared(one)
            if declared:
                type, name, default = declared
                self.struct.fields.append(
                    Field(name, type, default, " ".join([*self.before, after.strip()]).strip()))
            elif "(" not in one:
                self.struct.unclear.append(one)
        self.text, self.before = "", []


def _enumerators(lines: list[str]) -> list[tuple[str, str]]:
    values: list[tuple[str, str]] = []
    before: list[str] = []
    for line in lines:
        code, _, after = line.partition("///<")
        code = code.strip()
        if code.startswith("///"):
            before.append(code[3:].strip())
            continue
        names = re.findall(r"(\w+)(?:\s*=\s*\w+)?\s*(?:,|$)", re.sub(r"//.*$", "", code))
        if not names and after and values:
            values[-1] = values[-1][0], f"{values[-1][1]} {after.strip()}"
        for name in names:
            values.append((name, " ".join([*before, after.strip()]).strip()))
            before = []
    return values


def read(path: pathlib.Path, header: str) -> tuple[list[Struct], list[Enum]]:
    structs: list[Struct] = []
    enums: list[Enum] = []
    comments: list[str] = []
    lines = path.read_text().splitlines()
    at = 0
    while at < len(lines):
        line = lines[at]
        at += 1
        if line.startswith("///"):
            comments.append(line[3:].strip())
            continue
        found = _START.match(line)
        if found:
            struct = Struct(found.group(1), header, _words(comments))
            body = _Body(struct)
            while not found.group(2) and not lines[at].startswith("}"):
                body.line(lines[at])
                at += 1
            structs.append(struct)
        found = _ENUM.match(line)
        if found:
            text = [found.group(2)]
            while "};" not in text[-1]:
                text.append(lines[at])
                at += 1
            text[-1] = text[-1].partition("}")[0]
            enums.append(Enum(found.group(1), header, _words(comments), _enumerators(text)))
        comments = []
    return structs, enums


def read_all() -> tuple[dict[str, Struct], dict[str, Enum]]:
    """All of the public headers, by name."""
    structs: dict[str, Struct] = {}
    enums: dict[str, Enum] = {}
    for folder in FOLDERS:
        for path in sorted((ROOT / folder).glob("*.hpp")):
            some, more = read(path, f"{path.parent.name}/{path.name}")
            structs |= {one.name: one for one in some}
            enums |= {one.name: one for one in more}
    return structs, enums
