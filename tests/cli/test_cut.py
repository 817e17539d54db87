"""tf-cut: sections, halves, pieces, parts, and what is in a file."""

import math
import re
import zipfile

from boolean_support import *
from support import ToolTest


class Cut(ToolTest):
    tool = CUT

    def put_box(self, name="part.obj", low=(0, 0, 0), high=(4, 4, 1)):
        return write(self.path(name), box(low, high))

    def test_a_box_is_halved_and_each_half_is_a_solid(self):
        part = self.put_box()
        run = self.run_tool("half", part, "--height", "0.25", "-o", "half%d.stl", status=0)
        self.assertEqual(run.text, part + ": 2 pieces: 20 faces, volume 4; 20 faces, volume 12\n")
        self.assertEqual(run.err, "")
        for name in ("half0.stl", "half1.stl"):
            done = subprocess.run([MEND, "--check", name], cwd=self.folder, capture_output=True)
            self.assertEqual(done.returncode, 0, msg=done.stdout)
        for keep, volume in (("below", 4), ("above", 12)):
            run = self.run_tool("half", part, "--at", "9,9,0.25", "--keep", keep, "-f", "-o",
                                "half.off", status=0)
            self.assertIn(f"1 piece: 20 faces, volume {volume}\n", run.text)
        self.run_tool("half", "half1.stl", "--height", "0.5", "-f", "-o", "half%d.stl", status=2)
        os.remove(self.path("half0.stl"))
        self.run_tool("half", part, "--height", "0.5", "-o", "half%d.stl", status=4)
        self.assertFalse(os.path.exists(self.path("half0.stl")))
        self.put("half0.stl", "mine")
        self.put("lines0.svg", "mine")
        for words in (("half", "none.stl", "--height", "0.5", "-o", "half%d.stl"),
                      ("section", "none.stl", "--layers", "0.5", "-o", "lines%d.svg")):
            run = self.run_tool(*words, status=4)  # before anything is read
            self.assertIn("exists; -f overwrites it", run.err)
        for name in ("no.stl", "no.ply", "no.obj", "no.off", "no.3mf"):
            run = self.run_tool("half", part, "--height", "7", "--keep", "above", "-o", name,
                                status=0)
            self.assertIn("1 piece: 0 faces, volume 0\n", run.text)
            self.assertIn("the kept half is empty: the mesh is between heights 0 and 1", run.err)
            self.assertTrue(os.path.exists(self.path(name)))
        run = self.run_tool("half", part, "--height", "0.25", "--keep", "below", "-o", "-",
                            "--output-format", "off", status=0)
        self.assertTrue(run.out.startswith(b"OFF\n12 20"))

    def test_what_meets_is_made_one_first_which_is_said(self):
        write(self.path("two.obj"), together(box((0, 0, 0), (2, 2, 2)), box((1, 1, 0), (3, 3, 2))))
        run = self.run_tool("half", "two.obj", "--height", "1", "-n", status=0)
        self.assertIn("2 pieces", run.text)
        self.assertIn("overlapping parts are merged", run.err)
        entry = self.report("half", "two.obj", "--height", "1", "-n", status=0)["files"][0]
        self.assertEqual([w["code"] for w in entry["warnings"]], ["self-intersections"])
        write(self.path("apart.obj"),
              together(box((0, 0, 0), (2, 2, 2)), box((3, 3, 0), (4, 4, 2))))
        self.assertEqual(self.run_tool("half", "apart.obj", "--height", "1", "-n", status=0).err,
                         "")

    def test_caps_have_texture_by_their_planes(self):
        self.put_box()
        lines = [line.split() for line in self.read("part.obj").splitlines()]
        text = "".join(" ".join(line) + "\n" for line in lines if line[0] == "v")
        text += "vt 0 0\nvt 2 0\nvt 0 2\n"  # of faces of 4 x 4, two to a length of four
        text += "".join("f " + " ".join(f"{v}/{i}" for i, v in enumerate(line[1:], 1)) + "\n"
                        for line in lines if line[0] == "f")
        self.put("uv.obj", text)
        self.run_tool("half", "uv.obj", "--height", "0.5", "-o", "h%02d.obj", status=0)
        below, above = (self.read(f"h0{i}.obj") for i in range(2))
        caps = []
        for half in (below, above):
            points = [tuple(map(float, line.split()[1:4])) for line in half.splitlines()
                      if line.startswith("v ")]
            texture = [tuple(map(float, line.split()[1:3])) for line in half.splitlines()
                       if line.startswith("vt ")]
            pairs = set()
            for line in half.splitlines():
                if not line.startswith("f "):
                    continue
                corners = [tuple(int(n) - 1 for n in word.split("/")[:2])
                           for word in line.split()[1:]]
                if all(points[v][2] == 0.5 for v, _ in corners):
                    pairs |= {(points[v], texture[t]) for v, t in corners}
            caps.append(pairs)
        self.assertEqual(caps[0], caps[1])
        scale = [t[k] / p[k] for p, t in caps[0] for k in range(2) if p[k] != 0]
        self.assertEqual(len(caps[0]), 8)
        for one in scale:
            self.assertAlmostEqual(one, scale[0])

    def test_shapes_are_solids_within_distances(self):
        part = self.put_box()
        for words, least, greatest in ((("offset", "--distance", "0.4"), 39, 41),
                                       (("offset", "--distance", "-0.25"), 6, 6.2),
                                       (("hollow", "--wall", "0.25", "--drain", "2,2,0,0.5"), 9,
                                        10),
                                       (("thicken", "--thickness", "0.4"), 16, 22)):
            entry = self.report(*words, "--resolution", "0.1", part, "-f", "-o", "out.stl",
                                status=0)["files"][0]
            self.assertTrue(entry["pieces"][0]["certified"])
            self.assertTrue(least < entry["pieces"][0]["volume"] < greatest, msg=words)
            self.assertLess(entry["distances"]["min"], abs(float(words[2])) + 1e-9)
            done = subprocess.run([MEND, "--check", "out.stl"], cwd=self.folder,
                                  capture_output=True)
            self.assertEqual(done.returncode, 0, msg=done.stdout)
        entry = self.report("simplify", "--distance", "0.01", part, "-f", "-o", "out.stl",
                            status=0)["files"][0]
        self.assertEqual(entry["pieces"][0]["faces"], 12)
        self.assertLessEqual(entry["distances"]["max"], 0.01)
        run = self.run_tool("hollow", "--wall", "0.2", "--drain", "0,2,0,0.5", part, "-f", "-o",
                            "out.stl", status=0)
        self.assertRegex(run.text, r" 0\.19\d* to 0\.2\d* away\n$")
        self.assertEqual(run.err, "")
        write(self.path("two.obj"), together(box((0, 0, 0), (4, 4, 1)), box((9, 0, 0), (13, 4, 1))))
        run = self.run_tool("hollow", "--wall", "0.2", "--drain", "2,2,0,0.5", "two.obj", "-f",
                            "-o", "out.stl", "-r", "r.json", status=0)
        self.assertIn("1 cavity has no drain", run.err)
        self.assertEqual(json.loads(self.read("r.json"))["files"][0]["cavities"],
                         {"sealed": 1, "blind_drains": []})
        run = self.run_tool("hollow", "--wall", "0.6", part, "-n", status=1)
        self.assertIn("nowhere thicker than two walls", run.err)
        self.run_tool("hollow", part, "-f", "-o", "out.stl", status=2)
        self.run_tool("hollow", "--wall", "-1", part, "-f", "-o", "out.stl", status=2)

    def test_fewer_faces_keep_values_and_their_borders(self):
        points = [(x, y, 0) for x in range(9) for y in range(9)]
        faces = []
        for p in (9 * x + y for x in range(8) for y in range(8)):
            faces += [(p, p + 9, p + 10), (p, p + 10, p + 1)]
        rows = ["%d %d %d %d" % (*p, p[0] + 10 * p[1]) for p in points]
        rows += ["3 %d %d %d %d" % (*f, f[0] >= 36) for f in faces]
        self.put("sheet.ply", "ply\nformat ascii 1.0\nelement vertex 81\nproperty float x\n"
                   "property float y\nproperty float z\nproperty float warm\nelement face 128\n"
                   "property list uchar int vertex_indices\nproperty uchar side\nend_header\n"
                   + "\n".join(rows) + "\n")
        self.run_tool("simplify", "--distance", "0.001", "sheet.ply", "-o", "few.ply", "--ascii")
        lines = self.read("few.ply").split("end_header\n")[1].split("\n")
        vertices = [line.split() for line in lines if len(line.split()) == 4]
        self.assertEqual(len(vertices), 6)
        for x, y, _, warm in vertices:
            self.assertEqual(float(warm), float(x) + 10 * float(y))
        sides = [line.split()[-1] for line in lines if line.startswith("3 ")]
        self.assertEqual(sorted(sides), ["0", "0", "1", "1"])
        self.put("flag.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n")
        run = self.run_tool("simplify", "--distance", "0.1", "flag.obj", "-o", "few.obj")
        self.assertEqual(run.err, "")
        self.assertIn("f 1/1 2/2 3/3", self.read("few.obj"))

    def test_sections_are_written_in_four_formats(self):
        part = self.put_box()
        for name, start in (("s.svg", "<svg"), ("s.dxf", "0\nSECTION"), ("s.obj", "v "),
                            ("s.json", "{")):
            run = self.run_tool("section", part, "--layers", "0.25", "-o", name, status=0)
            self.assertEqual(run.text, part + ": 4 layers, 4 loops\n")
            self.assertTrue(self.read(name).startswith(start))
        self.assertEqual([layer["area"] for layer in json.loads(self.read("s.json"))["layers"]],
                         [16] * 4)
        entry = self.report("section", part, "--height", "0,1,2", "-n", status=0)["files"][0]
        self.assertEqual([layer["area"] for layer in entry["layers"]], [0, 16, 0])
        run = self.run_tool("section", part, "--at", "2,2,0.5", "--normal", "1,1,0", "-n", status=0)
        self.assertIn("1 loop, area 5.65685, length 13.3137", run.text)
        self.run_tool("section", part, "--layers", "0.25", "-o", "layer%03d.json", status=0)
        for i in range(4):
            layer, = json.loads(self.read(f"layer00{i}.json"))["layers"]
            self.assertEqual((layer["height"], layer["area"], len(layer["loops"][0]["points"])),
                             (0.125 + 0.25 * i, 16, 4))
        run = self.run_tool("section", part, "--height", "0.5", "--units", "cm", "-o", "-",
                            status=0)
        self.assertEqual(json.loads(run.out)["unit"], "cm")
        self.run_tool("section", part, "--height", "0.5", "-o", "s.svg", status=4)  # is there
        self.assertTrue(self.read("s.svg").count("<g") == 4)

    def test_isolines_are_of_heights_distances_and_properties(self):
        part = self.put_box()
        run = self.run_tool("isolines", part, "--count", "3", "-o", "a.svg", status=0)
        self.assertEqual(run.text, part + ": 3 levels, 3 lines, length 48\n")
        self.assertEqual(self.read("a.svg").count("<g id=\"level"), 3)
        run = self.run_tool("isolines", part, "--normal", "1,0,0", "--at", "1,0,0", "--levels",
                            "0.5,9", "-o", "a.obj", status=0)
        self.assertIn(": 2 levels, 1 line, length 10", run.text)
        self.assertIn("v 1.5 ", self.read("a.obj"))
        write(self.path("to.obj"), box((1, 1, 0), (3, 3, 1)))
        entry = self.report("isolines", part, "--to", "to.obj", "--levels",
                            "1", "-o", "a.dxf", status=0)["files"][0]
        self.assertTrue(entry["isolines"]["signed"])
        self.assertAlmostEqual(entry["isolines"]["max"], 2 ** 0.5)
        lines = [line + (f" {i % 2} 0.5 0" if line.startswith("v ") else "")
                 for i, line in enumerate(self.read("part.obj").splitlines())]
        self.put("colors.obj", "\n".join(lines) + "\n")
        run = self.run_tool("isolines", "colors.obj", "--value", "red", "--levels", "0.5", "-o",
                            "-", status=0)
        self.assertTrue(json.loads(run.out)["lines"])
        run = self.run_tool("isolines", "colors.obj", "--value", "gren", "--levels", "0.5", "-n",
                            status=2)
        self.assertIn("expected one of height, distance, red, green, blue", run.err)
        run = self.run_tool("isolines", part, "--levels", "5", "-n", "--html", "a.html", status=0)
        self.assertIn("no level is in the range: height is between 0 and 1", run.err)
        self.assertIn("isolines", self.read("a.html"))
        for arguments in ([], ["--levels", "1", "--value", "height", "--to", "a.obj"],
                          ["--value", "distance", "--levels", "1"], ["--count", "0"],
                          ["--levels", "1", "-o", "a.stl"], ["--levels", "1", "--height", "1"]):
            self.run_tool("isolines", part, *arguments, *([] if "-o" in arguments else ["-n"]),
                          status=2)

    def test_open_and_turned_surfaces_are_told_of(self):
        points, faces = box((0, 0, 0), (1, 1, 1))
        upright = [i for i, f in enumerate(faces) if len({points[v][2] for v in f}) == 2]
        part = write(self.path("open.obj"), (points, [f for i, f in enumerate(faces)
                                                      if i != upright[0]]))
        run = self.run_tool("section", part, "--height", "0.5", "-n", status=0)
        self.assertIn("1 polyline is open", run.err)
        a, b, c = faces[upright[0]]
        turned = write(self.path("turned.obj"), (points, [f for i, f in enumerate(faces)
                                                          if i != upright[0]] + [(a, c, b)]))
        run = self.run_tool("section", turned, "--height", "0.5", "-n", status=0)
        self.assertIn("1 polyline runs along inconsistently oriented faces", run.err)
        entry = self.report("section", turned, "--height", "0.5", "-n", status=0)["files"][0]
        self.assertIn("unoriented-loops", [w["code"] for w in entry["warnings"]])
        run = self.run_tool("half", part, "--height", "0.5", "-o", "h%d.stl", status=1)
        self.assertIn("not cut: its surface ends at 3 edges", run.text)
        self.assertIn("--open cuts it as a surface", run.err)
        self.assertEqual(sorted(os.listdir(self.folder)), ["open.obj", "turned.obj"])
        run = self.run_tool("half", part, "--height", "0.5", "--open", "-o", "h%d.stl", status=0)
        self.assertIn("2 pieces", run.text)

    def test_pieces_fit_the_bed_and_may_be_objects_of_one_file(self):
        part = self.put_box()
        entry = self.report("pieces", part, "--bed", "3,1.5", "-o", "piece%d.ply", "--caps", "cap",
                            status=0)["files"][0]
        self.assertEqual([piece["file"] for piece in entry["pieces"]],
                         [f"piece{i}.ply" for i in range(6)])
        self.assertAlmostEqual(sum(piece["volume"] for piece in entry["pieces"]), 16)
        self.assertTrue(all(piece["certified"] for piece in entry["pieces"]))
        self.assertIn(b"property int cap", self.read_bytes("piece0.ply"))
        self.run_tool("pieces", part, "--height", "0.25,0.5", "-o", "all.3mf", status=0)
        with zipfile.ZipFile(self.path("all.3mf")) as archive:
            model = archive.read("3D/3dmodel.model").decode()
        self.assertEqual(re.findall(r'name="(piece \d)"', model), ["piece 0", "piece 1", "piece 2"])
        self.run_tool("pieces", part, "--height", "0.25", "-o", "all.obj", status=0)
        self.assertEqual(re.findall(r"(?m)^o (.*)$", self.read("all.obj")), ["piece 0", "piece 1"])

    def test_parts_are_taken_by_volume_and_keep_their_colors(self):
        both = together(together(box((0, 0, 0), (1, 1, 1)), box((3, 0, 0), (5, 2, 2))),
                        box((6, 0, 0), (6.5, 1, 1)))
        part = write(self.path("three.obj"), both)
        run = self.run_tool("parts", part, "-o", "part%d.stl", status=0)
        self.assertEqual(run.text, part + ": 3 parts: 12 faces, volume 1; 12 faces, volume 8; "
                                          "12 faces, volume 0.5\n")
        run = self.run_tool("parts", part, "--min-volume", "0.75", "-n", status=0)
        self.assertIn("2 parts", run.text)
        run = self.run_tool("parts", part, "--largest", "1", "-o", "large.stl", status=0)
        self.assertIn("1 part: 12 faces, volume 8", run.text)
        lines = [line + (f" {i % 2} 0.5 0" if line.startswith("v ") else "")
                 for i, line in enumerate(self.read("three.obj").splitlines())]
        self.put("colors.obj", "\n".join(lines) + "\n")
        self.run_tool("parts", "colors.obj", "-o", "c%d.obj", status=0)
        self.assertEqual(len(re.findall(r"(?m)^v \S+ \S+ \S+ [01] 0.5 0$", self.read("c1.obj"))), 8)

    def test_info_says_what_a_file_is_as_a_table_of_many(self):
        part = self.put_box()
        run = self.run_tool("info", part, status=0)
        self.assertEqual(run.text, part + ": 12 faces, 4 x 4 x 1, solid; 1 component, area 48, "
                                          "volume 16, center (2, 2, 0.5), thinnest wall 1 at "
                                          "(1.33333, 1.33333, 0)\n")
        points, faces = cube()
        write(self.path("open.obj"), (points, faces[1:]))
        report = self.report("info", part, "open.obj", status=0)
        first, second = (entry["info"] for entry in report["files"])
        self.assertEqual(first["inertia"][2][2], 16 * 32 / 12)
        self.assertTrue(first["solid"] and not second["solid"])
        self.assertEqual(second["defects"], "open at 3 edges")
        self.assertTrue(second["area"] > 0 and second["volume"] is None)  # it ends: around nothing
        self.assertTrue(second["center"] is None and second["inertia"] is None)
        self.assertEqual(first["thinnest"]["by"], "ray")
        self.assertEqual(first["thinnest"]["thickness"], 1)
        self.assertEqual(first["oriented_box"]["size"], [4, 4, 1])
        self.assertIsNone(second["thinnest"])
        self.assertEqual((first["unit"], second["unit"]), (None, None))
        for how, thickness in (("sphere", 2 / 3), ("none", None)):
            info = self.report("info", part, "--measure-walls", how, "--units", "mm",
                               status=0)["files"][0]["info"]
            self.assertEqual(info["unit"], "mm")
            if thickness:
                self.assertAlmostEqual(info["thinnest"]["thickness"], thickness, delta=1e-5)
            else:
                self.assertIsNone(info["thinnest"])
        c, d = math.cos(0.5), math.sin(0.5)
        points, faces = box((0, 0, 0), (4, 2, 1))
        write(self.path("turned.obj"), ([[c * x - d * y, d * x + c * y, z] for x, y, z in points],
                                        faces))
        run = self.run_tool("info", "turned.obj", status=0)
        self.assertIn(" (turned 4 x 2 x 1), solid", run.text)
        with open(self.path("nan.obj"), "w", encoding="utf-8") as file:
            file.write("v nan 0 0\n")
            for p in points:
                file.write("v " + " ".join(map(repr, p)) + "\n")
            for a, b, c in faces:
                file.write(f"f {a + 2} {b + 2} {c + 2}\n")
        self.assertIn("12 faces, 4 x 2 x 1, not a solid: 1 vertex that is not finite",
                      self.run_tool("info", "nan.obj", status=0).text)
        report = self.report("parts", "open.obj", "-n", status=0)
        self.assertIsNone(report["files"][0]["pieces"][0]["volume"])
        write(self.path("huge.obj"), ([[1e200 * x for x in p] for p in points], faces))
        run = self.run_tool("info", "huge.obj", status=0)
        self.assertNotIn("nan", run.text)
        self.assertIn("beyond the range of doubles", run.err)

    def test_planes_that_meet_nothing_are_told(self):
        part = self.put_box()
        for arguments in (["section", part, "--height", "7"], ["section", part, "--layers", "5"],
                          ["half", part, "--height", "7"], ["pieces", part, "--height", "0.5,7"]):
            run = self.run_tool(*arguments, "-n", status=0)
            self.assertIn("the mesh is between heights 0 and 1\n", run.err, msg=arguments)
        run = self.run_tool("half", part, "--height", "7", "--keep", "above", "-n", status=0)
        self.assertIn("the kept half is empty: the mesh is between heights 0 and 1\n", run.err)
        for arguments in (["half", part, "--height", "7", "--keep", "below"],
                          ["pieces", part, "--height", "0.5,0.5"]):
            self.assertEqual(self.run_tool(*arguments, "-n", status=0).err, "", msg=arguments)

    def test_moves_of_many_pieces_are_one_warning(self):
        part = self.put_box()
        run = self.run_tool("pieces", part, "--bed", "0.3,0.3,0.3", "-o", "p.3mf", status=0)
        self.assertEqual(run.err.count("points moved"), 1)
        run = self.run_tool("pieces", part, "--bed", "1,1", "--caps", "c", "-o", "p%d.ply",
                            status=0)
        self.assertEqual(len(run.err.splitlines()), len(set(run.err.splitlines())))

    def test_threads_change_no_byte(self):
        part = self.put_box()
        for threads in (1, 2):
            self.run_tool("pieces", part, "--bed", "0.7,0.9,0.4", "-o", f"p{threads}.obj", "-j",
                          threads, status=0)
            self.run_tool("section", part, "--layers", "0.01", "-o", f"s{threads}.json", "-j",
                          threads, status=0)
        self.assertEqual(self.read("p1.obj"), self.read("p2.obj"))
        self.assertEqual(self.read("s1.json"), self.read("s2.json"))

    def test_pages_and_pictures(self):
        part = self.put_box()
        self.run_tool("half", part, "--height", "0.5", "-n", "--html", "a.html", "--png", "a.png",
                      status=0)
        self.run_tool("section", part, "--height", "0.5", "-n", "--html", "b.html", status=0)
        self.run_tool("info", part, "--png", "c.png", status=0)
        self.assertIn("caps", self.read("a.html"))
        self.assertTrue(self.read_bytes("c.png").startswith(b"\x89PNG"))

    def test_what_makes_no_sense_is_refused(self):
        part = self.put_box()
        for arguments, words in [
                (["cut", part], "not a mode"),
                ([part], "not a mode; expected one of half, section"),
                (["half", part, "-n"], "half needs --height or --at"),
                (["half", part, "--height", "1,2", "-n"], "one --height"),
                (["half", part, "--height", "x", "-n"], "--height x: expected a number"),
                (["half", part, "--height", "0.5", "-o", "a.stl"], "a_%d.stl"),
                (["half", part, "--height", "0.5"], "no output: -o FILE"),
                (["half", part, "--height", "0.5", "--bed", "1,1", "-n"], "--bed is not for half"),
                (["half", part, "--at", "0,0,0", "--normal", "0,0,0", "-n"], "--normal"),
                (["half", part, "--height", "1", "--caps", "c", "-o", "a.3mf"], "--caps needs"),
                (["half", part, "--height", "1", "--output-dir", "d"], "--keep below or above"),
                (["section", part, "-n"], "section needs --height"),
                (["section", part, "--height", "1", "-o", "a.stl"], "svg, dxf, obj or json"),
                (["section", part, "--layers", "0", "-n"], "a thickness greater than 0"),
                (["section", part, "--layers", "1", "--height", "1", "-n"], "exclude"),
                (["section", part, "--height", "1", "--precision", "float", "-n"], "is not for"),
                (["pieces", part, "-n"], "pieces needs --bed or --height"),
                (["pieces", part, "--bed", "1", "-n"], "--bed"),
                (["pieces", part, "--bed", "1,0", "-n"], "greater than 0"),
                (["pieces", part, "--bed", "1,1", "--at", "0,0,0", "-n"], "--bed chooses"),
                (["parts", part, "--height", "1", "-n"], "--height is not for parts"),
                (["parts", part, "--min-volume", "-1", "-n"], "--min-volume"),
                (["parts", part, "--largest", "2", "-o", "p.stl"],
                 "there may be several parts, but stl holds one: use -o p_%d.stl, or write 3mf"),
                (["info", part, "-o", "a.stl"], "--output is not for info")]:
            run = self.run_tool(*arguments, status=2)
            self.assertIn(words, run.err, msg=arguments)
        for arguments in (["pieces", part, "--bed", "1e-6,1", "-n"],
                          ["pieces", part, "--bed", "1e-3,1e-3,1e-3", "-n"],
                          ["section", part, "--layers", "1e-9", "-n"]):
            self.run_tool(*arguments, status=2)
        self.run_tool("info", "missing.stl", status=3)
        self.assertEqual(os.listdir(self.folder), ["part.obj"])


if __name__ == "__main__":
    main()
