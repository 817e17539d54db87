"""The functions of the C library: parameters, outputs and docstrings, from the C++ functions."""

from __future__ import annotations

import re

from c_language import NUMBERS, Language, List
from functions import Function

#: Types of parameters: the declaration in C, and the argument of the call. `{n}` is the name, `{c}`
#: the name of the count.
PARAMETERS = {
    "const mesh_ref&": ("const treeform_mesh* {n}", 'glue::ref({n}, "{n}")'),
    "mesh_view": ("const treeform_mesh* {n}", "glue::view({n})"),
    "points_view": ("const treeform_mesh* mesh", "glue::view(mesh).points"),
    "const mesh_refs&": ("const treeform_mesh* const* {n}, size_t {c}",
                         'glue::refs({n}, {c}, "{n}")'),
    "span<const string>": ("const char* const* {n}, size_t {c}", 'glue::texts({n}, {c}, "{n}")'),
    "span<const filesystem::path>": ("const char* const* {n}, size_t {c}",
                                     'glue::paths({n}, {c}, "{n}")'),
    "span<const point3>": ("const double* {n}, size_t {c}", 'glue::points({n}, {c}, "{n}")'),
    "span<const double> heights": ("const double* {n}, size_t {c}", "glue::heights({n}, {c})"),
    "span<const pair<point3,double>>": ("const double* {n}, size_t {c}",
                                        'glue::points_and_numbers({n}, {c}, "{n}")'),
    "span<const face_pair>": ("const treeform_face_pair* {n}, size_t {c}",
                              "glue::pairs_of(mesh, {n}, {c})"),
    "string_view": ("const char* {n}", 'std::string(&glue::need({n}, "{n}"))'),
    "const string&": ("const char* {n}", 'std::string(&glue::need({n}, "{n}"))'),
    "const filesystem::path&": ("const char* {n}", 'std::string(&glue::need({n}, "{n}"))'),
    "string_view format": ("const char* {n}", "glue::text({n})"),
    "string_view unit": ("const char* {n}", "glue::text({n})"),
    "const point2&": ("const double {n}[2]", 'glue::finite2({n}, "{n}")'),
    "const point3&": ("const double {n}[3]", 'glue::finite({n}, "{n}")'),
    "const array<double,3>&": ("const double {n}[3]", 'glue::three({n}, "{n}")'),
    "const transform<3>&": ("const double* {n}", "glue::matrix({n})"),
    "const oriented_plane&": ("const treeform_plane* {n}", "glue::plane({n})"),
    "const box3&": ("const treeform_box* {n}", 'glue::box(glue::need({n}, "{n}"))'),
    "const progress_callback&": ("treeform_progress {n}, void* {n}_data",
                                 "glue::progress({n}, {n}_data)"),
    "bool": ("int32_t {n}", "{n} != 0"),
}

#: The C++ types of the handles of C.
HANDLES = {"mesh_file": "file", "urdf_robot": "robot", "shared_search": "shared_search",
           "shared_weld": "shared_weld", "point_reader": "point_reader",
           "point_writer": "point_writer", "point_tree": "point_tree", "box_tree": "box_tree",
           "thread_scope": "thread_limit"}

#: Results that `glue::give` converts.
RESULTS = {"mesh": "treeform_made_mesh", "made_mesh": "treeform_made_mesh"}


