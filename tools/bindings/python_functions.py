"""Generates the functions of the package: signature, docstring and call. The docstring is that of
the C++ header, without sentences about C++ only, followed by the example from the existing
docstring."""

from __future__ import annotations

import ast
import re

from headers import FOLDERS, ROOT, Field
from python_language import ARGUMENTS, Function, Language, call_text, camel, wrapped

#: Exceptions of C++, and those of Python.
_ERRORS = {r"std::(invalid_argument|length_error)": "ValueError",
           r"\bio_error": "FileError", "std::overflow_error": "OverflowError"}
#: Annotations of options whose C++ default cannot be written in Python.
_OPTIONAL = {"vector<pair<string,string>>": "Columns | None",
             "optional<array<double,3>>": "Sequence[float] | None",
             "optional<point3>": "ArrayLike | None", "transform<3>": "ArrayLike | None",
             "pair_kinds": "Iterable[str] | None",
             "optional<array<double,2>>": "tuple[float, float] | None",
             "vector<weld_condition>": "Mapping[str, float] | None"}
_EMPTY = {"string": ("str", '""'), "filesystem::path": ("Path", '""'),
          "vector<string>": ("Iterable[str]", "()")}
_OPEN = {"solid": "NotClosedError if the mesh is open, ",
         "repaired": "NotClosedError if the mesh stays open, ",
         "solids": "NotClosedError if an operand is open, "}
_NOT_CERTIFIED = "NotCertifiedError if the result could not be certified"
_CHECK = "if False, also return results that could not be certified; see their `certificate`."


def read_docs() -> dict[str, str]:
    """The docstrings of the public C++ functions, without `///`; of overloads, the first one."""
    docs: dict[str, str] = {}
    for folder in FOLDERS:
        for path in sorted((ROOT / folder).glob("*.hpp")):
            comment: list[str] = []
            code = ""
            for line in path.read_text().splitlines():
                if line.startswith("///") and not code:
                    comment.append(line[4:])
                    continue
                code += f" {line}" if comment or code else ""
                found = re.match(r"[^({=]*?[\w>&] (\w+)\(", re.sub(r"requires .*?> ", "", code))
                if not line.strip() or found or code.rstrip().endswith((";", "}")):
                    if found and comment:
                        for name in (found[1], f"{found[1]} in {path.stem}"):
                            docs.setdefault(name, "\n".join(comment))
                    comment, code = [], ""
    return docs


def public_names(text: str) -> list[str]:
    """The public names of a module: generated functions and classes, other classes, values with a
    comment (`#:`), and functions with an example; or its own `__all__`."""
    said = re.search(r"^__all__ = (\[[^\]]*\])", text, re.M)
    if "# made of uses:" not in text:
        return sorted(ast.literal_eval(said[1])) if said else []
    names = set(re.findall(r"^#: .*\n([A-Z]+) = ", text, re.M))
    made = re.compile(r"^# made of headers:\n((?:#   [^\n]*\n)+).*?^# end$", re.M | re.S)
    names |= set(re.findall(r"\w+", " ".join(made.findall(text))))
    for one in ast.parse(made.sub("class _:\n    pass", text)).body:  # methods may follow
        if isinstance(one, ast.ClassDef) or (isinstance(one, ast.FunctionDef)
                                             and ">>> " in (ast.get_docstring(one) or "")):
            names.add(one.name)
    return sorted(name for name in names if name[0] != "_")


