"""Describes the Python package: classes of results, options, functions."""

from __future__ import annotations

import re
import textwrap
from dataclasses import dataclass, field

from headers import Enum, Field, Struct

NUMBERS = {"double": "float", "bool": "bool", "int": "int", "unsigned": "int", "size_t": "int",
           "uint8_t": "int", "uint32_t": "int", "uint64_t": "int", "int32_t": "int",
           "array<double,2>": "tuple[float, float]",
           "array<uint64_t,3>": "tuple[int, int, int]"}
#: Types that become arrays: annotation and shape.
ARRAYS = {"point3": ("Floats", "(3,)"), "transform<3>": ("Floats", "(4, 4)"),
          "array<array<double,3>,3>": ("Floats", "(3, 3)"), "box3": ("Floats", "(2, 3)"),
          "array<point3,2>": ("Floats", "(2, 3)"), "array<point3,3>": ("Floats", "(3, 3)"),
          "vector<uint32_t>": ("Ids", "({},)"),
          "vector<double>": ("Floats", "({},)"), "vector<point3>": ("Floats", "({}, 3)"),
          "vector<face>": ("Ids", "({}, 3)"), "vector<operand_element>": ("Ids", "({}, 2)")}

#: Types of columns: annotation, and the rest of the shape after n.
ROWS = {"double": ("Floats", ","), "point3": ("Floats", ", 3"), "uint32_t": ("Ids", ","),
        "optional<uint32_t>": ("Ids", ",")}


#: What results are created with, as parameters of C++.
CONTEXTS = {"": "", "attributes": ", const carrying& attributes",
            "moving": ", const held_mesh& moving", "data": ", const file_data* data",
            "parts": ", const held_meshes& parts", "whole": ", const tf::section_result& whole",
            "cloud": ", tf::points_view cloud", "robot": ", const tf::urdf_robot& robot",
            "robot_parts": ", std::vector<tf::urdf_mesh>& parts"}


@dataclass
class Attribute:
    """An attribute of a result. `code` is its value, where `from` is the C++ struct."""

    name: str
    annotation: str
    doc: str
    code: str
    default: str = ""


@dataclass
class Result:
    """A C++ struct as a class of Python."""

    cpp: str
    name: str
    module: str  #: "_cuts"
    base: str = "Result"
    doc: str = ""  #: "": the docstring of C++
    names: dict[str, str] = field(default_factory=dict)
    leave: str = ""
    inherited: str = ""  #: fields of the base class
    context: str = ""  #: a key of `CONTEXTS`
    custom: dict[str, list[Attribute]] = field(default_factory=dict)  #: "+": additional ones
    docs: dict[str, str] = field(default_factory=dict)
    true: str = ""  #: the condition for `bool()`; "": always true
    rows: str = ""  #: of a list with a column for each field: "tf::{}", "std::optional<tf::{}>"

    @property
    def is_tuple(self) -> bool:
        return self.base == "NamedTuple"


@dataclass
class Function:
    """A function of the extension, `cut(mesh: Mesh, ..., options: cut_options) -> CutPieces`, and
    its C++ call. The function of the package with this name takes the same arguments, with
    defaults, and each option as a keyword argument. Options in parentheses are positional."""

    declared: str
    call: str = ""  #: "": it is in `src/*.cpp`, or has a `body`
    context: str = ""  #: the argument whose attributes are carried over, or that is moved
    kind: str = "by_elements"  #: `job_kind`
    # of the package
    pieces: str = ""  #: the number of elements, of which a call handles those from `begin` to `end`
    #: Raises NotCertifiedError if the certificate is not ok; for a "solid" or "solids", also
    #: NotClosedError if a mesh is open. For several operands: "solids", "meshes".
    check: str = ""
    missing: str = ""  #: the message of ValueError instead of None
    made: str = ""  #: what the package returns, if not the result of the call
    value: str = "{}"
    body: str = ""  #: Python only: the returned expression, where `how` are the options
    given: str = ""  #: options computed from other arguments, `size=size_of(size)`
    leave: str = ""  #: options that it does not take
    words: dict[str, str] = field(default_factory=dict)  #: parameters of C++, and those of Python
    cpp: str = ""  #: "f" or "f in header" that has the docstring; "": that of the call
    doc: str = ""  #: replaces the description of C++
    also: str = ""  #: is added to the description
    docs: dict[str, str] = field(default_factory=dict)  #: sentences about arguments
    progress: bool = True  #: whether it takes `progress`
    steps: str = ""  #: for a class: the class of the extension that does its work in steps

    @property
    def name(self) -> str:
        return self.declared.partition("(")[0]

    @property
    def arguments(self) -> list[tuple[str, str, str, list[str]]]:
        """Names, types, defaults, positional options."""
        inside = self.declared[self.declared.index("(") + 1:self.declared.rindex(") -> ")]
        made = []
        for one in re.split(r", (?=\*{0,2}\w+: |\*)", inside):
            declared, _, default = one.partition(" = ")
            name, _, type = declared.partition(": ")
            type, _, first = type.rstrip(")").partition("(")
            made.append((name, type, default, first.split(", ") if first else []))
        return made

    @property
    def parameters(self) -> list[tuple[str, str]]:
        return [(name.strip("*"), type) for name, type, *_ in self.arguments
                if type in ARGUMENTS or re.fullmatch(r"[a-z]+(_[a-z]+)*", type)]

    @property
    def returns(self) -> str:
        return self.declared.rpartition(" -> ")[2]


