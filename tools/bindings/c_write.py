"""Writes the blocks of the C headers and the sources in tools/c/made, using `c_language.py`."""

from __future__ import annotations

import pathlib
import re
import subprocess
import textwrap

from c_functions import Functions
from c_language import Bound, Language, List, Member
from functions import Function
from headers import GENERATED, ROOT, Enum

INCLUDE = ROOT / "tools/c/include/treeform/c"
MADE = ROOT / "tools/c/made"
#: Phrases of C++ docstrings, and those of C.
IN_C = {"operand_element::none": "TREEFORM_NONE", "attribute_sources": "treeform_transfer_attributes",
        "attribute_sources::corner_groups": "treeform_corner_groups",
        "shared_search": "treeform_shared_search",
        "shared_weld": "treeform_shared_weld",
        "convex_hull_result::faces": "treeform_hull::faces", "part.mesh": "mesh",
        "boolean_statistics": "treeform_boolean_result", "round_to_las": "treeform_file_round_to_las",
        "penetration_depth_result": "treeform_penetration_depth"}
#: Enumerators in docstrings that mean functions or members there.
_OTHERS = ("relation", "degenerate")
_BLOCK = re.compile(r"^// made of [^\n]+:\n((?://   [^\n]+\n)+).*?^// end\n", re.M | re.S)
_STRUCT = re.compile(r"^typedef struct (treeform_\w+) \{\n(.*?)^\} \1;", re.M | re.S)


def formatted(text: str, name: str) -> str:
    """`text` formatted by clang-format."""
    done = subprocess.run(["clang-format", f"--assume-filename={ROOT / name}"], input=text,
                          capture_output=True, text=True, check=True)
    return done.stdout


def comment(text: str, indent: str = "") -> str:
    lines: list[str] = []
    for part in text.split("\n\n"):
        lines += textwrap.wrap(part, 95 - len(indent), break_long_words=False,
                               break_on_hyphens=False) + [""]
    return "".join(f"{indent}/// {line}".rstrip() + "\n" for line in lines[:-1])


def names_of(block: re.Match[str]) -> list[str]:
    """The names in a block of a header."""
    return [name for name in block.group(1).split() if name != "//"]


