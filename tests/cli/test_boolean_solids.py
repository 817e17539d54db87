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
                                (["xor"], 14), (["--expr", "b-a"], 7), (["--expr", "a+b"], 15)):
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

    def test_formulas_take_any_number_of_inputs(self):
        entry = self.made("--expr", "(a-b)*c", "a.obj", "b.obj", "c.obj")
        self.assertEqual((entry["operation"], entry["output"]["volume"]), ("(a-b)*c", 4))
        self.assertEqual(self.made("difference", "a.obj", "b.obj", "c.obj")["output"]["volume"], 3)

    def test_one_input_is_united_with_itself(self):
        self.mesh("heap.obj", together(box((0, 0, 0), (2, 2, 2)), box((1, 1, 1), (3, 3, 3))))
        self.assertEqual(self.made("union", "heap.obj")["output"]["volume"], 15)
        self.assertEqual(self.made("union", "heap.obj", "--inside", "odd")["output"]["volume"], 14)

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

    def test_max_move_bounds_what_rounding_does(self):
        self.mesh("third.obj", ([(x / 3 + 0.1, y / 3, z / 3) for x, y, z in cube()[0]], cube()[1]))
        words = ("difference", "a.obj", "third.obj", "-o", "out.stl")
        entry = self.entry(*words, "--max-move", "1e-12", status=1)
        self.assertEqual(entry["max_move"], {"given": "1e-12", "used": 1e-12})
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
        self.assertEqual(len(entry["inputs"][1]["open"]["list"]), 3)
        self.assertIn("ends at 3 edges", entry["inputs"][1]["reason"])
        self.assertIsNone(entry["output"])
        self.assertNotIn("out.obj", self.listing())
        self.run_tool("union", "open.obj", "--exit-zero", status=0)

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

    def ply(self, name, points, faces, colours):
        """With a colour of each point, and the number of each face as its property id."""
        text = "ply\nformat ascii 1.0\nelement vertex %d\n" % len(points)
        text += "".join("property double %s\n" % axis for axis in "xyz")
        text += "".join("property uchar %s\n" % c for c in ("red", "green", "blue"))
        text += "property float nx\n"
        text += "element face %d\nproperty list uchar int vertex_indices\n" % len(faces)
        text += "property int id\nend_header\n"
        for p, c in zip(points, colours):
            text += " ".join(map(repr, p)) + " %d %d %d 1\n" % c
        for i, f in enumerate(faces):
            text += "3 %d %d %d %d\n" % (*f, 100 + i)
        with open(self.path(name), "w") as file:
            file.write(text)

    def test_properties_are_carried_and_interpolated(self):
        points, faces = box((0, 0, 0), (2, 2, 2))
        self.ply("a.ply", points, faces, [(100 * p[0], 50 * p[1], 7) for p in points])
        entry = self.made("difference", "a.ply", "b.obj", "--ascii", name="out.ply")
        self.assertIn("attributes", [w["code"] for w in entry["warnings"]])  # the normals
        head, body = self.read("out.ply").split("end_header\n")
        self.assertNotIn("nx", head)
        rows = [line.split() for line in body.splitlines()]
        vertices = entry["output"]["vertices"]
        inside = 0
        for x, y, z, red, green, blue in (map(float, row) for row in rows[:vertices]):
            if (x, y, z) == (1, 1, 1):  # of the other, which has no colours
                inside += 1
                self.assertEqual((red, green, blue), (0, 0, 0))
            else:
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
        entry = self.made("union", "nan.obj", "b.obj")
        self.assertEqual(entry["output"]["volume"], 15)
        self.assertEqual(entry["inputs"][0]["skipped"]["non_finite"], 2)
        self.assertIn("non-finite", [w["code"] for w in entry["warnings"]])

    def test_touching_parts_are_told(self):
        self.mesh("d.obj", box((2, 2, 0), (3, 3, 2)))
        entry = self.made("union", "a.obj", "d.obj")
        self.assertEqual(entry["output"]["nonmanifold_edges"], 1)
        self.assertIn("nonmanifold", [w["code"] for w in entry["warnings"]])

    def test_a_dry_run_writes_no_mesh(self):
        entry = self.entry("union", "a.obj", "b.obj", "-o", "out.obj", "-n", status=0)
        self.assertEqual(entry["output"]["volume"], 15)
        self.assertIsNone(entry["output"]["file"])
        self.assertNotIn("out.obj", self.listing())


if __name__ == "__main__":
    main()
