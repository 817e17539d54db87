"""tf-selfintersect --repair: what is written is whole, closed and free of self-intersections."""

from boolean_support import *
from support import ToolTest

import struct


class Repair(ToolTest):
    def repaired(self, *arguments, status=0):
        return self.report(*arguments, status=status)["files"][0]

    def no_pairs(self, name):
        self.run_tool(self.path(name), "--touching", status=0)

    def test_two_cubes_become_the_surface_of_both(self):
        part = write(self.path("part.obj"), TWO_CUBES)
        entry = self.repaired(part, "--repair", "-o", "out.obj")
        repair = entry["repair"]
        self.assertEqual((repair["mode"], repair["certified"]), ("outer", True))
        self.assertGreater(repair["self_intersections"]["before"], 0)
        self.assertEqual(repair["self_intersections"]["after"], 0)
        self.assertEqual(repair["volume"], {"before": 2, "after": 1.875})
        self.assertEqual((repair["boundary_edges"], repair["lost_components"]), (0, 0))
        self.assertEqual(entry["output"]["file"], "out.obj")
        self.assertEqual(volume(*obj_mesh(self.read("out.obj"))), 1.875)
        self.no_pairs("out.obj")
        self.assertEqual(self.repaired(part, "--repair=outer")["repair"], repair)

    def test_splitting_keeps_every_face(self):
        part = write(self.path("part.obj"), TWO_CUBES)
        repair = self.repaired(part, "--repair=split", "-o", "out.ply")["repair"]
        self.assertEqual(repair["volume"]["after"], 2)
        self.assertEqual(repair["removed_faces"], 0)
        self.assertGreater(repair["nonmanifold_edges"], 0)
        self.no_pairs("out.ply")

    def test_faces_that_lie_on_others_are_not_removed_but_counted(self):
        part = write(self.path("part.obj"), together(cube(), cube()))
        repair = self.repaired(part, "--repair=split", "-o", "out.obj")["repair"]
        self.assertEqual((repair["removed_faces"], repair["covered_faces"], repair["faces"]),
                         (0, 12, 12))
        self.assertIn("12 faces lie on others",
                      self.run_tool(part, "--repair=split", "-n", status=0).text)

    def test_parts_that_touch_have_points_of_their_own(self):
        part = write(self.path("part.obj"), together(cube(), cube((1.0, 1.0, 0.0))))
        repair = self.repaired(part, "--repair", "-o", "out.obj")["repair"]
        self.assertEqual((repair["separated_points"], repair["nonmanifold_edges"]), (2, 0))
        self.run_tool(self.path("out.obj"), status=0)
        self.assertEqual(len(obj_mesh(self.read("out.obj"))[0]), 16)

    def test_what_is_written_is_checked_in_the_precision_written(self):
        part = write(self.path("part.obj"), together(cube((0.1, 0.2, 0.3)), cube((0.4, 0.5, 0.7))))
        entry = self.repaired(part, "--repair", "-o", "out.stl")
        self.assertEqual(entry["repair"]["precision_out"], "float")
        self.assertGreater(entry["repair"]["max_move"]["largest"], 1e-12)
        self.assertEqual(entry["output"]["max_move"], entry["repair"]["max_move"]["largest"])
        self.assertEqual(len(self.read_bytes("out.stl")), 84 + 50 * entry["repair"]["faces"])
        self.no_pairs("out.stl")
        entry = self.repaired(part, "--repair", "-o", "out.ply")
        self.assertLess(entry["repair"]["max_move"]["largest"], 1e-15)
        entry = self.repaired(part, "--repair", "-n", "--precision", "float")
        self.assertEqual(entry["repair"]["precision_out"], "float")

    def test_a_surface_that_ends_has_no_outer_side(self):
        points, faces = TWO_CUBES
        part = write(self.path("part.obj"), (points, faces[1:]))
        run = self.run_tool(part, "--repair", "-o", "out.obj", status=1)
        self.assertIn("bounds no solid", run.text)
        self.assertRegex(run.text, r"the first from \(.*\) to \(.*\) at face \d+; --repair=split")
        self.assertNotIn("out.obj", self.listing())
        entry = self.repaired(part, "--repair", status=1)
        self.assertEqual(entry["repair"]["open"]["count"], 3)
        self.assertEqual(len(entry["repair"]["open"]["list"]), 3)
        self.repaired(part, "--repair=split", "-o", "out.obj")
        self.no_pairs("out.obj")

    def test_a_fold_is_removed_and_the_border_stays(self):
        points, faces = grid(8)
        points = list(points)
        points[40] = (2.25, 2.5, 0.0)
        part = write(self.path("part.obj"), (points, faces))
        entry = self.repaired(part, "--repair=remove", "-o", "out.obj")
        self.assertGreater(entry["repair"]["filled_faces"], 0)
        self.assertEqual(entry["repair"]["boundary_edges"], 32)
        self.assertEqual(entry["repair"]["max_move"]["largest"], 0)
        self.no_pairs("out.obj")

    def test_sheets_that_pass_through_each_other_lose_little(self):
        points, faces = grid(8)
        across = [(x + 0.25, 4.25, y - 4.25) for x, y, _ in points]
        part = write(self.path("part.obj"), together((points, faces), (across, faces)))
        entry = self.repaired(part, "--repair=remove", "--keep-components", "--max-loss",
                              "10%", "-o", "out.obj")
        self.assertGreater(entry["repair"]["left_open_edges"], 0)
        self.assertLess(entry["repair"]["removed_faces"], 20)
        self.run_tool("out.obj", status=0)
        self.assertIn("edges left open",
                      self.run_tool(part, "--repair=remove", "-n", "--accept-loss").text)

    def test_faces_that_only_touch_stay_unless_contact_counts(self):
        part = write(self.path("part.obj"), TOUCHING)
        repair = self.repaired(part, "--repair=remove", "-o", "out.obj")["repair"]
        self.assertEqual((repair["removed_faces"], repair["faces"]), (0, 2))
        repair = self.repaired(part, "--repair=remove", "--touching", "-n",
                               "--accept-loss")["repair"]
        self.assertEqual((repair["removed_faces"], repair["faces"]), (1, 1))

    def test_what_would_leave_nothing_is_no_repair(self):
        points, faces = cube()
        inside_out = [tuple(reversed(f)) for f in faces]
        part = write(self.path("part.obj"), together((points, faces), (points, inside_out)))
        run = self.run_tool(part, "--repair", "-o", "out.stl", "-r", "report.json", status=1)
        self.assertIn("nothing would be left", run.text)
        self.assertIn("--repair=split keeps one of each", run.text)
        self.assertEqual(self.listing(), ["part.obj", "report.json"])
        self.assertFalse(json.loads(self.read("report.json"))["files"][0]["repair"]["certified"])
        self.run_tool(part, "--repair=split", "-o", "one.obj", status=0)
        self.assertEqual(len(obj_mesh(self.read("one.obj"))[1]), 12)

    def test_what_the_numbers_written_cannot_tell_apart_is_no_repair(self):
        points, faces = TWO_CUBES
        part = write(self.path("part.obj"), ([tuple(1e-320 * x for x in p) for p in points], faces))
        for mode in ("outer", "split"):
            run = self.run_tool(part, f"--repair={mode}", "-o", "out.stl", status=1)
            self.assertIn("thinner than the spacing of float32 numbers", run.text)
            self.assertNotIn("out.stl", self.listing())

    def test_what_is_too_large_to_be_cut_is_bad_input(self):
        points, faces = cube()
        part = write(self.path("part.obj"), ([tuple(1e302 * x for x in p) for p in points], faces))
        run = self.run_tool(part, "--repair", "-o", "out.obj", status=3)
        self.assertIn("beyond 2^1000", run.err)

    def test_what_floats_cannot_hold_is_said_whatever_the_mode(self):
        points, faces = cube()
        part = write(self.path("part.obj"), ([tuple(1e39 * x for x in p) for p in points], faces))
        for mode in ("outer", "split", "remove"):
            run = self.run_tool(part, f"--repair={mode}", "-o", "out.stl", status=1)
            self.assertIn("coordinates are too large", run.text)
            self.run_tool(part, f"--repair={mode}", "-o", f"{mode}.obj", status=0)

    def test_points_that_no_face_has_do_not_count(self):
        points, faces = cube()
        points = points + [(1e6 + 0.1, 0, 0)]
        part = write(self.path("part.obj"), (points, faces))
        for mode in ("outer", "split", "remove"):
            repair = self.repaired(part, f"--repair={mode}", "-o", f"{mode}.stl")["repair"]
            self.assertEqual(repair["max_move"]["largest"], 0)

    def test_limits_are_kept(self):
        part = write(self.path("part.obj"), together(cube((0.1, 0.2, 0.3)), cube((0.4, 0.5, 0.7)),
                                                     cube((0.2, 0.3, 0.4), 0.25)))
        run = self.run_tool(part, "--repair", "--max-move", "0", "-o", "out.stl", status=1)
        self.assertIn("--max-move", run.text)
        run = self.run_tool(part, "--repair", "--keep-components", "-o", "out.stl", status=1)
        self.assertIn("1 component would disappear", run.text)
        self.assertEqual(self.listing(), ["part.obj"])
        run = self.run_tool(part, "--repair", "-o", "out.stl", status=0)
        self.assertIn("1 component has disappeared", run.err)

    def test_in_place_a_file_keeps_its_kind(self):
        part = write(self.path("part.stl"), TWO_CUBES)
        run = self.run_tool(part, "--repair", "-o", "text.stl", "--ascii", status=0)
        self.run_tool(part, "--repair", "--in-place", status=0)
        self.assertEqual(len(self.read_bytes("part.stl")) % 50, 84 % 50)
        self.no_pairs("part.stl")
        before = self.read("text.stl")
        self.run_tool("text.stl", "--repair=split", "--in-place", status=0)
        self.assertEqual(self.read("text.stl").split("facet", 1)[1], before.split("facet", 1)[1])
        self.assertEqual(self.listing(), ["part.stl", "text.stl"])
        points, faces = TWO_CUBES
        part = write(self.path("open.obj"), (points, faces[1:]))
        before = self.read("open.obj")
        self.run_tool(part, "--repair", "--in-place", status=1)
        self.assertEqual(self.read("open.obj"), before)

    def test_moves_beyond_rounding_are_said(self):
        part = write(self.path("part.obj"), TWO_CUBES)
        repair = self.repaired(part, "--repair", "-o", "out.obj")["repair"]
        self.assertEqual(repair["max_move"]["step"], 2 ** -52)

    def test_a_clean_mesh_stays_as_it_is(self):
        part = write(self.path("part.obj"), cube())
        for mode in ("split", "outer", "remove"):
            self.run_tool(part, f"--repair={mode}", "-o", "out.obj", "-f", status=0)
            self.assertEqual(obj_mesh(self.read("out.obj")), obj_mesh(self.read("part.obj")))

    def test_properties_go_along(self):
        rows = "".join(f"{x} {y} {z} {x}\n" for x, y, z in TWO_CUBES[0])
        faces = "".join(f"3 {a} {b} {c} {i}\n" for i, (a, b, c) in enumerate(TWO_CUBES[1]))
        with open(self.path("part.ply"), "w") as file:
            file.write(f"ply\nformat ascii 1.0\nelement vertex {len(TWO_CUBES[0])}\n"
                       "property double x\nproperty double y\nproperty double z\n"
                       f"property double heat\nelement face {len(TWO_CUBES[1])}\n"
                       "property list uchar int vertex_indices\nproperty int id\nend_header\n" +
                       rows + faces)
        self.run_tool(self.path("part.ply"), "--repair", "-o", "out.ply", "--ascii", status=0)
        lines = self.read("out.ply").splitlines()
        self.assertIn("property double heat", lines)
        self.assertIn("property int id", lines)
        names = [l.split()[-1] for l in lines if l.startswith("property int")]
        self.assertEqual(names, ["id", "source_face"])
        count = int(next(l for l in lines if l.startswith("element vertex")).split()[2])
        body = lines[lines.index("end_header") + 1:]
        for line in body[:count]:
            x, _, _, heat = map(float, line.split())
            self.assertAlmostEqual(x, heat)
        for *_, number, source in (line.split() for line in body[count:]):
            self.assertEqual(number, source)

    def test_coplanar_faces_that_were_cut_are_merged_unless_told(self):
        part = write(self.path("part.obj"), together(cube(), cube((0.5, 0.0, 0.0))))
        self.assertEqual(self.repaired(part, "--repair", "-o", "out.ply")["repair"]["faces"], 12)
        kept = self.repaired(part, "--repair", "--keep-cuts", "-o", "cut.ply")["repair"]
        self.assertGreater(kept["faces"], 12)
        self.assertEqual((kept["volume"]["after"], kept["removed_faces"]), (1.5, 4))

    def test_what_loses_too_much_is_not_written(self):
        points, faces = TWO_CUBES
        part = write(self.path("part.obj"), (points, faces))
        run = self.run_tool(part, "--repair=remove", "-o", "out.obj", status=1)
        self.assertRegex(run.text, r"not repaired, nothing written: too much would be lost: the "
                                   r"volume would fall from 1\.875 to [0-9.]+ \(--accept-loss")
        entry = self.repaired(part, "--repair=remove", "-n", status=1)
        self.assertEqual(entry["repair"]["loss"]["of"], "volume")
        self.assertEqual(entry["repair"]["loss"]["before"], 1.875)
        self.run_tool(part, "--repair=remove", "--accept-loss", "-o", "out.obj", status=0)
        self.run_tool(part, "--repair=remove", "--max-loss", "90%", "-n", status=0)

    def test_what_is_inside_can_be_told(self):
        part = write(self.path("part.obj"), TWO_CUBES)
        entry = self.repaired(part, "--repair", "--fill-rule", "even-odd", "-n")
        self.assertEqual(entry["repair"]["volume"]["after"], 1.75)
        entry = self.repaired(part, "--repair", "--fill-rule", "positive", "-n")
        self.assertEqual(entry["repair"]["volume"]["after"], 1.875)

    def test_what_makes_no_sense_is_refused(self):
        part = write(self.path("part.obj"), TWO_CUBES)
        for options in (["--repair=all"], ["--max-move", "1"], ["--keep-components"],
                        ["--fill-rule", "even-odd"], ["--max-loss", "5%"], ["--accept-loss"],
                        ["--keep-cuts"], ["--repair=split", "--keep-cuts", "-n"],
                        ["--repair=split", "--fill-rule", "even-odd", "-n"],
                        ["--repair", "--first"], ["--repair", "--within"],
                        ["-o", "out.stl"], ["--repair", "-o", "out.xyz"]):
            self.run_tool(part, *options, status=2)
        # A word after --repair is an input, not its mode.
        self.run_tool("--repair", part, "-n", status=0)

    def test_what_to_type_is_said_of_words_at_the_wrong_place(self):
        part = write(self.path("part.obj"), TWO_CUBES)
        for mode in ("outer", "split", "remove"):
            for words in (["--repair", mode, part], [part, "--repair", mode, "-o", "out.stl"]):
                self.assertEqual(self.run_tool(*words, status=2).err,
                                 f"tf-selfintersect: error: --repair {mode}: type --repair={mode}\n"
                                 f"")
        run = self.run_tool("--repair", part, "fixed.stl", status=2)
        self.assertEqual(run.err, "tf-selfintersect: error: fixed.stl: no such file; to write "
                                  "the result there, type -o fixed.stl\n")
        self.run_tool("--repair", part, "fixed.stl", "-n", status=3)  # an input
        self.put("outer", "")
        self.run_tool("--repair", "outer", "-n", status=3)


main()
