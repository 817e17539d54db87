"""What tf-boolean makes: volumes, sources, precision, open inputs."""

from boolean_support import *


class Solids(BooleanTest):
    def made(self, *arguments, name="out.obj"):
        entry = self.entry(*arguments, "-o", name, "-f", status=0)
        self.assertTrue(entry["output"]["certified"])
        self.assertEqual(entry["output"]["file"], name)
        self.assertEqual(entry["output"]["self_intersections"], 0)
        return entry

    def test_each_operation_has_its_volume(self):
        for words, expected in ((["union"], 15), (["intersection"], 1), (["difference"], 7),
                                (["symmetric-difference"], 14), (["--expr", "b-a"], 7),
                                (["--expr", "a+b"], 15)):
            entry = self.made(*words, "a.obj", "b.obj")
            self.assertEqual(entry["output"]["volume"], expected)
            self.assertEqual(volume(*self.solid("out.obj")), expected)
            self.assertEqual([i["volume"] for i in entry["inputs"]], [8, 8])
            self.assertEqual([i["closed"] for i in entry["inputs"]], [True, True])
            self.assertEqual(entry["output"]["max_move"], 0)

    def test_shared_faces_leave_nothing_behind(self):
        self.assertEqual(self.made("difference", "a.obj", "c.obj")["output"]["volume"], 4)
        self.assertEqual(volume(*self.solid("out.obj")), 4)
        self.assertEqual(self.made("difference", "a.obj", "a.obj", "c.obj")["output"]["faces"], 0)

    def test_parts_below_a_volume_are_left_out_and_counted(self):
        points, faces = cube()
        self.mesh("speck.obj", ([tuple(x / 64 + 9 for x in p) for p in points], faces))
        run = self.run_tool("union", "a.obj", "speck.obj", "--min-volume", "0.01", "-o", "out.obj",
                            status=0)
        self.assertIn("volume 8, 1 part below 0.01 dropped (total 3.8147e-06)", run.text)
        entry = self.made("union", "a.obj", "speck.obj", "--min-volume", "0.01")
        self.assertEqual(entry["min_volume"], {"given": 0.01, "parts": 1, "volume": 1 / 64 ** 3})
        self.assertEqual(len(self.solid("out.obj")[0]), 8)
        entry = self.made("union", "speck.obj", "--min-volume", "0.01")
        self.assertEqual((entry["output"]["faces"], entry["min_volume"]["parts"]), (0, 1))
        self.assertEqual(self.made("union", "a.obj")["min_volume"]["parts"], None)

    def test_gaps_of_a_union_are_filled_and_counted(self):
        self.mesh("above.obj", box((0, 0, 2.125), (2, 2, 4.125)))
        both = ("union", "a.obj", "above.obj")
        run = self.run_tool(*both, "--gap", "0.25", "-o", "out.obj", status=0)
        self.assertIn("volume 16.5, gaps of up to 0.25 filled between 4 faces", run.text)
        entry = self.made(*both, "--gap", "0.25")
        self.assertEqual(entry["gap"], {"given": "0.25", "used": 0.25, "faces": 4})
        self.assertEqual(entry["output"]["components"], 1)
        entry = self.made(*both, "--gap", "0.1")
        self.assertEqual((entry["gap"]["faces"], entry["output"]["volume"]), (0, 16))
        self.assertEqual(self.made(*both)["gap"], {"given": None, "used": None, "faces": None})

    def test_where_nothing_is_left_of_a_union_it_says_so(self):
        points, faces = cube()
        self.mesh("none.obj", together((points, faces), (points, [f[::-1] for f in faces])))
        entry = self.made("union", "none.obj")
        self.assertEqual(entry["output"]["faces"], 0)
        self.assertEqual(entry["output"]["exact_faces"], 0)
        self.assertIn("nothing-left", [w["code"] for w in entry["warnings"]])

    def test_of_nothing_that_has_materials_a_file_of_nothing_is_written(self):
        text = self.read(self.mesh("a.obj", cube()))
        with open(self.path("a.mtl"), "w") as file:
            file.write("newmtl red\nKd 1 0 0\n")
        with open(self.path("a.obj"), "w") as file:
            file.write("mtllib a.mtl\nusemtl red\n" + text)
        self.assertEqual(self.made("difference", "a.obj", "a.obj")["output"]["faces"], 0)
        self.assertEqual(self.made("union", "out.obj", name="again.obj")["output"]["faces"], 0)

    def test_what_a_format_is_too_coarse_for_is_no_empty_result(self):
        self.mesh("tiny.obj", ([tuple(1e-320 * x for x in p) for p in cube()[0]], cube()[1]))
        for operation in ("union", "split"):
            entry = self.entry(operation, "tiny.obj", "-o", "out.stl", status=1)
            output = entry["output"]
            self.assertEqual((output["faces"], output["exact_faces"]), (0, 12))
            self.assertEqual((output["certified"], output["file"]), (False, None))
            text, = (w["text"] for w in entry["warnings"] if w["code"] == "vanished")
            self.assertIn("--precision double, in a format that has it, gives 12 faces", text)
            self.assertNotIn("out.stl", self.listing())
        self.made("union", "tiny.obj")

    def test_what_doubles_are_too_coarse_for_is_no_empty_result(self):
        # A tip within the last double below 1: where its sides leave the cube is where it ends.
        tip = [(1 - 2 ** -53, 0.5, 0.5), (2.0, 0.4, 0.4), (2.0, 0.6, 0.4), (2.0, 0.5, 0.6)]
        self.mesh("tip.obj", (tip, [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)]))
        self.mesh("cube.obj", cube())
        run = self.run_tool("intersection", "cube.obj", "tip.obj", "-o", "out.obj", status=1)
        self.assertIn("0 faces remain of the", run.text)
        self.assertIn("when rounded to double", run.text)
        self.assertIn("thinner than the spacing of double numbers", run.err)
        self.assertNotIn("out.obj", self.listing())
        self.made("union", "cube.obj", "tip.obj")

    def test_what_solids_do_not_share_is_an_empty_result(self):
        self.mesh("far.obj", box((5, 5, 5), (6, 6, 6)))
        output = self.made("intersection", "a.obj", "far.obj", name="out.stl")["output"]
        self.assertEqual((output["faces"], output["exact_faces"]), (0, 0))

    def test_where_rounding_leaves_faces_that_meet_is_said(self):
        # Two octahedra, all but equal, flat and cut by their own sides; they were found by chance.
        hexes = ("-0x1.f3d4af{}8161p-21 0x1.b65866034c599p-32 0x1.565849a8ecd1ep-31",
                 "-0x1.f3b1b2f08a8fbp-21 0x1.01976b46ddca5p-31 0x1.e073b3cc1b922p-33",
                 "-0x1.f3e47f31d8321p-21 0x1.caca6808a6914p-32 0x1.a61d14ed75c2p-31",
                 "-0x1.f3aa6p-21 0x1.76p-32 0x1.09p-32", "-0x1.f3e2cp-21 0x1.c8p-32 0x1.9d8p-31",
                 "-0x1.f3a5cp-21 0x1.11p-31 0x1.54p-34")
        faces = [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4),
                 (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]
        for name, digits, first in (("p.obj", "702", 0), ("q.obj", "782", 3)):
            points = [tuple(map(float.fromhex, row.format(digits).split())) for row in hexes]
            self.mesh(name, (points[first:] + points[:first], faces))
            self.made("union", name, name="whole-" + name)
        run = self.run_tool("union", "whole-p.obj", "whole-q.obj", "-o", "out.obj")
        if run.status == 1:
            self.assertRegex(run.text, r"pairs of faces meet when rounded to double, the first "
                                       r"near \(-9\.3")
            self.assertIn("nothing written", run.err)
            self.assertNotIn("more than two faces", run.err)
            self.assertNotIn("out.obj", self.listing())
        else:
            self.solid("out.obj")

    def test_parts_that_a_format_is_too_coarse_for_are_named(self):
        speck = box((5, 5, 5), (5 + 2 ** -40, 5 + 2 ** -40, 5 + 2 ** -40))
        self.mesh("both.obj", together(cube(), speck))
        entry = self.made("union", "both.obj", name="out.stl")
        self.assertEqual(entry["output"]["lost_parts"],
                         {"count": 1, "list": [[5, 5, 5]], "distance": 0.0})
        self.assertIn("1 part of the exact result dropped, the first at (5, 5, 5)",
                      " ".join(w["text"] for w in entry["warnings"]))
        entry = self.made("union", "both.obj")
        self.assertEqual(entry["output"]["lost_parts"], {"count": 0, "list": [], "distance": 0.0})

    def test_what_is_too_large_to_be_cut_is_bad_input(self):
        self.mesh("huge.obj", ([tuple(1e302 * x for x in p) for p in cube()[0]], cube()[1]))
        run = self.run_tool("union", "huge.obj", "-o", "out.obj", status=3)
        self.assertIn("beyond 2^1000", run.err)

    def test_formulas_take_any_number_of_inputs(self):
        entry = self.made("--expr", "(a-b)*c", "a.obj", "b.obj", "c.obj")
        self.assertEqual((entry["operation"], entry["output"]["volume"]), ("(a-b)*c", 4))
        self.assertEqual(self.made("difference", "a.obj", "b.obj", "c.obj")["output"]["volume"], 3)

    def test_one_input_is_united_with_itself(self):
        self.mesh("heap.obj", together(box((0, 0, 0), (2, 2, 2)), box((1, 1, 1), (3, 3, 3))))
        self.assertEqual(self.made("union", "heap.obj")["output"]["volume"], 15)
        entry = self.made("union", "heap.obj", "--fill-rule", "even-odd")
        self.assertEqual((entry["fill_rule"], entry["output"]["volume"]), ("even-odd", 14))
        again = self.made("union", "heap.obj", "--fill-rule", "even_odd")
        self.assertEqual(again["output"]["volume"], 14)

    def test_what_is_clean_stays_bit_for_bit(self):
        points = [(x / 3, y / 7, z * 1e-3) for x, y, z in cube()[0]]
        self.mesh("clean.obj", (points, cube()[1]))
        self.made("union", "clean.obj")
        self.assertEqual(self.solid("out.obj"), (points, cube()[1]))

    def test_inputs_are_moved_by_matrices(self):
        with open(self.path("m.txt"), "w") as file:
            file.write("1 0 0 -1\n0 1 0 -1\n0 0 1 -1\n0 0 0 1\n")
        entry = self.made("difference", "a.obj", "b.obj", "--matrix", "2:m.txt")
        self.assertEqual(entry["output"]["faces"], 0)
        self.assertEqual(entry["inputs"][1]["matrix"], "m.txt")

    def test_split_keeps_every_piece(self):
        entry = self.made("split", "a.obj", "b.obj")
        points, faces = self.solid("out.obj")
        self.assertEqual(len(points), 16 + 6)
        self.assertIsNone(entry["output"]["volume"])

    def test_a_ply_tells_where_faces_come_from(self):
        self.made("difference", "a.obj", "b.obj", "--ascii", "--source", "from", name="out.ply")
        head, body = self.read("out.ply").split("end_header\n")
        self.assertIn("property uint from_mesh", head)
        self.assertIn("property uint from_face", head)
        vertices = int(head.split("element vertex ")[1].split()[0])
        rows = [line.split() for line in body.splitlines()[vertices:]]
        self.assertEqual({row[4] for row in rows}, {"0", "1"})
        self.assertTrue(all(int(row[5]) < 12 for row in rows))

    def test_a_result_is_an_input_again_with_sources_of_its_own(self):
        self.mesh("right.obj", box((2, 0, 0), (3, 2, 2)))
        self.made("union", "a.obj", "right.obj", "--ascii", name="first.ply")
        self.made("difference", "b.obj", "first.ply", "--ascii", name="second.ply")
        head = self.read("second.ply").split("end_header")[0]
        self.assertEqual(head.count("property uint source_mesh"), 1)
        self.assertEqual(head.count("comment source_mesh"), 2)
        entry = self.made("union", "first.ply", "--merge-coplanar", name="third.ply")
        self.assertEqual(entry["output"]["faces"], 12)

    def test_floats_are_certified_as_floats(self):
        points = [(x + 0.1, y / 3, z - 0.7) for x, y, z in cube()[0]]
        self.mesh("odd.obj", (points, cube()[1]))
        entry = self.made("difference", "a.obj", "odd.obj", name="out.stl")
        self.assertEqual(entry["output"]["precision_out"], "float")
        self.assertGreater(entry["output"]["max_move"], 0)
        run = subprocess.run([TOOL, "-q", "out.stl"], cwd=self.folder)
        self.assertEqual(run.returncode, 0)
        entry = self.made("difference", "a.obj", "odd.obj", "--precision", "float")
        for point in self.solid("out.obj")[0]:
            self.assertEqual(struct.unpack("<3f", struct.pack("<3f", *point)), point)

    def test_operands_may_be_parts_of_a_scene(self):
        lines, first = [], 1
        for name, mesh in (("body", box((0, 0, 0), (4, 4, 4))),
                           ("bolt_1", box((1, 1, 1), (2, 2, 9))),
                           ("left bolt", box((3, 3, 1), (5, 5, 2))),
                           ("far", box((9, 9, 9), (10, 10, 10)))):
            points, faces = mesh
            lines += [f"o {name}", *(f"v {x} {y} {z}" for x, y, z in points),
                      *("f " + " ".join(str(c + first) for c in face) for face in faces)]
            first += len(points)
        with open(self.path("scene.obj"), "w") as file:
            file.write("\n".join([*lines, ""]))
        entry = self.entry("--expr", "body-(bolt_1+'left bolt')", "scene.obj", "-o", "out.ply",
                           "--ascii", "--source", "s", status=0)
        self.assertEqual(entry["output"]["volume"], 64 - 3 - 1)
        self.assertEqual([i["part"] for i in entry["inputs"]], ["body", "bolt_1", "left bolt"])
        self.assertEqual([i["faces"] for i in entry["inputs"]], [12, 12, 12])
        text = self.read("out.ply")
        self.assertIn("comment s_mesh 2 scene.obj: left bolt\n", text)
        faces = text.splitlines()[-entry["output"]["faces"]:]
        sources = {tuple(map(int, line.split()[-2:])) for line in faces}
        self.assertLessEqual({face // 12 for mesh, face in sources}, {0, 1, 2})
        self.assertTrue(all(face // 12 == mesh for mesh, face in sources))
        # Of several files, and by one that is no scene in itself.
        write(self.path("b.obj"), box((-1, -1, -1), (1, 1, 1)))
        self.run_tool("--expr", "body*bolt_1", "scene.obj", "b.obj", "-n", status=0)
        self.run_tool("--expr", "a*b", "scene.obj", "b.obj", "-n", status=0)  # letters are files
        run = self.run_tool("--expr", "body-nut", "scene.obj", "-n", status=2)
        self.assertIn("no part is named nut; the parts are body, bolt_1, left bolt, far", run.err)
        for formula in ("body-(bolt_1", "body-'bolt", "body bolt_1"):
            self.run_tool("--expr", formula, "scene.obj", "-n", status=2)
        self.run_tool("union", "scene.obj", "-o", "o.3mf", status=0)  # names stay
        self.run_tool("--expr", "body-far", "o.3mf", "-n", status=0)

    def test_dirty_inputs_are_mended_first_when_asked(self):
        points, faces = cube()
        turned = [(a, c, b) if i == 5 else (a, b, c) for i, (a, b, c) in enumerate(faces)]
        write(self.path("dirty.obj"), (points, turned[1:]))
        write(self.path("b.obj"), cube((0.5, 0.5, 0.5)))
        self.run_tool("union", "dirty.obj", "b.obj", "-o", "u.obj", status=1)
        run = self.run_tool("union", "dirty.obj", "b.obj", "--repair", "-o", "u.obj", "-v",
                            status=0)
        self.assertIn("dirty.obj: 1 face flipped, 1 hole filled (3 edges)", run.err)
        self.assertEqual(volume(*obj_mesh(self.read("u.obj"))), 1.875)
        entry = self.entry("union", "dirty.obj", "b.obj", "--repair", "-o", "u.ply", "--ascii",
                           "--source", "s", status=0)
        self.assertEqual(entry["inputs"][0]["repair"]["fill"]["holes"], 1)
        self.assertEqual(entry["inputs"][1]["repair"]["fill"]["holes"], 0)
        lines = self.read("u.ply").splitlines()
        sources = {line.split()[-1] for line in lines[lines.index("end_header") + 1:]
                   if line.startswith("3 ")}
        self.assertIn("4294967295", sources)
        self.assertLessEqual(sources - {"4294967295"}, set(map(str, range(12))))
        write(self.path("sheet.obj"), grid(2))
        entry = self.entry("union", "sheet.obj", "b.obj", "--repair", "-n", status=1)
        self.assertEqual(entry["error"]["code"], "not-repaired")
        for options in (["--check", "--repair"], ["union", "--repair", "--accept-open", "-n"]):
            self.run_tool(*options, "b.obj", status=2)

    def test_max_move_bounds_what_rounding_does(self):
        self.mesh("third.obj", ([(x / 3 + 0.1, y / 3, z / 3) for x, y, z in cube()[0]], cube()[1]))
        words = ("difference", "a.obj", "third.obj", "-o", "out.stl")
        entry = self.entry(*words, "--max-move", "1e-12", status=1)
        self.assertEqual((entry["max_move"]["given"], entry["max_move"]["used"]), ("1e-12", 1e-12))
        self.assertLess(1e-12, entry["max_move"]["largest"])
        self.assertIn("max-move", [w["code"] for w in entry["warnings"]])
        self.assertNotIn("out.stl", self.listing())
        self.entry(*words, "--max-move", "0.001%", status=0)
        self.assertIn("out.stl", self.listing())

    def test_open_inputs_are_named_and_nothing_is_written(self):
        points, faces = box((0, 0, 0), (2, 2, 2))
        self.mesh("open.obj", (points, faces[:5] + faces[6:]))
        entry = self.entry("union", "a.obj", "open.obj", "-o", "out.obj", status=1)
        self.assertEqual([i["closed"] for i in entry["inputs"]], [True, False])
        self.assertEqual(entry["inputs"][1]["open"]["count"], 3)
        self.assertEqual(entry["inputs"][1]["open"]["boundary_edges"], 3)
        self.assertEqual(entry["inputs"][1]["open"]["misoriented_edges"], 0)
        self.assertEqual(len(entry["inputs"][1]["open"]["list"]), 3)
        self.assertIn("ends at 3 edges", entry["inputs"][1]["reason"])
        self.assertIsNone(entry["output"])
        self.assertNotIn("out.obj", self.listing())
        self.run_tool("union", "open.obj", "--exit-zero", "-n", status=0)

    def test_inputs_are_counted_once_in_a_sentence(self):
        points, faces = box((0, 0, 0), (2, 2, 2))
        self.mesh("open.obj", (points, faces[1:]))
        said = lambda *names, status: self.run_tool("--check", *names, status=status)
        self.assertEqual(said("a.obj", "b.obj", status=0).text, "2 inputs: all bound solids\n")
        self.assertEqual(said("a.obj", status=0).text, "a.obj: bounds a solid\n")
        self.assertEqual(said("open.obj", status=1).text, "open.obj: bounds no solid\n")
        run = said("a.obj", "open.obj", status=1)
        self.assertEqual(run.text, "2 inputs: 1 of 2 bounds no solid\n")
        self.assertTrue(run.err.startswith("tf-boolean: warning: open.obj: not a solid: its "
                                           "surface ends at 3 edges, the first from ("),
                        msg=run.err)

    def test_sentences_have_six_digits_and_reports_all(self):
        self.mesh("third.obj", box((0, 0, 0), (1 / 3, 1, 1)))
        self.mesh("large.obj", box((0, 0, 0), (200, 200, 30.86425)))
        run = self.run_tool("union", "third.obj", "-n", "-r", "r.json", status=0)
        self.assertIn("volume 0.333333\n", run.text)
        self.assertAlmostEqual(json.loads(self.read("r.json"))["files"][0]["output"]["volume"],
                               1 / 3, 15)
        self.assertIn("volume 1234570\n", self.run_tool("union", "large.obj", "-n").text)

    def test_check_only_looks(self):
        points, faces = box((0, 0, 0), (2, 2, 2))
        self.mesh("open.obj", (points, faces[1:]))
        self.run_tool("--check", "a.obj", status=0)
        self.run_tool("union", "--check", "a.obj", "b.obj", status=0)
        entry = self.entry("--check", "a.obj", "open.obj", status=1)
        self.assertEqual([i["closed"] for i in entry["inputs"]], [True, False])
        # Corners of an STL are joined first; a seam that fits piece by piece is closed.
        self.mesh("soup.stl", box((0, 0, 0), (2, 2, 2)))
        self.run_tool("--check", "soup.stl", status=0)

    def ply(self, name, points, faces, colors):
        """With a color of each point, and the number of each face as its property id."""
        text = "ply\nformat ascii 1.0\nelement vertex %d\n" % len(points)
        text += "".join("property double %s\n" % axis for axis in "xyz")
        text += "".join("property uchar %s\n" % c for c in ("red", "green", "blue"))
        text += "".join("property float n%s\n" % axis for axis in "xyz")
        text += "element face %d\nproperty list uchar int vertex_indices\n" % len(faces)
        text += "property int id\nend_header\n"
        for p, c in zip(points, colors):
            text += " ".join(map(repr, p)) + " %d %d %d 0 0 1\n" % c
        for i, f in enumerate(faces):
            text += "3 %d %d %d %d\n" % (*f, 100 + i)
        with open(self.path(name), "w") as file:
            file.write(text)

    def test_properties_are_carried_and_interpolated(self):
        points, faces = box((0, 0, 0), (2, 2, 2))
        self.ply("a.ply", points, faces, [(100 * p[0], 50 * p[1], 7) for p in points])
        entry = self.made("difference", "a.ply", "b.obj", "--ascii", name="out.ply")
        head, body = self.read("out.ply").split("end_header\n")
        rows = [line.split() for line in body.splitlines()]
        vertices = entry["output"]["vertices"]
        inside = 0
        for x, y, z, red, green, blue, *normal in (map(float, row) for row in rows[:vertices]):
            if (x, y, z) == (1, 1, 1):  # of the other, which has no colors
                inside += 1
                self.assertEqual((red, green, blue), (0, 0, 0))
                self.assertEqual(sorted(normal), [0, 0, 1])  # of a face, which looks that way
            else:
                self.assertEqual(normal, [0, 0, 1])
                self.assertEqual((red, green, blue), (100 * x, 50 * y, 7))
        self.assertEqual(inside, 1)
        for _, *_, number, mesh, face in (map(int, row) for row in rows[vertices:]):
            self.assertEqual(number, 100 + face if mesh == 0 else 0)
        self.made("difference", "a.ply", "b.obj", "--ascii", "--no-attributes", name="bare.ply")
        self.assertNotIn("red", self.read("bare.ply"))

    def test_faces_without_finite_corners_are_left_out_and_counted(self):
        points, faces = box((0, 0, 0), (2, 2, 2))
        points = points + [(float("nan"), 0, 0), (float("inf"), 1, 0)]
        self.mesh("nan.obj", (points, [(0, 1, 8)] + faces + [(9, 8, 8)]))
        entry = self.made("union", "nan.obj", "b.obj", "--curves", "curves.obj")
        self.assertEqual(entry["output"]["volume"], 15)
        self.assertEqual(entry["inputs"][0]["skipped"]["non_finite"], 2)
        self.assertIn("non-finite", [w["code"] for w in entry["warnings"]])

    def test_touching_parts_have_points_of_their_own(self):
        self.mesh("d.obj", box((2, 2, 0), (3, 3, 2)))
        entry = self.made("union", "a.obj", "d.obj")
        self.assertEqual(entry["separated_points"], 2)
        self.assertEqual((entry["output"]["vertices"], entry["output"]["components"]), (16, 2))
        self.assertEqual(len(set(self.solid("out.obj")[0])), 14)

    def test_parts_that_touch_in_an_edge_are_said_whatever_the_format(self):
        self.mesh("d.obj", box((2, 2, 0), (3, 3, 2)))
        self.mesh("e.obj", box((5, 5, 0), (6, 6, 2)))
        for format in ("stl", "off", "ply", "obj", "glb", "3mf"):
            for other, count in (("d.obj", 1), ("e.obj", 0)):
                entry = self.made("union", "a.obj", other, name="out." + format)
                self.assertEqual(entry["output"]["nonmanifold_edges"], count)
                texts = [w["text"] for w in entry["warnings"] if w["code"] == "nonmanifold"]
                self.assertEqual(len(texts), count)
                for text in texts:
                    self.assertIn("the result touches itself: 1 edge has more than two faces",
                                  text)
                    self.assertIn("tf-repair moves the parts apart", text)
                    self.assertEqual("STL" in text, format == "stl")
        self.made("union", "a.obj", "d.obj", name="out.stl")
        done = subprocess.run([MEND, "--check", "out.stl"], cwd=self.folder, capture_output=True)
        self.assertIn("1 edge of more than two faces", done.stdout.decode())
        subprocess.run([MEND, "-q", "out.stl", "-o", "apart.stl"], cwd=self.folder, check=True)
        subprocess.run([MEND, "-q", "--check", "apart.stl"], cwd=self.folder, check=True)

    def test_a_dry_run_writes_no_mesh(self):
        entry = self.entry("union", "a.obj", "b.obj", "-o", "out.obj", "-n", status=0)
        self.assertEqual(entry["output"]["volume"], 15)
        self.assertIsNone(entry["output"]["file"])
        self.assertNotIn("out.obj", self.listing())

    def test_attributes_of_an_stl_go_along(self):
        data = bytearray(stl_bytes(box((0, 0, 0), (2, 2, 2))))
        for i in range(12):
            struct.pack_into("<H", data, 84 + 50 * i + 48, 1000 + i)
        with open(self.path("marked.stl"), "wb") as file:
            file.write(data)
        self.made("difference", "marked.stl", "b.obj", name="out.stl")
        out = self.read_bytes("out.stl")
        found = {struct.unpack_from("<H", out, at + 48)[0] for at in range(84, len(out), 50)}
        self.assertEqual(found, {0} | set(range(1000, 1012)))

    def test_normals_turn_around_with_what_is_cut_away(self):
        points, faces = box((1, 1, 1), (3, 3, 3))
        self.ply("b.ply", points, faces, [(0, 0, 0)] * 8)
        self.made("difference", "a.obj", "b.ply", "--ascii", name="out.ply")
        head, body = self.read("out.ply").split("end_header\n")
        vertices = int(head.split("element vertex ")[1].split()[0])
        rows = [list(map(float, line.split())) for line in body.splitlines()[:vertices]]
        corner, = [row for row in rows if row[:3] == [1, 1, 1]]
        self.assertEqual(corner[-3:], [0, 0, -1])

    def test_simplifying_leaves_few_faces(self):
        self.mesh("right.obj", box((2, 0, 0), (3, 2, 2)))
        entry = self.made("union", "a.obj", "right.obj", "--merge-coplanar")
        self.assertEqual((entry["output"]["faces"], entry["output"]["vertices"]), (12, 8))
        self.assertEqual(volume(*self.solid("out.obj")), 12)
        entry = self.made("union", "a.obj", "right.obj", "--merge-coplanar", "--source", "from",
                          name="out.ply")
        self.assertEqual(entry["output"]["faces"], 20)
        # Faces with texture coordinates of corners stay apart, also if nothing is written.
        for name, low in (("a.obj", 0), ("right.obj", 2)):
            points, faces = box((low, 0, 0), (low + 2, 2, 2))
            self.put(name, "".join("v %g %g %g\n" % p for p in points)
                     + "vt 0 0\nvt 1 0\nvt 1 1\n"
                     + "".join("f %d/1 %d/2 %d/3\n" % tuple(v + 1 for v in f) for f in faces))
        entry = self.made("union", "a.obj", "right.obj", "--merge-coplanar")
        self.assertEqual(entry["output"]["faces"], 20)
        entry = self.entry("union", "a.obj", "right.obj", "--merge-coplanar", "-n", status=0)
        self.assertEqual(entry["output"]["faces"], 20)
        # Faces with values of their own stay apart, except for --no-attributes.
        points, faces = box((0, 0, 0), (2, 2, 2))
        self.ply("a.ply", points, faces, [(0, 0, 0)] * 8)
        entry = self.made("union", "a.ply", "--merge-coplanar")
        self.assertEqual(entry["output"]["faces"], 12)
        entry = self.made("union", "a.ply", "right.obj", "--merge-coplanar", "--no-attributes",
                          name="out.ply")
        self.assertEqual(entry["output"]["faces"], 12)

    def sheet(self, name, height):
        self.mesh(name, ([(-1, -1, height), (3, -1, height), (3, 3, height), (-1, 3, height)],
                         [(0, 1, 2), (0, 2, 3)]))

    def test_an_open_surface_is_cut_where_that_is_accepted(self):
        self.sheet("sheet.obj", 1)
        self.run_tool("difference", "sheet.obj", "a.obj", "-n", status=1)
        for words, area in ((["difference"], 12), (["intersection"], 4), (["--expr", "a-b"], 12)):
            entry = self.made(*words, "sheet.obj", "a.obj", "--accept-open")
            points, faces = self.solid("out.obj")
            found = sum(abs((points[b][0] - points[a][0]) * (points[c][1] - points[a][1]) -
                            (points[b][1] - points[a][1]) * (points[c][0] - points[a][0])) / 2
                        for a, b, c in faces)
            self.assertEqual(found, area)
            output = entry["output"]
            self.assertEqual((output["closed"], output["volume"], output["oriented"]),
                             (False, None, None))
            self.assertEqual([i["closed"] for i in entry["inputs"]], [False, True])
            self.assertIn("ends at 4 edges", entry["inputs"][0]["reason"])
            self.assertIn("open", [w["code"] for w in entry["warnings"]])
        # Closed inputs are what they are; and what cannot be is told.
        self.assertTrue(self.made("union", "a.obj", "b.obj", "--accept-open")["output"]["closed"])
        run = self.run_tool("union", "sheet.obj", "a.obj", "--accept-open", "-o", "no.obj",
                            status=1)
        self.assertIn("not united", run.text)
        self.run_tool("difference", "a.obj", "sheet.obj", "--accept-open", "-o", "no.obj",
                      status=1)
        self.sheet("other.obj", 0.5)
        run = self.run_tool("intersection", "sheet.obj", "other.obj", "--accept-open", "-n",
                            status=1)
        self.assertIn("--accept-open allows one open input", run.text)
        self.assertNotIn("no.obj", self.listing())

    def test_the_report_has_the_volumes_of_two_inputs(self):
        volumes = self.made("difference", "a.obj", "b.obj")["volumes"]
        self.assertEqual(volumes, {"first": 8, "second": 8, "union": 15, "intersection": 1,
                                   "error": 0})
        self.assertIsNone(self.made("union", "a.obj", "b.obj", "c.obj")["volumes"])

    def test_a_volume_that_no_double_holds_is_not_told(self):
        self.mesh("large.obj", box((-1e200, -1e200, -1e200), (1e200, 1e200, 1e200)))
        run = self.run_tool("union", "large.obj", "-o", "out.obj", "-r", "r.json", status=0)
        self.assertNotIn("volume", run.text)
        self.assertIsNone(json.loads(self.read("r.json"))["files"][0]["output"]["volume"])

    def test_an_empty_result_is_an_empty_solid(self):
        for extension in ("obj", "stl", "ply", "off", "glb"):
            name = "out." + extension
            entry = self.made("difference", "c.obj", "a.obj", name=name)
            self.assertEqual((entry["output"]["faces"], entry["output"]["volume"]), (0, 0))
            entry = self.entry("union", "a.obj", name, status=0)
            self.assertEqual(entry["output"]["volume"], 8)
            self.assertEqual(entry["inputs"][1]["volume"], 0)
            self.assertIn("empty", [w["code"] for w in entry["warnings"]])
            run = subprocess.run([TOOL, name], cwd=self.folder, capture_output=True)
            self.assertEqual(run.returncode, 3)
            self.assertIn(b"no triangle", run.stderr)
        self.made("difference", "c.obj", "a.obj", "--ascii", name="out.stl")
        self.run_tool("union", "a.obj", "out.stl", "-n", status=0)
        self.run_tool("intersection", "out.stl", "out.ply", "-n", status=0)
        self.mesh("points.obj", ([(0, 0, 0)], []))
        self.run_tool("union", "a.obj", "points.obj", "-n", status=3)  # that is no mesh

    def test_a_glb_holds_sources_and_is_read_again(self):
        self.made("union", "a.obj", "b.obj", "--source", "from", name="out.glb")
        data = self.read_bytes("out.glb")
        length, = struct.unpack("<I", data[12:16])
        text, binary = json.loads(data[20:20 + length]), data[28 + length:]
        primitive, = text["meshes"][0]["primitives"]
        values = {}
        for name, number in primitive["extras"]["face_properties"].items():
            accessor = text["accessors"][number]
            view = text["bufferViews"][accessor["bufferView"]]
            at = view["byteOffset"] + accessor["byteOffset"]
            values[name] = struct.unpack(f"<{accessor['count']}I",
                                         binary[at:at + 4 * accessor["count"]])
        self.assertEqual(set(values["from_mesh"]), {0, 1})
        self.assertLess(max(values["from_face"]), 12)
        self.assertEqual(len(values["from_mesh"]) * 3,
                         text["accessors"][primitive["indices"]]["count"])
        entry = self.entry("union", "out.glb", status=0)
        self.assertEqual(entry["output"]["volume"], 15)

    def test_curves_are_where_inputs_meet(self):
        self.made("union", "a.obj", "b.obj", "--curves", "curves.obj")
        points = read_obj(self.read("curves.obj"))
        # Six sides of a hexagon around the corner they have in common.
        self.assertTrue(all(1 in p and 2 in p or p.count(2) == 2 for p in points), msg=points)
        self.made("union", "a.obj", "b.obj", "--curves", "curves.ply")
        self.assertIn("property int source_mesh1", self.read("curves.ply"))

if __name__ == "__main__":
    main()