class FunctionWriter:
    def __init__(self, language: Language, options: dict[str, str]) -> None:
        self.language, self.options = language, options
        self.docs = read_docs()
        self.public = {"_core": ["Attributes"]}
        for path in sorted((ROOT / "tools/python/treeform").glob("_[a-z]*.py")):
            if names := public_names(path.read_text()):
                self.public[path.stem] = names
        self.known = set(sum(self.public.values(), [])) | {
            one.name for of in language.results.values() for one in language.attributes(of)} | {
            name for enum in language.enums.values() for name, _ in enum.values} | {
            one.name for one in language.structs["certificate"].fields}
        self.option_names = {"options"} | {
            one.name for name in options for one in language.structs[name].fields} - self.known

    def exports(self) -> str:
        """The exports of the package: the public names of its modules."""
        text = ""
        for module, names in self.public.items():
            line = f"from .{module} import {', '.join(names)}"
            text += (line if len(line) <= 100 else call_text(
                f"from .{module} import (", names, ")")) + "\n"
        all = sorted(f'"{name}"' for name in [*sum(self.public.values(), []), "__version__"])
        return text + "\n" + call_text("__all__ = [", all, "]") + "\n"

    # ---- words ----

    def _token(self, found: re.Match[str]) -> str:
        name = found[1]
        owner, _, field = name.partition("::")
        if owner in self.language.results:
            name = ".".join(filter(None, (self.language.results[owner].name, field)))
        if owner in self.language.enums and field:
            return f"'{field}'"
        if field and owner.endswith("_options"):
            name = field
        elif name.endswith("_options"):
            name = name.removesuffix("_options")
        elif name.endswith("_statistics"):
            name = "statistics"
        return f"`{name}`"

    def said(self, text: str, names: set[str], own: str = "") -> str:
        """`text` in words of Python, without sentences that name what Python does not have."""
        text = re.sub(r"^\[([^\]]+)\] ", lambda m: f"({m[1]},) ", text)
        for before, after in self.language.words.items():
            text = text.replace(before, after)
        text = re.sub(r"\btreeform::", "", text)
        text = re.sub(rf"\b(?:those|as) of `{own}_options`", "`options`", text) if own else text
        text = re.sub(r"`?\bnone\b`?(?=:)|\b(?<=else )none\b", "`NONE`", text)
        text = re.sub(r"`(?:options\.)?([\w:]+)`", self._token, text)

        def is_known(token: str) -> bool:
            last = token.rpartition(".")[2]
            return last in names or (last not in self.option_names and (
                last in self.known or not re.search(r"_|::|\(", last)))

        text = re.sub(r" \(`([^`]+)`\)", lambda m: m[0] if is_known(m[1]) else "", text)
        kept = []
        for one in re.split(r"(?<=[.;])\s+(?=[A-Z`\[(]|for |if |naming )", text):
            if all(map(is_known, re.findall(r"`([^`]*)`", one))):
                kept.append(one)
        made = " ".join(kept).strip()
        return made[:-1] + "." if made.endswith(";") else made

    def _paragraphs(self, one: Function, names: set[str]) -> tuple[list[str], list[str], str]:
        """From the C++ docstring: the description, the exceptions, the cost."""
        name = one.cpp or (re.findall(r"tf::(\w+)\(", one.call) or [one.name])[0]
        text = self.docs[name] if not one.doc or name in self.docs else ""
        body, *tags = re.split(r"\n?^\\(?=\w)", text, flags=re.M)
        for before, after in one.words.items():
            body = body.replace(f"`{before}`", f"`{after}`")
        said = [one.doc] if one.doc else [
            self.said(" ".join(part.split()), names, one.name)
            for part in re.split(r"\n\n|\n(?=- )", body)]
        if one.missing:
            said = [part.replace("None if ", "Raises ValueError if ") for part in said]
        raises: list[str] = []
        cost = ""
        for tag in tags:
            kind, _, rest = " ".join(tag.split()).partition(" ")
            if kind == "throws":
                for there, here in _ERRORS.items():
                    rest = re.sub(there, here, rest)
                what = self.said(rest, names)
                raises += [what.rstrip(".")] if " " in what and what[0].isupper() else []
            elif kind == "cost":
                cost = self.said(rest, names)
        return [part for part in [*said, one.also] if part], raises, cost

    # ---- arguments ----

    def _option(self, field: Field) -> tuple[str, str]:
        """The annotation and default of an option."""
        type, default = field.type, field.default.rpartition("treeform::")[2]
        if type in _OPTIONAL:
            return _OPTIONAL[type], "None"
        if type in _EMPTY:
            return _EMPTY[type]
        if type == "point3":
            return "ArrayLike", f"({default or '0.0, 0.0, 0.0'})".replace(
                "std::numeric_limits<double>::infinity()", "np.inf")
        annotation = self.language.annotation(type)
        if annotation.endswith("None"):
            return annotation, "None"
        if "max()" in default or "(-1)" in default:
            return f"{annotation} | None", "None"
        if "infinity()" in default:
            return annotation, "np.inf"
        if type in self.language.enums:
            return "str", f'"{default.rpartition("::")[2]}"'
        return annotation, {"true": "True", "false": "False"}.get(
            default, default.replace("'", "_"))

    def text(self, one: Function, example: str) -> str:
        """The code of the function."""
        language = self.language
        names = {name for name, *_ in one.arguments}
        signature, last, values = [], [], []
        notes = dict(one.docs)
        taken = {name for name, _ in one.parameters}
        how = ""

        def only_by_name() -> None:
            if not any(part.startswith("*") for part in signature):
                signature.append("*")

        for name, type, default, first in one.arguments:
            if name == "*":
                only_by_name()
            elif type in language.structs:
                how = camel(type)
                fields = {f.name: f for f in language.option_fields(
                    type, f"{self.options[type]} {one.leave}")}
                names |= set(fields)
                for option in [*first, "*", *(f for f in fields if f not in first)]:
                    if option == "*":
                        only_by_name()
                        continue
                    annotation, value = self._option(fields[option])
                    signature.append(f"{option}: {annotation} = {value}")
                    notes.setdefault(option, self._note(fields[option], annotation, names))
                    if not notes[option]:
                        raise ValueError(f"{one.name}: the option {option} has no sentence")
                values.append("how")
            else:
                plain = name.strip("*")
                annotation, value = ARGUMENTS["str" if type in language.enums else type][3:] \
                    if type in language.enums or type in ARGUMENTS else (type, "{}")
                if default == "None" and "None" not in annotation and annotation != "Any":
                    annotation += " | None"
                (last if name.startswith("**") else signature).append(
                    f"{name}: {annotation}{default and ' = ' + default}")
                if plain in taken:
                    values.append(value.format(plain))
        if one.progress:
            only_by_name()
            last.insert(0, "progress: Progress = None")
        if one.check:
            signature.append("check: bool = True")
            notes["check"] = _CHECK
        signature += last
        returns = one.made or re.sub(r"Optional\[(.+)\]$", r"\1 | None", one.returns)
        if one.missing:
            returns = returns.removesuffix(" | None")
        text = f"class {one.name}(InSteps[_core.{one.steps}]):\n" if one.steps else \
            call_text(f"def {one.name}(", signature, f") -> {returns}:") + "\n"
        said, raises, cost = self._paragraphs(one, names)
        lines: list[str] = []
        for before, part in zip([":", *said], said):
            is_item = part.startswith("- ")
            goes_on = not lines or is_item and (before.startswith("- ") or before.endswith(":"))
            lines += ([] if goes_on else [""]) + wrapped(
                part, 6 if is_item else 4, "" if lines else '"""', 4)
        order = [part.partition(":")[0].strip("*") for part in signature]
        for i, name in enumerate(sorted(notes, key=order.index)):
            lines += ([""] if i == 0 else []) + wrapped(f"{name}: {notes[name]}", 8, "", 4)
        raised = [_OPEN.get(one.check, "") + _NOT_CERTIFIED] if one.check else []
        raised += raises
        for part in filter(None, [raised and f"Raises {'; '.join(raised)}",
                                  cost and f"Cost: {cost}"]):
            lines += ["", *wrapped(part if part.endswith(".") else part + ".", 4, "")]
        if not example:
            raise ValueError(f"{one.name}: its docstring has no example")
        text += "\n".join(lines) + "\n\n" + example + '    """\n'
        if one.steps:
            end = ") -> None:\n        super().__init__(locals())\n"
            return text + "\n" + call_text("    def __init__(", ["self", *signature], end)
        if how:
            text += f"    how = options(_core.{how}, locals(){one.given and ', ' + one.given})\n"
        front, back = one.value.split("{}")
        if one.check:
            of = "" if one.check.endswith("s") else ', of=""'
            front, back = f"checked({front}", f"{back}, check{of})"
        if one.body:
            return text + f"    return {front}{one.body}{back}\n"
        values.append("progress=progress")
        if not one.missing:
            return text + call_text(f"    return {front}_core.{one.name}(", values,
                                    f"){back}") + "\n"
        text += call_text(f"    made = _core.{one.name}(", values, ")") + "\n    if made is None:\n"
        return text + (f'        raise ValueError("{one.name}: {one.missing}")\n'
                       f"    return {front}made{back}\n")

    def _note(self, field: Field, annotation: str, names: set[str]) -> str:
        """The sentence about an option."""
        text = self.said(self.language.sentence(field, False), names)
        values = self.language.words_of(field.type.removeprefix("optional<").rstrip(">"))
        if annotation.endswith("None"):
            text = re.sub("(Not given|Default|`NONE`):", "None:", text)
        return " ".join(filter(None, [values and values + ".", text]))

    def function(self, one: Function, before: str) -> str:
        """The function for a block, with the example that it has in the block `before`."""
        head = rf'^(?:def|class) {one.name}\(.*?^    """'
        found = re.search(head + r'.*?^(    >>> .*?)^    """', before, re.M | re.S)
        return self.text(one, found[1] if found else "")
