#!/usr/bin/env python3
"""api_reference.py [FOLDER | --filter FILE]: the API reference, made by Doxygen in FOLDER/html.

FOLDER is build/reference unless named. Fails if Doxygen warns of anything, a link leads nowhere, a
public header is in no group, or in two, or the door has grown: headers, free functions and types,
nested ones too, are counted in Doxygen's XML. With --filter, prints FILE as Doxygen is to see it:
the names of a header in the group of its question, a module of Python as a page, and a document
with the links that it has on GitHub."""

import ast
import html
import pathlib
import re
import shutil
import subprocess
import sys
import textwrap
import xml.etree.ElementTree

import links

# What the door has at most. These numbers only shrink; what is new takes the place of something.
MOST = {"headers": 53, "functions": 190, "types": 180}

# The question that a group answers, and the headers that do; of treeform/mesh/ or treeform/tree/.
GROUPS = {
    "files": ("How do I read and write files?", "mesh",
              "read write mesh_file point_stream"),
    "meshes": ("What is a mesh, and what does it carry?", "mesh",
               "mesh as_mesh properties attributes attribute_sources"),
    "meeting": ("Which faces meet?", "mesh",
                "self_intersections intersections predicates"),
    "solids": ("How do I make, mend and combine solids?", "mesh",
               "boolean solid section cut offset simplify repair certificate"),
    "welding": ("How do I merge points?", "mesh", "weld weld_options weld_stream"),
    "asking": ("What is inside, nearest, or hit by a ray?", "mesh",
               "point_location distance measure deviation"),
    "placing": ("Where does a part go, and what is in its way?", "mesh",
                "slide placement time_of_impact convex_hull pack align clash"),
    "trees": ("How do I build a tree over boxes?", "tree",
              "aabb build build_within dynamic_tree lazy_tree refit tree"),
    "searching": ("How do I search it?", "tree",
                  "answers nearness nearness_batch nearness_pair point_search ray search "
                  "search_pair"),
    "threads": ("How many threads, and which version?", "tree", "parallel version"),
}
GROUP_OF = {f"treeform/{room}/{name}.hpp": group
            for group, (_, room, names) in GROUPS.items() for name in names.split()}
COUNT = sum(len(names.split()) for _, _, names in GROUPS.values())


ROOT = pathlib.Path(__file__).resolve().parents[2]
START = ROOT / "tests/house/reference/start.md"
C_HEADERS = ROOT / "tools/c/include/treeform/c"
PACKAGE = ROOT / "tools/python/treeform"


def public_name(path):
    return re.sub(r".*include/(?=treeform/)", "", str(path))


def page_of(path):
    """The name of a document's page: tools/c/README.md has tools_c_README."""
    return path.relative_to(ROOT).with_suffix("").as_posix().replace("/", "_")


def first_sentence(text):
    return re.match(r"(.*?)\.(\s|$)", " ".join(text.split()))[1]


def c_title(name):
    text = re.sub(r"(?m)^/// ?", "", (C_HEADERS / f"{name}.h").read_text())
    return first_sentence(text.split("\\file\n")[1])


def python_modules():
    """Name, title, file and public names of each module of the package."""
    package = ast.parse((PACKAGE / "__init__.py").read_text())
    for node in package.body:
        if isinstance(node, ast.ImportFrom) and node.module:
            path = next(PACKAGE.glob(f"{node.module}.py*"))
            docstring = ast.get_docstring(ast.parse(path.read_text()))
            title = first_sentence(docstring or "Attributes of meshes.")
            yield node.module.strip("_"), title, path, [name.name for name in node.names]


def shown_at_start():
    """The documents that the start page names, in its order."""
    targets = [(START.parent / link).resolve() for _, link in links.links_of(START.read_text())]
    return [path for path in dict.fromkeys(targets) if path.suffix == ".md" and path != START]


def questions(of):
    """The list of what the start page leads to, in a language."""
    if of == "python":
        return [f"- @subpage python_{name} &ndash; " + ", ".join(f"`{one}`" for one in names)
                for name, _, _, names in python_modules()]
    if of == "c":
        return [f"- @ref c_{path.stem}" for path in sorted(C_HEADERS.glob("*.h"))]
    if of == "rooms":
        return [f"- @subpage {page_of(path)}" for path in links.documents(ROOT)
                if path not in (START, *shown_at_start())]
    return [f"- @ref {group} &ndash; "
            + ", ".join(f"`<treeform/{room}/{name}.hpp>`" for name in names.split())
            for group, (_, room, names) in GROUPS.items() if room == of]


def link_in_site(path, link):
    """A link of a document as Doxygen is to see it; None where it leads out of the site."""
    name, _, anchor = link.partition("#")
    target = (path.parent / name).resolve() if name else path
    if links.ELSEWHERE.match(link):
        return link
    if target.suffix == ".md":
        return f"#{page_of(target)}" + (f"-{anchor}" if anchor else "")
    return f"@ref {public_name(target)}" if target.suffix == ".h" else None


