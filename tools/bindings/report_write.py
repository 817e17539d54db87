"""Generates the functions in tools/shell/made that fill the objects of reports with the fields of
results, and the rows for these objects in tools/REPORTS.md."""

from __future__ import annotations

import pathlib
import re
from dataclasses import dataclass

from c_write import formatted
from headers import GENERATED, ROOT, Enum, Field, Struct

MADE = ROOT / "tools/shell/made"
PAGE = ROOT / "tools/REPORTS.md"


@dataclass(frozen=True)
class Object:
    """`name(from)` is the object for a struct. Keys are the names of fields, or `field=key`."""

    name: str
    struct: str
    fields: str  #: "": all
    rows: tuple[str, ...]  #: places on the page: "repair.steps.join" for "repair.steps.join.gap"

    def keys(self, structs: dict[str, Struct]) -> list[tuple[str, Field]]:
        struct = structs[self.struct]
        named = [one.partition("=") for one in self.fields.split()]
        return [(key or field, struct[field]) for field, _, key in named] or [
            (field.name, field) for field in struct.fields]


OBJECTS = [
    Object("join_entry", "repair_statistics",
           "tetrahedra degenerate repeated closed_edges split_edges gap_limit widest_closed",
           ("repair.steps.join", "inputs[].repair.join")),
    Object("orient_entry", "repair_statistics", "flipped turned_outward strays",
           ("repair.steps.orient", "inputs[].repair.orient")),
    Object("fill_entry", "repair_statistics", "holes hole_edges=edges filled=faces",
           ("repair.steps.fill", "inputs[].repair.fill")),
    Object("cut_entry", "repair_statistics",
           "pairs removed split_vertices=separated_points labeled_cells dropped_area flipped_area",
           ("repair.steps.resolve", "inputs[].repair.resolve")),
    Object("detach_entry", "repair_statistics", "detached=moved touching",
           ("repair.steps.detach", "inputs[].repair.detach")),
    Object("effort_entry", "search_effort", "", ("depth.effort", "effort", "pairs[].effort")),
    Object("deviations_entry", "deviation_result",
           "mean mean_absolute rms p50 p95 p99 max lowest highest", ("deviation",)),
    Object("freedom_entry", "align_freedom", "", ("align.freedoms[]",)),
    Object("fit_entry", "align_result",
           "rms rms_at_start overlap inliers correlation uncertainty scale converged outcome "
           "iterations best_start pivot pivot_moved freedoms", ("align",)),
]

KINDS = {"double": "number", "bool": "bool", "uint64_t": "count", "uint32_t": "count",
         "unsigned": "count", "point3": "point", "string": "text"}


class Writer:
    def __init__(self, structs: dict[str, Struct], enums: dict[str, Enum]) -> None:
        self.structs, self.enums = structs, enums
        self.made_of = {one.struct: one for one in OBJECTS}

    def kind(self, type: str) -> str:
        if inner := re.fullmatch(r"vector<(.+)>", type):
            return f"list of {self.kind(inner[1])}s"
        return "text" if type in self.enums else KINDS.get(type, "object")

    def value(self, field: Field) -> str:
        inner = re.fullmatch(r"vector<(\w+)>", field.type)
        if inner and inner[1] in self.made_of:
            return f"list_of(from.{field.name}, {self.made_of[inner[1]].name})"
        value = f"from.{field.name}"
        return f"tf::name_of({value})" if field.type in self.enums else value

    def row(self, one: Object, key: str, field: Field, prefixes: list[str]) -> str:
        if not field.doc:
            raise ValueError(f"{one.struct}::{field.name} has no sentence for {PAGE.name}")
        text = re.split(r"(?<=\w)\. |\.$", " ".join(field.sentence.split()))[0]
        text = text[0].lower() + text[1:] if text[1:2].islower() else text
        if field.type in self.enums:
            words = [f"`{name.replace('_', '-')}`" for name, _ in self.enums[field.type].values]
            text += f": {', '.join(words[:-1])} or {words[-1]}"
        keys = " ".join(f"`{prefix}.{key}`" for prefix in prefixes)
        return f"| {keys} | {self.kind(field.type)} | {text} |\n"

    def page(self) -> str:
        """The page with the rows of all objects, at the position of their first row."""
        lines = PAGE.read_text().splitlines(True)
        for one in OBJECTS:
            keys = one.keys(self.structs)
            # An object in several sections has rows in each of them.
            places: dict[int, list[str]] = {}
            for prefix in one.rows:
                here = {f"`{prefix}.{key}`" for key, _ in keys}
                found = [i for i, line in enumerate(lines)
                         if line.startswith("| `") and here & set(line.split(" | ")[0][2:].split())]
                if not found:
                    raise ValueError(f"{PAGE.name} has no row of {prefix}")
                places.setdefault(found[0], []).append(prefix)
                for i in found[1:]:
                    lines[i] = ""
            for i, prefixes in places.items():
                lines[i] = "".join(self.row(one, key, field, prefixes) for key, field in keys)
            lines = "".join(lines).splitlines(True)
        return "".join(lines)

    def files(self) -> dict[pathlib.Path, str]:
        headers = sorted({self.structs[one.struct].header for one in OBJECTS})
        declared, defined = "", ""
        for one in OBJECTS:
            call = f"json {one.name}(const tf::{one.struct}& from)"
            members = ", ".join(f'{{"{key}", {self.value(field)}}}'
                                for key, field in one.keys(self.structs))
            declared += f"[[nodiscard]] {call};\n"
            defined += f"{call} {{ return {{ {members} }}; }}\n\n"
        header = (GENERATED + "#pragma once\n/// \\file\n/// Fields of results, as reports have "
                  "them.\n\n#include \"tools/picture/json.hpp\"\n"
                  + "".join(f"#include <treeform/{name}>\n" for name in headers)
                  + "#include <treeform/tf.hpp>\n\nnamespace tools {\n\n" + declared
                  + "\n}  // namespace tools\n")
        source = (GENERATED + "#include \"tools/shell/made/report_fields.hpp\"\n\n"
                  "namespace tools {\nnamespace {\n\n"
                  "template <class T>\njson list_of(const std::vector<T>& values, json entry(const "
                  "T&)) {\n"
                  "json list = json::array();\nfor (const T& one : values) "
                  "list.push_back(entry(one));\n"
                  "return list;\n}\n\n}  // namespace\n\n" + defined + "}  // namespace tools\n")
        name = "tools/shell/made/report_fields"
        return {MADE / "report_fields.hpp": formatted(header, f"{name}.hpp"),
                MADE / "report_fields.cpp": formatted(source, f"{name}.cpp"), PAGE: self.page()}