class Writer:
    def __init__(self, language: Language, lists: list[List],
                 enums: dict[str, tuple[str, str | dict[str, str]]],
                 functions: dict[str, list[Function]]) -> None:
        self.language, self.enums = language, enums
        self.functions = Functions(language, lists, functions)
        self.lists = {one.of: one for one in lists}
        self.order: dict[str, list[str]] = {}  #: the current members of structs
        self.fields: set[str] = set()  #: of the struct (of a function: its parameters)
        self.near: set[str] = set()  #: for a function: fields of its options and its result
        self.known = {name for path in INCLUDE.glob("*.h")
                      for name in re.findall(r"\b(treeform_\w+)\(", path.read_text())}

    # ---- words ----

    def words(self, text: str) -> str:
        """A sentence of C++ with the names of C in backticks."""
        def name(found: re.Match[str]) -> str:
            word, _, of = found.group(1).partition("::")
            if word in self.fields and not of:
                return found.group(0)
            if not of and word not in (*_OTHERS, *self.near) and self.constant_of(word):
                return f"`{self.constant_of(word)}`"
            if word in self.enums and not of and self.enums[word][0].startswith("treeform_"):
                return f"`{self.enums[word][0]}`"
            if word in self.enums and of:
                names = [value for value, _ in self.language.enums[word].values]
                return f"`{self.constants(word)[names.index(of)]}`"
            bound = self.language.bound.get(word)
            if bound:
                return f"`{bound.c}{of and '::' + of}`"
            if of:
                return found.group(0)
            there = f"treeform_{word}" in self.known
            return f"`treeform_{word}`" if there else found.group(0)
        text = re.sub(r"`(\w+(?:::\w+)?)`", name, text)
        text = re.sub(r"(^|; )none( for|:)", r"\1`TREEFORM_NONE`\2", text)
        text = re.sub(r"\b(or|else) none$", r"\1 `TREEFORM_NONE`", text)
        text = re.sub(r"\bNone (?=if|when|where|without)", "Null ", text)
        text = text.replace(" For many calls, pass prepared meshes.", "")
        text = text.replace("A prepared mesh is", "The mesh itself is")
        text = re.sub(r"\bit returns false\b", "it returns other than 0", text)
        text = text.replace("meshes that are not prepared", "meshes without an index")
        text = re.sub(r"`options\.(\w+)`", r"`options->\1`", text)
        for cpp, c in IN_C.items():
            text = text.replace(f"`{cpp}`", f"`{c}`")
        unknown = r"`(?!treeform_)\w+::\w+`"  # what C does not have, in parentheses or a sentence
        return re.sub(rf" \({unknown}\)|(?<=\.)\s{unknown}[^.]*\.", "", text)

    # ---- headers ----

    def read_order(self, text: str) -> None:
        for name, body in _STRUCT.findall(text):
            body = re.sub(r"//.*", "", body)
            members: list[str] = []
            for one in body.split(";"):
                one = " ".join(one.split())
                if one and "(" in one:
                    members.append(Member(one).name)
                elif one:
                    members += [Member(part).name for part in one.split(",")]
            self.order[name] = members

    def in_order(self, c: str, members: list[Member]) -> list[Member]:
        """Existing members keep their order, so that compiled programs keep working; new ones come
        last."""
        before = self.order.get(c, [])
        before = before[1:] if before and before[0] in ("owner", "struct_size") else before
        place = {name: i for i, name in enumerate(before)}
        return sorted(members, key=lambda one: place.get(one.name, len(before)))

    def struct(self, bound: Bound) -> str:
        self.fields = {one.name for one in self.language.structs[bound.cpp].fields}
        self.near = set()
        first = {"options": "size_t struct_size;\n", "result": "void* owner;\n"}.get(bound.kind, "")
        said = self.language.structs[bound.cpp].doc
        text = comment(self.words(said))
        text += f"typedef struct {bound.c} {{\n{first}"
        for one in self.in_order(bound.c, self.language.members(bound)):
            doc = self.words(one.doc)
            line = f"    {one.decl};"
            if doc and len(line) + len(doc) < 82 and "\n" not in doc:
                text += f"{line}  ///< {doc}\n"
            else:
                text += comment(doc, "    ") if doc else ""
                text += line + "\n"
        text += f"}} {bound.c};\n"
        if bound.kind == "options":
            text += (f"/// Sets the defaults.\nTREEFORM_C_API void {bound.c}_init({bound.c}* options,"
                     " size_t size);\n")
        return text

    def list_struct(self, one: List) -> str:
        element = {"uint32_t": "const uint32_t*", "double": "const double*",
                   "string": "const char* const*"}.get(one.of)
        element = element or f"const {self.language.bound[one.of].c}*"
        return (comment(one.doc) + f"typedef struct {one.c} {{\nvoid* owner;\n"
                f"{element} {one.name};  ///< [count]\nsize_t count;\n}} {one.c};\n")

    def constants(self, name: str) -> list[str]:
        prefix = self.enums[name][1]
        special = prefix if isinstance(prefix, dict) else {}
        front = prefix if isinstance(prefix, str) else ""
        return ["TREEFORM_" + special.get(value, (front + value).upper())
                for value, _ in self.language.enums[name].values]

    def constant_of(self, value: str) -> str:
        """The constant of C for an enumerator; of several enumerations, of the first in `ENUMS`."""
        for name, (c, _) in self.enums.items():
            values = [one for one, _ in self.language.enums[name].values]
            if value in values and c.startswith("treeform_"):
                return self.constants(name)[values.index(value)]
        return ""

    def enum(self, name: str) -> str:
        it: Enum = self.language.enums[name]
        c = self.enums[name][0]
        self.fields = self.near = set()
        text = comment(self.words(it.doc)) + f"typedef int32_t {c};\nenum {{\n"
        last = len(it.values) - 1
        for i, (constant, (_, doc)) in enumerate(zip(self.constants(name), it.values)):
            if doc:
                text += comment(self.words(doc), "    ")
            text += f"    {constant} = {i}{',' if i < last else ''}\n"
        text += "};\n"
        if it.named:
            text += (f'/// The name of a value, as in reports: "{it.values[0][0].replace("_", "-")}"; '
                     f'"unknown" for others.\nTREEFORM_C_API const char* {c}_name({c} value);\n')
        return text

    def thing(self, name: str) -> str:
        if name.endswith(")"):
            return self.function(name)
        if name in self.language.bound:
            return self.struct(self.language.bound[name])
        if name in self.enums:
            return self.enum(name)
        return self.list_struct(next(one for one in self.lists.values()
                                     if one.c == "treeform_" + name))

    def function(self, entry: str) -> str:
        """The declaration, with the docstring of C++."""
        _, it = self.functions.find(entry)
        declared = self.functions.prototype(entry)
        self.fields = {name for _, name, _ in it.parameters} | set(re.findall(r"\w+", declared))
        types = re.findall(r"\w+", " ".join([it.returns, *(one for one, _, _ in it.parameters)]))
        self.near = {one.name for type in types if type in self.language.bound
                     for one in self.language.structs[type].fields
                     if one.name not in self.language.bound[type].leave.split()}
        said = it.doc or next(one.doc for one in self.functions.functions[it.name] if one.doc)
        if it.returns.startswith("optional<"):
            said = re.sub(r"\b([Nn])one (?=if|when|where|without)",
                          r"\1ull, with `TREEFORM_OK`, ", said)
        if "const oriented_plane&" in [type for type, _, _ in it.parameters] and "null" not in said:
            said += "\n\nA null `plane` means z = 0."
        if ("points_view", "points", False) in it.parameters:
            said = said.replace("`points`", "`mesh`")
        return f"{comment(self.words(said))}TREEFORM_C_API {self.functions.prototype(entry)};\n"

    def header_of(self, name: str) -> str:
        if name.endswith(")"):
            return self.functions.find(name)[1].header
        for all in (self.language.structs, self.language.enums):
            if name in all:
                return all[name].header
        return ""

    def block(self, names: list[str]) -> str:
        text = "// made of the headers of C++:\n"
        text += "".join(f"//   {line}\n" for line in textwrap.wrap(" ".join(names), 90))
        return text + "\n".join(self.thing(name) for name in names) + "// end\n"

    def header(self, path: pathlib.Path) -> str:
        """The text of a C header with its blocks regenerated."""
        text = path.read_text()
        self.read_order(text)

        def made(found: re.Match[str]) -> str:
            names = names_of(found)
            return self.block(names)
        return formatted(_BLOCK.sub(made, text), f"tools/c/include/treeform/c/{path.name}")

    # ---- sources ----

    def declarations(self) -> str:
        text = GENERATED + ("#pragma once\n/// \\file\n/// Fills structs of C from those of C++, "
                            "and reads options.\n\n")
        headers = sorted({self.header_of(name) for name in self.language.bound})
        text += "".join(f"#include <treeform/{one}>\n" for one in headers)
        text += "\n#include <tools/c/handles.hpp>\n\nnamespace glue {\n\n"
        for bound in self.language.bound.values():
            if bound.kind == "options":
                text += f"[[nodiscard]] tf::{bound.cpp} read(const {bound.c}* options);\n"
                text += f"[[nodiscard]] tf::{bound.cpp} read(const {bound.c}& o);\n"
            elif bound.kind != "same":
                text += f"void fill(keeper& kept, const tf::{bound.cpp}& from, {bound.c}& to);\n"
        for one in self.lists.values():
            text += (f"void fill(keeper& kept, const std::vector<{one.element}>& from, "
                     f"{one.c}& to);\n")
        return text + "\n}  // namespace glue\n"

    def filling(self, bound: Bound) -> str:
        """The functions for a struct."""
        members = self.language.members(bound)
        if bound.kind == "same":
            fields = [one.name for one in self.language.structs[bound.cpp].fields
                      if one.name not in bound.custom]
            names = [bound.names.get(name, name) for name in fields]
            text = f"static_assert(sizeof({bound.c}) == sizeof(tf::{bound.cpp}));\n"
            return text + "".join(
                f"static_assert(offsetof({bound.c}, {c}) == offsetof(tf::{bound.cpp}, {cpp}));\n"
                for c, cpp in zip(names, fields))
        if bound.kind == "options":
            text = (f"tf::{bound.cpp} glue::read(const {bound.c}* options) {{\n"
                    f"return read(chosen(options, {bound.c}_init));\n}}\n"
                    f"tf::{bound.cpp} glue::read(const {bound.c}& o) {{\ntf::{bound.cpp} how;\n")
            text += "".join(one.read + "\n" for one in members) + "return how;\n}\n\n"
            text += (f"void {bound.c}_init({bound.c}* options, size_t size) {{\n"
                     f"{bound.c} to{{}};\n")
            defaults = "".join(one.default + "\n" for one in members if one.default)
            if "from." in defaults:
                text += f"const tf::{bound.cpp} from;\n"
            text += "using namespace glue;\n" if re.search(r"\b(not_known|copy)\b", defaults) else ""
            return text + defaults + "glue::init(options, size, to);\n}\n"
        body = "".join(one.fill + "\n" for one in members if one.fill)
        kept = "kept" if re.search(r"(?<!\.)\bkept\b", body) else ""
        return (f"void glue::fill(keeper& {kept}, const tf::{bound.cpp}& from, {bound.c}& to) {{\n"
                + body + "}\n")

    def list_filling(self, one: List) -> str:
        bound = self.language.bound.get(one.of)
        value = "from.data()"
        if one.of == "string":
            value = "words(kept, from)"
        elif bound:
            value = f"{'same' if bound.kind == 'same' else 'list'}<{bound.c}>(" \
                    f"{'' if bound.kind == 'same' else 'kept, '}from)"
        kept = "kept" if "kept" in value else ""
        return (f"void glue::fill(keeper& {kept}, const std::vector<{one.element}>& from, "
                f"{one.c}& to) {{\nto.{one.name} = {value};\nto.count = from.size();\n}}\n")

    def source(self, stem: str, names: list[str], text: str) -> str:
        """The source for a C header."""
        parts = [self.filling(bound) for bound in self.language.bound.values()
                 if bound.cpp in names or any(self.language.bound[name].c == bound.c for name in
                 names if name in self.language.bound)]
        parts += [self.list_filling(one) for one in self.lists.values()
                  if one.c[len("treeform_"):] in names]
        constants = "".join(
            f"static_assert({constant} == static_cast<int>(tf::{name}::{value}));\n"
            for name in names if name in self.enums
            for constant, (value, _) in zip(self.constants(name), self.language.enums[name].values))
        constants += "".join(
            f"const char* {self.enums[name][0]}_name({self.enums[name][0]} value) {{ "
            f"return glue::name_of<tf::{name}>(value); }}\n"
            for name in names if name in self.enums and self.language.enums[name].named)
        calls = [name for name in names if name.endswith(")")]
        headers = {self.header_of(name) for name in calls}
        if (ROOT / f"tools/c/{stem}.hpp").exists():
            headers.add(f"tools/c/{stem}.hpp")
        result = GENERATED
        result += "".join(f"#include <{'' if one.startswith('tools/') else 'treeform/'}{one}>\n"
                          for one in sorted({*headers, "tools/c/made/structs.hpp"}, reverse=True))
        result += "\nnamespace tf = treeform;\n\n" + constants + "\n"
        parts += [self.functions.body(name) for name in calls]
        return formatted(result + "\n".join(parts), f"tools/c/made/{stem}.cpp")
