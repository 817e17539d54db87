"""Meshes: faces, polygons, seams, borders, soups."""

from weld_support import *

NORMALS = XYZ + ["float nx", "float ny", "float nz"]
# Two triangles that share an edge in space but no vertex; the corners differ in their normals.
FOLDED = ply_text(NORMALS,
                  [(0, 0, 0, 0, 0, 1), (1, 0, 0, 0, 0, 1), (0, 1, 0, 0, 0, 1),
                   (1, 0, 0, 1, 0, 0), (0, 1, 0, 1, 0, 0), (1, 1, 1, 1, 0, 0)],
                  [(0, 1, 2), (4, 3, 5)])


def cut_strip():
    """Two squares side by side, each of two triangles, with a gap of 0.01 between them."""
    left = ([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [(0, 1, 2), (0, 2, 3)])
    right = ([(1.01, 0, 0), (2, 0, 0), (2, 1, 0), (1.01, 1, 0)], [(0, 1, 2), (0, 2, 3)])
    return together(left, right)


class Meshes(WeldTest):
    def test_a_soup_becomes_an_indexed_mesh_without_loss(self):
        write(self.path("cube.stl"), cube())
        run = self.run_tool("cube.stl", "-o", "cube.obj", status=0)
        self.assertIn("28 of 36 vertices merged, 8 kept", run.text)
        points, faces = read_obj(self.read("cube.obj"))
        self.assertEqual(sorted(points), sorted(map(lambda p: tuple(map(float, p)), cube()[0])))
        self.assertEqual([[points[c] for c in f] for f in faces],
                         [[cube()[0][c] for c in f] for f in cube()[1]])

    def test_what_rounding_to_floats_folds_is_said(self):
        write(self.path("odd.obj"), cube((1e9, 1e9, 0)))
        warnings = self.report("odd.obj", "-o", "odd.stl", status=0)["files"][0]["warnings"]
        self.assertEqual([w["code"] for w in warnings],
                         ["rounded", "precision", "rounding-defects"])
        self.assertIn("12 faces lost all area", warnings[2]["text"])
        self.assertEqual(self.report("odd.obj", "-o", "odd.ply", status=0)["files"][0]["warnings"],
                         [])

    def test_an_stl_stays_the_same_stl(self):
        data = stl_bytes(cube())
        self.write("cube.stl", data)
        self.run_tool("cube.stl", "-o", "out.stl", status=0)
        self.assertEqual(self.read_bytes("out.stl")[80:84], data[80:84])
        self.run_tool("out.stl", "-o", "again.stl", status=0)
        self.assertEqual(self.read_bytes("again.stl"), self.read_bytes("out.stl"))
        points = lambda bytes_: [struct.unpack_from("<9f", bytes_, 96 + 50 * i) for i in range(12)]
        self.assertEqual(points(self.read_bytes("out.stl")), points(data))

    def test_every_mesh_format_is_written(self):
        write(self.path("cube.stl"), cube())
        for extension in ("obj", "ply", "off", "glb", "stl"):
            self.run_tool("cube.stl", "-o", f"out.{extension}", status=0)
            self.run_tool(f"out.{extension}", "--check",
                          status=1 if extension == "stl" else 0)

    def test_seams_are_kept_unless_let_go(self):
        self.write("in.ply", FOLDED)
        for options, kept in (([], 6), (["--ignore-seams", "normal"], 4),
                              (["--ignore-seams", "nx,nz,ny"], 4),
                              (["--ignore-seams", "nx"], 6), (["--same", "normal=0.5"], 6),
                              (["--same", "normal=1"], 4), (["--ignore-seams", "uv,color"], 6)):
            entry = self.entry("in.ply", *options, status=0)
            self.assertEqual(entry["points"]["out"], kept, msg=options)
        entry = self.entry("in.ply", status=0)
        self.assertEqual(entry["same"],
                         [{"property": p, "tolerance": 0} for p in ("nx", "ny", "nz")])
        self.assertIn("only with equal nx, ny, nz", self.run_tool("in.ply", "--check").text)

    def test_faces_that_collapse_are_dropped_and_counted_or_kept(self):
        points = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0.001, 0), (5, 5, 5)]
        write(self.path("in.obj"), (points, [(0, 1, 2), (0, 1, 3), (1, 1, 4)]))
        faces = self.entry("in.obj", "-t", "0.01", "-o", "out.obj", status=0)["faces"]
        self.assertEqual((faces["in"], faces["out"], faces["collapsed"], faces["degenerate"]),
                         (3, 1, 1, 1))
        self.assertEqual(read_obj(self.read("out.obj"))[1], [(0, 1, 2)])
        faces = self.entry("in.obj", "-t", "0.01", "--keep-degenerate", "-o", "all.obj",
                           status=0)["faces"]
        self.assertEqual((faces["in"], faces["out"], faces["collapsed"]), (3, 3, 1))
        self.assertEqual(read_obj(self.read("all.obj"))[1], [(0, 1, 2), (0, 1, 0), (1, 1, 3)])

    def test_polygons_stay_polygons(self):
        points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (1, 0, 0), (2, 0, 0), (2, 1, 0),
                  (1.5, 2, 0), (1, 1, 0)]
        write(self.path("in.obj"), (points, [(0, 1, 2, 3), (4, 5, 6, 7, 8)]))
        entry = self.entry("in.obj", "-o", "out.obj", status=0)
        self.assertEqual(entry["polygons"], {"in": 2, "out": 2})
        self.assertEqual(read_obj(self.read("out.obj"))[1], [(0, 1, 2, 3), (1, 4, 5, 6, 2)])

    def test_a_polygon_loses_the_corners_that_merge(self):
        points = [(0, 0, 0), (1, 0, 0), (1.001, 0, 0), (1, 1, 0), (0, 1, 0)]
        write(self.path("in.obj"), (points, [(0, 1, 2, 3, 4)]))
        entry = self.entry("in.obj", "-t", "0.01", "-o", "out.obj", status=0)
        self.assertEqual((entry["polygons"], entry["faces"]["collapsed"]), ({"in": 1, "out": 1}, 1))
        self.assertEqual(read_obj(self.read("out.obj"))[1], [(0, 1, 2, 3)])

    def test_a_polygon_that_pinches_comes_apart(self):
        points = [(0, 0, 0), (1, 1, 0), (2, 1, 0), (0, 0.001, 0), (-1, 2, 0), (-1, 0, 0),
                  (0, -3, 0)]
        write(self.path("in.obj"), (points, [(0, 1, 2, 3, 4, 5, 6)]))
        self.run_tool("in.obj", "-t", "0.01", "-o", "out.obj", status=0)
        self.assertEqual(read_obj(self.read("out.obj"))[1], [(0, 1, 2), (0, 3, 4, 5)])

    def test_face_properties_and_polygons_survive_together(self):
        rows = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (1, 0, 0), (2, 0, 0), (1, 1, 0)]
        self.write("in.ply", ply_text(XYZ, rows, [((0, 1, 2, 3), 7), ((4, 5, 6), 9)],
                                      ["int material"]))
        self.run_tool("in.ply", "-o", "out.ply", "--ascii", status=0)
        self.assertEqual(self.ply_rows("out.ply", "face"),
                         [("4", "0", "1", "2", "3", "7"), ("3", "1", "4", "2", "9")])

    def test_parts_keep_their_faces(self):
        self.write("in.obj", "o one\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n"
                             "o two\nv 1 0 0\nv 2 0 0\nv 1 1 0\nf 5 6 7\n")
        self.run_tool("in.obj", "-o", "out.obj", status=0)
        lines = [line for line in self.read("out.obj").splitlines() if line[0] in "of"]
        self.assertEqual(lines, ["o one", "f 1 2 3 4", "o two", "f 2 5 3"])

    def test_borders_stitch_shells_and_leave_the_inside_alone(self):
        strip = cut_strip()
        write(self.path("strip.obj"), strip)
        entry = self.entry("strip.obj", "-t", "0.02", "--borders", "-o", "out.obj", status=0)
        self.assertEqual((entry["points"]["out"], entry["displacement"]["max"]),
                         (6, max(1.01 - 1, 0)))
        tent = ([(0, 0, 0), (4, 0, 0), (4, 4, 0), (0, 4, 0), (2, 2, 1), (2, 2.01, 1)],
                [(0, 1, 4), (1, 2, 5), (1, 5, 4), (2, 3, 5), (3, 0, 4), (3, 4, 5)])
        write(self.path("tent.obj"), tent)
        self.assertEqual(self.entry("tent.obj", "-t", "0.1")["points"]["out"], 5)
        self.assertEqual(self.entry("tent.obj", "-t", "0.1", "--borders")["points"]["out"], 6)

    def test_borders_of_a_soup_are_those_of_its_equal_corners(self):
        write(self.path("strip.stl"), cut_strip())
        entry = self.entry("strip.stl", "-t", "0.02", "--borders", "-o", "out.obj", status=0)
        self.assertEqual((entry["points"]["in"], entry["points"]["out"]), (12, 6))
        write(self.path("cube.stl"), cube())
        entry = self.entry("cube.stl", "-t", "1", "--borders", "-o", "cube.obj", status=0)
        self.assertEqual(entry["points"]["out"], 8)  # closed: no vertex is on an open edge

    def test_keep_manifold_leaves_a_third_face_at_an_edge_apart(self):
        fan = together(([(0, 0, 0), (0, 0, 1), (1, 0, 0)], [(0, 1, 2)]),
                       ([(0, 0, 0), (0, 0, 1), (0, 1, 0)], [(1, 0, 2)]),
                       ([(0, 0, 0), (0, 0, 1), (-1, -1, 0)], [(0, 1, 2)]))
        write(self.path("fan.obj"), fan)
        entry = self.entry("fan.obj", "-o", "out.obj", status=0)
        self.assertEqual(entry["nonmanifold_edges"], {"before": 0, "after": 1})
        self.assertEqual(entry["kept_apart"], None)
        self.assertIn("nonmanifold", [w["code"] for w in entry["warnings"]])
        entry = self.entry("fan.obj", "--keep-manifold", "-o", "apart.obj", status=0)
        self.assertEqual(entry["nonmanifold_edges"], {"before": 0, "after": 0})
        self.assertGreater(entry["kept_apart"], 0)
        self.assertEqual(entry["warnings"], [])

    def test_keep_manifold_closes_a_soup_all_the_same(self):
        write(self.path("cube.stl"), cube())
        entry = self.entry("cube.stl", "--keep-manifold", "-o", "out.obj", status=0)
        self.assertEqual((entry["points"]["out"], entry["kept_apart"]), (8, 0))

    def test_faces_that_turn_over_are_counted(self):
        points = [(0, 0, 0), (10, 0, 0), (5, 0.1, 0), (5, -1, 0), (5, -0.3, 0)]
        write(self.path("in.obj"), (points, [(0, 1, 2), (0, 3, 4)]))
        entry = self.entry("in.obj", "-t", "0.6", "--keep", "last", "-o", "out.obj")
        self.assertEqual(entry["faces"]["flipped"], 1)
        self.assertIn("flipped", [w["code"] for w in entry["warnings"]])

    def test_options_for_faces_need_faces(self):
        self.cloud("in.xyz", [(0, 0, 0)])
        self.assertIn("no faces", self.run_tool("in.xyz", "--borders", "--check", status=3).err)
        self.run_tool("in.xyz", "--keep-manifold", "--keep-degenerate", "--check", status=0)


if __name__ == "__main__":
    main()
