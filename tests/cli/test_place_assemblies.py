"""tf-place clash, check, and what measure says of depth, points inside and deviation."""

import random

from place_support import *
from weld_support import xyz_bytes

SHIFT = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]


def moved_by(x, y, z):
    matrix = list(SHIFT)
    matrix[3], matrix[7], matrix[11] = x, y, z
    return matrix


class Assemblies(PlaceTest):
    def setUp(self):
        super().setUp()
        self.mesh("floor.obj", box((0, 0, 0), (4, 4, 1)))
        self.mesh("part.obj", box((1, 1, 0.75), (2, 2, 3)))
        self.mesh("near.obj", box((2.5, 2.5, 1.1), (3, 3, 2)))

    def scene(self, name, *parts):
        """An OBJ of named boxes."""
        text, first = "", 1
        for part, (points, faces) in parts:
            text += f"o {part}\n" + "".join(f"v {x} {y} {z}\n" for x, y, z in points)
            text += "".join("f " + " ".join(str(first + i) for i in f) + "\n" for f in faces)
            first += len(points)
        self.put(name, text)
        return name

    # ---- clash ----

    def test_clash_names_parts_and_says_how_deep(self):
        run = self.run_tool("clash", "floor.obj", "part.obj", "near.obj")
        self.assertEqual(run.status, 1)
        self.assertIn("floor and part: penetrating, at most 0.25 deep, common volume 0.25",
                      run.text)
        self.assertIn("3 parts: 1 pair penetrates, 0 touch", run.text)
        entry = self.entry("clash", "floor.obj", "part.obj", "near.obj", status=1)
        pair, = entry["pairs"]
        self.assertEqual((pair["a"], pair["b"], pair["depth"]), ("floor", "part", 0.25))
        self.assertEqual(pair["move"], [0, 0, -0.25])
        self.assertEqual(pair["volume"], 0.25)
        self.assertEqual(pair["regions"][0]["box"], {"min": [1, 1, 1], "max": [2, 2, 1]})
        self.assertEqual(entry["counts"]["penetrating"], 1)

    def test_clash_of_parts_of_one_file_that_share_corners_keeps_them_apart(self):
        self.scene("two.obj", ("left", box((0, 0, 0), (1, 1, 1))),
                   ("right", box((1, 0, 0), (2, 1, 1))))
        entry = self.entry("clash", "two.obj", status=0)
        pair, = entry["pairs"]
        self.assertEqual((pair["a"], pair["b"], pair["status"]), ("left", "right", "touching"))
        self.assertEqual(self.entry("clash", "two.obj", "--clearance", "0.1", status=1)["parts"], 2)

    def test_clash_says_if_a_single_part_has_components(self):
        self.mesh("two.obj", together(cube(), cube((3, 0, 0))))
        self.run_tool("drop", "two.obj", "-o", "two.stl", status=0)
        for name in ("two.obj", "two.stl"):
            warning, = self.entry("clash", name, status=0)["warnings"]
            self.assertEqual((warning["code"], warning["text"]),
                             ("one-part", "there is only one part, and it has 2 components; split "
                                          "them with tf-cut parts"))
        self.assertEqual(self.entry("clash", "floor.obj", status=0)["warnings"], [])

    def test_clash_ignores_pairs_by_name(self):
        self.scene("bolts.obj", ("plate", box((0, 0, 0), (9, 9, 1))),
                   ("bolt_1", box((1, 1, -1), (2, 2, 2))), ("bolt_2", box((4, 4, -1), (5, 5, 2))))
        self.assertEqual(self.run_tool("clash", "bolts.obj").status, 1)
        self.assertEqual(self.run_tool("clash", "bolts.obj", "--ignore", "bolt_?:plate").status, 0)
        self.assertEqual(self.run_tool("clash", "bolts.obj", "--ignore", "plate:bolt_1").status, 1)
        run = self.run_tool("clash", "bolts.obj", "--ignore", "nut:plate")
        self.assertIn("--ignore nut:plate: no pair of parts matches", run.err)
        self.assertEqual(self.run_tool("clash", "bolts.obj", "--ignore", "plate").status, 2)

    def test_clash_keeps_a_clearance(self):
        files = ["clash", "floor.obj", "near.obj"]
        self.assertEqual(self.run_tool(*files).status, 0)
        self.assertEqual(self.run_tool(*files, "--clearance", "0.05").status, 0)
        entry = self.entry(*files, "--clearance", "0.2", status=1)
        pair, = entry["pairs"]
        self.assertAlmostEqual(pair["distance"], 0.1)
        self.assertEqual(pair["nearest"][0][2], 1)
        self.assertEqual(self.run_tool(*files, "--clearance", "0.2", "--exit-zero").status, 0)

    def test_clash_colors_the_faces_that_penetrate(self):
        self.assertEqual(self.run_tool("clash", "floor.obj", "part.obj", "-o", "out.ply",
                                       "--ascii").status, 1)
        rows = [line.split() for line in self.read("out.ply").splitlines()
                if line.startswith("3 ")]
        self.assertEqual(len(rows), 24)
        red = [row for row in rows if "224" in row and "32" in row]
        self.assertGreaterEqual(len(red), 10)

    # ---- check ----

    def test_check_finds_the_poses_that_clash(self):
        self.mesh("ball.obj", box((0, 0, 0), (1, 1, 1)))
        self.put("poses.jsonl", "\n".join(
            json.dumps({"ball": moved_by(1, 1, z)}) for z in (0.5, 1, 1.25, 2)) + "\n\n")
        run = self.run_tool("check", "floor.obj", "ball.obj", "--poses", "poses.jsonl",
                            "--results", "out.jsonl")
        self.assertEqual(run.status, 1)
        self.assertIn("4 poses of 2 parts: 1 with a clash, the first is pose 0", run.text)
        rows = [json.loads(line) for line in self.read("out.jsonl").splitlines()]
        self.assertEqual([row["clash"] for row in rows], [True, False, False, False])
        self.assertEqual(rows[1]["pairs"][0]["status"], "touching")
        self.assertEqual(rows[2]["pairs"], [])
        entry = self.entry("check", "floor.obj", "ball.obj", "--poses", "poses.jsonl",
                           "--clearance", "0.5", status=1)
        self.assertEqual(entry["poses"]["clashing"], 3)

    def test_check_reads_plain_matrices(self):
        self.put("poses.txt", "".join(" ".join(map(str, moved_by(*by))) + "\n"
                                      for by in ((0, 0, 0), (0, 0, 9), (0, 0, 0), (0, 0, 0.25))))
        entry = self.entry("check", "floor.obj", "part.obj", "--poses", "poses.txt", status=0)
        self.assertEqual((entry["poses"]["count"], entry["poses"]["clashing"]), (2, 0))
        self.assertEqual([one["pose"] for one in entry["poses"]["list"]], [1])  # it touches

    def test_check_of_a_report(self):
        self.assertEqual(self.run_tool("drop", "part.obj", "--fixed", "floor.obj", "-n", "-r",
                                       "no.json").status, 1)
        self.mesh("high.obj", box((1, 1, 5), (2, 2, 6)))
        self.assertEqual(self.run_tool("drop", "high.obj", "--fixed", "floor.obj", "-n", "-r",
                                       "r.json").status, 0)
        entry = self.entry("check", "high.obj", "floor.obj", "--poses", "r.json", status=0)
        pair, = entry["poses"]["list"][0]["pairs"]
        self.assertEqual(pair["status"], "touching")

    def robot(self):
        links = "".join(f"<link name='{name}'><collision><geometry><mesh filename='{name}.obj'/>"
                        "</geometry></collision></link>" for name in ("base", "arm", "tip"))
        self.mesh("base.obj", box((-1, -1, -1), (1, 1, 1)))
        self.mesh("arm.obj", box((-0.25, -0.25, 0), (0.25, 0.25, 4)))
        self.mesh("tip.obj", box((-0.5, -0.5, 0), (0.5, 0.5, 4)))
        self.put("robot.urdf", f"<robot name='r'>{links}"
                 "<joint name='lift' type='prismatic'><parent link='base'/><child link='arm'/>"
                 "<axis xyz='0 0 1'/></joint>"
                 "<joint name='bend' type='revolute'><parent link='arm'/><child link='tip'/>"
                 "<origin xyz='0 0 4'/><axis xyz='0 1 0'/></joint></robot>")

    def test_check_of_a_robot_leaves_out_links_that_a_joint_connects(self):
        self.robot()
        self.put("angles.jsonl", '{}\n{"bend": 3.14159}\n{"bend": 3.14159, "lift": 1.5}\n')
        entry = self.entry("check", "robot.urdf", "--poses", "angles.jsonl", status=1)
        self.assertEqual(entry["parts"], 3)
        self.assertEqual([one["pose"] for one in entry["poses"]["list"]], [1])
        pair, = entry["poses"]["list"][0]["pairs"]
        self.assertEqual((pair["a"], pair["b"]), ("base", "tip"))
        self.assertEqual(self.run_tool("check", "robot.urdf", "--poses", "angles.jsonl", "--ignore",
                                       "base:tip").status, 0)

    def test_check_of_a_robot_of_boxes_and_spheres(self):
        shapes = {"base": "<box size='2 2 2'/>", "arm": "<cylinder radius='0.2' length='4'/>",
                  "tip": "<sphere radius='0.5'/>"}
        links = "".join(f"<link name='{name}'><collision><geometry>{shape}</geometry></collision>"
                        "</link>" for name, shape in shapes.items())
        self.put("robot.urdf", f"<robot name='r'>{links}"
                 "<joint name='lift' type='prismatic'><parent link='base'/><child link='arm'/>"
                 "<axis xyz='0 0 1'/></joint>"
                 "<joint name='slide' type='prismatic'><parent link='arm'/><child link='tip'/>"
                 "<axis xyz='0 0 1'/></joint></robot>")
        self.put("angles.jsonl", '{"slide": 1.5}\n{"slide": 1.4999}\n{"slide": 1.501}\n')
        entry = self.entry("check", "robot.urdf", "--poses", "angles.jsonl", status=1)
        self.assertEqual([one["pose"] for one in entry["poses"]["list"]], [0, 1])
        self.assertEqual([one["code"] for one in entry["warnings"]], ["approximated"] * 2)

    def test_check_says_what_is_wrong_with_poses(self):
        self.robot()
        for text, words in (('{"bend": "x"}\n',
                             "poses.jsonl:1: the value of joint bend is not a number"),
                            ('{}\n{"bond": 1}\n', "poses.jsonl:2: there is no joint bond"),
                            ("1 2 3", "poses of a robot are lines of JSON"),
                            ("{}\n{\n", "poses.jsonl:2: not valid JSON")):
            self.put("poses.jsonl", text)
            run = self.run_tool("check", "robot.urdf", "--poses", "poses.jsonl")
            self.assertEqual(run.status, 3, msg=text)
            self.assertIn(words, run.err)
        for text, words in (('{"part": [1, 2]}', "a matrix has 16 numbers, not 2"),
                            ('{"pert": []}', "no part is named pert"),
                            ('{"part": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,1,1]]}',
                             "the last row of a matrix must be 0 0 0 1"),
                            ("1 2 3", "the file ends within a pose"), ("a", "expected a number")):
            self.put("poses.jsonl", text)
            run = self.run_tool("check", "part.obj", "--poses", "poses.jsonl")
            self.assertEqual(run.status, 3, msg=text)
            self.assertIn(words, run.err)
        self.assertEqual(self.run_tool("check", "part.obj").status, 2)
        self.put("bad.urdf", "<robot><link name='a'/><link name='b'/><joint name='j' "
                 "type='planar'><parent link='a'/><child link='b'/></joint></robot>")
        run = self.run_tool("check", "bad.urdf", "--poses", "poses.jsonl")
        self.assertEqual(run.status, 3)
        self.assertIn('joint j: type "planar"', run.err)

    # ---- measure ----

    def test_measure_says_how_deep(self):
        run = self.run_tool("measure", "part.obj", "--fixed", "floor.obj")
        self.assertIn("at most 0.25 deep: a translation by (0, 0, 0.25) moves it out of floor.obj",
                      run.text)
        entry = self.entry("measure", "part.obj", "--fixed", "floor.obj", status=0)
        effort = entry["depth"].pop("effort")
        self.assertEqual(entry["depth"], {"bound": 0.25, "move": [0, 0, 0.25]})
        self.assertTrue(0 < effort["pairs"] < effort["bound"] and effort["skipped_candidates"] == 0)
        self.assertIsNone(self.entry("measure", "near.obj", "--fixed", "floor.obj")["depth"])

    def test_measure_finds_no_depth_when_told(self):
        run = self.run_tool("measure", "part.obj", "--fixed", "floor.obj", "--no-depth")
        self.assertNotIn("deep", run.text)
        entry = self.entry("measure", "part.obj", "--fixed", "floor.obj", "--no-depth", status=0)
        self.assertEqual((entry["depth"], entry["status"]), (None, "penetrating"))

    def test_of_crowds_of_long_thin_faces_depth_and_clear_end_and_say_so(self):
        source = random.Random(1)
        for name in ("needles.obj", "others.obj"):
            points, faces = [], []
            for i in range(4000):
                middle = [source.uniform(-1, 1) for _ in range(3)]
                along = [source.uniform(-1, 1) for _ in range(3)]
                points += [tuple(m - d for m, d in zip(middle, along)),
                           tuple(m + d for m, d in zip(middle, along)),
                           tuple(m + d + 1e-3 for m, d in zip(middle, along))]
                faces.append((3 * i, 3 * i + 1, 3 * i + 2))
            self.mesh(name, (points, faces))
        run = self.run_tool("measure", "needles.obj", "--fixed", "others.obj")
        self.assertRegex(run.text, "deep: .*; the search ended after [0-9,]+ pairs of faces, so "
                                   "a shorter translation may exist")
        entry = self.entry("measure", "needles.obj", "--fixed", "others.obj", status=0)
        effort = entry["depth"]["effort"]
        self.assertLessEqual(effort["pairs"], effort["bound"])
        self.assertGreater(effort["skipped_candidates"], 0)
        run = self.run_tool("separate", "needles.obj", "--fixed", "others.obj", "-o", "out.obj",
                            status=0)
        self.assertIn("; the search ended after ", run.text)
        self.run_tool("measure", "out.obj", "--fixed", "others.obj", "--no-depth", status=0)

    def test_measure_counts_the_points_of_a_cloud_that_are_inside(self):
        with open(self.path("cloud.xyz"), "wb") as file:
            file.write(xyz_bytes([(1, 1, 0.5), (2, 2, 5), (1, 1, 1), (3, 3, 0.25)]))
        run = self.run_tool("measure", "cloud.xyz", "--fixed", "floor.obj")
        self.assertIn("2 of 4 points inside, 1 on the surface", run.text)
        self.assertNotIn("inside it", run.text)
        entry = self.entry("measure", "cloud.xyz", "--fixed", "floor.obj")
        self.assertEqual(entry["points"], {"inside": 2, "on": 1, "outside": 1})
        self.assertIsNone(entry["inside"])

    def test_measure_writes_distances_and_minds_the_band(self):
        files = ["measure", "part.obj", "--fixed", "floor.obj"]
        entry = self.entry(*files, "--distances", "d.ply", "--tolerance-band", "-0.25,2", status=0)
        found = entry["deviation"]
        self.assertTrue(found["signed"])
        self.assertEqual((found["lowest"], found["highest"]), (-0.25, 2))
        self.assertEqual(found["tolerance_band"]["within"], 8)
        data = self.read_bytes("d.ply")
        self.assertIn(b"property double distance", data)
        run = self.run_tool(*files, "--tolerance-band", "-0.2,1")
        self.assertEqual(run.status, 1)
        self.assertIn("8 are out of the band from -0.2 to 1", run.text)
        self.assertEqual(self.run_tool(*files, "--tolerance-band", "1,-1").status, 2)
        said = " ".join(self.run_tool("measure", "--help", status=0).text.split())
        self.assertIn("Exit status 1 only if a point is out of --tolerance-band: 0 also if MOVING "
                      "penetrates", said)
        self.assertEqual(self.run_tool("drop", "part.obj", "-n", "--distances", "x.ply").status, 2)
        self.assertEqual(self.run_tool(*files, "--distances", "d.ply").status, 4)  # it is there

    def test_what_penetrates_is_said_once(self):
        run = self.run_tool("slide", "part.obj", "--fixed", "floor.obj", "-n")
        self.assertEqual(run.status, 1)
        self.assertEqual(run.text.count("penetrat"), 1)
        self.assertRegex(run.text, r"not placed: penetrates floor.obj at the start \(\d+ pairs "
                                   r"of faces, the first \d+ and \d+\); tf-place separate moves "
                                   r"it out")


if __name__ == "__main__":
    main()
