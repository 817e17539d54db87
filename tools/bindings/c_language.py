"""The structs of the C library: their members, and the code that fills and reads them."""

from __future__ import annotations

import re
from dataclasses import dataclass, field

from headers import Enum, Field, Struct

#: Number types in C.
NUMBERS = {"double": "double", "uint8_t": "uint8_t", "uint32_t": "uint32_t", "unsigned": "uint32_t",
           "uint64_t": "uint64_t", "size_t": "uint64_t", "int": "int32_t", "int32_t": "int32_t"}


@dataclass
class Member:
    """A member of a C struct. In code, `from` is the C++ struct, `to` the C struct, `o` options."""

    decl: str  #: "double at[3]"
    doc: str = ""
    fill: str = ""  #: code from C++ to C
    read: str = ""  #: code from C to C++, for options
    default: str = ""  #: for options

    @property
    def name(self) -> str:
        return re.search(r"(?:\(\*)?(\w+)\)?(?:\[[^\]]*\])*(?:\(.*\))?$", self.decl).group(1)


@dataclass
class Bound:
    """A C++ struct in C."""

    cpp: str
    c: str = ""  #: name without "treeform_"; "": as in C++
    kind: str = ""  #: "options", "result" (has an owner), "part" (of others), "same" (bit for bit)
    names: dict[str, str] = field(default_factory=dict)  #: names that differ from C++
    counts: dict[str, str] = field(default_factory=dict)  #: of lists, if not "..._count"
    leave: str = ""  #: fields that are not in C
    custom: dict[str, list[Member]] = field(default_factory=dict)  #: by hand; "+": additional members

    def __post_init__(self) -> None:
        self.c = "treeform_" + (self.c or self.cpp)
        self.kind = self.kind or ("options" if self.cpp.endswith("_options") else "result")


def singular(name: str) -> str:
    for ending, one in (("boxes", "box"), ("meshes", "mesh"), ("ies", "y"), ("s", "")):
        if name.endswith(ending) and not name.endswith("ss"):
            return name[:-len(ending)] + one
    return name


