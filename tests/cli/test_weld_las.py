"""LAS and LAZ through tf-weld: what comes in comes out, and decisions hold for what is written."""

from weld_support import *

FIELDS = struct.Struct("<iiiHBBbBH")  # a record of format 0


def las_file(points, scale=0.01, offset=0.0, extra=b""):
    """LAS 1.2, format 0. A point is X, Y, Z in steps, and its intensity."""
    header = bytearray(227)
    header[0:4] = b"LASF"
    header[24:26] = bytes((1, 2))
    struct.pack_into("<HIIBHI", header, 94, 227, 227 + len(extra), 1 if extra else 0, 0, 20,
                     len(points))
    struct.pack_into("<6d", header, 131, *[scale] * 3, *[offset] * 3)
    return bytes(header) + extra + b"".join(
        FIELDS.pack(*p[:3], p[3], 0x09, 2, 0, 0, 7) for p in points)


def las_points(data):
    first, = struct.unpack_from("<I", data, 96)
    count, = struct.unpack_from("<I", data, 107)
    return [FIELDS.unpack_from(data, first + 20 * i)[:4] for i in range(count)]


POINTS = [(0, 0, 0, 5), (100, 0, 0, 9), (100, 30, 0, 3), (-5000, 1, 1, 4), (0, 0, 0, 8)]