#: Types of arguments: in C++, in the stub, in the call; in the package, and the conversion there.
ARGUMENTS = {
    "Mesh": ("const held_mesh&", "HeldMesh", "{}.ref()", "MeshLike", "held({})"),
    "MeshOrCloud": ("const held_mesh&", "HeldMesh", "{}.ref()", "MeshOrCloud", "held_body({})"),
    "Meshes": ("const held_meshes&", "Sequence[HeldMesh]", "refs_of({})", "Iterable[MeshLike]",
               'each({0}, "{0}", held)'),
    "Parts": ("const held_meshes&", "Sequence[HeldMesh]", "refs_of({})", "Iterable[MeshOrCloud]",
              'each({0}, "{0}")'),
    "Operands": ("const held_meshes&", "Sequence[HeldMesh]", "refs_of({})", "MeshesLike",
                 "operands_of({})"),
    "Bodies": ("const held_meshes&", "Sequence[HeldMesh]", "refs_of({})", "Any", "bodies({})"),
    "Vector": ("const array_of<double>&", "Floats", "point_of({})", "ArrayLike",
               '_arrays.vector({0}, "{0}")'),
    "Matrix": ("const array_of<double>&", "Floats", "transform_of({})", "ArrayLike | None",
               '_arrays.matrix({0}, "{0}")'),
    "Points": ("const points_array&", "Floats", "points_of({})", "ArrayLike",
               '_arrays.points({0}, "{0}")'),
    "Cloud": ("const points_array&", "Floats", "points_of({})", "MeshOrCloud", "points_of({})"),
    "Numbers": ("const array_of<double>&", "Floats", "rows_of<double>({})", "ArrayLike",
                '_arrays.floats({0}, "{0}")'),
    "Levels": ("const array_of<double>&", "Floats", "rows_of<double>({})", "ArrayLike",
               'np.atleast_1d(_arrays.floats({0}, "{0}"))'),
    "Groups": ("const ids_array&", "Ids", "rows_of<std::uint32_t>({})", "ArrayLike | None",
               '_arrays.labels({0}, "{0}")'),
    "File": ("const std::filesystem::path&", "str", "{}", "Path", "path_of({})"),
    "Folders": ("const std::vector<std::filesystem::path>&", "list[str]", "{}", "Iterable[Path]",
                '_arrays.paths({0}, "{0}")'),
    "Feature": ("const tf::mesh_feature&", "Feature", "{}", "Feature",
                'need({0}, "{0}", Feature)'),
    "PairIds": ("const ids_array&", "Ids", "{}", "", ""),
    "Kinds": ("const array_of<std::uint8_t>&", "Bytes", "{}", "", ""),
    "Words": ("const std::vector<std::string>&", "list[str]", "{}", "", ""),
    "Heights": ("const array_of<double>&", "Floats", "rows_of<double>({})", "ArrayLike | None",
                "heights_of({})"),
    "Drains": ("const array_of<double>&", "Floats", "points_and_numbers({})", "ArrayLike",
               "drains_of({})"),
    "Poses": ("const array_of<double>&", "Floats", "transforms_of({})", "ArrayLike | None",
              'poses_of({0}, "{0}")'),
    "Chosen": ("const ids_array&", "Ids", "rows_of<std::uint32_t>({})", "ArrayLike",
               "chosen_of(mesh, {})"),
    "Pairs": ("const ids_array&", "Ids", "rows_of<tf::part_pair>({})", "", ""),
    **{type: (cpp, type, "{}", type, f'_arrays.{convert}({{0}}, "{{0}}")')
       for type, cpp, convert in (
           ("float", "double", "number"), ("int", "std::size_t", "whole"), ("bool", "bool", "flag"),
           ("str", "const std::string&", "word"))},
}