def page_seen(path):
    """A document: its headings have the labels, its links the targets that they have on GitHub."""
    def seen(match):
        if match[0].startswith("!"):
            picture = (path.parent / match[2]).resolve().relative_to(ROOT).as_posix()
            return f"![{match[1]}]({picture})"
        link = link_in_site(path, match[2])
        return "[{}]({})".format(match[1].replace("`", ""), link) if link else match[1]

    page, lines = page_of(path), []
    for number, line, prose in links.lines_of(path.read_text()):
        heading = re.match(r"(#+) (.*)", line) if prose else None
        if prose:
            line = re.sub(r"!?\[((?:[^][]|\[[^]]*\])*)\]\(([^()\s]*)\)", seen, line)
        if heading:
            label = page if heading[1] == "#" else f"{page}-{links.anchor_of(heading[2])}"
            line = f"{'# Overview' if path == ROOT / 'README.md' else line} {{#{label}}}"
        lines += questions(line.split()[1]) if line.startswith("@questions ") else [line]
    if path.name == "CONTRIBUTING.md":
        lines += ["## Documents of folders", "", *questions("rooms")]
    return "\n".join(lines) + "\n"


def docstring_seen(text):
    """A docstring of Python as a text of Markdown: examples are code, lists of fields are lists."""
    for paragraph in re.split(r"\n\s*\n", text or ""):
        if paragraph.lstrip().startswith(">>>"):
            paragraph = f"```py\n{paragraph}\n```"
        elif re.match(r"\*?\w+(, \w+)*: ", paragraph):
            paragraph = re.sub(r"(?m)^(\*?\w+(?:, \w+)*): ", r"- `\1`: ", paragraph)
        yield paragraph + "\n"


def definition_seen(node, page, owner=""):
    """A function, or a class with its methods, of Python."""
    name = owner + node.name
    is_class = isinstance(node, ast.ClassDef)
    yield f"{'###' if owner else '##'} {name} {{#{page}-{name.replace('.', '-')}}}\n"
    if not is_class:
        result = f" -> {ast.unparse(node.returns)}" if node.returns else ""
        call = f"{name}({ast.unparse(node.args)}){result}"
        yield "```py\n" + "\n".join(textwrap.wrap(call, 96, subsequent_indent="    ")) + "\n```\n"
    yield from docstring_seen(ast.get_docstring(node))
    members = [one for one in node.body if isinstance(one, ast.FunctionDef)] if is_class else []
    plain = [one for one in members if not one.name.startswith("_") and not ast.get_docstring(one)]
    if plain:
        yield "Also: " + ", ".join(f"`{one.name}`" for one in plain) + "\n"
    for one in members:
        if not one.name.startswith("_") and ast.get_docstring(one):
            yield from definition_seen(one, page, name + ".")


def module_seen(path):
    if path.stem == "__init__":
        yield from ["# Python, by question {#python}", "", *questions("python")]
    for name, title, module, names in python_modules():
        if path == module:
            yield f"# {title} {{#python_{name}}}\n"
            for node in ast.parse(path.read_text()).body:
                if getattr(node, "name", None) in names:
                    yield from definition_seen(node, f"python_{name}")
                elif isinstance(node, (ast.Assign, ast.AnnAssign)):
                    target = getattr(node, "target", None) or node.targets[0]
                    if getattr(target, "id", None) in names:
                        yield f"## {target.id} {{#python_{name}-{target.id}}}\n"
                        yield f"```py\n{ast.get_source_segment(path.read_text(), node)}\n```\n"


def seen_by_doxygen(path):
    path = path.resolve()
    if path.suffix == ".md":
        return page_seen(path)
    if path.suffix in (".py", ".pyi"):
        return "\n".join(module_seen(path))
    text, group = path.read_text(), GROUP_OF.get(public_name(path))
    if path.parent == C_HEADERS:
        text = re.sub(r"(?s)\A(.*\n#include [^\n]+\n)\n",
                      rf"\1/** \\addtogroup c_{path.stem} {path.name}: {c_title(path.stem)}\n"
                      "@ingroup in_c\n@{ */\n",
                      text)
        return text + "/** @} */\n"
    if not group:
        return text
    title, room, _ = GROUPS[group]
    # The group begins in the empty line that follows: lines keep their numbers.
    text = re.sub(r"(?m)^namespace treeform \{\n$",
                  f"namespace treeform {{ /** \\\\addtogroup {group} {title}\n"
                  f"@ingroup in_{room}\n@{{ */", text)
    return re.sub(r"(?m)^\}  // namespace treeform$", r"/** @} */ \g<0>", text)


def check_groups():
    headers = {public_name(path) for path in ROOT.glob("lib*/include/**/*.hpp")
               if "detail" not in path.parts} - {"treeform/treeform.hpp", "treeform/tf.hpp"}
    wrong = [f"{name}: is in no group of {pathlib.Path(__file__).name}"
             for name in sorted(headers - set(GROUP_OF))]
    wrong += [f"{name}: there is no such header" for name in sorted(set(GROUP_OF) - headers)]
    if COUNT != len(GROUP_OF):
        wrong.append("a header is in two groups")
    return wrong


