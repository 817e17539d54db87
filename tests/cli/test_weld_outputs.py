"""Files that tf-weld writes: results, maps, removed points, labels, joined inputs, in place."""

from weld_support import *

COLUMNS = XYZ + ["uchar red", "float intensity"]
ROWS = [(0, 0, 0, 10, 0.5), (1, 0, 0, 20, 1.5), (0, 0, 0, 30, 2.5), (1, 0, 0, 40, 3.5),
        (2, 0, 0, 50, 4.5)]


class Outputs(WeldTest):
    def setUp(self):
        super().setUp()
        self.write("in.ply", ply_text(COLUMNS, ROWS))

    def test_all_other_properties_are_kept(self):
        self.run_tool("in.ply", "-o", "out.ply", "--ascii", status=0)
        self.assertEqual(self.ply_rows("out.ply"),
                         [("0", "0", "0", "10", "0.5"), ("1", "0", "0", "20", "1.5"),
                          ("2", "0", "0", "50", "4.5")])
        self.assertIn("property uchar red", self.read("out.ply"))
        self.assertIn("property double x", self.read("out.ply"))

    def test_the_map_leads_from_each_point_to_its_place(self):
        self.run_tool("in.ply", "--map", "map.csv", status=0)
        self.assertEqual(self.read("map.csv"), "input,output\n0,0\n1,1\n2,0\n3,1\n4,2\n")
        self.run_tool("in.ply", "--map", "map.bin", status=0)
        self.assertEqual(struct.unpack("<5Q", self.read_bytes("map.bin")), (0, 1, 0, 1, 2))
        run = self.run_tool("in.ply", "--map", "-", "--check", status=1)
        self.assertEqual(run.text, self.read("map.csv"))
        self.assertIn("2 of 5 points would be merged", run.err)

    def test_removed_points_keep_their_properties(self):
        entry = self.entry("in.ply", "--removed", "gone.ply", "--ascii", status=0)
        self.assertEqual(self.ply_rows("gone.ply"),
                         [("0", "0", "0", "30", "2.5"), ("1", "0", "0", "40", "3.5")])
        self.assertEqual(entry["removed"], "gone.ply")
        for name in ("gone.xyz", "gone.txt", "gone.csv", "gone.pcd"):
            self.run_tool("in.ply", "--removed", name, status=0)
        self.assertEqual(self.read("gone.xyz"), "0 0 0 30 2.5\n1 0 0 40 3.5\n")
        self.assertEqual(self.read("gone.txt"), self.read("gone.xyz"))
        self.assertEqual(self.read("gone.csv").splitlines()[0], "x,y,z,red,intensity")

    def test_kept_and_removed_are_what_came_in(self):
        for which in ("first", "last", "min:intensity", "max:red"):
            self.run_tool("in.ply", "--keep", which, "-o", "out.xyz", "--removed", "gone.xyz",
                          "-f", status=0)
            both = self.numbers("out.xyz") + self.numbers("gone.xyz")
            self.assertEqual(sorted(both), sorted(ROWS), msg=which)

    def test_a_label_drops_nothing(self):
        entry = self.entry("in.ply", "--label", "group", "-o", "out.ply", "--ascii", status=0)
        self.assertEqual(self.ply_rows("out.ply"),
                         [tuple(map(str, (*row, group))) for row, group in
                          zip(ROWS, (0, 1, 0, 1, 2))])
        self.assertEqual(entry["points"],
                         {"in": 5, "out": 5, "removed": 0, "distinct": 3, "groups": 2})
        self.assertEqual(entry["label"], "group")

    def test_a_label_replaces_a_property_of_its_name_with_a_warning(self):
        entry = self.entry("in.ply", "--label", "red", "-o", "out.ply", "--ascii", status=0)
        self.assertEqual([row[3] for row in self.ply_rows("out.ply")], ["0", "1", "0", "1", "2"])
        self.assertEqual([w["code"] for w in entry["warnings"]], ["replaced"])

    def test_a_labeled_mesh_keeps_its_faces_and_polygons(self):
        write(self.path("cube.obj"), together(cube(), ([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)],
                                                       [(0, 1, 2, 3)])))
        entry = self.entry("cube.obj", "--label", "g", "-o", "out.ply", "--ascii", status=0)
        self.assertEqual((entry["points"]["distinct"], entry["points"]["out"]), (8, 12))
        self.assertEqual(entry["faces"]["in"], entry["faces"]["out"])
        self.assertEqual(self.ply_rows("out.ply", "face")[-1], ("4", "8", "9", "10", "11"))

    def test_check_writes_nothing_and_says_whether_anything_would_merge(self):
        run = self.run_tool("in.ply", "--check", status=1)
        self.assertIn("2 of 5 points would be merged, 3 would stay (equal)", run.text)
        self.run_tool("in.ply", "--check", "--exit-zero", status=0)
        self.cloud("apart.xyz", [(0, 0, 0), (1, 0, 0)])
        self.run_tool("apart.xyz", "--check", status=0)
        self.run_tool("apart.xyz", "--check", "-t", "1", status=1)
        self.assertEqual(self.listing(), ["apart.xyz", "in.ply"])

    def test_point_formats_are_written_and_read_back(self):
        for name in ("out.ply", "out.pcd", "out.xyz", "out.csv", "out.txt", "out.asc"):
            self.run_tool("in.ply", "-o", name, status=0)
            entry = self.entry(name, status=0)
            self.assertEqual((entry["points"]["in"], entry["points"]["removed"]), (3, 0), msg=name)
        self.assertEqual(self.read("out.txt"), self.read("out.xyz"))

    def test_a_dry_run_writes_reports_only(self):
        self.run_tool("in.ply", "-n", "-o", "out.ply", "--removed", "gone.ply", "--map", "map.csv",
                      "-r", "r.json", status=0)
        self.assertEqual(self.listing(), ["in.ply", "map.csv", "r.json"])

    def test_output_dir_names_one_file_for_each_input(self):
        os.mkdir(self.path("out"))
        write(self.path("cube.stl"), cube())
        self.run_tool("in.ply", "cube.stl", "--output-dir", "out", status=0)
        self.assertEqual(sorted(os.listdir(self.path("out"))), ["cube-weld.stl", "in-weld.ply"])

    def test_in_place_replaces_each_input_and_keeps_its_kind(self):
        self.cloud("a.xyz", [(0, 0, 0), (0, 0, 0)])
        self.run_tool("in.ply", "a.xyz", "--in-place", status=0)
        self.assertEqual(self.read("a.xyz"), "0 0 0\n")
        self.assertIn("format ascii", self.read("in.ply"))
        self.assertEqual(len(self.ply_rows("in.ply")), 3)
        self.run_tool("in.ply", "--in-place", "--binary", status=0)
        self.assertIn(b"format binary_little_endian", self.read_bytes("in.ply"))
        self.assertEqual(self.listing(), ["a.xyz", "in.ply"])

    def test_in_place_leaves_a_file_alone_when_anything_fails(self):
        self.write("bad.ply", ply_text(XYZ, [(0, 0, 0)] * 2)[:-2])
        before = self.read_bytes("bad.ply")
        self.run_tool("bad.ply", "--in-place", "--same", "nonsense", status=3)
        self.assertEqual(self.read_bytes("bad.ply"), before)

    def test_existing_files_are_not_overwritten_without_force(self):
        for option, name in (("-o", "out.ply"), ("--map", "m.csv"), ("--removed", "gone.ply"),
                             ("-r", "r.json")):
            self.write(name, "mine")
            run = self.run_tool("in.ply", option, name, status=4)
            self.assertIn(name, run.err)
            self.assertEqual(self.read(name), "mine")
            self.run_tool("in.ply", option, name, "-f", status=0)
            self.assertNotEqual(self.read_bytes(name), b"mine")

    def test_all_outputs_appear_or_none(self):
        if not os.path.exists("/dev/full"):
            self.skipTest("no /dev/full")
        self.run_tool("in.ply", "--removed", "gone.ply", "-o", "/dev/full", "--output-format",
                      "ply", status=4)
        self.run_tool("in.ply", "-o", "no/such/out.ply", "--removed", "gone.ply", status=4)
        self.assertEqual(self.listing(), ["in.ply"])

    def test_rounding_that_brings_points_together_is_told(self):
        self.cloud("in.xyz", [(1, 0, 0), (1 + 2 ** -40, 0, 0), (5, 0, 0)])
        entry = self.entry("in.xyz", "-o", "keep.ply", status=0)
        self.assertEqual((entry["output"]["precision_out"], entry["output"]["max_move"],
                          entry["output"]["within_tolerance"]), ("double", 0, 0))
        entry = self.entry("in.xyz", "-o", "single.ply", "--precision", "float", status=0)
        self.assertEqual((entry["output"]["precision_out"], entry["output"]["max_move"],
                          entry["output"]["within_tolerance"]), ("float", 2 ** -40, 1))
        self.assertEqual([w["code"] for w in entry["warnings"]], ["rounded", "precision"])

    def test_means_within_the_tolerance_of_each_other_are_told(self):
        self.cloud("in.xyz", [(0, 0, 0), (1, 0, 0), (1.75, 0, 0), (2.5, 0, 0)])
        entry = self.entry("in.xyz", "-t", "1", "--keep", "mean", "-o", "out.xyz", status=0)
        apart = [b[0] - a[0] for a, b in zip(self.numbers("out.xyz"), self.numbers("out.xyz")[1:])]
        self.assertEqual(entry["output"]["within_tolerance"], sum(d <= 1 for d in apart))
        entry = self.entry("in.xyz", "-t", "1", "--keep", "last", "-o", "last.xyz", status=0)
        self.assertEqual(self.numbers("last.xyz"), [(1, 0, 0), (2.5, 0, 0)])
        self.assertEqual(entry["displacement"]["max"], 1)