class Functions:
    def __init__(self, language: Language, lists: list[List],
                 functions: dict[str, list[Function]]) -> None:
        self.language, self.functions = language, functions
        self.lists = {one.of: one.c for one in lists}

    def find(self, entry: str) -> tuple[str, Function]:
        """The name in C, and the C++ function, for "repair()", "intersections=mesh_intersections()"
        or "weld(file)", where `file` is the first parameter."""
        name, first = re.fullmatch(r"([\w=]+)\((\w*)\)", entry).groups()
        c, _, cpp = name.partition("=")
        for one in self.functions.get(cpp or c, []):
            if (not first or one.parameters[0][1] == first) and self._fits(one):
                return f"treeform_{c}", one
        raise ValueError(f"{entry}: no function that C could have")

    def _fits(self, function: Function) -> bool:
        try:
            self.parameters(function)
            self.result(function)
        except KeyError:
            return False
        return True

    def _parameter(self, type: str, name: str) -> tuple[str, str]:
        enum = self.language.enum(type)
        if enum and enum.startswith("treeform_"):
            count = len(self.language.enums[type].values)
            return f"{enum} {{n}}", f'glue::choice<tf::{type}>({{n}}, {count}, "{{n}}")'
        if found := re.fullmatch(r"const (\w+_options)&", type):
            bound = self.language.bound.get(found[1])
            if bound:
                return f"const {bound.c}* {{n}}", "glue::read({n})"
        if found := re.fullmatch(r"(const )?(\w+)&", type):
            return (f"{found[1] or ''}treeform_{HANDLES[found[2]]}* {{n}}",
                    'glue::content({n}, "{n}")')
        if found := re.fullmatch(r"span<const (\w+)>", type):
            if found[1] in NUMBERS:
                c = found[1]
                return f"const {c}* {{n}}, size_t {{c}}", 'glue::array({n}, {c}, "{n}")'
            c = self.language.bound[found[1]].c
            return (f"const {c}* {{n}}, size_t {{c}}",
                    f'glue::same_as<tf::{found[1]}>(glue::array({{n}}, {{c}}, "{{n}}"))')
        if re.match(r"(const )?(treeform_\w+|void|char|float|u?int\d+_t|double|size_t)\b", type):
            size = re.search(r"(\[\d+\])?$", type)[0]
            return f"{type.removesuffix(size)} {{n}}{size}", "{n}"  # as it is in C
        raise KeyError(type)

    def parameters(self, function: Function) -> tuple[list[str], list[str]]:
        """The parameters in C, and the arguments of the call."""
        declared: list[str] = []
        arguments: list[str] = []
        several = sum(type.startswith(("span<", "const mesh_refs&"))
                      for type, _, _ in function.parameters) > 1
        for type, name, default in function.parameters:
            key = f"{type} {name}"
            try:
                c, call = PARAMETERS.get(key) or PARAMETERS.get(type) or self._parameter(type, name)
            except KeyError:
                if default:
                    break
                raise
            names = {"n": name, "c": f"{name}_count" if several else "count"}
            declared.append(c.format(**names))
            arguments.append(call.format(**names))
        return declared, arguments

    def result(self, function: Function) -> tuple[str, str]:
        """The output parameter in C, and the code that sets it to the value `{}`."""
        type = function.returns
        optional = re.fullmatch(r"optional<(.+)>", type)
        inside = optional[1] if optional else type
        bound = self.language.bound.get(inside)
        if type == "void":
            return "", "{};"
        scalar = {**NUMBERS, "bool": "int32_t", "size_t": "size_t"}.get(type)
        if scalar or type in self.language.enums or type.startswith("treeform_"):
            c = scalar or self.language.enum(type) or type
            value = f"static_cast<{c}>({{}})" if type in self.language.enums else "{}"
            return f"{c}* result", f'(void)glue::need(result, "result");\n*result = {value};'
        if type == "write_result":
            give = "glue::give_written([&] {{ return {}; }}, written);"
            return "treeform_written** written", give
        if found := re.fullmatch(r"answer_of<(treeform_\w+)>", type):
            c = found[1]
        elif found := re.fullmatch(r"vector<(\w+)>", type):
            c = self.lists[found[1]]
        elif inside in RESULTS:
            c = RESULTS[inside]
        elif inside in HANDLES:
            c = f"treeform_{HANDLES[inside]}"
        elif bound and bound.kind == "part":
            c = self.lists[inside]
        elif bound and bound.kind == "result":
            c = bound.c
        else:
            raise KeyError(type)
        name = c.rpartition("_")[2]
        if c == "treeform_made_mesh" or name in [one for _, one, _ in function.parameters]:
            name = "made"
        value = "glue::as_list({})" if bound and bound.kind == "part" else "{}"
        return f"{c}** {name}", f"glue::start({name});\nreturn glue::give({value}, {name});"

    def prototype(self, entry: str) -> str:
        name, function = self.find(entry)
        declared = [*self.parameters(function)[0], self.result(function)[0]]
        return f"treeform_code {name}({', '.join(one for one in declared if one)})"

    def body(self, entry: str) -> str:
        _, function = self.find(entry)
        call = f"{function.space}::{function.name}({', '.join(self.parameters(function)[1])})"
        return (f"{self.prototype(entry)} {{\nreturn glue::guard([&] {{\n"
                f"{self.result(function)[1].format(call)}\n}});\n}}\n")
