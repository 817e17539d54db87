#!/usr/bin/env python3
"""api_reference.py SOURCE FOLDER | --filter FILE: the API reference, made by Doxygen in FOLDER/html.

Fails if Doxygen warns of anything, a public header is in no group, or in two, or the door has grown:
headers, free functions and types, nested ones too, are counted in Doxygen's XML. With --filter,
prints FILE as Doxygen is to see it: the names of a header in the group of its question, and links of
documents that lead out of the reference without what only a folder of sources has."""

import pathlib
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree

# What the door has at most. These numbers only shrink; what is new takes the place of something.
MOST = {"headers": 54, "functions": 190, "types": 280}

# The question that a group answers, and the headers that do; of treeform/mesh/ or treeform/tree/.
GROUPS = {
    "files": ("How do I read and write files?", "mesh",
              "read write mesh_file point_stream"),
    "meshes": ("What is a mesh, and what does it carry?", "mesh",
               "mesh as_mesh properties attributes carry"),
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
              "aabb build build_within dynamic_tree lazy_tree refit strategy tree"),
    "searching": ("How do I search it?", "tree",
                  "answers nearness nearness_batch nearness_pair point_search ray search search_pair"),
    "threads": ("How many threads, and which version?", "tree", "parallel version"),
}
GROUP_OF = {f"treeform/{room}/{name}.hpp": group
            for group, (_, room, names) in GROUPS.items() for name in names.split()}
COUNT = sum(len(names.split()) for _, _, names in GROUPS.values())


def public_name(path):
    return re.sub(r".*include/(?=treeform/)", "", str(path))


def seen_by_doxygen(path):
    text = pathlib.Path(path).read_text()
    if path.endswith(".md"):  # a link to what is no page, "[benchmarks](tests/bench/README.md)"
        pages = r"(?:lib(?:mesh|tree)/)?README\.md"
        return re.sub(rf"(?<!!)\[([^]]*)\]\((?!https?:|{pages}\))[^)]*\)", r"\1", text)
    group = GROUP_OF.get(public_name(path))
    if not group:
        return text
    title = GROUPS[group][0]
    # The group begins in the empty line that follows: lines keep their numbers.
    text = re.sub(r"(?m)^namespace treeform \{\n$",
                  f"namespace treeform {{ /** \\\\addtogroup {group} {title}\n@{{ */", text)
    return re.sub(r"(?m)^\}  // namespace treeform$", r"/** @} */ \g<0>", text)


def check_groups(source):
    headers = {public_name(path) for path in source.glob("lib*/include/**/*.hpp")
               if "detail" not in path.parts} - {"treeform/treeform.hpp", "treeform/tf.hpp"}
    wrong = [f"{name}: is in no group of {pathlib.Path(__file__).name}"
             for name in sorted(headers - set(GROUP_OF))]
    wrong += [f"{name}: there is no such header" for name in sorted(set(GROUP_OF) - headers)]
    if COUNT != len(GROUP_OF):
        wrong.append("a header is in two groups")
    return wrong


def is_inner(name):
    return not name or "detail" in name.split("::") or "@" in name


def count_door(folder):
    """The names of free functions and types that Doxygen's XML has: an overload counts by itself."""
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


def main():
    if sys.argv[1] == "--filter":
        sys.stdout.write(seen_by_doxygen(sys.argv[2]))
        return 0
    source, folder = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]).resolve()
    wrong = check_groups(source)
    if not shutil.which("doxygen"):
        print("\n".join(wrong) or "skipped: no doxygen")
        return 1 if wrong else 77
    folder.mkdir(parents=True, exist_ok=True)
    settings = (source / "tests/house/Doxyfile").read_text() + f'\nOUTPUT_DIRECTORY = "{folder}"\n'
    shutil.rmtree(folder / "xml", ignore_errors=True)
    run = subprocess.run(["doxygen", "-"], cwd=source, input=settings, text=True,
                         stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    wrong += run.stderr.splitlines()
    if run.returncode:
        wrong.append(f"doxygen ended with status {run.returncode}")
    for group in GROUPS:
        if not list(folder.glob(f"html/group__{group}.html")):
            wrong.append(f"no page of the group {group}")
    counted = count_door(folder / "xml")
    wrong += [f"{counted[what]} public {what}, {most} at most"
              for what, most in MOST.items() if counted[what] > most]
    print("\n".join(wrong) if wrong else f"{folder}/html/index.html: " + ", ".join(
        f"{count} {what}" for what, count in counted.items()) + f" in {len(GROUPS)} groups")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
