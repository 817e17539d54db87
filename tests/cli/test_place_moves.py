"""Where tf-place puts things: exact travels, statuses, exit codes, what is written."""

from place_support import *

import math


class Moves(PlaceTest):
    def setUp(self):
        super().setUp()
        self.mesh("a.obj", box((1, 1, 5.5), (2, 2, 6.5)))
        self.mesh("floor.obj", box((0, 0, 0), (4, 4, 1)))
        self.mesh("in.obj", box((1, 1, 0.75), (2, 2, 1.75)))

    def placed(self, *arguments):
        entry = self.entry(*arguments, status=0)
        self.assertTrue(entry["placed"])
        return entry

    def refused(self, *arguments):
        entry = self.entry(*arguments, "-o", "refused.obj", status=1)
        self.assertFalse(entry["placed"])
        self.assertEqual(entry["not_placed"], [entry["input"]])
        for key in ("matrix", "travel", "output"):
            self.assertIsNone(entry[key])
        self.assertNotIn("refused.obj", self.listing())
        return entry

    def test_a_box_drops_exactly_onto_another(self):
        entry = self.placed("drop", "a.obj", "--fixed", "floor.obj", "-o", "out.obj")
        self.assertEqual((entry["travel"], entry["status"], entry["distance"]),
                         (4.5, "touching", 0))
        self.assertEqual(entry["matrix"], [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, -4.5],
                                           [0, 0, 0, 1]])
        self.assertEqual(self.points("out.obj"), box((1, 1, 1), (2, 2, 2))[0])
        self.assertIsNone(entry["bed"])
        for contact in entry["contacts"]:
            self.assertEqual((contact["point"][2], contact["normal"]), (1, [0, 0, 1]))
            self.assertIn(contact["fixed"], (2, 3))  # the faces of its top
        self.assertEqual(len(entry["contacts"]), entry["contact_count"])

    def test_without_a_direction_it_slides_down(self):
        entry = self.placed("slide", "a.obj", "--fixed", "floor.obj", "-o", "out.obj")
        self.assertEqual((entry["travel"], entry["direction"]), (4.5, [0, 0, -1]))

    def test_without_fixed_meshes_it_drops_on_the_bed(self):
        entry = self.placed("drop", "a.obj", "-o", "out.obj")
        self.assertEqual((entry["travel"], entry["status"]), (5.5, "touching"))
        self.assertEqual(entry["bed"], {"given": 0, "used": 0, "reached": True})
        self.assertEqual(self.lowest("out.obj"), 0)
        self.assertEqual([c["part"] for c in entry["contacts"]], ["bed"])
        self.assertEqual(self.placed("drop", "a.obj", "--bed", "-2.5")["travel"], 8)
        self.assertEqual(self.placed("drop", "a.obj", "--bed", "5.5")["travel"], 0)

    def test_the_bed_and_fixed_meshes_together_stop_it_at_the_first(self):
        both = ("drop", "a.obj", "--fixed", "floor.obj", "--bed")
        self.assertEqual(self.placed(*both, "0")["travel"], 4.5)
        self.assertEqual(self.placed(*both, "2")["travel"], 3.5)
        self.mesh("beside.obj", box((7, 7, 0), (8, 8, 1)))
        self.assertEqual(self.placed("drop", "a.obj", "--fixed", "beside.obj", "--bed", "0")
                         ["travel"], 5.5)
        self.assertIn("nothing is in the way",
                      self.refused("drop", "a.obj", "--fixed", "beside.obj")["reason"])

    def test_what_is_below_the_bed_is_lifted_onto_it_but_not_among_others(self):
        entry = self.placed("drop", "a.obj", "--bed", "6", "-o", "out.obj")
        self.assertEqual((entry["status_at_start"], entry["status"]), ("penetrating", "touching"))
        self.assertEqual((entry["travel"], entry["direction"]), (0.5, [0, 0, 1]))
        self.assertEqual((self.lowest("out.obj"), entry["bed"]["reached"]), (6, True))
        entry = self.placed("drop", "a.obj", "--bed", "5.25", "--clearance", "0.5", "-d", "1,0,-1",
                            "-o", "out.obj", "-f")
        self.assertEqual(self.points("out.obj")[0], (0.75, 1, 5.75))
        self.assertEqual(entry["status_at_start"], "closer-than-clearance")
        self.mesh("odd.stl", box((0.1, 0.1, -0.7), (0.7, 0.7, 0.9)))
        self.placed("drop", "odd.stl", "-o", "out.stl")
        self.assertEqual(self.lowest("out.stl"), 0)
        self.assertIn("lifted by 0.5", self.run_tool("drop", "a.obj", "--bed", "6", "-n").text)
        entry = self.refused("drop", "a.obj", "--bed", "6", "--fixed", "floor.obj")
        self.assertEqual(entry["status"], "penetrating")
        self.assertIn("0.5 below the bed", entry["reason"])
        self.assertIn("without --fixed", entry["reason"])
        entry = self.refused("drop", "a.obj", "--bed", "6", "--max-travel", "0.25")
        self.assertIn("0.25", entry["reason"])

    def test_a_place_that_the_numbers_do_not_reach_is_refused(self):
        for arguments in (["drop", "a.obj"], ["lay", "a.obj"],
                          ["pack", "a.obj", "--size", "9,9"]):
            run = self.run_tool(*arguments, "--bed", "-1e300", "-o", "out.stl", status=2)
            self.assertIn("range of the float32 coordinates", run.err)
        self.mesh("far.obj", box((0, 0, 1e300), (1e300, 1e300, 2e300)))
        most = 1.7e308
        self.mesh("most.obj", box((-most, -most, -most), (most, most, most)))
        self.mesh("left.obj", box((-most, 0, 0), (-1.6e308, 1, 1)))
        self.mesh("right.obj", box((1.6e308, 0, 0), (most, 1, 1)))
        self.refused("separate", "most.obj", "--fixed", "a.obj", "--clearance", "1%")
        for arguments in (["drop", "far.obj", "--output-format", "stl"],
                          ["mate", "left.obj", "--fixed", "right.obj"],
                          ["align", "left.obj", "--fixed", "right.obj"],
                          ["drop", "far.obj", "--fixed", "a.obj", "--output-format", "stl"],
                          ["lay", "most.obj"],
                          ["align", "most.obj", "--fixed", "a.obj"]):
            self.assertIn("beyond the range", self.refused(*arguments)["reason"])
        self.assertEqual(self.listing(),
                         ["a.obj", "far.obj", "floor.obj", "in.obj", "left.obj", "most.obj",
                          "right.obj"])

    def test_what_rounding_takes_is_said(self):
        self.mesh("third.obj", box((1 / 3, 1 / 3, 1 / 3), (2 / 3, 2 / 3, 2 / 3)))
        entry = self.placed("drop", "third.obj", "-o", "out.stl")
        self.assertEqual([w["code"] for w in entry["warnings"]], ["rounded"])
        self.assertLess(0, entry["rounding"]["max_move"])
        self.assertLess(entry["rounding"]["max_move"], 2 ** -25)
        self.assertEqual(entry["rounding"]["step"], 2 ** -24)
        self.assertEqual(entry["rounding"]["collapsed_faces"], 0)
        self.assertEqual(self.placed("drop", "third.obj", "-o", "out.obj")["warnings"], [])
        # Floats that stay as fine as they were are nothing to speak of.
        self.assertEqual(self.placed("drop", "out.stl", "--bed", "0.1", "-o", "on.stl")["warnings"],
                         [])
        self.mesh("post.obj", box((3e8, 3e8, 0), (3e8 + 1000, 3e8 + 1000, 1)))
        self.mesh("fine.stl", ball_of_lines())
        entry = self.placed("mate", "fine.stl", "--fixed", "post.obj", "-o", "far.stl")
        self.assertEqual([w["code"] for w in entry["warnings"]], ["rounded", "rounding-defects"])
        self.assertGreater(entry["rounding"]["collapsed_faces"], 0)
        self.assertIn("lost all area", entry["warnings"][1]["text"])
        self.assertEqual(self.placed("mate", "fine.stl", "--fixed", "post.obj", "-o", "far.obj",
                                     "--precision", "double")["warnings"], [])

    def test_the_lowest_point_written_is_the_bed_exactly(self):
        self.mesh("odd.stl", box((0.1, 0.1, 0.3), (0.7, 0.7, 0.9)))
        self.mesh("odd.obj", box((0.1, 0.1, 1 / 3), (0.7, 0.7, 0.9)))
        for bed in (0, 0.1, -1 / 3, 1e-9):
            self.placed("drop", "odd.obj", "--bed", repr(bed), "-o", "out.obj", "-f")
            self.assertEqual(self.lowest("out.obj"), bed)
            entry = self.placed("drop", "odd.stl", "--bed", repr(bed), "-o", "out.stl", "-f")
            self.assertEqual(self.lowest("out.stl"), entry["bed"]["used"])
            self.assertGreaterEqual(entry["bed"]["used"], bed)
            self.assertLess(entry["bed"]["used"] - bed, abs(bed) * 2**-22 + 1e-40)

    def test_slide_stops_at_the_clearance(self):
        slide = ("slide", "a.obj", "--fixed", "floor.obj", "-d", "0,0,-3")
        entry = self.placed(*slide, "--clearance", "0.5")
        self.assertEqual((entry["travel"], entry["status"], entry["distance"]), (4, "clear", 0.5))
        self.assertEqual(entry["direction"], [0, 0, -1])
        self.assertEqual(self.placed(*slide)["travel"], 4.5)
        self.assertEqual(entry["closest"]["fixed"]["point"][2], 1)
        self.assertEqual(entry["closest"]["moving"]["point"][2], 1.5)

    def test_slide_gives_up_beyond_the_longest_travel(self):
        slide = ("slide", "a.obj", "--fixed", "floor.obj", "-d", "0,0,-1", "--max-travel")
        self.assertEqual(self.placed(*slide, "4.5")["travel"], 4.5)
        self.assertIn("within a travel of 4.4", self.refused(*slide, "4.4")["reason"])
        self.assertIn("nothing is in the way", self.refused(
            "slide", "a.obj", "--fixed", "floor.obj", "-d", "1,0,0")["reason"])

    def test_what_touches_stays_and_what_penetrates_is_said(self):
        self.mesh("on.obj", box((1, 1, 1), (2, 2, 2)))
        for mode in (["drop"], ["slide", "-d", "0,0,-1"], ["mate"], ["separate"]):
            entry = self.placed(*mode, "on.obj", "--fixed", "floor.obj")
            self.assertEqual((entry["travel"], entry["status"]), (0, "touching"))
        for mode in (["drop"], ["slide", "-d", "0,0,-1"], ["mate"]):
            entry = self.refused(*mode, "in.obj", "--fixed", "floor.obj")
            self.assertEqual(entry["status_at_start"], "penetrating")
            self.assertIn("penetrates floor.obj", entry["reason"])
            self.assertGreater(len(entry["contacts"]), 0)

    def test_mate_brings_the_nearest_points_together(self):
        self.mesh("corner.obj", box((7, 8, 1), (8, 9, 2)))
        entry = self.placed("mate", "corner.obj", "--fixed", "floor.obj", "-o", "out.obj")
        self.assertEqual((entry["travel"], entry["status"]), (5, "touching"))
        self.assertEqual(self.points("out.obj"), box((4, 4, 1), (5, 5, 2))[0])
        entry = self.placed("mate", "corner.obj", "--fixed", "floor.obj", "--clearance", "1.25")
        self.assertAlmostEqual(entry["travel"], 3.75, places=12)
        self.assertEqual(entry["status"], "clear")
        self.assertGreaterEqual(entry["distance"], 1.25)
        self.refused("mate", "corner.obj", "--fixed", "floor.obj", "--max-travel", "4.9")

    def test_clear_takes_the_short_way_out(self):
        entry = self.placed("separate", "in.obj", "--fixed", "floor.obj", "-o", "out.obj")
        self.assertEqual((entry["travel"], entry["direction"]), (0.25, [0, 0, 1]))
        self.assertEqual(self.lowest("out.obj"), 1)
        entry = self.placed("separate", "in.obj", "--fixed", "floor.obj", "--clearance", "0.5")
        self.assertEqual((entry["travel"], entry["distance"], entry["status"]),
                         (0.75, 0.5, "clear"))
        self.assertEqual(entry["status_at_start"], "penetrating")
        self.assertEqual(self.placed("separate", "a.obj", "--fixed", "floor.obj", "--clearance",
                                     "4.5")["travel"], 0)
        self.assertIn("longer than 0.2", self.refused(
            "separate", "in.obj", "--fixed", "floor.obj", "--max-travel", "0.2")["reason"])

    def test_clear_minds_all_fixed_meshes(self):
        self.mesh("lid.obj", box((0, 0, 2), (4, 4, 3)))
        entry = self.placed("separate", "in.obj", "--fixed", "floor.obj", "--fixed", "lid.obj",
                            "-o", "out.obj")
        self.assertEqual(entry["travel"], 0.25)
        self.assertEqual(self.entry("measure", "out.obj", "--fixed", "floor.obj", "--fixed",
                                    "lid.obj")["status"], "touching")
        entry = self.placed("separate", "in.obj", "--fixed", "floor.obj", "--fixed", "lid.obj",
                            "--clearance", "0.5")
        self.assertEqual((entry["travel"], entry["direction"]), (2.25, [0, 0, -1]))  # not up

    def test_a_float_file_never_penetrates_as_written(self):
        self.mesh("slope.obj", ([(0, 0, 0), (3, 0, 1), (0, 3, 1.1), (0, 0, -4)],
                                [(0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0)]))
        for i in range(12):
            at = (0.3 + 0.07 * i, 0.2 + 0.05 * i, 3.1)
            self.mesh("a.stl", box(at, [x + 0.3 for x in at]))
            entry = self.placed("slide", "a.stl", "--fixed", "slope.obj", "-d", "0.1,-0.03,-1",
                                "-o", "out.stl", "-f")
            self.assertEqual(entry["output"]["precision_out"], "float")
            self.assertEqual(entry["output"]["max_move"], entry["rounding"]["max_move"])
            again = self.entry("measure", "out.stl", "--fixed", "slope.obj")
            self.assertIn(again["status"], ("disjoint", "touching"))
            self.assertLess(again["distance"], 1e-6)

    def test_precision_is_that_asked_for(self):
        self.mesh("third.obj", box((0, 0, 1 / 3), (1, 1, 2)))
        for precision in ("float", "double", "keep"):
            entry = self.placed("drop", "third.obj", "--bed", "0.1", "-o", "out.ply",
                                "--precision", precision, "-f")
            self.assertEqual(entry["output"]["precision_out"],
                             "float" if precision == "float" else "double")

    def test_several_fixed_meshes_are_indexed_only_where_they_matter(self):
        for i in range(5):
            self.mesh(f"far{i}.obj", box((10 + i, 0, 0), (10.5 + i, 1, 1)))
        fixed = [x for i in range(5) for x in ("--fixed", f"far{i}.obj")]
        entry = self.placed("drop", "a.obj", *fixed, "--fixed", "floor.obj")
        self.assertEqual(entry["travel"], 4.5)
        self.assertEqual([f["indexed"] for f in entry["fixed"]], 5 * [False] + [True])
        skipped = entry["skipped"]
        self.assertEqual((skipped["parts_not_indexed"], skipped["pairs_culled_by_box"],
                          skipped["primitives_not_indexed"]), (5, 5, 60))
        self.assertEqual({c["part"] for c in entry["contacts"]}, {5})

    def test_stl_corners_are_joined_so_that_a_body_has_an_inside(self):
        self.mesh("small.stl", box((1, 1, 1), (2, 2, 2)))
        self.mesh("big.stl", box((0, 0, 0), (10, 10, 10)))
        entry = self.entry("measure", "small.stl", "--fixed", "big.stl", status=0)
        self.assertEqual((entry["status"], entry["inside"], entry["distance"],
                          entry["surface_distance"]), ("penetrating", "moving", 0, 1))
        entry = self.entry("measure", "big.stl", "--fixed", "small.stl", status=0)
        self.assertEqual(entry["inside"], "fixed")
        entry = self.placed("separate", "small.stl", "--fixed", "big.stl")
        self.assertEqual(entry["travel"], 2)

    def test_measure_tells_the_statuses_apart(self):
        at = lambda z: self.mesh("m.obj", box((1, 1, z), (2, 2, z + 1)))
        for z, clearance, status, distance in (
                (1.25, [], "disjoint", 0.25), (1, [], "touching", 0), (0.5, [], "penetrating", 0),
                (1.25, ["--clearance", "0.5"], "closer-than-clearance", 0.25),
                (1.5, ["--clearance", "0.5"], "clear", 0.5)):
            entry = self.entry("measure", at(z), "--fixed", "floor.obj", *clearance, status=0)
            self.assertEqual((entry["status"], entry["distance"]), (status, distance))

    def test_measure_colors_the_faces(self):
        self.run_tool("measure", "in.obj", "--fixed", "floor.obj", "-o", "out.ply", "--scene",
                      "--ascii", status=0)
        text = self.read("out.ply")
        self.assertIn("property int tf_class", text)
        faces = [line.split() for line in text.splitlines() if line.startswith("3 ")]
        self.assertEqual(len(faces), 24)
        classes = [int(f[-1]) for f in faces]
        colors = {int(f[-1]): tuple(map(int, f[4:7])) for f in faces}
        self.assertEqual(colors[1], (224, 32, 32))
        self.assertEqual(classes[12 + 2], 1)  # the top of the floor
        self.assertEqual(classes[12 + 3], 2)  # its other half, at the diagonal
        self.assertEqual(classes[12], 0)
        self.mesh("near.obj", box((1, 1, 1.25), (2, 2, 2)))
        self.run_tool("measure", "near.obj", "--fixed", "floor.obj", "-o", "out.ply", "--ascii",
                      "--clearance", "0.5", "-f", status=0)
        faces = [line.split() for line in self.read("out.ply").splitlines()
                 if line.startswith("3 ")]
        self.assertEqual([int(f[-1]) for f in faces][:4], [3, 3, 0, 0])

    def test_a_scene_holds_the_fixed_meshes_too(self):
        self.placed("drop", "a.obj", "--fixed", "floor.obj", "-o", "out.obj", "--scene")
        self.assertEqual(self.points("out.obj"), box((1, 1, 1), (2, 2, 2))[0] +
                         box((0, 0, 0), (4, 4, 1))[0])
        self.assertIn("o floor", self.read("out.obj"))

    def test_the_matrix_file_gives_the_place(self):
        self.mesh("third.obj", box((0, 0, 1 / 3), (1, 1, 2)))
        self.run_tool("drop", "third.obj", "--matrix", "m.txt", "-o", "out.obj", status=0)
        rows = [list(map(float, line.split())) for line in self.read("m.txt").splitlines()]
        self.assertEqual(rows, [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, -1 / 3], [0, 0, 0, 1]])
        self.assertEqual(self.lowest("out.obj"), 0)
        run = self.run_tool("drop", "third.obj", "--matrix", "-", status=0)
        self.assertEqual(run.text, self.read("m.txt"))
        # fed back, it is at its place already
        entry = self.placed("drop", "third.obj", "--start", "m.txt")
        self.assertEqual((entry["travel"], entry["matrix"]), (0, rows))

    def test_a_flat_face_turned_and_rounded_before_is_one_side(self):
        count, turn = 60, 0.3
        ring = [(math.cos(2 * math.pi * i / count), math.sin(2 * math.pi * i / count))
                for i in range(count)]
        points = [(x, y, z) for z in (0.0, 0.5) for x, y in ring]
        points = [(x, y * math.cos(turn) - z * math.sin(turn),
                   y * math.sin(turn) + z * math.cos(turn)) for x, y, z in points]
        caps = [(0, i + 1, i) for i in range(1, count - 1)]
        caps += [(count, count + i, count + i + 1) for i in range(1, count - 1)]
        sides = [(i, (i + 1) % count, count + i) for i in range(count)]
        sides += [((i + 1) % count, count + (i + 1) % count, count + i) for i in range(count)]
        self.mesh("disc.stl", (points, caps + sides))
        area = count / 2 * math.sin(2 * math.pi / count)
        entry = self.placed("lay", "disc.stl", "-o", "out.stl")
        self.assertAlmostEqual(entry["sides"][entry["chosen"]]["area"], area, places=5)
        self.assertEqual(entry["tolerance"]["given"], "0.0001%")
        self.assertLessEqual(entry["corrected"], 2 * entry["tolerance"]["used"])
        self.assertEqual(len({p for p in self.points("out.stl") if p[2] == 0}), count)
        exactly = self.placed("lay", "disc.stl", "-t", "0", "-o", "exact.stl")
        self.assertEqual(exactly["tolerance"], {"given": "0", "used": 0})
        self.assertLess(exactly["sides"][exactly["chosen"]]["area"], 0.9 * area)
        self.assertGreater(len(exactly["sides"]), len(entry["sides"]))

    def test_lay_turns_a_side_down_exactly(self):
        points, faces = box((0, 0, 0), (1, 2, 4))
        turned = [(0.6 * x - 0.8 * z, y, 0.8 * x + 0.6 * z + 3) for x, y, z in points]
        self.mesh("turned.obj", (turned, faces))
        entry = self.placed("lay", "turned.obj", "--bed", "0.1", "-o", "out.obj", "--matrix",
                            "m.txt")
        self.assertEqual((entry["status"], entry["bed"]["reached"]), ("touching", True))
        self.assertAlmostEqual(entry["sides"][entry["chosen"]]["area"], 8)
        self.assertEqual(self.lowest("out.obj"), 0.1)
        self.assertEqual(sum(p[2] == 0.1 for p in self.points("out.obj")), 4)
        rows = [list(map(float, line.split())) for line in self.read("m.txt").splitlines()]
        self.assertEqual(rows, entry["matrix"])
        for old, new in zip(turned, self.points("out.obj")):
            for row, x in zip(rows, new):
                self.assertAlmostEqual(sum(m * c for m, c in zip(row, (*old, 1))), x, places=12)
        entry = self.placed("lay", "a.obj", "--face-normal", "1,0.1,0", "-o", "out.stl")
        self.assertEqual(entry["sides"][entry["chosen"]]["normal"], [1, 0, 0])
        self.assertEqual(self.lowest("out.stl"), 0)
        entry = self.placed("lay", "a.obj", "--face-point", "1.5,1,6")
        self.assertEqual(entry["sides"][entry["chosen"]]["normal"], [0, -1, 0])

    def test_what_pack_leaves_out_is_counted(self):
        points, faces = box((0, 0, 0), (1, 1, 1))
        self.mesh("nan.obj", (points + [(math.nan, 0, 0)], faces + [(0, 1, 8), (1, 2, 8)]))
        entry = self.placed("pack", "a.obj", "nan.obj", "--size", "9,9", "-n")
        self.assertEqual(entry["skipped"]["non_finite"], 2)

    def test_pack_puts_all_on_the_plate_or_names_what_does_not_fit(self):
        for i in range(4):
            self.mesh(f"p{i}.stl", box((7 * i, 3, 5), (7 * i + 4, 7, 8)))
        names = [f"p{i}.stl" for i in range(4)]
        entry = self.placed("pack", *names, "--size", "10,10", "--spacing", "1.5", "-o",
                            "out.stl", "--matrix", "m.txt")
        self.assertEqual((entry["fits"], entry["not_placed"]), (True, []))
        self.assertEqual(len(self.read("m.txt").splitlines()), 16)
        points = self.points("out.stl")
        self.assertEqual(len(points), 4 * 36)
        self.assertEqual(min(p[2] for p in points), 0)
        for axis in (0, 1):
            self.assertGreaterEqual(min(p[axis] for p in points), 0)
            self.assertLessEqual(max(p[axis] for p in points), 10)
        for i in range(4):  # each as a file of its own, then measured against the others
            write(self.path(f"q{i}.stl"), (points[36 * i:36 * i + 36],
                                           [(3 * f, 3 * f + 1, 3 * f + 2) for f in range(12)]))
        for i in range(4):
            fixed = [x for j in range(4) if j != i for x in ("--fixed", f"q{j}.stl")]
            self.assertGreaterEqual(self.entry("measure", f"q{i}.stl", *fixed)["distance"], 1.5)
        entry = self.entry("pack", *names, "--size", "10,9", "--spacing", "1.5", status=1)
        self.assertEqual((entry["fits"], len(entry["not_placed"])), (False, 2))
        self.mesh("tall.stl", box((0, 0, 0), (1, 1, 9)))
        entry = self.entry("pack", "tall.stl", "--size", "5,5,8", status=1)
        self.assertEqual(entry["not_placed"], ["tall.stl"])

    def test_fit_brings_a_moved_copy_back(self):
        points, faces = grid(12)
        hills = [(x, y, 0.06 * (x - 5) ** 2 - 0.02 * (y - 7) ** 2 + 0.003 * x * x * y)
                 for x, y, _ in points]
        c, s = math.cos(0.02), math.sin(0.02)
        self.mesh("fixed.obj", (hills, faces))
        moved = [(c * x - s * y + 0.05, s * x + c * y - 0.03, z + 0.04) for x, y, z in hills]
        self.mesh("moved.obj", (moved, faces))
        entry = self.entry("align", "moved.obj", "--fixed", "fixed.obj", "-o", "out.obj", status=0)
        self.assertTrue(entry["align"]["converged"])
        self.assertLess(entry["align"]["rms"], 1e-3 * entry["align"]["rms_at_start"])
        for p, q in zip(self.points("out.obj"), hills):
            for x, y in zip(p, q):
                self.assertAlmostEqual(x, y, places=3)

    def test_fit_of_a_part_needs_to_know_that_it_is_one_or_says_that_it_is_in_doubt(self):
        bowl = [(x, y, 0.05 * (x - 5) ** 2 + 0.02 * (y - 7) ** 2 + 0.004 * x * x * y) for x, y,
                _ in grid(16)[0]]
        faces = grid(16)[1]
        self.mesh("fixed.obj", (bowl, faces))
        c, s = math.cos(0.03), math.sin(0.03)
        # a third more than there is on the other side
        beside = [(x, y, z + 30) for x, y, z in bowl[::3]]
        moved = [(c * x - s * y + 0.2, s * x + c * y, z) for x, y, z in bowl + beside]
        self.put("moved.xyz", "".join(f"{x!r} {y!r} {z!r}\n" for x, y, z in moved))
        entry = self.entry("align", "moved.xyz", "--fixed", "fixed.obj", "--weights", "equal", "-n",
                           status=1)
        align = entry["align"]
        self.assertEqual((align["outcome"], align["converged"]), ("doubtful", False))
        for options in ([], ["--trim", "0.26"], ["--overlap", "0.7", "--metric", "plane"],
                        ["--trim", "0.26", "--starts", "6"]):
            with self.subTest(options):
                entry = self.entry("align", "moved.xyz", "--fixed", "fixed.obj", *options, "-n",
                                   status=0)
                found = entry["align"]
                self.assertEqual((found["outcome"], found["undetermined"], len(found["freedoms"])),
                                 ("converged", 0, 6))
                self.assertEqual(found["inliers"], len(bowl))
                for row, wanted in zip(entry["matrix"], ((c, s, 0), (-s, c, 0), (0, 0, 1))):
                    for x, y in zip(row, wanted):
                        self.assertAlmostEqual(x, y, places=6)
        entry = self.entry("align", "moved.xyz", "--fixed", "fixed.obj", "--iterations", "1", "-n",
                           status=1)
        self.assertEqual((entry["align"]["outcome"], entry["align"]["iterations"]),
                         ("out-of-iterations", 1))

    def test_fit_of_a_plane_on_a_plane_says_that_it_slides(self):
        self.mesh("flat.obj", grid(9))
        run = self.run_tool("align", "flat.obj", "--fixed", "flat.obj", "-n", status=0)
        self.assertIn("3 motions are not determined", run.text)
        found = self.entry("align", "flat.obj", "--fixed", "flat.obj", "-n", status=0)["align"]
        self.assertEqual(found["undetermined"], 3)
        for free in found["freedoms"][:3]:
            self.assertAlmostEqual(free["shift"][2], 0)

    def test_normals_turn_with_the_mesh(self):
        lines = ["ply", "format ascii 1.0", "element vertex 3"]
        lines += [f"property double {name}" for name in ("x", "y", "z", "nx", "ny", "nz")]
        lines += ["element face 1", "property list uchar int vertex_indices", "end_header"]
        lines += ["0 0 5 1 0 0", "1 0 5 1 0 0", "0 1 5 1 0 0", "3 0 1 2"]
        with open(self.path("n.ply"), "w") as file:
            file.write("\n".join(lines) + "\n")
        with open(self.path("turn.txt"), "w") as file:
            file.write("0 -1 0 0\n1 0 0 0\n0 0 1 0\n0 0 0 1\n")
        self.placed("drop", "n.ply", "--start", "turn.txt", "-o", "out.ply", "--ascii")
        rows = [line.split() for line in self.read("out.ply").splitlines()]
        self.assertEqual([list(map(float, row)) for row in rows if len(row) == 6],
                         [[0, 0, 0, 0, 1, 0], [0, 1, 0, 0, 1, 0], [-1, 0, 0, 0, 1, 0]])

    def test_a_cloud_drops_on_the_bed(self):
        with open(self.path("cloud.xyz"), "w") as file:
            file.write("0 0 3.5\n1 0 4\nnan 0 1\n0 1 5\n")
        self.assertEqual(self.placed("drop", "cloud.xyz", "-o", "out.xyz")["travel"], 3.5)
        self.assertEqual(self.read("out.xyz").split("\n")[0], "0 0 0")

    def test_points_without_a_face_move_along_and_do_not_count(self):
        points, faces = box((1, 1, 5.5), (2, 2, 6.5))
        write(self.path("stray.obj"), (points + [(0, 0, 1)], faces))
        self.assertEqual(self.placed("drop", "stray.obj", "-o", "out.obj")["travel"], 5.5)
        self.assertEqual(self.points("out.obj")[-1], (0, 0, -4.5))


if __name__ == "__main__":
    main()
