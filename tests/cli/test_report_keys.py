"""tools/REPORTS.md: all keys of the tools' reports, no other, of the types named; true examples."""

import re

from boolean_support import *
from weld_support import XYZ, ply_text, xyz_bytes

HOME = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
PAGE = os.path.join(HOME, "tools", "REPORTS.md")
NAMES = {"tf-selfintersect": TOOL, "tf-boolean": BOOLEAN, "tf-cut": CUT, "tf-place": PLACE,
         "tf-repair": MEND,
         "tf-weld": WELD}

# Modes whose entries have keys of their own.
OWN_MODES = ["tf-place clash", "tf-place check"]

# What rounding breaks is mended: no small mesh is known of which faces still meet then.
NOT_SEEN = {("tf-selfintersect", "repair.meeting[].faces"),
            ("tf-selfintersect", "repair.meeting[].near"),
            ("tf-boolean", "output.meeting[].faces"), ("tf-boolean", "output.meeting[].near"),
            ("tf-repair", "repair.meeting[].faces"), ("tf-repair", "repair.meeting[].near")}


class Key:
    def __init__(self, kinds):
        self.kinds = kinds.split(" or ")
        self.seen = set()


def page_sections():
    """The lines of each section of the page, by its heading."""
    sections, lines = {}, []
    with open(PAGE) as file:
        for line in file:
            if line.startswith("## "):
                lines = sections.setdefault(line[3:].strip().strip("`"), [])
            lines.append(line)
    return sections


def keys_of(lines):
    """The rows | `key` | type | text | of a section."""
    keys = {}
    for line in lines:
        cells = [cell.strip() for cell in line.split(" | ")]
        if not line.startswith("| `") or len(cells) != 3:
            continue
        for name in re.findall(r"`([^`]+)`", cells[0]):
            assert name not in keys, name
            keys[name] = Key(cells[1])
    for name in list(keys):
        for dot in re.finditer(r"\.", name):
            above = name[:dot.start()]
            if not above.endswith("[]"):
                keys.setdefault(above, Key("object"))
    return keys


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def is_count(value):
    return isinstance(value, int) and not isinstance(value, bool) and value >= 0


def is_list(value, kind, length=None):
    return isinstance(value, list) and all(map(kind, value)) and length in (None, len(value))


def is_point(value):
    return is_list(value, is_number, 3)


def is_text(value):
    return isinstance(value, str)


KINDS = {
    "null": lambda v: v is None,
    "bool": lambda v: isinstance(v, bool),
    "text": is_text,
    "count": is_count,
    "number": is_number,
    "point": is_point,
    "box": lambda v: isinstance(v, dict) and sorted(v) == ["max", "min"] and
    all(map(is_point, v.values())),
    "matrix": lambda v: is_list(v, lambda row: is_list(row, is_number, 4), 4),
    "pair": lambda v: is_list(v, is_count, 2),
    "weights": lambda v: is_list(v, is_number, 3),
    "row": lambda v: is_list(v, lambda x: True, 4) and is_count(v[0]) and is_count(v[1]) and
    is_text(v[2]) and is_count(v[3]),
    "object": lambda v: isinstance(v, dict),
}


def is_kind(value, kind):
    if kind.startswith("list of "):
        return is_list(value, KINDS[kind[8:].removesuffix("s")])
    return KINDS[kind](value)