class Language:
    """Translates all structs and enumerations."""

    def __init__(self, structs: dict[str, Struct], enums: dict[str, Enum], bound: list[Bound],
                 enum_names: dict[str, str]) -> None:
        self.structs, self.enums = structs, enums
        self.bound = {one.cpp: one for one in bound}
        self.enum_names = enum_names

    # ---- a field ----

    def members(self, of: Bound) -> list[Member]:
        """The members of a struct, in the order of C++."""
        made: list[Member] = []
        for one in self.structs[of.cpp].fields:
            made += self._member(of, one)
        return made + of.custom.get("+", [])

    def _member(self, of: Bound, one: Field, path: str = "") -> list[Member]:
        if one.name in of.custom:
            return of.custom[one.name]
        if one.name in of.leave.split() or one.name in ("status", "cancelled") \
                and one.name not in of.names:
            return []
        name = of.names.get(one.name, one.name)
        full = path + one.name
        if of.kind == "same":
            return [self._same(name, one)]
        if of.kind == "options":
            return self._option(of, name, one)
        return self._result(of, name, full, one)

    def enum(self, type: str) -> str:
        return self.enum_names.get(type, f"treeform_{type}") if type in self.enums else ""

    def _same(self, name: str, one: Field) -> Member:
        """The members of a struct with the same memory layout in C++ and C."""
        simple = {**NUMBERS, "size_t": "size_t", "bool": "uint8_t"}
        if one.type in self.enums:
            return Member(f"uint8_t {name}", one.doc + f" (a `{self.enum(one.type)}`)")
        if one.type in simple:
            return Member(f"{simple[one.type]} {name}", one.doc)
        arrays = {"point3": "[3]", "array<point3,2>": "[2][3]"}
        if one.type in arrays:
            return Member(f"double {name}{arrays[one.type]}", one.doc)
        if self.bound[one.type].kind == "same":
            return Member(f"{self.bound[one.type].c} {name}", one.doc)
        raise ValueError(f"{one.type} {name}: not the same in C")

    def _result(self, of: Bound, name: str, path: str, one: Field) -> list[Member]:
        type, source, to = one.type, f"from.{path}", f"to.{name}"
        numbers = {**NUMBERS, "bool": "int32_t", "size_t": "size_t"}
        if type in numbers:
            return [Member(f"{numbers[type]} {name}", one.doc, f"{to} = {source};")]
        if type in self.enums:
            c = self.enum(type)
            return [Member(f"{c} {name}", one.doc, f"{to} = static_cast<{c}>({source});")]
        sizes = {"point3": "[3]", "transform<3>": "[12]", "array<array<double,3>,3>": "[9]"}
        if type in sizes:
            return [Member(f"double {name}{sizes[type]}", one.doc, f"copy({source}, {to});")]
        if type == "array<point3,3>":
            return [Member(f"double {name}[3][3]", one.doc,
                           f"std::memcpy({to}, {source}.data(), sizeof {to});")]
        if found := re.fullmatch(r"(?:array<uint64_t|counts_by<\w+),(\w+)>", type):
            size = {"pair_kind_count": "7"}.get(found.group(1), found.group(1))
            return [Member(f"uint64_t {name}[{size}]", one.doc,
                           f"std::copy({source}.begin(), {source}.end(), {to});")]
        if found := re.fullmatch(r"optional<array<uint64_t,(\d)>>", type):
            return [Member(f"uint64_t {name}[{found.group(1)}]", one.doc,
                           f"if ({source}) std::copy({source}->begin(), {source}->end(), {to});")]
        simple = {"optional<double>": ("double", f"{source}.value_or(not_known)"),
                  "optional<uint32_t>": ("uint32_t", f"{source}.value_or(TREEFORM_NONE)"),
                  "box3": ("treeform_box", f"copied({source})"),
                  "mesh": ("treeform_arrays", f"arrays({source})"),
                  "string": ("const char*", f"{source}.c_str()")}
        if type in simple:
            c, value = simple[type]
            none = "; NaN: none" if type == "optional<double>" and "NaN" not in one.doc else ""
            doc = one.doc.rstrip(".") + none if none else one.doc
            return [Member(f"{c} {name}", doc, f"{to} = {value};")]
        if found := re.fullmatch(r"vector<(.+)>", type):
            return self._list(of, name, path, one, found.group(1))
        if found := re.fullmatch(r"optional<(\w+)>", type):
            c = self.bound[found.group(1)].c
            return [Member(f"const {c}* {name}", one.doc,
                           f"if ({source}) {to} = &filled<{c}>(kept, *{source});")]
        if type in self.bound:
            c = self.bound[type].c
            if self.bound[type].kind == "same":
                return [Member(f"{c} {name}", one.doc, f"{to} = same<{c}>({source});")]
            return [Member(f"const {c}* {name}", one.doc, f"{to} = &filled<{c}>(kept, {source});")]
        if type in self.structs:  # its fields, one by one
            made: list[Member] = []
            for inner in self.structs[type].fields:
                made += self._member(of, inner, path + ".")
            return made
        raise ValueError(f"{of.cpp}: {type} {name}: C has no such thing yet")

    def _list(self, of: Bound, name: str, path: str, one: Field, element: str) -> list[Member]:
        source, to = f"from.{path}", f"to.{name}"
        rows = {"point3": "double", "point2": "double", "face": "uint32_t",
                "array<uint32_t,2>": "uint32_t", "array<point3,2>": "double"}
        doc = one.doc
        count = of.counts.get(one.name, "" if one.shape else f"{singular(name)}_count")
        if element in NUMBERS or element == "uint8_t":
            c, value = NUMBERS[element], f"or_null({source})"
        elif element in rows:
            c, value = rows[element], f"flat({source})"
        elif element == "string":
            c, value = "char* const", f"words(kept, {source})"
        else:
            c = self.bound[element].c
            same = self.bound[element].kind == "same"
            value = f"same<{c}>({source})" if same else f"list<{c}>(kept, {source})"
        shape = {"point3": "[3]", "face": "[3]", "point2": "[2]", "array<uint32_t,2>": "[2]",
                 "array<point3,2>": "[2][3]"}.get(element, "")
        if one.shape:
            doc = re.sub(r"^(\[[^\]]+\])(?!\[)", rf"\1{shape}", doc)
        made = [Member(f"const {c}* {name}", doc, f"{to} = {value};")]
        if count:
            if not one.shape:
                made[0].doc = f"[{count}]{shape} {doc}"
            made.append(Member(f"size_t {count}", "", f"to.{count} = {source}.size();"))
        return made

    def _option(self, of: Bound, name: str, one: Field) -> list[Member]:
        type, how, o, to = one.type, f"how.{one.name}", f"o.{name}", f"to.{name}"
        source, doc = f"from.{one.name}", self._with_default(one)
        if type == "bool":
            return [Member(f"int32_t {name}", doc, "", f"{how} = {o} != 0;", f"{to} = {source};")]
        if type in NUMBERS:
            value = f"limit({o})" if type == "size_t" else o
            return [Member(f"{NUMBERS[type]} {name}", doc, "", f"{how} = {value};",
                           f"{to} = {source};")]
        if type in self.enums:
            c = self.enum(type)
            return [Member(f"{c} {name}", doc, "",
                           f'{how} = choice<tf::{type}>({o}, {len(self.enums[type].values)}, '
                           f'"{name}");', f"{to} = static_cast<{c}>({source});")]
        if type == "progress_callback":
            return [Member("treeform_progress progress", one.doc, "", f"{how} = progress(o);"),
                    Member("void* progress_data")]
        if type == "function<bool(string_view,double)>":
            return [Member("treeform_progress progress", "", "", f"{how} = step_progress(o);"),
                    Member("void* progress_data")]
        if type == "span<const uint32_t>":
            count = f"{singular(name)}_count"
            return [Member(f"const uint32_t* {name}", f"{doc.rstrip('.')}; or null", "",
                           f'{how} = array({o}, o.{count}, "{name}");'),
                    Member(f"size_t {count}")]
        if type == "span<const part_pair>":
            count = f"{singular(name)}_count"
            return [Member(f"const uint32_t* {name}", f"[{count}][2] {doc.rstrip('.')}; or null", "",
                           f'{how} = rows_of<tf::part_pair>({o}, o.{count}, "{name}");'),
                    Member(f"size_t {count}")]
        if found := re.fullmatch(r"vector<(string|filesystem::path|pair<string,string>|"
                                 r"weld_condition)>", type):
            c = {"pair<string,string>": "treeform_named_column",
                 "weld_condition": "treeform_weld_condition"}.get(found.group(1), "char* const")
            reader = {"string": "texts", "filesystem::path": "paths",
                      "pair<string,string>": "columns_of",
                      "weld_condition": "conditions"}[found.group(1)]
            count = of.counts.get(one.name, f"{singular(name)}_count")
            return [Member(f"const {c}* {name}", f"[{count}] {doc}", "",
                           f'{how} = {reader}({o}, o.{count}, "{name}");'),
                    Member(f"size_t {count}")]
        simple = {
            "point3": (f"double {name}[3]", f'point({o}, "{name}")', f"copy({source}, {to});"),
            "optional<double>": (f"double {name}", f"given({o})", f"{to} = not_known;"),
            "optional<point3>": (f"const double* {name}", f'point_if({o}, "{name}")', ""),
            "transform<3>": (f"const double* {name}", f"matrix({o})", ""),
            "string": (f"const char* {name}", f"text({o})", ""),
            "filesystem::path": (f"const char* {name}", f"text({o})", ""),
            "optional<box3>": (f"const treeform_box* {name}", f"box({o})", ""),
            "optional<array<double,3>>": (f"const double* {name}", f"axes({o})", ""),
            "pair_kinds": (f"uint32_t {name}", f"kinds({o})", f"{to} = TREEFORM_ALL_KINDS;"),
            "communicator": (f"const treeform_communicator* {name}", f"communicator_of({o})", "")}
        if type in simple:
            decl, value, default = simple[type]
            prefix = {"transform<3>": "[12] ", "optional<point3>": "[3] ",
                      "optional<array<double,3>>": "[3] "}.get(type, "")
            ending = "; or null" if "*" in decl and "char" not in decl else ""
            if type == "optional<double>" and "NaN" not in doc:
                ending = "; NaN: not given"
            said = f"{prefix}{doc.rstrip('.') if ending else doc}{ending}".strip("; ")
            said = said.replace("] ; ", "]; ")
            return [Member(decl, said, "", f"{how} = {value};", default)]
        if found := re.fullmatch(r"optional<(\w+)>", type):
            inner = found.group(1)
            if inner in self.enums:
                return [Member(f"int32_t {name}", self._optional_enum(doc, self.enum(inner)), "",
                               f"if ({o} != -1) {how} = choice<tf::{inner}>({o}, "
                               f'{len(self.enums[inner].values)}, "{name}");', f"{to} = -1;")]
        raise ValueError(f"{of.cpp}: {type} {name}: C has no such option yet")

    @staticmethod
    def _optional_enum(doc: str, enum: str) -> str:
        """The sentence for an option that is an enumerator or -1; none in C++ is -1."""
        said = re.sub(r"\bnone\b", "-1", doc)
        if said == doc:
            return f"{doc.rstrip('.')}; a `{enum}`, or -1 for the default"
        if said.startswith("-1"):
            return f"a `{enum}`; {said}"
        return said.replace("; -1", f" (a `{enum}`); -1", 1)

    def _with_default(self, one: Field) -> str:
        """The sentence for an option, with its default unless that is 0."""
        value = one.default
        if "infinity" in value:
            value = "infinite"
        elif "max()" in value or value == "static_cast<std::size_t>(-1)":
            value = "all"
        elif value == "true":
            value = "1"
        elif one.type in self.enums:
            word = value.rpartition("::")[2]
            value = "" if word == self.enums[one.type].values[0][0] else f"`{word}`"
        value = value.replace("'", "")
        if value in ("", "0", "0.0", "false") or "::" in value or "default" in one.doc.lower():
            return one.doc
        doc = one.doc.rstrip(".")
        return f"{doc}; default {value}" if doc else f"default {value}"


@dataclass
class List:
    """A list that a function returns."""

    of: str
    c: str
    name: str
    doc: str

    def __post_init__(self) -> None:
        self.c = "treeform_" + self.c

    @property
    def element(self) -> str:
        return {"uint32_t": "std::uint32_t", "double": "double", "string": "std::string"}.get(
            self.of, f"tf::{self.of}")