def camel(name: str) -> str:
    return "".join(part.capitalize() for part in name.split("_"))


class Language:
    def __init__(self, structs: dict[str, Struct], enums: dict[str, Enum], results: list[Result],
                 words: dict[str, str]) -> None:
        self.structs, self.enums, self.words = structs, enums, words
        self.results = {one.cpp: one for one in results}

    # ---- results ----

    def attributes(self, of: Result) -> list[Attribute]:
        made: list[Attribute] = []
        for one in self.structs[of.cpp].fields:
            made += self._attribute(of, one, "")
        return made + of.custom.get("+", [])

    def _attribute(self, of: Result, one: Field, path: str) -> list[Attribute]:
        if one.name in of.custom:
            return of.custom[one.name]
        if one.name in of.leave.split() or one.name in ("status", "cancelled"):
            return []
        name, source = of.names.get(one.name, one.name), f"from.{path}{one.name}"
        type = one.type
        context = f", {of.context}" if of.context else ""
        doc = of.docs.get(name) or self.sentence(one)
        if of.rows:
            kind, width = ROWS[type]
            shape = f"(n{width})"
            return [Attribute(name, kind, doc if doc.startswith(shape) else f"{shape} {doc}",
                              f"column(from, &tf::{of.cpp}::{one.name})")]
        if type == "mesh":
            return [Attribute(name, "Mesh", doc,
                              f"mesh_object(std::move({source}), certificate, data)")]
        if type == "certificate":
            return [Attribute(name, "Certificate", doc, "certificate")]
        if type.startswith("vector<") and (inner := type[7:-1]) in self.results:
            return [Attribute(name, f"list[{self.results[inner].name}]", doc,
                              f"as_python(std::move({source}){context})")]
        if type in self.structs and type not in self.results and type not in ARRAYS:
            if name in ("statistics", "steps"):
                counts = [(inner.name, self.sentence(inner).rstrip("."))
                          for inner in self.structs[type].fields]
                doc += " Keys: " + "; ".join(f"'{key}'{text and f' ({text})'}"
                                             for key, text in counts) + "."
                return [Attribute(name, "dict[str, Any]", doc, f"counters({source})")]
            made: list[Attribute] = []
            for inner in self.structs[type].fields:
                made += self._attribute(of, inner, f"{path}{one.name}.")
            return made
        return [Attribute(name, self.annotation(type), doc, f"as_python(std::move({source}))")]

    def counters_code(self, name: str, leave: str) -> str:
        fields = [one.name for one in self.structs[name].fields if one.name not in leave.split()]
        return (f"py::dict counters(const tf::{name}& from) {{\npy::dict made;\n"
                + "".join(f'made["{one}"] = from.{one};\n' for one in fields)
                + "return made;\n}\n")

    def annotation(self, type: str) -> str:
        if type in NUMBERS:
            return NUMBERS[type]
        if type in self.enums or type == "string":
            return "str"
        if type == "vector<string>":
            return "list[str]"
        if type in ARRAYS:
            return ARRAYS[type][0]
        if type in self.results:
            return self.results[type].name
        if found := re.fullmatch(r"optional<(.+)>", type):
            return f"{self.annotation(found.group(1))} | None"
        raise ValueError(f"{type}: there is no type for it in Python")

    def words_of(self, type: str) -> str:
        """The values of an enumeration with up to six, such as "'none', 'quarter' or 'any'"."""
        words = [f"'{value}'" for value, _ in self.enums[type].values] if type in self.enums else []
        return f"{', '.join(words[:-1])} or {words[-1]}" if 1 < len(words) < 7 else ""

    def sentence(self, one: Field, has_words: bool = True) -> str:
        """The sentence about a field, with its shape and its possible values."""
        text = one.sentence
        shape = ARRAYS.get(one.type.removeprefix("optional<").removesuffix(">"), ("", ""))[1]
        if one.type in ARRAYS:
            shape = ARRAYS[one.type][1]
        if not text:
            return ""
        text = re.sub(r"`?\bnone\b`?(?=:)", "`NONE`", text)
        for before, after in self.words.items():
            text = text.replace(before, after)
        if "uint32_t" in one.type:
            text = re.sub(r"\b(else|or) none\b", r"\1 `NONE`", text)
        if has_words and (words := self.words_of(one.type)):
            text = f"{text.rstrip('.')}: {words}".lstrip(": ")
        if shape and text:
            text = f"{shape.format(one.shape or 'n')} {text}"
        elif text:
            text = text[0].upper() + text[1:]
        return text if not text or text.endswith((".", ":")) else text + "."

    def class_text(self, of: Result, order: list[str]) -> str:
        """The code of the class."""
        own = [one for one in self.attributes(of) if one.name not in of.inherited.split()]
        place = {name: i for i, name in enumerate(order)}
        own.sort(key=lambda one: (bool(one.default), place.get(one.name, len(order))))
        head = "" if of.is_tuple else "@dataclass(frozen=True, repr=False)\n"
        text = f"{head}class {of.name}({of.base}):\n"
        doc = of.doc or self.structs[of.cpp].doc
        if not doc:
            raise ValueError(f"{of.cpp} has no docstring")
        lines = wrapped(doc, 4, '"""')
        for one in own:
            if one.name.startswith("_"):
                continue
            if not one.doc:
                raise ValueError(f"{of.cpp}::{one.name} has no sentence")
            lines += ([""] if one is own[0] else []) + wrapped(f"{one.name}: {one.doc}", 8, "", 4)
        text += "\n".join(lines) + '\n    """\n\n'
        for one in own:
            text += f"    {one.name}: {one.annotation}{one.default and ' = ' + one.default}\n"
        if of.true:
            text += f"\n    def __bool__(self) -> bool:\n        return {of.true}\n"
        if of.is_tuple:
            text += "\n    def __repr__(self) -> str:\n        return tuple_repr(self)\n"
        return text

    def object_code(self, of: Result) -> str:
        """The C++ function that creates an object of the class."""
        attributes = self.attributes(of)
        text = self.declaration(of)[:-2] + " {\n"
        codes = [one.code for one in attributes]
        if "certificate" in " ".join(codes) and any(
                one.name == "certificate" for one in self.structs[of.cpp].fields):
            text += "const py::object certificate = as_python(tf::certificate(from.certificate));\n"
        elif any("certificate" in code for code in codes):
            text += "const py::object certificate = py::none();\n"
        if any("data)" in code for code in codes):
            value = {"attributes": "data_of(from, attributes)", "": "py::none()"}.get(of.context)
            text += f"const py::object data = {value};\n" if value else ""
        text += "py::dict made;\n"
        # What a function of the struct computes comes before its fields are moved away.
        for one in sorted(attributes, key=lambda one: not re.search(r"\bfrom\.\w+\(", one.code)):
            text += f'made["{one.name}"] = {one.code};\n'
        return text + f'return object_of("treeform.{of.module}", "{of.name}", made);\n}}\n'

    def declaration(self, of: Result) -> str:
        type = f"std::vector<{of.rows}>" if of.rows else "tf::{}"
        return (f"py::object object(of_result, {type.format(of.cpp)}&& from"
                f"{CONTEXTS[of.context]});\n")

    # ---- options ----

    def option_fields(self, name: str, leave: str) -> list[Field]:
        return [one for one in self.structs[name].fields if one.name not in leave.split()
                and "progress" not in one.type and "function<" not in one.type]

    def option_code(self, name: str, leave: str) -> str:
        text = f"template <class Visit>\nvoid each_field(tf::{name}& how, const Visit& visit) {{\n"
        for one in self.option_fields(name, leave):
            text += f'visit("{one.name}", how.{one.name});\n'
        return text + "}\n"

    def option_class(self, name: str) -> str:
        return f'add_options_of<tf::{name}>(module, "{camel(name)}");\n'

    def option_stub(self, name: str, leave: str) -> str:
        arguments = ["self", "*"]
        for one in self.option_fields(name, leave):
            type = {"pair_kinds": "Optional[list[str]]", "filesystem::path": "str",
                    "vector<string>": "list[str]", "vector<weld_condition>": "Same",
                    "vector<filesystem::path>": "list[str]",
                    "vector<pair<string,string>>": "Optional[Mapping[str, str | int]]",
                    "optional<array<double,3>>": "Optional[Sequence[float]]",
                    "optional<array<double,2>>": "Optional[Sequence[float]]"}.get(one.type)
            type = type or self.annotation(one.type)
            if type.endswith(" | None"):
                type = f"Optional[{type[:-7]}]"
            if type == "int":
                type = "Optional[int]"
            arguments.append(f"{one.name}: {type} = ...")
        text = f"class {camel(name)}:\n    names: tuple[str, ...]\n"
        text += "    defaults: dict[str, Any]\n"
        return text + call_text("    def __init__(", arguments, ") -> None: ...") + "\n\n"

    # ---- functions ----

    def function_code(self, one: Function) -> str:
        parameters = []
        call, pieces = one.call, one.pieces
        how = ""
        for name, type in one.parameters:
            cpp, _, value = ARGUMENTS.get(type, ("", "", "{}", "", ""))[:3]
            if type in self.structs:
                cpp, value, how = f"tf::{type}", "{}", name
            elif type in self.enums:
                cpp = "const std::string&"
                value = f'choice<tf::{type}>("{name}", words_of<tf::{type}>::all, {{}})'
            parameters.append(f"{cpp}{'' if cpp.endswith('&') else ' '}{name}")
            call = call.replace(f"${name}", value.format(name))
            pieces = pieces.replace(f"${name}", value.format(name))
        text = f"py::object {one.name}({', '.join(parameters)}) {{\n"
        context = f", {one.context}" if one.context else ""
        if one.context.startswith("attributes of "):
            operand = one.context[len("attributes of "):]
            many = dict(one.parameters)[operand] in ("Meshes", "Operands")
            text += f"carrying attributes({operand if many else '{&' + operand + '}'});\n"
            text += f"attributes.keep_apart({how});\n" if how else ""
            context = ", attributes"
        if pieces:
            return text + (f"return as_python(in_pieces({pieces}, [&](std::size_t begin, "
                           f"std::size_t end) {{\nreturn {call};\n}}){context});\n}}\n")
        if one.returns == "None":
            text = text.replace("py::object", "void", 1)
            return text + f"without_lock([&] {{ {call}; }});\n}}\n"
        report = bool(how) and any("progress" in f.type for f in self.structs[dict(
            one.parameters)[how]].fields)
        text += f"return as_python(run([&](const tf::progress_callback&" \
                f"{' report' if report or 'report' in call else ''}) {{\n"
        if report:
            text += f"{how}.progress = report;\n"
        return text + f"return {call};\n}}){context});\n}}\n"

    def function_stub(self, one: Function) -> str:
        arguments = []
        for name, type in one.parameters:
            stub = ARGUMENTS[type][1] if type in ARGUMENTS else ""
            if type in self.structs:
                stub = camel(type)
            elif type in self.enums:
                stub = "str"
            arguments.append(f"{name}: {stub}")
        return call_text(f"def {one.name}(", [*arguments, "progress: Watched = ..."],
                     f") -> {one.returns}: ...") + "\n"


def wrapped(text: str, indent: int, front: str, first: int | None = None) -> list[str]:
    lines: list[str] = []
    for i, part in enumerate(text.split("\n\n")):
        lines += ([""] if i else []) + textwrap.wrap(
            part, 100, initial_indent=" " * (indent if first is None else first)
            + (front if i == 0 else ""), subsequent_indent=" " * indent,
            break_long_words=False, break_on_hyphens=False)
    return lines


def call_text(front: str, arguments: list[str], end: str, width: int = 100) -> str:
    """A declaration or call, on several lines if necessary."""
    if not arguments:
        return front + end
    lines, line = [], front
    for i, one in enumerate(arguments):
        piece = one + (", " if i + 1 < len(arguments) else end)
        if len(line + piece.rstrip()) > width:
            lines.append(line.rstrip())
            line = " " * len(front)
        line += piece
    return "\n".join([*lines, line])