class Reports(PlaceTest):
    @classmethod
    def setUpClass(cls):
        cls.sections = sections = page_sections()
        cls.head = keys_of(sections["Top level"])
        cls.common = keys_of(sections["Keys of every entry"])
        cls.own = {tool: keys_of(sections[tool]) for tool in [*NAMES, *OWN_MODES]}
        cls.codes = {kind: set(re.findall(r"`([a-z-]+)`", "".join(sections[kind])))
                     for kind in ("Errors", "Warnings")}

    def run_report(self, tool, *arguments, stdin=b"", status):
        done = subprocess.run([NAMES[tool], *map(str, arguments), "-r", "-"], cwd=self.folder,
                              input=stdin, capture_output=True, timeout=120)
        run = Run(done)
        self.assertIn(run.status, status if isinstance(status, tuple) else (status,),
                      msg=f"{tool} {arguments}\n{run.text[-3000:]}\n{run.err}")
        return json.loads(run.text)

    # ---- comparing ----

    def look(self, keys, value, path, where, strict):
        """`value`, at `path` of a report, and all below it."""
        key = keys.get(path)
        self.assertIsNotNone(key, msg=f"{where}: {path} is not in the page")
        kinds = [kind for kind in key.kinds if is_kind(value, kind)]
        self.assertTrue(kinds, msg=f"{where}: {path} is {json.dumps(value)[:200]}, "
                                   f"not {' or '.join(key.kinds)}")
        key.seen.add(kinds[0])
        if kinds[0] == "object":
            self.look_at_keys(keys, value, path + ".", where, strict)
        if kinds[0] == "list of objects":
            for one in value:
                self.look_at_keys(keys, one, path + "[].", where, strict)

    def look_at_keys(self, keys, value, prefix, where, strict):
        for name, below in value.items():
            self.look(keys, below, prefix + name, where, strict)
        for name in keys:
            rest = name[len(prefix):]
            if strict and name.startswith(prefix) and "." not in rest:
                self.assertIn(rest, value, msg=f"{where}: no {name}")

    def compare(self, report):
        tool = report["tool"]
        where = " ".join([tool, *report["command"][1:]])
        self.look_at_keys(self.head, {k: v for k, v in report.items() if k != "files"}, "", where,
                          False)
        self.assertLessEqual({k for k in self.head if "." not in k}, set(report), msg=where)
        self.head["files"].seen.add("list of objects")
        mode = " ".join([tool, *report["command"][1:2]])
        keys = {**self.common, **self.own[mode if mode in OWN_MODES else tool]}
        for entry in report["files"]:
            self.look_at_keys(keys, entry, "", where, entry["error"] is None)
            if entry["error"]:
                self.assertIn(entry["error"]["code"], self.codes["Errors"])
            for warning in entry["warnings"]:
                self.assertIn(warning["code"], self.codes["Warnings"], msg=where)

    # ---- reports ----

    def selfintersect(self):
        write(self.path("two.obj"), TWO_CUBES)
        write(self.path("two.stl"), together(TWO_CUBES, CROSSING))
        self.mesh("open.obj", (TWO_CUBES[0], TWO_CUBES[1][1:]))
        points, faces = cube()  # open, and an edge in two on one side only
        self.mesh("pieces.obj", (points + [(0.5, 0, 0)], [(0, 2, 8), (8, 2, 1), *faces[2:]]))
        self.mesh("large.obj", together(box((0, 0, 0), (1e39, 1e39, 1e39)),
                                        box((1e38, 1e38, 1e38), (2e39, 2e39, 2e39))))
        self.mesh("huge.obj", box((0, 0, 0), (1e299, 1e299, 1e299)))
        points, faces = TWO_CUBES
        third = [tuple(x / 3 for x in p) for p in points]
        self.mesh("nan.obj", (third + [(math.nan, 0, 0)], faces + [(0, 1, 16)]))
        for arguments, status in [
                (["two.obj", "--units", "mm"], 1),
                (["two.stl", "-t", "0.01%", "--touching", "--limit", "2"], 1),
                (["nan.obj", "-o", "marked.ply", "--precision", "float", "--no-coplanar"], 1),
                (["two.obj", "--first"], 1),
                (["two.stl", "--tile-faces", "10"], 1),
                (["two.obj", "--between", "--box", "0,0,0,1,1,1"], (0, 1)),
                (["two.obj", "missing.obj", "two.stl", "--exit-zero"], 3),
                (["-", "--format", "obj"], 3),
                (["nan.obj", "--repair", "-o", "fixed.stl"], 0),
                (["two.obj", "--repair=split", "-n", "--max-move", "0"], (0, 1)),
                (["two.obj", "--repair=remove", "-o", "removed.ply", "--accept-loss"], 0),
                (["two.obj", "--repair=remove", "-n"], 1),
                (["open.obj", "--repair", "-n"], 1),
                (["pieces.obj", "--repair", "-n"], 1),
                (["large.obj", "--repair", "-o", "large.stl"], 1),
                (["huge.obj", "--repair", "-n"], 0)]:
            yield arguments, status

    def boolean(self):
        for name, mesh in (("a", box((0, 0, 0), (2, 2, 2))), ("b", box((1, 1, 1), (3, 3, 3))),
                           ("c", box((0, 0, 0), (1, 2, 2)))):
            self.mesh(name + ".obj", mesh)
        self.mesh("third.obj", box((1 / 3, 1 / 3, 1 / 3), (2, 2, 2)))
        points, faces = cube()
        self.mesh("open.obj", (points, faces[1:]))
        self.mesh("sheet.obj", grid(4, 1.5))
        with open(self.path("a.obj")) as one, open(self.path("named.obj"), "w") as file:
            lines = one.read().splitlines()
            file.write("\n".join([*lines[:8], "o body", *lines[8:], "o nut",
                                  "v 9 9 9", "v 8 9 9", "v 9 8 9", "v 9 9 8", "f 9 10 11",
                                  "f 9 12 10", "f 9 11 12", "f 10 12 11", ""]))
        self.mesh("speck.obj", together(cube(), box((5, 5, 5), (5 + 2 ** -40,) * 3)))
        self.mesh("tiny.obj", ([tuple(1e-320 * x for x in p) for p in points], faces))
        with open(self.path("m.txt"), "w") as file:
            file.write("1 0 0 0.5\n0 1 0 0.25\n0 0 1 0\n0 0 0 1\n")
        for arguments, status in [
                (["difference", "a.obj", "b.obj", "-o", "out.ply", "--max-move", "0.1"], 0),
                (["union", "a.obj", "b.obj", "c.obj", "-n"], 0),
                (["--expr", "a-b", "third.obj", "b.obj", "--matrix", "2:m.txt", "-o", "e.stl"], 0),
                (["union", "a.obj", "c.obj", "-o", "simple.obj", "--merge-coplanar"], 0),
                (["union", "a.obj", "speck.obj", "--min-volume", "1e-9", "--gap", "1%", "-n"], 0),
                (["split", "a.obj", "open.obj", "-n"], 0),
                (["union", "a.obj", "open.obj", "--repair", "-n"], 0),
                (["--expr", "body-nut", "named.obj", "-n"], 0),
                (["union", "a.obj", "sheet.obj", "--repair", "-n"], 1),
                (["difference", "sheet.obj", "a.obj", "--accept-open", "-n"], 0),
                (["union", "a.obj", "open.obj", "-n"], 1),
                (["--check", "a.obj", "open.obj"], 1),
                (["union", "speck.obj", "-o", "speck.stl"], 0),
                (["union", "tiny.obj", "-o", "tiny.stl"], 1),
                (["union", "large.obj", "-o", "large2.stl"], 1),
                (["union", "huge.obj", "-n"], 0),
                (["union", "huge.obj", "huge.obj", "-n"], 0),
                (["union", "nan.obj", "-n"], (0, 1)),
                (["union", "a.obj", "missing.obj", "-n"], 3)]:
            yield arguments, status

    def cut(self):
        self.mesh("part.obj", box((0, 0, 0), (4, 4, 1)))
        self.mesh("slit.obj", (box((0, 0, 0), (1, 1, 1))[0], box((0, 0, 0), (1, 1, 1))[1][1:]))
        self.mesh("flat.obj", ([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)]))
        for arguments, status in [
                (["half", "part.obj", "--at", "1,1,1", "--normal", "1,1,0", "-o", "half.3mf"], 0),
                (["half", "part.obj", "--height", "0.5", "--keep", "below", "-o", "low.stl"], 0),
                (["half", "part.obj", "--height", "0.5", "-n"], 0),
                (["half", "slit.obj", "--height", "0.5", "-n"], 1),
                (["pieces", "part.obj", "--bed", "3,3", "-o", "piece%d.ply", "--caps", "cap"], 0),
                (["section", "part.obj", "--layers", "0.25", "-o", "layers.svg"], 0),
                (["section", "slit.obj", "nan.obj", "--height", "0.5,2", "-n"], 0),
                (["isolines", "part.obj", "--count", "2", "-o", "lines.svg"], 0),
                (["isolines", "part.obj", "--value", "distance", "--to", "slit.obj", "--levels",
                  "0.5", "-n"], 0),
                (["parts", "part.obj", "-o", "parts.obj"], 0),
                (["parts", "slit.obj", "-n"], 0),
                (["simplify", "part.obj", "--distance", "0.01", "-o", "few.stl"], 0),
                (["offset", "part.obj", "--distance", "0.4", "--resolution", "0.1", "-n"], 0),
                (["hollow", "part.obj", "--wall", "0.2", "--drain", "0.5,0.5,0,0.1", "-n"], 0),
                (["info", "part.obj", "--units", "mm"], 0),
                (["info", "part.obj", "flat.obj", "huge.obj", "missing.obj"], 3)]:
            yield arguments, status

    def place(self):
        self.mesh("part.obj", box((1, 1, 5), (2, 2, 6)))
        self.mesh("in.obj", box((0.5, 0.5, 0.5), (1.5, 1.5, 1.5)))
        self.mesh("floor.obj", box((0, 0, 0), (4, 4, 1)))
        far = box((50, 0, 0), (54, 4, 1))
        lines = obj_bytes(together(box((0, 0, 0), (4, 4, 1)), far)).decode().splitlines()
        with open(self.path("scene.obj"), "w") as file:
            file.write("\n".join([*lines[:16], "o floor", *lines[16:28], "o far", *lines[28:], ""]))
        with open(self.path("cloud.xyz"), "wb") as file:
            file.write(xyz_bytes([(1, 1, 5), (2, 1, 5), (1, 2, 7)]))
        self.mesh("post.obj", box((3e8, 3e8, 0), (3e8 + 1000, 3e8 + 1000, 1)))
        self.mesh("fine.stl", ball_of_lines())
        self.mesh("tube.obj", tube(2, 1, 3))
        fixed = ["--fixed", "floor.obj"]
        for arguments, status in [
                (["drop", "part.obj", "-o", "on_bed.stl", "--matrix", "m1.txt"], 0),
                (["drop", "part.obj", "--fixed", "scene.obj", "--scene", "-o", "scene.ply"], 0),
                (["drop", "cloud.xyz", *fixed, "-n"], 0),
                (["drop", "missing.obj", "part.obj", *fixed, "-n"], 3),
                (["drop", "part.obj", "--fixed", "missing.obj", "-n"], 3),
                (["slide", "part.obj", *fixed, "--clearance", "0.1", "-n"], 0),
                (["slide", "part.obj", *fixed, "--max-travel", "1%", "-n"], 1),
                (["slide", "in.obj", *fixed, "-n"], 1),
                (["mate", "fine.stl", "--fixed", "post.obj", "-o", "far.stl"], 0),
                (["separate", "in.obj", *fixed, "-o", "cleared.obj"], 0),
                (["measure", "part.obj", *fixed], 0),
                (["measure", "in.obj", *fixed, "-o", "in.ply"], 0),
                (["measure", "cloud.xyz", "--fixed", "cloud.xyz"], 0),
                (["measure", "nan.obj", "--fixed", "nan.obj"], 0),
                (["measure", "in.obj", "--fixed", "outer.obj"], 0),
                (["measure", "in.obj", *fixed, "--distances", "d.ply"], 0),
                (["measure", "cloud.xyz", *fixed, "--tolerance-band", "-1,1"], 1),
                (["lay", "part.obj", "-n"], 0),
                (["lay", "fine.stl", "--stable", "-n"], 0),
                (["turn", "part.obj", *fixed, "--axis", "1,0,0", "--origin", "0,0,3", "-n"], 0),
                (["mate", "part.obj", *fixed, "--feature", "plane", "-n"], 0),
                (["mate", "tube.obj", "--fixed", "tube.obj", "--feature", "axis", "-n"], 0),
                (["align", "part.obj", *fixed, "-n"], (0, 1)),
                (["pack", "part.obj", "nan.obj", "--size", "9,9", "-o", "plate.stl"], 0),
                (["pack", "part.obj", "floor.obj", "--size", "4,3", "-n"], 1)]:
            yield arguments, status

    def assemblies(self):
        self.mesh("near.obj", box((0, 0, 1.05), (4, 4, 2)))
        self.mesh("inside.obj", box((1, 1, 0.25), (2, 2, 0.5)))
        with open(self.path("robot.urdf"), "w") as file:
            file.write("<robot name='r'>" + "".join(
                f"<link name='{name}'><collision><geometry><mesh filename='{name}.obj'/></geometry>"
                "</collision></link>" for name in ("floor", "part", "in")) + "".join(
                f"<joint name='j{name}' type='prismatic'><parent link='floor'/><child "
                f"link='{name}'/>"
                "<axis xyz='0 0 1'/></joint>" for name in ("part", "in")) + "</robot>")
        self.put("poses.jsonl", '{"jpart": -5}\n{"jpart": -4.5, "jin": 0.5}\n')
        self.put("moves.jsonl", '{"part": [1,0,0,0,0,1,0,0,0,0,1,-5,0,0,0,1]}\n{}\n')
        for arguments, status in [
                (["clash", "floor.obj", "in.obj", "nan.obj", "-o", "clash.ply"], 1),
                (["clash", "floor.obj", "near.obj", "--clearance", "0.1"], 1),
                (["clash", "floor.obj", "inside.obj"], 1),
                (["clash", "inside.obj", "floor.obj", "--ignore", "in*:fl*"], 0),
                (["clash", "inside.obj", "floor.obj", "--no-depth"], 1),
                (["clash", "part.obj", "floor.obj", "missing.obj"], 3),
                (["check", "robot.urdf", "--poses", "poses.jsonl"], 1),
                (["check", "floor.obj", "part.obj", "--poses", "moves.jsonl", "--results",
                  "results.jsonl"], 1),
                (["check", "floor.obj", "--poses", "missing.jsonl"], 3)]:
            yield arguments, status

    def weld(self):
        with open(self.path("cloud.ply"), "w") as file:
            file.write(ply_text([*XYZ, "float range"],
                                [(0, 0, 0, 1), (0.1, 0, 0, 2), (1, 0, 0, 3), ("nan", 0, 0, 4)]))
        self.mesh("cube.stl", cube())
        self.mesh("cube.obj", cube())
        with open(self.path("empty.ply"), "w") as file:
            file.write(ply_text(XYZ, []))
        for arguments, status in [
                (["cube.stl", "-o", "cube.ply"], 0),
                (["cloud.ply", "-t", "0.2", "-o", "thin.ply", "--precision", "float", "--map",
                  "map.csv", "--removed", "gone.xyz"], 0),
                (["cloud.ply", "-t", "0.2", "--same", "range=5", "--check"], 1),
                (["cloud.ply", "-t", "20%", "--label", "group", "-o", "labeled.ply"], 0),
                (["cube.stl", "--withhold", "-o", "withheld.las"], 0),
                (["cloud.ply", "-t", "0.2", "-n", "--tile-points", "2"], 0),
                (["cube.stl", "cube.obj", "--join", "--keep-manifold", "-o", "all.obj"], 0),
                (["cube.stl", "missing.stl", "--check"], 3),
                (["empty.ply", "--check"], 3)]:
            yield arguments, status

    def mend(self):
        points, faces = cube()
        self.mesh("hole.obj", (points, faces[1:]))
        self.mesh("bad.obj", together((points, faces[1:]),
                                      ([(3 + x, y, z) for x, y, z in grid(1)[0]],
                                                            grid(1)[1])))
        self.mesh("inverted.obj", (points, [(a, c, b) for a, b, c in faces]))
        self.put("scene.obj", "".join(
            [f"o {name}\n" + "".join(f"v {x + at} {y} {z}\n" for x, y, z in points) +
             "".join(f"f {a + first} {b + first} {c + first}\n" for a, b, c in faces)
             for name, at, first in (("left", 0, 1), ("right", 5, 1 + len(points)))]))
        for arguments, status in [
                (["hole.obj", "-o", "filled.stl", "--precision", "float"], 0),
                (["hole.obj", "--sheet", "-n", "--no-join", "--no-orient", "--no-resolve",
                  "--no-detach"], 0),
                (["hole.obj", "--no-fill", "-n"], 1),
                (["bad.obj", "-n", "--strays", "0.3"], 1),
                (["two.obj", "--check"], 1),
                (["hole.obj", "--wrap", "0.5", "-n"], 0),
                (["inverted.obj", "nan.obj", "missing.obj", "-n"], 3),
                (["large.obj", "-o", "large3.stl"], 1),
                (["scene.obj", "-n"], 0),
                (["huge.obj", "-n"], 0)]:
            yield arguments, status

    def test_page_and_reports_have_the_same_keys_of_the_same_types(self):
        self.mesh("outer.obj", box((-9, -9, -9), (9, 9, 9)))
        for tool, runs in (("tf-selfintersect", self.selfintersect), ("tf-boolean", self.boolean),
                           ("tf-cut", self.cut),
                           ("tf-place", self.place), ("tf-place", self.assemblies),
                           ("tf-repair", self.mend),
                           ("tf-weld", self.weld)):
            for arguments, status in runs():
                self.compare(self.run_report(tool, *arguments, status=status))
        for tool, keys in (("head", self.head), ("entry", self.common), *self.own.items()):
            for name, key in keys.items():
                if (tool, name) in NOT_SEEN:
                    self.assertFalse(key.seen, msg=f"{tool} {name} is seen now")
                else:
                    self.assertEqual(sorted(key.seen), sorted(key.kinds), msg=f"{tool} {name}")

    def assert_holds(self, value, part, where):
        """All of `part` is in `value`; of lists, the first elements."""
        if isinstance(part, dict):
            for name, below in part.items():
                self.assertIn(name, value, msg=where)
                self.assert_holds(value[name], below, f"{where}.{name}")
        elif isinstance(part, list):
            self.assertLessEqual(len(part), len(value), msg=where)
            for one, below in zip(value, part):
                self.assert_holds(one, below, where + "[]")
        elif isinstance(part, float):
            self.assertAlmostEqual(value, part, delta=1e-12 * abs(part), msg=where)
        else:
            self.assertEqual(value, part, msg=where)

    def test_the_examples_are_what_the_tools_write(self):
        for tool in NAMES:
            text = "".join(self.sections[tool])
            command, example = re.search(rf"^    {tool} (.*)\n\n```json\n(.*?)```", text,
                                         re.MULTILINE | re.DOTALL).groups()
            done = subprocess.run([NAMES[tool], *command.split(), "-r", "-"], cwd=HOME,
                                  capture_output=True, timeout=120)
            self.assert_holds(json.loads(done.stdout), json.loads(example), tool)


if __name__ == "__main__":
    main()