class Join(WeldTest):
    def test_inputs_become_one_set_in_their_order(self):
        self.cloud("a.xyz", [(0, 0, 0), (1, 0, 0)])
        self.cloud("b.xyz", [(1, 0, 0), (2, 0, 0)])
        entry = self.entry("a.xyz", "b.xyz", "--join", "-o", "all.xyz", "--map", "m.csv", status=0)
        self.assertEqual(self.read("all.xyz"), "0 0 0\n1 0 0\n2 0 0\n")
        self.assertEqual(self.read("m.csv"), "input,output\n0,0\n1,1\n2,1\n3,2\n")
        self.assertEqual(entry["input"], None)
        self.assertEqual([(s["input"], s["points"], s["first_point"]) for s in entry["sources"]],
                         [("a.xyz", 2, 0), ("b.xyz", 2, 2)])
        self.assertEqual(entry["points"]["out"], 3)

    def test_without_it_each_input_stays_on_its_own(self):
        self.cloud("a.xyz", [(0, 0, 0)])
        self.cloud("b.xyz", [(0, 0, 0)])
        report = self.report("a.xyz", "b.xyz", "--check", status=0)
        self.assertEqual([f["points"]["removed"] for f in report["files"]], [0, 0])

    def test_properties_go_together_by_name(self):
        self.write("a.ply", ply_text(XYZ + ["float f", "uchar n"], [(0, 0, 0, 0.5, 1)]))
        self.write("b.ply", ply_text(["float x", "float y", "float z", "ushort n", "int k"],
                                     [(1, 0, 0, 300, -7)]))
        entry = self.entry("a.ply", "b.ply", "--join", "-o", "all.ply", "--ascii", status=0)
        self.assertEqual(self.ply_rows("all.ply"), [("0", "0", "0", "0.5", "1", "0"),
                                                    ("1", "0", "0", "nan", "300", "-7")])
        for line in ("property double x", "property float f", "property ushort n",
                     "property int k"):
            self.assertIn(line, self.read("all.ply"))
        self.assertEqual(sorted(w["code"] for w in entry["warnings"]), ["missing-property"] * 2)

    def test_lists_and_values_of_one_name_are_refused(self):
        self.write("a.ply", ply_text(XYZ + ["float f"], [(0, 0, 0, 1)]))
        self.write("b.ply", ply_text(XYZ + ["list uchar float f"], [(0, 0, 0, 1, 2)]))
        run = self.run_tool("a.ply", "b.ply", "--join", "-o", "all.ply", status=3)
        self.assertIn("property f has different types", run.err)
        self.assertEqual(self.listing(), ["a.ply", "b.ply"])

    def test_faces_are_renumbered(self):
        write(self.path("a.obj"), ([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [(0, 1, 2, 3)]))
        write(self.path("b.stl"), ([(1, 0, 0), (2, 0, 0), (1, 1, 0)], [(0, 1, 2)]))
        self.run_tool("a.obj", "b.stl", "--join", "-o", "all.obj", status=0)
        points, faces = read_obj(self.read("all.obj"))
        self.assertEqual((len(points), faces), (5, [(0, 1, 2, 3), (1, 4, 2)]))

    def test_joined_inputs_share_a_tolerance(self):
        self.cloud("a.xyz", [(0, 0, 0), (0, 0, 1)])
        self.cloud("b.xyz", [(0, 0, 100)])
        entry = self.entry("a.xyz", "b.xyz", "--join", "-t", "1%", "-o", "all.xyz", status=0)
        self.assertEqual((entry["tolerance"], entry["points"]["out"]),
                         ({"given": "1%", "used": 1}, 2))

    def test_an_input_that_cannot_be_read_ends_the_work(self):
        self.cloud("a.xyz", [(0, 0, 0)])
        run = self.run_tool("a.xyz", "missing.xyz", "--join", "-o", "all.xyz", status=3)
        self.assertIn("missing.xyz", run.err)
        self.assertEqual(self.listing(), ["a.xyz"])

    def test_one_input_may_be_joined_with_none(self):
        self.cloud("a.xyz", [(0, 0, 0)])
        self.assertEqual(self.entry("a.xyz", "--join", "--check", status=0)["input"], "a.xyz")


if __name__ == "__main__":
    main()
