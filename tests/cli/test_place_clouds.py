"""Clouds of points placed among meshes, and meshes among clouds."""

from place_support import *


class Clouds(PlaceTest):
    def setUp(self):
        super().setUp()
        self.mesh("floor.obj", box((0, 0, 0), (4, 4, 1)))
        self.cloud("cloud.xyz", (1, 1, 3.5), (9, 9, 0.5), (2, 3, 2.75))

    def cloud(self, name, *points):
        with open(self.path(name), "w") as file:
            file.writelines(" ".join(map(str, p)) + "\n" for p in points)
        return name

    def rows(self, name):
        return [tuple(map(float, line.split())) for line in self.read(name).splitlines()]

    def test_measure_tells_how_a_cloud_lies_to_a_mesh(self):
        entry = self.entry("measure", "cloud.xyz", "--fixed", "floor.obj", status=0)
        self.assertEqual((entry["status"], entry["distance"]), ("disjoint", 1.75))
        nearest = entry["closest"]["moving"]
        self.assertEqual((nearest["vertex"], nearest["point"]), (2, [2, 3, 2.75]))
        for key in ("face", "triangle", "barycentric"):
            self.assertIsNone(nearest[key])
        self.assertIsNone(entry["closest"]["fixed"]["vertex"])
        for z, status in ((1, "touching"), (0.5, "penetrating"), (1.25, "disjoint")):
            self.cloud("one.xyz", (9, 9, 9), (2, 3, z))
            entry = self.entry("measure", "one.xyz", "--fixed", "floor.obj", status=0)
            self.assertEqual(entry["status"], status)
            self.assertIsNone(entry["inside"])
            self.assertEqual(entry["points"]["inside"], 1 if status == "penetrating" else 0)
            self.assertEqual(entry["points"]["on"], 1 if status == "touching" else 0)
        entry = self.entry("measure", "cloud.xyz", "--fixed", "floor.obj", "--clearance", "2")
        self.assertEqual(entry["status"], "closer-than-clearance")

    def test_a_fixed_cloud_is_measured_as_well(self):
        one = self.entry("measure", "cloud.xyz", "--fixed", "floor.obj", status=0)
        two = self.entry("measure", "floor.obj", "--fixed", "cloud.xyz", status=0)
        self.assertEqual(one["distance"], two["distance"])
        self.assertEqual(two["closest"]["fixed"]["vertex"], 2)
        self.cloud("other.xyz", (1, 1, 5.5))
        entry = self.entry("measure", "cloud.xyz", "--fixed", "other.xyz", status=0)
        self.assertEqual((entry["distance"], entry["status"]), (2, "disjoint"))

    def test_a_cloud_drops_and_slides_onto_a_mesh_exactly(self):
        entry = self.entry("drop", "cloud.xyz", "--fixed", "floor.obj", "-o", "out.xyz", status=0)
        self.assertEqual((entry["travel"], entry["status"]), (1.75, "touching"))
        self.assertEqual({(c["moving"], c["part"]) for c in entry["contacts"]}, {(2, 0)})
        for contact in entry["contacts"]:
            self.assertEqual((contact["point"], contact["normal"]), ([2, 3, 1], [0, 0, 1]))
        self.assertEqual(self.rows("out.xyz"), [(1, 1, 1.75), (9, 9, -1.25), (2, 3, 1)])
        self.assertIn("a point and a face", self.run_tool("drop", "cloud.xyz", "--fixed",
                                                          "floor.obj", "-n").text)
        self.cloud("beside.xyz", (9, 2, 0.5), (7, 2, 3))
        entry = self.entry("slide", "beside.xyz", "--fixed", "floor.obj", "-d", "-1,0,0", status=0)
        self.assertEqual((entry["travel"], entry["contacts"][0]["moving"]), (5, 0))

    def test_clearance_mate_and_clear_take_clouds(self):
        entry = self.entry("drop", "cloud.xyz", "--fixed", "floor.obj", "--clearance", "0.5",
                           status=0)
        self.assertEqual((entry["travel"], entry["distance"]), (1.25, 0.5))
        entry = self.entry("mate", "cloud.xyz", "--fixed", "floor.obj", "-o", "out.xyz", status=0)
        self.assertEqual((entry["travel"], entry["status"]), (1.75, "touching"))
        self.cloud("within.xyz", (1, 1, 0.75), (2, 2, 1.5))
        entry = self.entry("separate", "within.xyz", "--fixed", "floor.obj", "-o", "clear.xyz",
                           status=0)
        self.assertEqual((entry["travel"], entry["direction"]), (0.25, [0, 0, 1]))
        self.assertEqual(self.rows("clear.xyz"), [(1, 1, 1), (2, 2, 1.75)])
        self.entry("slide", "within.xyz", "--fixed", "floor.obj", status=1)

    def test_a_mesh_drops_onto_a_cloud(self):
        self.mesh("a.obj", box((0.5, 0.5, 5), (2.5, 3.5, 6)))
        entry = self.entry("drop", "a.obj", "--fixed", "cloud.xyz", status=0)
        self.assertEqual((entry["travel"], entry["status"]), (1.5, "touching"))
        self.assertEqual({c["fixed"] for c in entry["contacts"]}, {0})

    def test_points_that_are_none_are_left_out_and_keep_their_numbers(self):
        self.cloud("holes.xyz", ("nan", 1, 1), (1, 1, 3.5), (2, "inf", 0), (2, 3, 2.75))
        entry = self.entry("drop", "holes.xyz", "--fixed", "floor.obj", "-o", "out.xyz", status=0)
        self.assertEqual((entry["travel"], entry["contacts"][0]["moving"]), (1.75, 3))
        self.assertEqual(entry["skipped"]["non_finite"], 2)
        self.assertEqual([w["code"] for w in entry["warnings"]], ["non-finite"])
        self.assertEqual(self.rows("out.xyz")[1::2], [(1, 1, 1.75), (2, 3, 1)])

    def test_points_are_colored_by_what_they_meet(self):
        self.cloud("mixed.xyz", (1, 1, 0.5), (2, 2, 1), (3, 3, 1.25), (9, 9, 9))
        self.run_tool("measure", "mixed.xyz", "--fixed", "floor.obj", "--clearance", "0.5", "-o",
                      "out.ply", "--ascii", status=0)
        rows = [line.split() for line in self.read("out.ply").splitlines()]
        rows = rows[[r[0] for r in rows].index("end_header") + 1:]
        # What is inside meets no face: it is nearer to one than the clearance.
        self.assertEqual([int(r[-1]) for r in rows], [0, 2, 3, 0])
        self.assertEqual(rows[1][3:6], ["236", "208", "0"])

    def test_pack_refuses_clouds_and_says_so(self):
        run = self.run_tool("pack", "cloud.xyz", "--size", "9,9", "-n", status=2)
        self.assertIn("cloud.xyz: a point cloud", run.err)

    def test_any_number_of_threads_gives_the_same_report(self):
        self.cloud("many.xyz", *((i % 37 * 0.1, i % 41 * 0.1, 2 + i % 7 * 0.3)
                                 for i in range(3000)))
        for mode in (["measure"], ["drop"], ["mate"]):
            reports = [self.entry(*mode, "many.xyz", "--fixed", "floor.obj", "-j", n, status=0)
                       for n in (1, 2, 8)]
            self.assertEqual(reports[0], reports[1])
            self.assertEqual(reports[0], reports[2])


if __name__ == "__main__":
    main()
