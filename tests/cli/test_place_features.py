"""tf-place: plates and boxes, stability, turns, features."""

from place_support import *


class PlaceFeatures(PlaceTest):
    def setUp(self):
        super().setUp()
        self.mesh("a.obj", box((0, 0, 0), (4, 4, 2)))
        self.mesh("b.obj", box((9, 9, 9), (11, 10, 10)))
        self.mesh("wall.obj", box((-20, 5, -5), (20, 6, 5)))

    def relation(self, moving, fixed):
        return self.entry("measure", moving, "--fixed", fixed, status=0)

    def test_copies_fill_plates_beside_each_other(self):
        entry = self.entry("pack", "a.obj", "b.obj", "--count", "a.obj:5", "--size", "9,4.5",
                           "--spacing", "0.5", "--plates", "4", "-o", "out.obj", status=0)
        self.assertEqual(len(entry["parts"]), 6)
        self.assertEqual([part["input"] for part in entry["parts"]], ["a.obj"] * 5 + ["b.obj"])
        self.assertEqual((entry["fits"], entry["plates"]), (True, 3))
        for part in entry["parts"]:
            x = part["matrix"][0][3] + (9 if part["input"] == "b.obj" else 0)
            self.assertGreaterEqual(x + 1e-9, 1.2 * 9 * part["plate"] - 1.0)
        points = self.points("out.obj")
        self.assertEqual(len(points), 48)
        self.assertLessEqual(max(p[0] for p in points), 2 * 1.2 * 9 + 9)
        run = self.run_tool("pack", "a.obj", "--count", "a.obj:5", "--size", "9,4.5",
                            "--spacing",
                            "0.5", "--plates", "2", "--tries", "3", "-n", status=1)
        self.assertIn("4 of 5 parts placed on 2 plates; no arrangement of all was found in 3 tries",
                      run.text)
        for bad in ("a.obj", "a.obj:0", "a.obj:x", ":3", "c.obj:3"):
            self.run_tool("pack", "a.obj", "--count", bad, "--size", "9,9", "-n", status=2)

    def test_a_box_with_a_height_is_filled_and_a_flat_one_is_not(self):
        size = ["--size", "4,4,7", "--spacing", "0.5"]
        entry = self.entry("pack", "a.obj", "--count", "a.obj:3", *size, "-o", "out.obj",
                           status=0)
        points = self.points("out.obj")
        self.assertEqual(sorted({p[2] for p in points}), [0, 2, 2.5, 4.5, 5, 7])
        self.assertEqual(entry["plates"], 1)
        entry = self.entry("pack", "a.obj", "--count", "a.obj:3", *size, "--flat", "-n",
                           status=1)
        self.assertEqual(len(entry["not_placed"]), 2)

    def test_time_ends_the_tries(self):
        options = ["--size", "4,4", "--count", "a.obj:2", "-n"]
        entry = self.entry("pack", "a.obj", *options, "--tries", "1000000", "--time", "0.05",
                           status=1)
        self.assertLess(entry["tries"], 1000000)
        for option in (["--tries", "0"], ["--plates", "0"], ["--time", "0"], ["--tries", "x"]):
            self.run_tool("pack", "a.obj", *options, *option, status=2)

    def test_the_most_stable_side_is_chosen_and_all_are_described(self):
        self.mesh("tall.obj", box((0, 0, 0), (1, 2, 8)))
        entry = self.entry("lay", "tall.obj", "--stable", "-o", "out.obj", status=0)
        self.assertEqual(entry["center_of_mass"], {"point": [0.5, 1, 4], "of": "solid"})
        angles = [side["tip_angle"] for side in entry["sides"]]
        self.assertEqual(max(angles), angles[entry["chosen"]])
        self.assertAlmostEqual(angles[entry["chosen"]], math.degrees(math.atan2(1, 0.5)), places=9)
        self.assertEqual([side["overhang"] for side in entry["sides"]], [0] * 6)
        points, faces = box((0, 0, 0), (1, 2, 8))
        self.mesh("open.obj", (points, faces[2:]))
        entry = self.entry("lay", "open.obj", "-n", status=0)
        self.assertEqual(entry["center_of_mass"]["of"], "surface")
        self.run_tool("lay", "a.obj", "--stable", "--largest-face", "-n", status=2)
        self.run_tool("lay", "a.obj", "--overhang-angle", "91", "-n", status=2)
        self.run_tool("drop", "a.obj", "--stable", "-n", status=2)

    def test_a_turn_ends_at_the_wall_as_written(self):
        for precision, places in (("double", 7), ("float", 4)):
            entry = self.entry("turn", "a.obj", "--fixed", "wall.obj", "-o", f"{precision}.ply",
                               "--precision", precision, "--matrix", f"{precision}.txt", status=0)
            angle = math.degrees(math.asin(5 / math.sqrt(32)) - math.atan2(4, 4))
            self.assertAlmostEqual(entry["turn"]["angle"], angle, places=places)
            self.assertIn(entry["status"], ("disjoint", "touching"))
            self.assertIn(self.relation(f"{precision}.ply", "wall.obj")["status"],
                          ("disjoint", "touching"))
        entry = self.entry("turn", "a.obj", "--fixed", "wall.obj", "--clearance", "0.5", "-o",
                           "clear.obj", status=0)
        self.assertGreaterEqual(self.relation("clear.obj", "wall.obj")["distance"], 0.5)
        run = self.run_tool("turn", "a.obj", "--fixed", "wall.obj", "--max-angle", "5", "-n",
                            status=1)
        self.assertIn("nothing is in the way", run.text)
        for bad in (["--axis", "0,0,0"], ["--max-angle", "0"], ["--max-angle", "400"],
                    ["--max-travel", "3"], ["--bed", "0"], ["--origin", "1,2"]):
            self.run_tool("turn", "a.obj", "--fixed", "wall.obj", "-n", *bad, status=2)
        self.run_tool("slide", "a.obj", "--fixed", "wall.obj", "-n", "--axis", "0,0,1", status=2)

    def test_planes_come_together(self):
        entry = self.entry("mate", "b.obj", "--fixed", "a.obj", "--feature", "plane", "--pick",
                           "9,9.5,9.5", "-o", "out.obj", status=0)
        self.assertEqual(entry["status"], "touching")
        self.assertAlmostEqual(entry["features"]["turn_angle"], 90)
        self.assertAlmostEqual(entry["features"]["offset"], 0)
        points = self.points("out.obj")
        self.assertAlmostEqual(sum(p[0] for p in points) / 8, 2)
        self.assertAlmostEqual(sum(p[1] for p in points) / 8, 2)
        low, high = min(p[2] for p in points), max(p[2] for p in points)
        self.assertAlmostEqual(high - low, 2)
        self.assertTrue(abs(low - 2) < 1e-9 or abs(high) < 1e-9)
        entry = self.entry("mate", "b.obj", "--fixed", "a.obj", "--feature", "plane", "--pick", "0",
                           "--pick-fixed", "0", "--flip", "--clearance", "0.25", "-o", "far.obj",
                           status=0)
        self.assertGreaterEqual(self.relation("far.obj", "a.obj")["distance"], 0.25)

    def test_axes_come_together(self):
        self.mesh("plate.obj", tube(9, 3.1, 2))
        points, faces = tube(3, 1, 8)
        self.mesh("pin.obj", ([(z + 40, x, y) for x, y, z in points], faces))
        entry = self.entry("mate", "pin.obj", "--fixed", "plate.obj", "--feature", "axis",
                           "--pick-fixed", "3.1,0,1", "-o", "out.obj", status=0)
        self.assertAlmostEqual(entry["features"]["turn_angle"], 90)
        self.assertTrue(entry["features"]["fixed"]["hollow"])
        self.assertAlmostEqual(entry["features"]["moving"]["radius"], 3)
        self.assertEqual(entry["status"], "disjoint")
        written = self.points("out.obj")
        self.assertAlmostEqual(max(math.hypot(p[0], p[1]) for p in written), 3)
        self.assertAlmostEqual(min(p[2] for p in written), -3)
        run = self.run_tool("mate", "a.obj", "--fixed", "plate.obj", "--feature", "axis", "-n",
                            status=1)
        self.assertIn("has no axis", run.text)
        run = self.run_tool("mate", "pin.obj", "--fixed", "a.obj", "--feature", "axis",
                            "--pick-fixed", "2", "-n", status=1)
        self.assertIn("the fixed mesh has no axis at the picked face or point", run.text)
        for bad in (["--pick", "1"], ["--flip"], ["--feature", "line"],
                    ["--feature", "axis", "--pick", "x"], ["--feature", "axis", "--pick", "1,2"]):
            self.run_tool("mate", "pin.obj", "--fixed", "plate.obj", "-n", *bad, status=2)


if __name__ == "__main__":
    main()