class Las(WeldTest):
    def setUp(self):
        super().setUp()
        record = struct.pack("<H16sHH32s", 0, b"LASF_Projection", 2112, 4, b"") + b"abcd"
        self.write("in.las", las_file(POINTS, extra=record))

    def test_records_that_stay_are_as_they_were(self):
        entry = self.entry("in.las", "-t", "0.3", "-o", "out.las", "--removed", "gone.las",
                           status=0)
        data = self.read_bytes("out.las")
        self.assertEqual(las_points(data), [POINTS[0], POINTS[1], POINTS[3]])
        self.assertEqual(las_points(self.read_bytes("gone.las")), [POINTS[2], POINTS[4]])
        self.assertEqual(data[227:227 + 58], self.read_bytes("in.las")[227:227 + 58])
        self.assertEqual(struct.unpack_from("<dd", data, 179), (100 * 0.01, -5000 * 0.01))
        self.assertEqual((entry["format"], entry["output"]["format"]), ("las", "las"))
        self.assertEqual(entry["output"]["within_tolerance"], 0)
        self.assertEqual(entry["warnings"], [])

    def test_packed_and_back_it_is_the_same(self):
        self.run_tool("in.las", "-t", "0.3", "-o", "out.las", status=0)
        self.run_tool("in.las", "-o", "all.laz", "--rule", "chain", "-t", "0", status=0)
        self.run_tool("all.laz", "-t", "0.3", "-o", "again.las", status=0)
        self.assertEqual(self.read_bytes("again.las"), self.read_bytes("out.las"))

    def test_a_label_becomes_extra_bytes(self):
        self.run_tool("in.las", "-t", "0.3", "--label", "group", "-o", "out.las", status=0)
        data = self.read_bytes("out.las")
        self.assertEqual(struct.unpack_from("<H", data, 105)[0], 24)
        self.assertIn(b"group", data)
        self.run_tool("out.las", "-o", "out.csv", status=0)
        self.assertTrue(self.read("out.csv").splitlines()[0].endswith(",group"))

    def test_another_scale_is_rounded_before_anything_is_decided(self):
        # 0.304 becomes 0.30, which is within 0.3 of the point at the origin.
        self.write("a.las", las_file([(0, 0, 0, 1)]))
        self.write("b.las", las_file([(304, 0, 0, 2)], scale=0.001))
        entry = self.entry("a.las", "b.las", "--join", "-t", "0.3", "-o", "out.las",
                           "--las-scale", "0.01", status=0)
        self.assertEqual(entry["points"]["out"], 1)
        self.assertEqual([w["code"] for w in entry["warnings"]], ["las-grid"])
        entry = self.entry("a.las", "b.las", "--join", "-t", "0.3", "-o", "out.ply", status=0)
        self.assertEqual((entry["points"]["out"], entry["warnings"]), (2, []))

    def test_joined_files_get_the_finest_scale_of_theirs(self):
        self.write("a.las", las_file([(0, 0, 0, 1)]))
        self.write("b.las", las_file([(304, 0, 0, 2)], scale=0.001))
        entry = self.entry("a.las", "b.las", "--join", "-t", "0.3", "-o", "out.las", status=0)
        self.assertEqual((entry["points"]["out"], entry["warnings"]), (2, []))
        self.assertEqual(struct.unpack_from("<d", self.read_bytes("out.las"), 131), (0.001,))

    def test_withheld_points_stay_with_a_flag(self):
        entry = self.entry("in.las", "-t", "0.3", "--withhold", "-o", "out.las", status=0)
        data = self.read_bytes("out.las")
        self.assertEqual(las_points(data), POINTS)
        first, = struct.unpack_from("<I", data, 96)
        classes = [data[first + 20 * i + 15] for i in range(5)]
        self.assertEqual(classes, [2, 2, 2 | 0x80, 2, 2 | 0x80])
        self.assertEqual((entry["points"]["out"], entry["points"]["removed"]), (5, 0))
        self.assertEqual((entry["withheld"], entry["label"]), (2, None))
        self.assertIsNone(entry["output"]["within_tolerance"])
        # Flags that were there stay; all else of the records is the same.
        self.run_tool("out.las", "-t", "0", "--withhold", "-o", "again.laz", status=0)
        self.run_tool("again.laz", "-o", "again.csv", "--same", "x,intensity", status=0)
        rows = [line.split(",") for line in self.read("again.csv").splitlines()]
        flags = [row[rows[0].index("withheld")] for row in rows[1:]]
        self.assertEqual(flags, ["0", "0", "1", "0", "1"])
        # With an order, the brighter of two stays.
        self.run_tool("in.las", "-t", "0.3", "--withhold", "--order", "max:intensity", "-o",
                      "bright.las", status=0)
        data = self.read_bytes("bright.las")
        self.assertEqual([data[first + 20 * i + 15] >> 7 for i in range(5)], [1, 0, 1, 0, 0])

    def test_points_of_another_format_are_withheld_too(self):
        self.write("in.csv", "x,y,z\n0,0,0\n0,0,0\n1,0,0\n")
        self.run_tool("in.csv", "--withhold", "-o", "out.las", status=0)
        self.run_tool("out.las", "-t", "0", "--label", "g", "-o", "out.csv", status=0)
        rows = [line.split(",") for line in self.read("out.csv").splitlines()]
        self.assertEqual([row[rows[0].index("withheld")] for row in rows[1:]], ["0", "1", "0"])

    def test_withhold_is_refused_where_it_means_nothing(self):
        for more in (["-o", "out.ply"], ["-o", "out.las", "--label", "g"], ["--check"],
                     ["-o", "out.las", "--removed", "gone.las"],
                     ["-o", "out.las", "--keep", "mean"]):
            run = self.run_tool("in.las", "--withhold", *more, status=2)
            self.assertIn("withhold", run.err)
        self.assertEqual(self.listing(), ["in.las"])

    def test_means_are_checked_as_they_are_written(self):
        entry = self.entry("in.las", "-t", "0.3", "--keep", "mean", "-o", "out.las", status=0)
        self.assertEqual(len(las_points(self.read_bytes("out.las"))), 3)
        self.assertIsNotNone(entry["output"]["within_tolerance"])

    def test_dropped_points_get_steps_of_their_own_in_tiles_as_in_memory(self):
        rows = "".join(f"{i / 8},{i % 7 * 1e-5},{1e6 + i / 64},{200 if i > 30 else 2}\n"
                       for i in range(50))
        self.write("in.csv", ("x,y,z,classification\n" + rows).encode())
        self.write("in.xyz", "".join(f"{i} 0 {i / 3}\n" for i in range(50)).encode())
        for name in ("in.csv", "in.xyz"):
            for t, keep in (("1", "first"), ("0.3", "last"), ("2", "mean"), ("0.01", "first")):
                for end in ("las", "laz"):
                    work = [name, "-t", t, "--keep", keep, "-f"]
                    self.run_tool(*work, "-o", "a.ply", "--removed", "a." + end, status=0)
                    self.run_tool(*work, "-o", "b.ply", "--removed", "b." + end, "--tile-points",
                                  10, status=0)
                    self.assertEqual(self.read_bytes("a." + end), self.read_bytes("b." + end))
                    self.assertEqual(self.read_bytes("a.ply"), self.read_bytes("b.ply"))

    def test_what_tiles_make_of_las_is_what_memory_makes(self):
        self.write("in.xyz", "".join(f"{i} 0 0\n" for i in range(50)).encode())
        self.run_tool("in.xyz", "-t", "1", "-o", "out.las", status=0)
        self.run_tool("out.las", "-t", "2", "--tile-points", "10", "-o", "tiles.las", status=0)
        self.run_tool("out.las", "-t", "2", "-o", "whole.las", status=0)
        self.assertEqual(self.read_bytes("tiles.las"), self.read_bytes("whole.las"))

    def test_damaged_files_end_with_the_byte_and_the_reason(self):
        whole = self.read_bytes("in.las")
        self.write("cut.las", whole[:-1])
        run = self.run_tool("cut.las", "-o", "x.las", status=3)
        self.assertIn("cut.las: byte 285: the file ends within the points: 5 announced, 4 found",
                      run.err)
        self.write("a.e57", b"ASTM-E57" + bytes(100))
        self.assertIn("pdal translate", self.run_tool("a.e57", "-o", "x.las", status=3).err)


if __name__ == "__main__":
    main()
