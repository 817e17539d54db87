"""tf-repair: dirty meshes in, solids out; what is wrong, what was done, what is refused."""

import re
import zipfile

from boolean_support import *
from support import ToolTest

def flipped(face):
    return face[0], face[2], face[1]


class Mend(ToolTest):
    tool = MEND

    def mended(self, *arguments, status=0):
        return self.report(*arguments, status=status)["files"][0]

    def cube_without(self, *numbers):
        points, faces = cube()
        return points, [f for i, f in enumerate(faces) if i not in numbers]

    def test_a_solid_comes_back_as_it_was(self):
        part = write(self.path("part.obj"), CLEAN)
        run = self.run_tool(part, "-o", "out.obj", status=0)
        self.assertEqual(run.text,
                         part + ": solid, 12 faces, volume 1 (was 1): nothing to repair\n")
        self.assertEqual(obj_mesh(self.read("out.obj")), obj_mesh(self.read("part.obj")))
        self.assertEqual(run.err, "")

    def test_a_flat_part_without_its_cap_is_closed(self):
        points, faces = box((0, 0, 0), (100, 100, 2))
        open_top = [f for f in faces if not all(points[i][2] == 2 for i in f)]
        part = write(self.path("plate.obj"), (points, open_top))
        run = self.run_tool(part, "-o", "out.stl", status=0)
        self.assertIn("volume 20000 ", run.text)
        self.assertIn("1 hole filled (4 edges)", run.text)

    def test_a_shell_within_another_is_said_to_be_dropped(self):
        (outer, faces), (inner, more) = box((0, 0, 0), (20, 20, 20)), box((5, 5, 5), (15, 15, 15))
        part = write(self.path("nested.obj"),
                     (outer + inner, faces + [tuple(i + len(outer) for i in f) for f in more]))
        entry = self.mended(part, "-o", "out.obj")
        self.assertEqual(entry["repair"]["dropped_shells"], 1)
        text, = (w["text"] for w in entry["warnings"] if w["code"] == "dropped-shells")
        self.assertIn("1 shell within another was dropped", text)
        self.assertIn("--fill-rule even-odd makes a cavity of it", text)
        run = self.run_tool(part, "--fill-rule", "even-odd", "-o", "hollow.obj", status=0)
        self.assertIn("volume 7000 ", run.text)
        self.assertEqual(run.err, "")

    def test_what_a_refusal_offers_leads_on(self):
        rim = [(3, 0), (2, 2), (-1, 3), (-3, 0), (-2, -2), (1, -3)]
        lens = [(0, 0, 1)] + [(x, y, 0.2 * (i % 2)) for i, (x, y) in enumerate(rim)]
        roof = [(0, 1 + i, 1 + (i + 1) % 6) for i in range(6)]
        flat = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
        for name, mesh in (("lens", (lens, roof)), ("flat", (flat, [(0, 1, 2), (0, 2, 3)]))):
            part = write(self.path(name + ".obj"), mesh)
            run = self.run_tool(part, "-o", "out.obj", "--force", status=1)
            offers = re.findall(r"--(?:sheet|accept-loss|wrap 2%)", run.text)
            self.assertEqual("--accept-loss" in offers, name == "lens", msg=run.text)
            self.assertIn("--sheet", offers)
            for offer in offers:
                self.run_tool(part, "-o", "out.obj", "--force", *offer.split(), status=0)

    def test_rooms_are_one_solid_and_their_labels_are_counted(self):
        lines = [f"v {x} {y} {z}" for x in range(3) for y in range(3) for z in range(2)]
        point = lambda x, y, z: 6 * x + 2 * y + z + 1
        for i in range(2):
            for j in range(2):
                roof = [point(i, j, 1), point(i + 1, j, 1), point(i + 1, j + 1, 1),
                        point(i, j + 1, 1)]
                lines += ["f " + " ".join(map(str, roof)),
                          "f " + " ".join(str(p - 1) for p in reversed(roof))]
        for at in range(3):  # walls, each there once
            for i in range(2):
                for ends in ((point(at, i, 0), point(at, i + 1, 0)),
                             (point(i + 1, at, 0), point(i, at, 0))):
                    a, b = ends if at else reversed(ends)
                    lines.append(f"f {a} {b} {b + 1} {a + 1}")
        rooms = self.path("rooms.obj")
        with open(rooms, "w") as file:
            file.write("\n".join(lines) + "\n")
        entry = self.mended(rooms, "-o", "house.obj")
        self.assertEqual(volume(*obj_mesh(self.read("house.obj"))), 4)
        did = entry["repair"]["steps"]["resolve"]
        self.assertEqual((did["labeled_cells"], did["dropped_area"], did["flipped_area"]),
                         (4, 4, 0))
        self.assertIn("4 cells labeled inside or outside (area 4 dropped)",
                      self.run_tool(rooms, "-n", status=0).text)
        self.run_tool("house.obj", "--check", status=0)

    def test_faces_that_are_tetrahedra_become_their_boundary(self):
        corners = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
        five = [(0, 4, 2, 1), (3, 1, 2, 7), (5, 1, 7, 4), (6, 2, 4, 7), (1, 2, 4, 7)]
        def sign(t):
            a, *rest = (corners[i] for i in t)
            (p, q, r) = ([x - y for x, y in zip(c, a)] for c in rest)
            return (p[0] * (q[1] * r[2] - q[2] * r[1]) - p[1] * (q[0] * r[2] - q[2] * r[0]) +
                    p[2] * (q[0] * r[1] - q[1] * r[0]))
        for wanted in (1, -1):
            with self.subTest(sign=wanted):
                same = [t if sign(t) * wanted > 0 else (t[0], t[1], t[3], t[2]) for t in five]
                with open(self.path("volume.obj"), "w") as file:
                    file.writelines(f"v {x} {y} {z}\n" for x, y, z in corners)
                    file.writelines("f " + " ".join(str(i + 1) for i in t) + "\n" for t in same)
                run = self.run_tool("volume.obj", "-o", "out.obj", "--force", status=0)
                self.assertIn("solid, 12 faces, volume 1 ", run.text)
                self.assertIn("boundary kept of 5 tetrahedra", run.text)
                entry = self.mended("volume.obj", "--check", status=1)
                self.assertEqual(entry["defects"]["tetrahedra"], 5)
                self.assertIn("faces are the sides of 5 tetrahedra",
                              self.run_tool("volume.obj", "--check", status=1).text)
                self.run_tool("out.obj", "--check", status=0)

    def test_each_kind_of_dirt_is_mended_and_counted(self):
        points, faces = cube()
        far = [(9.0, 9.0, 9.0), (9.01, 9.0, 9.0), (9.0, 9.01, 9.0)]
        torn = together(*[([points[c] for c in face], [(0, 1, 2)]) for face in faces])
        gap = [tuple(x + 1e-5 * ((7 * i + k) % 3 - 1) for k, x in enumerate(p))
               for i, p in enumerate(torn[0])]
        for name, mesh, volume_after, done in [
                ("hole", self.cube_without(3), 1, "1 hole filled (3 edges)"),
                ("holes", self.cube_without(0, 11), 1, "2 holes filled (6 edges)"),
                ("flips", (points, [flipped(f) if i % 5 == 0 else f for i, f in enumerate(faces)]),
                 1, "3 faces flipped"),
                ("inverted", (points, [flipped(f) for f in faces]), 1, "1 part turned outward"),
                ("stray", (points + far, faces + [(8, 9, 10)]), 1, "1 stray face dropped"),
                ("twice", (points, faces + faces[:1]), 1, "1 repeated face dropped"),
                ("flat", (points, faces + [(0, 0, 1)]), 1, "1 face without area dropped"),
                ("cracks", (gap, torn[1]), None, "crack edges closed"),
                ("overlap", TWO_CUBES, 1.875, "pairs cut"),
                ("touching", together(cube(), cube((1.0, 1.0, 0.0))), None, "moved apart")]:
            with self.subTest(name):
                part = write(self.path(name + ".obj"), mesh)
                entry = self.mended(part, "-o", name + "-out.obj")
                run = self.run_tool(part, "-n", status=0)
                self.assertIn(done, run.text)
                self.assertTrue(entry["repair"]["solid"])
                self.assertTrue(entry["repair"]["certified"])
                after = volume(*obj_mesh(self.read(name + "-out.obj")))
                self.assertAlmostEqual(entry["repair"]["volume"]["after"], after)
                if volume_after is not None:
                    self.assertEqual(after, volume_after)
                self.run_tool(name + "-out.obj", "--check", status=0)

    def test_a_wrap_is_closed_around_anything(self):
        faces = [face for i, face in enumerate(cube()[1]) if i not in (0, 1)]  # one side is open
        part = write(self.path("part.obj"), together((cube()[0], faces), TWO_CUBES))
        run = self.run_tool(part, "--wrap", "1.5", "-o", "out.stl", status=0)
        self.assertRegex(run.text,
                         r"part.obj: wrap, [\d,]+ faces, volume .* \(was .*\), 0.05 from the faces")
        self.assertNotIn("covers both sides", run.err)
        self.run_tool("out.stl", "--check", status=0)
        entry = self.mended(part, "--wrap", "20%", "--offset", "0.1", "-o", "out.ply")
        self.assertIsNone(entry["repair"])
        wrap = entry["wrap"]
        self.assertTrue(wrap["certified"])
        self.assertEqual((wrap["offset"], wrap["components"]), (0.1, 1))
        self.assertEqual(wrap["faces"], 2 * wrap["vertices"] - 4)
        self.assertEqual(entry["output"]["precision_out"], "double")
        self.run_tool("out.ply", "--check", status=0)
        opened = write(self.path("open.obj"), (cube()[0], faces))
        run = self.run_tool(opened, "--wrap", "0.1", "-n", status=0)
        self.assertIn("covers both sides", run.err)
        warnings = self.mended(opened, "--wrap", "0.1", "-n")["warnings"]
        self.assertEqual([w["code"] for w in warnings], ["double-walled"])

    def test_a_wrap_takes_no_steps_and_a_size_that_makes_sense(self):
        part = write(self.path("part.obj"), CLEAN)
        for arguments, said in [
                (["--wrap", "1", "--gap", "1"], "--gap: --wrap replaces all steps"),
                (["--wrap", "1", "--no-fill"], "--no-fill: --wrap replaces all steps"),
                (["--offset", "1"], "--offset needs --wrap"),
                (["--wrap", "0"], "--wrap: expected a SIZE greater than 0"),
                (["--wrap", "1", "--offset", "0"], "--offset: expected a DIST greater than 0"),
                (["--wrap", "1e-7", "--precision", "float"], "is too small: coordinates are"),
                (["--wrap", "x"], "--wrap")]:
            with self.subTest(arguments):
                self.assertIn(said, self.run_tool(part, "-n", *arguments, status=2).err)

    def test_what_is_wrong_is_said_and_nothing_is_changed(self):
        part = write(self.path("part.obj"), self.cube_without(0, 11))
        run = self.run_tool(part, "--check", status=1)
        self.assertEqual(run.text, part + ": open at 6 edges\n")
        entry = self.mended(part, "--check", status=1)
        self.assertEqual(entry["defects"]["boundary_edges"], 6)
        self.assertIsNone(entry["repair"])
        write(self.path("two.obj"), TWO_CUBES)
        self.assertIn("pairs of faces meet", self.run_tool("two.obj", "--check", status=1).text)
        write(self.path("clean.obj"), CLEAN)
        self.assertEqual(self.run_tool("clean.obj", "--check", status=0).text,
                         "clean.obj: solid, 12 faces, volume 1\n")
        self.assertEqual(self.listing(), ["clean.obj", "part.obj", "two.obj"])

    def test_what_is_not_finite_is_a_defect(self):
        points, faces = CLEAN
        part = write(self.path("part.stl"), (list(points) + [(float("nan"), 0.0, 0.0)],
                                             list(faces) + [(0, 1, len(points))]))
        defects = self.mended(part, "--check", status=1)["defects"]
        self.assertEqual((defects["non_finite"], defects["non_finite_vertices"]), (1, 1))
        self.assertEqual(defects["boundary_edges"], 0)
        self.assertIn("1 vertex that is not finite, 1 face with a corner that is not finite",
                      self.run_tool(part, "--check", status=1).text)

    def test_a_step_can_be_left_out(self):
        hole = write(self.path("hole.obj"), self.cube_without(3))
        run = self.run_tool(hole, "--no-fill", "-o", "out.stl", status=1)
        self.assertEqual(run.text, hole
                         + ": not written: open at 3 edges (--sheet writes it, --wrap 2% wraps "
                           "it)\n")
        self.assertNotIn("out.stl", self.listing())
        run = self.run_tool(hole, "--holes", "2", "-n", status=1)
        entry = self.mended(hole, "--sheet", "-o", "sheet.obj")
        self.assertEqual((entry["repair"]["certified"], entry["repair"]["solid"]), (True, False))
        self.assertIsNone(entry["repair"]["steps"]["fill"])
        self.assertEqual(obj_mesh(self.read("sheet.obj")), obj_mesh(self.read("hole.obj")))
        self.assertTrue(self.run_tool(hole, "--sheet", "-n", status=0).text.startswith(
            hole + ": sheet, 11 faces, area 5.5: nothing to repair"))
        touching = write(self.path("two.obj"), together(cube(), cube((1.0, 1.0, 0.0))))
        entry = self.mended(touching, "--no-detach", "-n")
        self.assertIsNone(entry["repair"]["steps"]["detach"])
        self.assertEqual(entry["repair"]["volume"]["after"], 2)

    def test_what_would_lose_too_much_is_not_written(self):
        sheet = [(x + 3, y, z) for x, y, z in grid(1)[0]]
        points, faces = together(self.cube_without(3), (sheet, grid(1)[1]))
        part = write(self.path("part.obj"), (points, faces))
        run = self.run_tool(part, "-o", "out.obj", status=1)
        self.assertEqual(run.text, part
                         + ": not written: open at 4 edges (--sheet writes it, --accept-loss makes "
                           "a solid, --wrap 2% wraps it)\n")
        entry = self.mended(part, "--strays", "30%", "-o", "out.obj", status=1)
        self.assertEqual(entry["repair"]["loss"], {"of": "area", "before": 6.5, "after": 5.5})
        self.assertNotIn("out.obj", self.listing())
        for options in (["--strays", "30%", "--accept-loss"],
                        ["--strays", "0.3", "--max-loss", "20%"]):
            self.run_tool(part, *options, "-f", "-o", "out.obj", status=0)
            self.assertEqual(volume(*obj_mesh(self.read("out.obj"))), 1)

    def test_rounding_that_moves_a_point_too_far_is_not_written(self):
        part = write(self.path("part.obj"), cube((1 / 3, 0.0, 0.0)))
        run = self.run_tool(part, "-o", "out.stl", "--max-move", "1e-12", status=1)
        self.assertIn("--max-move", run.text)
        entry = self.mended(part, "-o", "out.stl")
        self.assertEqual(entry["repair"]["precision_out"], "float")
        self.assertLess(0, entry["repair"]["max_move"]["largest"])

    def test_what_is_written_is_manifold_for_who_joins_equal_coordinates(self):
        part = write(self.path("part.stl"), together(cube(), cube((1.0, 1.0, 0.0))))
        entry = self.mended(part, "-o", "out.stl")
        self.assertGreater(entry["repair"]["steps"]["detach"]["moved"], 0)
        self.assertEqual(entry["repair"]["steps"]["detach"]["touching"], 0)
        entry = self.mended("out.stl", "--check")
        self.assertEqual(entry["defects"]["nonmanifold_edges"], 0)
        self.assertEqual(entry["defects"]["nonmanifold_vertices"], 0)

    def test_properties_and_sources_go_with_the_faces(self):
        points, faces = self.cube_without(3)
        rows = [f"3 {a} {b} {c} {10 * i}" for i, (a, b, c) in enumerate(faces)]
        self.put("part.ply", "\n".join(
            ["ply", "format ascii 1.0", f"element vertex {len(points)}", "property double x",
             "property double y", "property double z", f"element face {len(faces)}",
             "property list uchar int vertex_indices", "property int id", "end_header",
             *(f"{x} {y} {z}" for x, y, z in points), *rows, ""]))
        self.run_tool("part.ply", "-o", "out.ply", "--ascii", "--source", "from", status=0)
        lines = self.read("out.ply").splitlines()
        names = [line.split()[-1] for line in lines if line.startswith("property int")]
        self.assertEqual(names, ["id", "from"])
        body = lines[lines.index("end_header") + 1 + len(points):]
        self.assertEqual([tuple(map(int, line.split()[4:])) for line in body],
                         [(10 * i, i) for i in range(11)] + [(0, -1)])

    def test_coplanar_faces_that_were_cut_are_merged_unless_told(self):
        part = write(self.path("part.obj"), together(cube(), cube((0.5, 0.0, 0.0))))
        merged = self.mended(part, "-o", "out.stl")["repair"]
        kept = self.mended(part, "--keep-cuts", "-o", "cut.stl")["repair"]
        self.assertEqual(merged["faces"], 12)
        self.assertGreater(kept["faces"], 12)
        self.assertEqual(merged["steps"]["resolve"], kept["steps"]["resolve"])

    def test_lines_where_faces_met(self):
        part = write(self.path("part.obj"), TWO_CUBES)
        self.run_tool(part, "-o", "out.stl", "--curves", "lines.obj", status=0)
        self.assertIn("\nl ", self.read("lines.obj"))

    def test_a_scene_stays_a_scene(self):
        lines, first = ["mtllib m.mtl"], 1
        for name, (points, faces) in (("left", self.cube_without(3)), ("right", cube((3, 0, 0)))):
            lines += [f"o {name}", f"usemtl {name}_m", *(f"v {x} {y} {z}" for x, y, z in points),
                      *("f " + " ".join(str(c + first) for c in face) for face in faces)]
            first += len(points)
        self.put("scene.obj", "\n".join([*lines, ""]))
        self.put("m.mtl", "newmtl left_m\nKd 1 0 0\nnewmtl right_m\nKd 0 1 0\n")
        self.run_tool("scene.obj", "-o", "out.obj", status=0)
        text = self.read("out.obj")
        self.assertEqual([l for l in text.splitlines()
                          if l.split()[0] in ("o", "usemtl", "mtllib")],
                         ["mtllib m.mtl", "o left", "usemtl left_m", "o right", "usemtl right_m"])
        self.run_tool("scene.obj", "-o", "out.3mf", status=0)
        with zipfile.ZipFile(self.path("out.3mf")) as package:
            model = package.read("3D/3dmodel.model").decode()
        self.assertEqual(re.findall(r'<object id="\d+" type="model" name="(\w+)"', model),
                         ["left", "right"])
        entry = self.mended("out.3mf", "-o", "again.3mf")
        self.assertEqual(entry["repair"]["steps"]["fill"]["holes"], 0)

    def test_overlapping_objects_stay_apart_where_the_output_has_objects(self):
        lines, first = [], 1
        for name, (points, faces) in (("a", cube()), ("b", cube((0.5, 0, 0)))):
            lines += [f"o {name}", *(f"v {x} {y} {z}" for x, y, z in points),
                      *("f " + " ".join(str(c + first) for c in face) for face in faces)]
            first += len(points)
        self.put("scene.obj", "\n".join([*lines, ""]))
        run = self.run_tool("scene.obj", "-o", "out.3mf", status=0)
        self.assertIn("2 parts, each a solid, 24 faces, volume 2 (was 2): nothing to repair",
                      run.text)
        entry = self.mended("scene.obj", "-o", "again.3mf")
        self.assertEqual([(p["name"], p["faces"], p["solid"]) for p in entry["repair"]["parts"]],
                         [("a", 12, True), ("b", 12, True)])
        self.run_tool("out.3mf", "--check", status=0)
        for name in ("out.stl", "out.glb"):
            run = self.run_tool("scene.obj", "-o", name, status=0)
            self.assertIn(": solid, ", run.text)
            self.assertIn("volume 1.5 (was 2)", run.text)
            self.run_tool(name, "--check", status=0)
        self.put("scene.obj", "\n".join([*lines, "o c", "v 5 0 0", "v 6 0 0", "v 5 1 0",
                                         "f 17 18 19", ""]))
        run = self.run_tool("scene.obj", "-o", "no.3mf", status=1)
        self.assertIn('not written: part "c": open at 3 edges', run.text)

    def test_many_files_at_once(self):
        write(self.path("in-a.obj"), CLEAN)
        write(self.path("in-b.obj"), self.cube_without(3))
        write(self.path("in-c.obj"), grid(3))
        report = self.report("in-a.obj", "in-b.obj", "in-c.obj", "--output-dir", "out", status=1)
        self.assertEqual([f["exit"] for f in report["files"]], [0, 0, 1])
        self.assertEqual(sorted(os.listdir(self.path("out"))),
                         ["in-a-repaired.obj", "in-b-repaired.obj"])
        self.run_tool("in-b.obj", "--in-place", status=0)
        self.run_tool("in-b.obj", "--check", status=0)

    def test_help_and_what_makes_no_sense(self):
        run = self.run_tool("--help", status=0)
        self.assertEqual([line for line in run.text.splitlines() if len(line) > 80], [])
        for group in ("Steps, in this order", "Options:", "Limits", "Output:",
                      "Exit status:"):
            self.assertIn(group, run.text)
        part = write(self.path("part.obj"), CLEAN)
        for options in ([], ["--check", "-o", "out.stl"], ["--check", "--max-loss", "5%"],
                        ["--gap", "1", "--no-join", "-n"], ["--strays", "120%", "-n"],
                        ["--max-loss", "-1", "-n"], ["--fill-rule", "even", "-n"],
                        ["--holes", "3", "--sheet", "-n"], ["--source", "s", "-o", "out.stl"],
                        ["--curves", "out.stl", "-n"],
                        ["--fill-rule", "even-odd", "--no-resolve", "-n"], ["-o", "out.xyz"],
                        ["--keep-cuts", "--no-resolve", "-n"], ["--keep-cuts", "--sheet", "-n"],
                        ["--keep-cuts", "--check"]):
            with self.subTest(options=options):
                run = self.run_tool(part, *options, status=2)
                self.assertTrue(run.err.startswith("tf-repair: error: "), msg=run.err)

    def test_nothing_to_work_on(self):
        self.put("points.obj", "v 0 0 0\nv 1 0 0\n")
        run = self.run_tool("points.obj", "-n", status=3)
        self.assertIn("no triangle", run.err)
        self.put("nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        self.run_tool("nan.obj", "-n", status=3)


main()
