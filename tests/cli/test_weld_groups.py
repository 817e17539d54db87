"""Which points merge, and which one stays."""

from weld_support import *

import random


class Groups(WeldTest):
    def kept(self, points, *arguments):
        self.cloud("in.xyz", points)
        self.run_tool("in.xyz", *arguments, "-o", "out.xyz", "-f", status=0)
        return self.numbers("out.xyz")

    def test_without_a_tolerance_only_equal_points_merge(self):
        points = [(0, 0, 0), (1, 0, 0), (0, 0, 5e-324), (-0.0, 0, 0), (1, 0, 0)]
        self.assertEqual(self.kept(points), [(0, 0, 0), (1, 0, 0), (0, 0, 5e-324)])

    def test_the_tolerance_is_inclusive(self):
        points = [(0, 0, 0), (3, 4, 0)]
        self.assertEqual(len(self.kept(points, "-t", "5")), 1)
        self.assertEqual(len(self.kept(points, "-t", "4.999999999999999")), 2)

    def test_old_names_of_the_tolerance_are_accepted(self):
        points = [(0, 0, 0), (3, 4, 0)]
        self.assertEqual(len(self.kept(points, "--eps", "5", "--exact")), 1)
        self.assertEqual(len(self.kept(points, "--threshold", "5")), 1)

    def test_a_share_of_the_diagonal_is_a_tolerance(self):
        points = [(0, 0, 0), (3, 4, 0), (100, 0, 0), (float("nan"), 1e9, 0)]
        entry_points = self.kept(points, "-t", "5%")
        self.assertEqual(entry_points[0], (0, 0, 0))
        self.assertEqual(len(entry_points), 3)  # 5 % of 100.08, the NaN is not in the box
        self.assertEqual(len(self.kept(points, "-t", "4.9%")), 4)

    def test_first_drops_what_is_near_an_earlier_kept_point_and_chain_what_is_linked(self):
        line = [(float(i), 0, 0) for i in range(6)]
        self.assertEqual(self.kept(line, "-t", "1"), [(0, 0, 0), (2, 0, 0), (4, 0, 0)])
        self.assertEqual(self.kept(line, "-t", "1", "--rule", "first"),
                         [(0, 0, 0), (2, 0, 0), (4, 0, 0)])
        self.assertEqual(self.kept(line, "-t", "1", "--rule", "chain"), [(0, 0, 0)])

    def test_the_order_of_the_file_decides(self):
        self.assertEqual(self.kept([(1, 0, 0), (0, 0, 0), (2, 0, 0)], "-t", "1"), [(1, 0, 0)])

    def test_keep_says_which_point_of_a_group_stays(self):
        points = [(1, 0, 0, 7), (2, 0, 0, 9), (0, 0, 0, 7), (9, 9, 9, 1)]
        for which, expected in (("first", (1, 0, 0, 7)), ("last", (0, 0, 0, 7)),
                                ("mean", (1, 0, 0, 23 / 3)), ("min:column_4", (1, 0, 0, 7)),
                                ("max:column_4", (2, 0, 0, 9)), ("min:x", (0, 0, 0, 7)),
                                ("max:x", (2, 0, 0, 9))):
            kept = self.kept(points, "-t", "1", "--keep", which)
            self.assertEqual(len(kept), 2, msg=which)
            for got, value in zip(kept[0], expected):
                self.assertAlmostEqual(got, value, places=12, msg=which)
            self.assertEqual(kept[1], (9, 9, 9, 1))

    def test_an_order_says_which_point_stays_and_keeps_the_promise(self):
        line = [(0, 0, 0, 5), (1, 0, 0, 3), (2, 0, 0, 4), (3, 0, 0, 9), (4, 0, 0, "nan")]
        for order, expected in (("column_4", (1, 3)), ("min:column_4", (1, 3)),
                                ("max:column_4", (0, 3)), ("x", (0, 2, 4)), ("max:x", (0, 2, 4))):
            kept = self.kept(line, "-t", "1", "--order", order)
            self.assertEqual(tuple(p[0] for p in kept), expected, msg=order)
        kept = self.kept(line, "-t", "1", "--rule", "chain", "--order", "max:column_4")
        self.assertEqual(kept, [(3, 0, 0, 9)])

    def test_map_label_and_removed_go_by_the_order(self):
        self.cloud("in.xyz", [(0, 0, 0, 5), (9, 0, 0, 1), (0, 0, 0, 2), (0, 0, 0, 7)])
        entry = self.entry("in.xyz", "--order", "column_4", "-o", "out.xyz", "--map", "map.csv",
                           "--removed", "gone.xyz", status=0)
        self.assertEqual(entry["order"], "min:column_4")
        self.assertEqual(self.numbers("out.xyz"), [(9, 0, 0, 1), (0, 0, 0, 2)])
        self.assertEqual(self.numbers("gone.xyz"), [(0, 0, 0, 5), (0, 0, 0, 7)])
        self.assertEqual(self.read("map.csv").split(), ["input,output", "0,1", "1,0", "2,1", "3,1"])
        self.run_tool("in.xyz", "--order", "column_4", "-o", "all.xyz", "--label", "g", status=0)
        self.assertEqual([row[4] for row in self.numbers("all.xyz")], [1, 0, 1, 1])

    def test_same_keeps_points_with_other_values_apart(self):
        points = [(0, 0, 0, 1, 5), (0, 0, 0, 2, 5), (0, 0, 0, 1.25, 5)]
        self.assertEqual(len(self.kept(points)), 1)
        self.assertEqual(len(self.kept(points, "--same", "column_4")), 3)
        self.assertEqual(len(self.kept(points, "--same", "column_4=0.25")), 2)
        self.assertEqual(len(self.kept(points, "--same", "column_4=1,column_5")), 1)
        self.assertEqual(len(self.kept(points, "--same", "z,column_5=0")), 1)

    def test_colors_of_a_cloud_do_not_keep_points_apart_unless_asked_for(self):
        columns = XYZ + ["uchar red", "uchar green", "uchar blue"]
        self.write("in.ply", ply_text(columns, [(0, 0, 0, 255, 0, 0), (0, 0, 0, 0, 0, 255)]))
        for options, count in (([], 1), (["--same", "color"], 2), (["--same", "color=255"], 1),
                               (["--same", "red"], 2), (["--same", "green"], 1)):
            self.run_tool("in.ply", *options, "-o", "out.ply", "--ascii", "-f", status=0)
            self.assertEqual(len(self.ply_rows("out.ply")), count, msg=options)

    def test_a_property_that_is_not_there_is_an_input_error_that_names_those_that_are(self):
        self.cloud("in.xyz", [(0, 0, 0, 1)])
        for options in (["--same", "intensity"], ["--keep", "min:intensity"],
                        ["--order", "intensity"], ["--order", "max:intensity"],
                        ["--ignore-seams", "intensity"], ["--same", "normal"]):
            run = self.run_tool("in.xyz", *options, "-o", "out.xyz", status=3)
            self.assertIn("the points have column_4", run.err)
            self.assertIn(f"{options[0]} ", run.err)
            self.assertNotIn("out.xyz", self.listing())

    def test_points_that_are_nowhere_stay_and_are_counted(self):
        nan, inf = float("nan"), float("inf")
        self.cloud("in.xyz", [(nan, 0, 0), (nan, 0, 0), (inf, 0, 0), (inf, 0, 0), (0, 0, 0)])
        entry = self.entry("in.xyz", "-t", "100", "-o", "out.xyz", status=0)
        self.assertEqual(entry["skipped"], {"non_finite": 4})
        self.assertEqual((entry["points"]["in"], entry["points"]["out"]), (5, 5))
        self.assertEqual([w["code"] for w in entry["warnings"]], ["non-finite"])

    def test_no_two_kept_points_are_within_the_tolerance_and_none_moves_further(self):
        generator = random.Random(7)
        points = [tuple(generator.randrange(12) / 4 for _ in range(3)) for _ in range(400)]
        kept = self.kept(points, "-t", "0.5")
        within = lambda a, b: sum((x - y) ** 2 for x, y in zip(a, b)) <= 0.25
        self.assertLess(len(kept), 400)
        self.assertFalse(any(within(a, b) for i, a in enumerate(kept) for b in kept[:i]))
        self.assertTrue(all(any(within(p, q) for q in kept) for p in points))
        self.assertEqual(self.kept(kept, "-t", "0.5"), kept)


if __name__ == "__main__":
    main()
