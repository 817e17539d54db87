"""Writes the blocks of the package, its stub, and the sources in tools/python/src/made."""

from __future__ import annotations

import ast
import pathlib
import re

from c_write import formatted
from headers import GENERATED, ROOT
from python_functions import FunctionWriter, public_names
from python_language import Function, Language, call_text
from python_stub import Stub

PACKAGE = ROOT / "tools/python/treeform"
MADE = ROOT / "tools/python/src/made"
#: Modules whose results are converted in `places.cpp`.
PLACES = ("_assembly", "_nearness", "_placement")
BLOCK = re.compile(r"^# made of (headers|names|uses)[^\n]*:\n"
                   r"((?:#   [^\n]+\n)*).*?^# end\n",
                   re.M | re.S)

#: The imports of the modules of the package, in this order.
USES = {"html": "", "os": "", "re": "", "shutil": "", "tempfile": "",
        "dataclasses": "dataclass replace", "functools": "partial",
        "typing": "IO Any Iterable List Mapping NamedTuple Sequence Union", "warnings": "warn",
        "numpy": "np", "numpy.typing": "ArrayLike NDArray", ".": "_arrays _core",
        "._arrays": "NONE Floats Ids path_of",
        "._errors": "FileError NotClosedError checked file_error need options require",
        "._files": "Columns Path",
        "._mesh": "MeshOrCloud HasCells HasFaces HasPolys HasTensors HasTriangles Mesh MeshLike "
                  "MeshResult as_mesh bodies each held held_body listed points_of",
        "._placement": "SearchEffort", "._progress": "Progress part", "._properties": "Feature",
        "._repair": "MadeMesh", "._results": "Certificate Result tuple_repr",
        "._steps": "Communicator InSteps in_communicator"}


def uses(text: str) -> str:
    """The imports of a module, and its `__all__`."""
    tree = ast.parse(text)
    used = {one.id for one in ast.walk(tree) if isinstance(one, ast.Name)}
    used -= {one.name for one in tree.body if isinstance(one, (ast.ClassDef, ast.FunctionDef))}
    used -= {one.id for one in ast.walk(tree)
             if isinstance(one, ast.Name) and isinstance(one.ctx, ast.Store)}
    groups: list[list[str]] = [[], [], []]
    for module, names in USES.items():
        there = [name for name in names.split() if name in used]
        group = groups[2 if module[0] == "." else module.startswith("numpy")]
        if not names and module in used:
            group.append(f"import {module}")
        elif there == ["np"]:
            group.append("import numpy as np")
        elif there:
            line = f"from {module} import {', '.join(there)}"
            group.append(line if len(line) <= 100 else
                         call_text(f"from {module} import (", there, ")"))
    names = call_text("__all__ = [", [f'"{name}"' for name in public_names(text)], "]")
    return "\n\n".join(["\n".join(one) for one in groups if one] + [names]) + "\n"


class Writer:
    def __init__(self, language: Language, options: dict[str, str], counters: dict[str, str],
                 states: dict[str, str], functions: list[Function]) -> None:
        self.states = states
        self.language, self.options, self.counters = language, options, counters
        self.functions = [one for one in functions if not one.body and not one.steps]
        self.package = FunctionWriter(language, options)
        self.by_name = {one.name: one for one in functions}
        self.classes = {one.name: one for one in reversed(language.results.values())}

    def package_file(self, path: pathlib.Path) -> str:
        """A file of the package with its blocks regenerated."""
        text = BLOCK.sub(self._block, path.read_text())
        return re.sub(r"(^# made of uses:\n).*?(?=^# end\n)", lambda m: m[1] + uses(text), text,
                      flags=re.M | re.S)

    def stub(self) -> str:
        return Stub(self.language, self.options, self.functions).text()

    def _block(self, found: re.Match[str]) -> str:
        kind, names = found.group(1), found.group(2).replace("#", " ").split()
        head = found.group(0)[:found.end(2) - found.start()]
        if kind == "uses":
            return found.group(0)
        if kind == "names":
            return head + self.package.exports() + "# end\n"
        made = []
        for name in names:
            if name in self.by_name:
                made.append(self.package.function(self.by_name[name], found.group(0)))
                continue
            of = self.classes[name]
            before = re.search(rf"^class {of.name}\(.*?(?=^\S)", found.group(0), re.M | re.S)
            order = re.findall(r"^    (\w+): ", before.group(0).rpartition('"""')[2], re.M) \
                if before else []
            made.append(self.language.class_text(of, order))
        return head + "\n\n".join(made) + "# end\n"

    def _calls(self, start: str, what: str, calls: list[Function]) -> str:
        text = start + "namespace {\n\n"
        text += "\n".join(self.language.function_code(one) for one in calls)
        return text + f"\n}}  // namespace\n\nvoid add_{what}(py::module_& module) {{\n" + "".join(
            f'add_job(module, "{one.name}", &{one.name}'
            f"{'' if one.kind == 'by_elements' else ', job_kind::' + one.kind});\n"
            for one in calls) + "}\n\n}  // namespace binding\n"

    def sources(self) -> dict[pathlib.Path, str]:
        enums = sorted(name for name in self.language.enums)
        first = GENERATED + "#pragma once\n\n"
        words = first + '#include "../words.hpp"\n\nnamespace binding {\n\n'
        for name in enums:
            values = self.language.enums[name].values
            words += (f"template <>\nstruct words_of<tf::{name}> {{\n"
                      f"static constexpr words<{len(values)}> all{{"
                      + ", ".join(f'"{value}"' for value, _ in values) + "};\n};\n")
        words += "\n}  // namespace binding\n"
        head = first + '#include "../fields.hpp"\n\nnamespace binding {\n\n' + "".join(
            self.language.declaration(one) for one in self.language.results.values())
        head += "\n" + "".join(f"py::dict counters(const tf::{name}& from);\n"
                                for name in self.counters)
        head += "\n}  // namespace binding\n"
        states = first + '#include "../base.hpp"\n\nnamespace binding {\n\n' + "\n".join(
            self.language.option_code(name, leave) for name, leave in self.states.items())
        states += "\n}  // namespace binding\n"
        start = GENERATED + '#include "../bindings.hpp"\n\nnamespace binding {\n\n'
        options = start + "\n".join(
            self.language.option_code(name, leave) for name, leave in self.options.items())
        options += "\nvoid add_options(py::module_& module) {\n" + "".join(
            self.language.option_class(name) for name in self.options)
        options += "}\n\n}  // namespace binding\n"
        of_places, results = (start + "\n".join(
            self.language.object_code(one) for one in self.language.results.values()
            if (one.module in PLACES) == places) for places in (True, False))
        of_places += "\n}  // namespace binding\n"
        results += "\n" + "\n".join(self.language.counters_code(name, leave)
                                    for name, leave in self.counters.items())
        results += "\n}  // namespace binding\n"
        calls = [one for one in self.functions if one.call]
        functions = self._calls(start, "functions", [one for one in calls if not one.context])
        operations = self._calls(start, "operations", [one for one in calls if one.context])
        made = {"words.hpp": words, "made.hpp": head, "options.cpp": options,
                "results.cpp": results, "places.cpp": of_places,
                "functions.cpp": functions, "operations.cpp": operations,
                "states.hpp": states}
        return {MADE / name: formatted(text, f"tools/python/src/made/{name}")
                for name, text in made.items()}
