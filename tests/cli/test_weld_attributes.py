"""Properties of points from format to format: names, types, scales, and what is said of them."""

from weld_support import *

import random

CSV = "Point,Northing,Easting,Elevation,Code,intensity,red,green,blue\n"


def las_file(points, scale=0.01, offset=(0.0, 0.0, 0.0), records=b"", count=0, epoch=False):
    """LAS 1.4, format 7. A point is X, Y, Z in steps, intensity, and red, green, blue."""
    header = bytearray(375)
    header[0:4] = b"LASF"
    header[6] = 16 + epoch
    header[24:26] = bytes((1, 4))
    struct.pack_into("<HIIBHI", header, 94, 375, 375 + len(records), count, 7, 36, 0)
    struct.pack_into("<6d", header, 131, *[scale] * 3, *offset)
    for axis in range(3):
        where = [p[axis] * scale + offset[axis] for p in points]
        struct.pack_into("<2d", header, 179 + 16 * axis, max(where), min(where))
    struct.pack_into("<Q", header, 247, len(points))
    return bytes(header) + records + b"".join(
        struct.pack("<3iHBBBBhHd3H", *p[:4], 0x11, 0, 2, 0, 0, 0, 0.0, *p[4:]) for p in points)


def record(user, number, data):
    return struct.pack("<H16sHH32s", 0, user, number, len(data), b"") + data


def system(name):
    return record(b"LASF_Projection", 2112, b'PROJCS["' + name + b'"]')