def is_inner(name):
    """True for what is no name of the door of C++."""
    words = (name or "").split("::")
    return words[0] != "treeform" or "detail" in words or "@" in name


def count_door(folder):
    """The names of free functions and types that Doxygen's XML has: an overload counts by
    itself."""
    functions, types = {}, {}
    for path in sorted(folder.glob("*.xml")):
        for compound in xml.etree.ElementTree.parse(path).getroot().iter("compounddef"):
            kind, name = compound.get("kind"), compound.findtext("compoundname")
            if kind in ("class", "struct", "union"):
                if compound.get("prot") == "private" or is_inner(name):
                    continue
                types[name] = name
            elif kind not in ("namespace", "group") or kind == "namespace" and is_inner(name):
                continue
            for member in compound.iter("memberdef"):
                named = member.findtext("qualifiedname") or member.findtext("name")
                if member.get("prot") == "private" or is_inner(named):
                    continue
                if member.get("kind") == "enum":
                    types[member.get("id")] = named
                elif member.get("kind") == "function" and kind in ("namespace", "group"):
                    functions[member.get("id")] = named
    free = [name for name in functions.values() if name.rpartition("::")[0] not in types]
    return {"headers": len(GROUP_OF) + 2, "functions": len(free), "types": len(types)}


def index_of_names(folder):
    """The address of each name of C++, C and Python; of overloads, that of the first."""
    index = {"cpp": {}, "python": {}}
    for path in sorted((folder / "xml").glob("*.xml")):
        for compound in xml.etree.ElementTree.parse(path).getroot().iter("compounddef"):
            kind, name = compound.get("kind"), compound.findtext("compoundname")
            if kind in ("class", "struct") and "detail" not in name:
                address = f"{compound.get('id')}.html"
                index["cpp"].setdefault(name.removeprefix("treeform::"), address)
            if kind != "group":
                continue
            for member in compound.iter("memberdef"):
                if member.get("prot") == "private":
                    continue
                page, _, place = member.get("id").rpartition("_1")
                index["cpp"].setdefault(member.findtext("name"), f"{page}.html#{place}")
    for name, _, _, names in python_modules():
        index["python"] |= {one: f"python_{name}.html#python_{name}-{one}" for one in names}
    return index


def link_names(folder):
    """In texts of all pages, names in backticks become links."""
    index = index_of_names(folder)
    for path in (folder / "html").glob("*.html"):
        of_python = path.name.startswith(("python_", "tools_python_"))
        names = index["cpp"] | index["python"] if of_python else index["python"] | index["cpp"]

        def linked(match):
            address = names.get(html.unescape(match[1]).removeprefix("treeform."))
            if not address or address == path.name:
                return match[0]
            return f'<a class="el" href="{address}">{match[0]}</a>'

        text = path.read_text()
        if 'id="nested-classes"' not in text:  # Doxygen's: all of them are private
            text = re.sub(r'<a href="#nested-classes">\w+</a> &#124;\s*', "", text)
        path.write_text(re.sub(r"<code>([\w:.]+)(?:\(.*?\))?</code>(?!</a>|</h)", linked, text))


def main():
    if sys.argv[1:2] == ["--filter"]:
        sys.stdout.write(seen_by_doxygen(pathlib.Path(sys.argv[2])))
        return 0
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "build/reference").resolve()
    wrong = check_groups()
    if not shutil.which("doxygen"):
        print("\n".join(wrong) or "skipped: no doxygen")
        return 1 if wrong else 77
    if folder in (ROOT, *ROOT.parents):
        sys.exit(f"{folder} has the sources: it would be emptied")
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    pages = [START, *shown_at_start(), *links.documents(ROOT)]
    pages += [PACKAGE / "__init__.py", *(module for _, _, module, _ in python_modules())]
    settings = (ROOT / "tests/house/reference/Doxyfile").read_text() + "\nINPUT += "
    settings += " ".join(f'"{path.relative_to(ROOT)}"' for path in dict.fromkeys(pages))
    settings += f'\nOUTPUT_DIRECTORY = "{folder}"\n'
    run = subprocess.run(["doxygen", "-"], cwd=ROOT, input=settings, text=True,
                         stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    wrong += run.stderr.splitlines()
    if run.returncode:
        wrong.append(f"doxygen ended with status {run.returncode}")
    wrong += [f"no page of the group {group}" for group in GROUPS
              if not (folder / f"html/group__{group}.html").exists()]
    link_names(folder)
    wrong += links.site_faults(folder / "html")
    counted = count_door(folder / "xml")
    wrong += [f"{counted[what]} public {what}, {most} at most"
              for what, most in MOST.items() if counted[what] > most]
    print("\n".join(wrong) if wrong else f"{folder}/html/index.html: " + ", ".join(
        f"{count} {what}" for what, count in counted.items()) + f" in {len(GROUPS)} groups")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