class Attributes(WeldTest):
    def setUp(self):
        super().setUp()
        self.rng = random.Random(43)

    def both(self, *command, out, size=20):
        """The entry of a run in memory; one in tiles writes the same bytes and says the same."""
        found = []
        for tiled in ([], ["--tile-points", size]):
            entry = self.entry(*command, "-o", out, "-f", *tiled, status=0)
            found.append((self.read_bytes(out), [w["text"] for w in entry["warnings"]]))
        self.assertEqual(found[0][1], found[1][1], msg=command)
        self.assertTrue(found[0][0] == found[1][0], msg=command)
        return found[0][1]

    def colored(self, most):
        return [(self.rng.randrange(1000), self.rng.randrange(1000), i, self.rng.randrange(99),
                 *(self.rng.randrange(most + 1) for _ in range(3))) for i in range(90)]

    def test_colors_of_las_are_of_8_bits_elsewhere(self):
        for most, words in ((65535, "16-bit"), (255, "below 256")):
            points = self.colored(most)
            self.write("in.las", las_file(points))
            for out in ("out.ply", "out.pcd", "out.csv", "out.xyz"):
                said = self.both("in.las", out=out)
                self.assertIn(words, said[0])
            self.run_tool("in.las", "-o", "out.csv", "-f", status=0)
            head, *rows = self.read("out.csv").splitlines()
            red = head.split(",").index("red")
            self.assertEqual([int(r.split(",")[red]) for r in rows],
                             [p[4] >> 8 if most > 255 else p[4] for p in points])
            self.both("in.las", out="back.las")
            self.assertEqual(self.read_bytes("back.las")[375:], las_file(points)[375:])

    def test_float_intensities_become_whole_numbers(self):
        for scale, words in ((200.0, "rounded"), (1.0, "multiplied by 65535")):
            rows = [(i, 0.5 * i, 0.0, self.rng.random() * scale) for i in range(80)]
            self.write("in.pcd", "VERSION 0.7\nFIELDS x y z intensity\nSIZE 4 4 4 4\nTYPE F F F F\n"
                       "COUNT 1 1 1 1\nWIDTH 80\nHEIGHT 1\nPOINTS 80\nDATA ascii\n" +
                       "".join("%g %g %g %.9g\n" % row for row in rows))
            for out in ("out.las", "out.laz"):
                said = self.both("in.pcd", out=out)
                self.assertEqual(len(said), 1)
                self.assertIn(words, said[0])
            self.run_tool("out.las", "-o", "out.csv", "-f", status=0)
            head, first = self.read("out.csv").splitlines()[:2]
            for name in ("return_number", "number_of_returns"):
                self.assertEqual(first.split(",")[head.split(",").index(name)], "1")

    def test_drop_takes_all_columns_of_a_kind(self):
        rows = [(i, 0, 0, i % 256, 7, 255, 0, 0, 1, 0.5) for i in range(60)]
        names = ["float x", "float y", "float z", "uchar red", "uchar green", "uchar blue",
                 "float nx",
                 "float ny", "float nz", "float curvature"]
        self.write("in.ply", ply_text(names, rows))
        for other in ("pcd", "las"):
            self.run_tool("in.ply", "-o", "in." + other, status=0)
        for source in ("in.ply", "in.pcd", "in.las"):
            self.both(source, "--ascii", "--drop", "normal,color", out="out.ply")
            head = self.read("out.ply").partition("end_header")[0]
            self.assertIn(" curvature\n", head)
            for name in ("red", "rgb", "nx", "normal_x"):
                self.assertNotIn(" " + name + "\n", head)
        self.assertIn("--drop uv: no such property", self.run_tool(
            "in.ply", "--drop", "uv", "-o", "out.ply", "-f", status=3).err)
        self.write("in.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nvt 0 0\nvt 1 0\n"
                   "f 1/1/1 2/2/1 3/1/1\n")
        for drop, line in (("normal", "f 1/1 2/2 3/1"), ("uv", "f 1//1 2//1 3//1"),
                           ("uv,normal", "f 1 2 3")):
            self.run_tool("in.obj", "--drop", drop, "-o", "out.obj", "-f", status=0)
            self.assertIn(line + "\n", self.read("out.obj"))

    def test_what_is_rounded_in_las_is_counted(self):
        self.write("in.csv", "x,y,z,gps_time\n" + "".join(
            f"{i},0,0,{2 ** 60 + (0 if i < 50 else 2 * i + 1)}\n" for i in range(70)))
        for out in ("out.las", "out.laz"):
            said = self.both("in.csv", out=out)
            self.assertEqual(said, ["20 whole numbers of gps_time rounded: LAS stores "
                                    "floating-point numbers there"])

    def test_names_are_those_of_the_format(self):
        rows = [(i, 0, 0, i % 256, 7, 255, 0, 0, 1, 0.5) for i in range(60)]
        self.write("in.ply", ply_text(["float x", "float y", "float z", "uchar red", "uchar green",
                                       "uchar blue", "float nx", "float ny", "float nz",
                                       "float curvature"], rows))
        self.assertEqual(self.both("in.ply", out="out.pcd"), [])
        self.assertIn(b"\nFIELDS x y z rgb normal_x normal_y normal_z curvature\n",
                      self.read_bytes("out.pcd"))
        said = self.both("out.pcd", "--ascii", out="back.ply")
        self.assertEqual((said, self.ply_rows("back.ply")), ([], self.ply_rows("in.ply")))
        said = self.both("in.ply", out="out.obj")
        self.assertEqual(said, ["not written to OBJ: curvature of points"])
        self.assertIn("\nvn 0 0 1\n", self.read("out.obj"))
        # A condition on what is called otherwise in the output holds all the same.
        self.both("out.pcd", "-t", "1.5", "--same", "normal_x", "--keep", "last", out="thin.ply")

    def test_tables_say_what_was_taken_and_keep_what_they_can(self):
        lines = ["%d,%d.25,%d.5,30,%s,%s,%d,0,255" %
                 (i, 4100000 + i, 500000 + i, self.rng.choice(("tree", "", "7")), i if i % 7
                  else "",
                  i % 256) for i in range(90)]
        self.write("in.csv", CSV + "\n".join(lines) + "\n")
        said = self.both("in.csv", "--ascii", out="out.ply")
        self.assertEqual(said[0],
                         "x, y and z are the columns 'Easting', 'Northing' and 'Elevation'")
        self.assertIn("Code, intensity empty or not a number: read as NaN", said[1])
        self.assertIn("property uchar red\n", self.read("out.ply"))
        self.write("large.csv", "x,y,z,stamp\n" + "".join(
            f"{i},0,0,{1234567890123456789 - i}\n" for i in range(70)))
        self.both("large.csv", out="out.csv")
        self.assertIn(",1234567890123456788\n", self.read("out.csv"))
        columns = ["--columns", "x=E,y=N,z=4"]
        self.write("named.csv", "id;E;N;H\n" + "".join(f"{i};{i}.5;2;3\n" for i in range(70)))
        self.assertEqual(self.both("named.csv", *columns, out="out.csv"), [])
        self.assertTrue(self.read("out.csv").startswith("id,x,y,z\n0,0.5,2,3\n"))
        self.assertIn("there is no column 'Q' among id, E, N, H", self.run_tool(
            "named.csv", "--columns", "x=Q,y=N,z=H", "-o", "none.csv", status=3).err)
        self.write("angles.csv", "lat,lon,height\n50.1,8.2,3\n")
        self.assertIn("project them", self.run_tool("angles.csv", "-o", "none.csv", status=3).err)

    def test_properties_are_dropped_and_renamed(self):
        self.write("in.las", las_file(self.colored(65535)))
        self.both("in.las", "--drop", "red,green,blue",
                  "--rename", "intensity=strength", out="out.csv")
        head = self.read("out.csv").splitlines()[0].split(",")
        self.assertIn("strength", head)
        self.assertNotIn("red", head)
        for option in (["--drop", "none"], ["--rename", "none=b"]):
            self.assertIn("no such property; the points have intensity",
                          self.run_tool("in.las", *option, "-o", "n.csv", status=3).err)
        self.assertIn("red already exists",
                      self.run_tool("in.las", "--rename", "blue=red", "-o", "n.csv",
                                    status=3).err)
        self.run_tool("in.las", "--drop", "red", "--check", status=2)

    def test_scale_and_offset_of_las_are_those_asked_for(self):
        self.write("in.las", las_file(self.colored(9)))
        self.cloud("in.xyz", [(i + 0.004, 0.0, 1000.0) for i in range(80)])
        for name in ("in.las", "in.xyz"):
            for which in (["--las-scale", "0.5"], ["--las-offset", "10,20,30"],
                          ["--las-scale", "0.25,0.5,1", "--las-offset", "5"]):
                self.both(name, *which, out="out.las")
                grid = struct.unpack_from("<6d", self.read_bytes("out.las"), 131)
                if "--las-scale" in which:
                    self.assertIn(grid[0], (0.5, 0.25))
                if "--las-offset" in which:
                    self.assertIn(grid[3], (10.0, 5.0))
        self.run_tool("in.las", "--las-scale", "0", "-o", "n.las", status=2)
        self.run_tool("in.las", "--las-scale", "1", "-o", "n.ply", status=2)

    def test_points_that_are_none_are_dropped_first(self):
        self.write("in.xyz", "1 2 3\nnan 2 3\n1 2 inf\n4 5 6\n")
        entry = self.entry("in.xyz", "--drop-non-finite", "-o", "out.xyz", status=0)
        self.assertEqual(self.numbers("out.xyz"), [(1, 2, 3), (4, 5, 6)])
        self.assertEqual([w["code"] for w in entry["warnings"]], ["non-finite"])
        self.run_tool("in.xyz", "--drop-non-finite", "--map", "m.csv", "-o", "o.xyz", status=2)

    def test_las_of_other_systems_or_times_is_joined_only_when_asked(self):
        points = self.colored(9)
        self.write("a.las", las_file(points, records=system(b"zone 43"), count=1, epoch=True))
        self.write("b.las", las_file(points, records=system(b"zone 44"), count=1, epoch=True))
        self.write("c.las", las_file(points))
        for names, words in ((["a.las", "b.las"], "zone 43, zone 44"),
                             (["c.las", "b.las"], "none, zone 44"),
                             (["b.las", "c.las"], "zone 44, none")):
            for tiled in ([], ["--tile-points", 20]):
                run = self.run_tool(*names, "--join", *tiled, "-o", "out.las", status=3)
                self.assertIn(words, run.err)
                self.assertIn("--mixed", run.err)
            self.both(*names, "--join", "--mixed", out="all.las")
        self.write("d.las", las_file(points, records=system(b"zone 43"), count=1))
        self.assertIn("GPS time", self.run_tool("a.las", "d.las", "--join", "-o", "out.las",
                                                status=3).err)

    def test_joined_las_has_one_grid_that_holds_all(self):
        points = [(2 ** 31 - 1 - i, 0, 0, 1, 0, 0, 0) for i in range(60)]
        self.write("a.las", las_file(points, scale=1e-7))
        self.write("b.las", las_file(points, scale=1.5e-7, offset=(1000.0, 0.0, 0.0)))
        said = self.both("a.las", "b.las", "--join", out="out.las")
        self.assertIn("rounded to the scale of the LAS file", said[0])


if __name__ == "__main__":
    main()
