"""Meshes in PLY and STL that tf-weld welds in tiles on the disk: the bytes, maps and reports that
memory gives."""

from weld_support import *

import glob
import random
import signal

NAN = float("nan")
ORDERS = {"ascii": None, "binary_little_endian": "<", "binary_big_endian": ">"}
VERTEX = [("double", "x"), ("double", "y"), ("double", "z"), ("float", "nx"), ("uchar", "red"),
          ("int", "kind"), ("double", "range")]
FACE = [("list uchar int", "vertex_indices"), ("ushort", "material"), ("list uchar short", "flags"),
        ("float", "quality")]
EDGE = [("int", "vertex1"), ("int", "vertex2"), ("uchar", "crease")]
CODES = {"double": "d", "float": "f", "uchar": "B", "int": "i", "ushort": "H", "short": "h"}


def put(values, columns, order):
    """A row of text or bytes; the value of a list is a tuple."""
    parts = []
    for value, (kind, _) in zip(values, columns):
        words = kind.split()
        numbers = [(CODES[words[-1]], v) for v in (value if words[0] == "list" else (value,))]
        parts += [(CODES[words[1]], len(value))] + numbers if words[0] == "list" else numbers
    if order is None:
        return (" ".join(repr(v) for _, v in parts) + "\n").encode()
    return struct.pack(order + "".join(c for c, _ in parts), *(v for _, v in parts))


def ply_mesh(encoding, elements):
    head = f"ply\nformat {encoding} 1.0\ncomment by hand\n"
    body = b""
    for name, columns, rows in elements:
        head += f"element {name} {len(rows)}\n" + "".join(f"property {k} {n}\n" for k, n in columns)
        body += b"".join(put(row, columns, ORDERS[encoding]) for row in rows)
    return (head + "end_header\n").encode() + body


def grid(n, rng, jitter=0.0):
    """Points and faces of a wavy sheet: quads, and triangles."""
    points = [(i / n + jitter * rng.random(), j / n + jitter * rng.random(), (i * j % 5) / (20 * n))
              for i in range(n + 1) for j in range(n + 1)]
    at = lambda i, j: i * (n + 1) + j
    faces = []
    for i in range(n):
        for j in range(n):
            quad = (at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1))
            faces += [quad] if (i + j) % 3 else [quad[:3], (quad[0], *quad[2:])]
    return points, faces


def soup(points, faces, rng, jitter=0.0):
    """Each face with corners of its own."""
    cut, new = [], []
    for face in faces:
        new.append(tuple(range(len(cut), len(cut) + len(face))))
        cut += [tuple(x + jitter * rng.random() for x in points[p]) for p in face]
    return cut, new


def families(rng):
    points, faces = grid(9, rng)
    yield "grid", points, faces
    yield "soup", *soup(points, faces, rng)
    yield "loose soup", *soup(points, faces, rng, 0.01)
    shuffled = list(range(len(points)))
    rng.shuffle(shuffled)
    where = {p: i for i, p in enumerate(shuffled)}
    mixed = [tuple(where[p] for p in f) for f in faces]
    rng.shuffle(mixed)
    yield "shuffled", [points[p] for p in shuffled], mixed
    large = [tuple(rng.randrange(len(points)) for _ in range(rng.choice((3, 4, 5, 9, 60))))
             for _ in range(60)]
    yield "any polygons", points, large + faces + faces[:20] + [(3, 3, 4), (5, 5, 5, 5)]
    broken = [(NAN, 0.0, 1.0) if i % 7 == 0 else p for i, p in enumerate(points)]
    yield "broken", broken, faces
    fan = [(0.05 * rng.random(), 0.0, 0.0) for _ in range(200)]
    yield "crowd", fan, [tuple(rng.sample(range(200), 3)) for _ in range(300)]
    yield "no faces", points, []


def mesh(rng, encoding, points, faces, edges=True):
    rows = [(*p, rng.choice((0.0, 1.0)), rng.choice((7, 7, 7, 200)), rng.randrange(2),
             rng.choice((0.0, -0.0, 1.5, -2.0, NAN))) for p in points]
    faces = [(f, rng.randrange(9), tuple(range(rng.randrange(4))), rng.choice((0.25, NAN, -3.0)))
             for f in faces]
    lines = [(rng.randrange(-1, len(points)), rng.randrange(len(points)), rng.randrange(3))
             for _ in range(20)]
    behind = [("edge", EDGE, lines)] if edges else []
    return ply_mesh(encoding, [("vertex", VERTEX, rows), ("face", FACE, faces)] + behind)


def triangles(encoding, points, faces, edges):
    """Without lists but those of corners, which are alike if the faces are."""
    rows = [(*p, 0.0, 7, 0, 0.0) for p in points]
    return ply_mesh(encoding, [
        ("vertex", VERTEX, rows), ("face", FACE[:2], [(f, i % 9) for i, f in enumerate(faces)]),
        *([("edge", EDGE, edges)] if edges else [])])


def stl(points, faces, bits=0):
    rows = b"".join(struct.pack("<12fH", *(3 * [0.0]), *(x for p in f for x in points[p]),
                                bits * i % 7)
                    for i, f in enumerate(faces))
    return 80 * b" " + struct.pack("<I", len(faces)) + rows


OPTIONS = ([], ["--ignore-seams", "normal,color"], ["--ignore-seams", "normal", "--same", "kind"],
           ["--rule", "chain", "--ignore-seams", "color,normal"], ["--keep", "last"],
           ["--keep", "mean", "--ignore-seams", "normal,color"],
           ["--keep", "max:range", "--ignore-seams", "color"],
           ["--order", "range", "--ignore-seams", "normal,color"],
           ["--keep-degenerate", "--ignore-seams", "normal,color"],
           ["--same", "z=0.01", "--rule", "chain"])


class TilesOfMeshes(WeldTest):
    def setUp(self):
        super().setUp()
        self.rng = random.Random(21)

    def check(self, *command, size, out="out.ply",
              also=("--removed", "gone.ply", "--map", "map.csv")):
        """Whether all that the command writes is the same in memory and in tiles."""
        found = []
        for tiled in ([], ["--tile-points", size]):
            entry = self.entry(*command, "-o", out, *also, "-f", *tiled, status=0)
            self.assertEqual(entry["tiles"] is None, not tiled)
            entry["tiles"] = 0
            # Shapes of faces are looked at in memory alone.
            entry["warnings"] = [w for w in entry["warnings"] if w["code"] != "concave-faces"]
            found.append([entry] + [self.read_bytes(n) for n in (out, *also[1::2])])
            for name in (out, *also[1::2]):
                os.remove(self.path(name))
        self.assertEqual(*(str(f[0]) for f in found))  # NaN differs from itself
        for memory, tiles in zip(found[0][1:], found[1][1:]):
            self.assertTrue(memory == tiles, msg=f"bytes differ: {command}")
        self.assertFalse(any("tiles" in n for n in self.listing()))
        return found[1][0]

    def test_all_options_give_the_bytes_that_memory_gives(self):
        options = list(OPTIONS)
        collapsed = 0
        for name, points, faces in families(self.rng):
            encoding = self.rng.choice(list(ORDERS))
            self.write("in.ply", mesh(self.rng, encoding, points, faces))
            self.rng.shuffle(options)
            for which in options[:6]:
                tolerance, size = self.rng.choice((("0", 40), ("0.02", 60), ("0.15", 30),
                                                   ("5%", 200)))
                with self.subTest(family=name, encoding=encoding, which=which, t=tolerance):
                    entry = self.check("in.ply", "-t", tolerance, *which, size=size)
                    collapsed += entry["faces"]["collapsed"]
                    self.assertEqual(entry["polygons"]["in"], len(faces))
        self.assertGreater(collapsed, 1000)

    def test_outputs_of_other_encodings_and_labels_are_those_of_memory(self):
        points, faces = soup(*grid(7, self.rng), self.rng)
        across = ["--ignore-seams", "normal,color"]
        for encoding in ORDERS:
            self.write("in.ply", mesh(self.rng, encoding, points, faces))
            self.check("in.ply", "-t", "0.01", *across, "--order", "max:range", out="out.obj",
                       size=50)
            for which in (["--ascii"], ["--binary"], ["--label", "group"]):
                also = ("--map", "map.bin") if "--label" in which else ("--removed", "gone.csv")
                self.check("in.ply", "-t", "0.01", *across, *which, size=50, also=also)

    def test_stl_is_indexed_as_in_memory(self):
        points, faces = grid(9, self.rng)
        points[4] = (NAN, 0.0, 0.0)
        points[15] = (-0.0, *points[15][1:])
        faces = [f[:3] for f in faces] + [(7, 7, 8), (8, 9, 8),
                                          (4, 4, 5)] + [f[:3] for f in faces[:9]]
        where, corners = soup(points, faces, self.rng)
        where[where.index((0.0, 0.0, 0.0))] = (-0.0, 0.0, -0.0)
        for bits in (0, 1):
            self.write("in.stl", stl(where, corners, bits))
            for which in (["-t", "0"], ["-t", "0.05", "--rule", "chain"],
                          ["-t", "0", "--order", "z"],
                          ["-t", "0", "--keep-degenerate"],
                          ["-t", "3%", "--rule", "chain", "--same", "x"],
                          ["-t", "9", "--rule", "chain"]):
                for out in ("out.ply", "out.obj"):
                    entry = self.check("in.stl", *which, size=60, out=out)
                    self.assertEqual(entry["faces"]["degenerate"], 4)
                    self.assertGreater(entry["nonmanifold_edges"]["before"], 0)
            self.assertEqual(b"stl_attribute" in self.made("in.stl"), bits == 1)
        self.write("in.stl", stl(where, corners) + b"more")
        self.check("in.stl", size=60)
        self.write("in.stl", stl(where, corners)[:-7])
        said = [self.run_tool("in.stl", "-o", "out.ply", *tiled, status=3).err
                for tiled in ([], ["--tile-points", 10])]
        self.assertEqual(*(text.splitlines()[-1] for text in said))
        self.assertEqual(self.listing(), ["in.stl"])

    def made(self, name):
        self.run_tool(name, "-o", "made.ply", "--tile-points", 60, status=0)
        made = self.read_bytes("made.ply")
        os.remove(self.path("made.ply"))
        return made

    def test_counts_without_output_are_those_of_memory(self):
        points, faces = soup(*grid(6, self.rng), self.rng)
        self.write("in.ply", mesh(self.rng, "ascii", points, faces, edges=False))
        for tolerance, status in (("0", 1), ("0.2", 1)):
            command = ["in.ply", "-t", tolerance, "--ignore-seams", "normal,color", "--check"]
            said = [self.run_tool(*command, *tiled, status=status).out
                    for tiled in ([], ["--tile-points", 20])]
            self.assertEqual(*said)
            self.assertIn(b"triangles kept", said[0])

    def test_edges_of_many_faces_and_faces_turned_over_are_counted(self):
        points = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0)] + [(0.5, 1.0, k / 4) for k in range(5)]
        points += [(0.5, 0.01, 3.0), (0.5, -0.01, 3.0), (0.5, 0.02, 3.0), (0.5, 0.03, 3.0)]
        faces = [(0, 1, 2 + k) for k in range(5)] + [(0, 7, 8)] + [(9, 8, 1), (10, 7, 1)]
        rows = [(*p, 0.0, 7, 0, 0.0) for p in points]
        self.write("in.ply", ply_mesh("ascii", [
            ("vertex", VERTEX, rows), ("face", FACE[:1], [(f,) for f in faces])]))
        entry = self.check("in.ply", "-t", "0.03", "--keep", "last", size=2)
        self.assertEqual(entry["nonmanifold_edges"]["before"], 1)
        self.check("in.ply", "-t", "0.3", size=2)

    def test_faces_of_fewer_than_three_corners_are_left_out_as_in_memory(self):
        points, faces = grid(5, self.rng)
        rows = [(*p, 0.0, 7, 0, 0.0) for p in points]
        short = faces[:4] + [(0, 1)] + faces[4:] + [(), (3,)]
        for encoding in ORDERS:
            self.write("in.ply", ply_mesh(encoding, [
                ("vertex", VERTEX, rows), ("face", FACE[:1], [(f,) for f in short])]))
            for which in ([], ["-t", "0.3"], ["--label", "group"]):
                removed = () if "--label" in which else ("--removed", "gone.ply")
                entry = self.check("in.ply", *which, size=2, also=(*removed, "--map", "map.csv"))
                self.assertIn("short-faces", [w["code"] for w in entry["warnings"]])
                self.assertEqual(entry["polygons"]["in"], len(faces))

    def test_a_damaged_face_ends_before_the_work_with_nothing_left(self):
        points, faces = grid(5, self.rng)
        for face, words in (((0, 1, 36), "vertex index 36 is out of range"),
                            ((0, -1, 2), "vertex index -1 is out of range")):
            for encoding in ORDERS:
                rows = [(*p, 0.0, 7, 0, 0.0) for p in points]
                self.write("in.ply", ply_mesh(encoding, [
                    ("vertex", VERTEX, rows), ("face", FACE[:1], [(f,) for f in faces + [face]])]))
                said = [self.run_tool("in.ply", "-o", "out.ply", *tiled, status=3).err
                        for tiled in ([], ["--tile-points", 10])]
                self.assertEqual(*said)
                self.assertIn(words, said[0])
                self.assertEqual(self.listing(), ["in.ply"])
        whole = mesh(self.rng, "binary_little_endian", points, faces)
        self.write("in.ply", whole[:-50])
        said = [self.run_tool("in.ply", "-o", "out.ply", *tiled, status=3).err
                for tiled in ([], ["--tile-points", 10])]
        self.assertEqual(*said)
        self.write("in.ply", whole + b"more")
        entry = self.check("in.ply", size=10)
        self.assertIn("trailing-bytes", [w["code"] for w in entry["warnings"]])

    def test_what_tiles_cannot_do_says_so(self):
        points, faces = grid(5, self.rng)
        self.write("in.ply", mesh(self.rng, "ascii", points, faces))
        self.write("in.stl", stl(*soup(points, [f[:3] for f in faces], self.rng)))
        for name, option in (("in.ply", ["-o", "out.off"]),
                             ("in.ply", ["--keep-manifold", "-o", "out.ply"]),
                             ("in.ply", ["--borders", "-o", "out.ply"]),
                             ("in.ply", ["--precision", "float", "-o", "out.ply"]),
                             ("in.ply", ["--keep", "mean", "-o", "out.obj"]),
                             ("in.stl", ["-t", "0.1", "-o", "out.ply"]),
                             ("in.stl", ["--keep", "last", "-o", "out.ply"]),
                             ("in.stl", ["--label", "group", "-o", "out.ply"])):
            entry = self.entry(name, *option, "-f", "--tile-points", 10, status=0)
            self.assertIsNone(entry["tiles"])
            said = [w["text"] for w in entry["warnings"] if w["code"] == "in-memory"]
            self.assertIn("needs the whole mesh in memory", said[0])
        self.run_tool("in.ply", "--plan", "--work", "tiles", "--keep-manifold", status=2)

    def test_processes_that_share_tiles_give_what_one_gives(self):
        points, faces = soup(*grid(8, self.rng), self.rng, 0.005)
        self.write("in.ply", mesh(self.rng, "binary_little_endian", points, faces))
        options = ["-t", "0.02", "--ignore-seams", "normal,color", "--work", "tiles"]
        self.run_tool("in.ply", *options, "--plan", "--tile-points", 60, status=0)
        for tile in range(99):
            if self.run_tool("in.ply", *options, "--tile", tile).status != 0:
                break
        self.assertGreater(tile, 2)
        self.run_tool("in.ply", *options, "--finish", "-o", "out.ply", "--map", "a.csv", status=0)
        self.run_tool("in.ply", *options[:4], "-o", "memory.ply", "--map", "b.csv", status=0)
        self.assertEqual(self.read_bytes("out.ply"), self.read_bytes("memory.ply"))
        self.assertEqual(self.read("a.csv"), self.read("b.csv"))

    def test_killed_work_goes_on_and_gives_the_same(self):
        points, faces = soup(*grid(14, self.rng), self.rng, 0.002)
        self.write("in.ply", mesh(self.rng, "binary_little_endian", points, faces))
        for which in ([], ["--keep", "mean"], ["--order", "range"]):
            options = ["in.ply", "-t", "0.02", "--ignore-seams", "normal,color", *which]
            self.run_tool(*options, "-o", "memory.ply", "-f", status=0)
            command = [*options, "--tile-points", 200, "-o", "out.ply", "-j1"]
            for step in range(1, 200):
                run = self.run_tool(*command, "--stop-at", step)
                if run.status == 0:
                    break
                self.assertEqual(run.status, -signal.SIGKILL)
                self.assertNotIn("out.ply", self.listing())
                self.run_tool(*command, status=0)
                self.assertEqual(self.read_bytes("out.ply"), self.read_bytes("memory.ply"))
                os.remove(self.path("out.ply"))
                self.assertEqual(self.listing(), ["in.ply", "memory.ply"])
            self.assertGreater(step, 7)
            os.remove(self.path("out.ply"))

    def written(self, *names):
        found = {name: self.read_bytes(name) for name in names}
        for name in names:
            os.remove(self.path(name))
        return found

    @unittest.skipIf(NO_MPI, NO_MPI)
    def test_ranks_of_mpi_give_what_one_gives(self):
        points, faces = soup(*grid(7, self.rng), self.rng, 0.005)
        for encoding in ORDERS:
            self.write(encoding + ".ply", mesh(self.rng, encoding, points, faces))
        small, big, text = (encoding + ".ply" for encoding in
                            ("binary_little_endian", "binary_big_endian", "ascii"))
        self.write("few.ply", mesh(self.rng, "ascii", points[:4], [(0, 1, 2), (1, 2, 3)]))
        alike = [f[:3] for f in faces] + [faces[3][:3]] * 2 + [(4, 4, 5)]
        self.write("alike.ply", triangles("binary_big_endian", points, alike,
                                          [(i, 2 * i, i % 3) for i in range(90)]))
        self.write("ends.ply", self.read_bytes("alike.ply") + b"more")
        self.write("in.stl", stl(*soup(points[:99], [f[:3] for f in faces if max(f) < 99] +
                                       [(7, 7, 8), (8, 9, 8)], self.rng)))
        across = ["--ignore-seams", "normal,color"]
        gone = ["--removed", "gone.ply", "--map", "map.csv"]
        inputs = self.listing()
        for sizes, name, options, out in (
                ((2, 3, 7), small, ["-t", "0.02", *across, *gone], "out.ply"),
                ((3,), text, ["-t", "0.15", "--rule", "chain", "--same", "kind", *gone], "out.ply"),
                ((2,), big, ["-t", "0.02", "--keep", "mean", *across, *gone], "out.ply"),
                ((3,), small, ["-t", "0.02", "--keep", "max:range", *gone], "out.ply"),
                ((3,), small, ["-t", "0.02", "--order", "range", "--label", "group", "--map",
                               "map.csv"], "out.ply"),
                ((4,), small, ["-t", "0.15", "--order", "x", "--keep-degenerate", *gone],
                 "out.obj"),
                ((7,), "few.ply", ["-t", "9", *gone], "out.ply"),
                ((2, 4, 7), "alike.ply", ["-t", "0.02", *gone], "out.ply"),
                ((3,), "alike.ply", ["-t", "0.02", "--keep", "mean", "--ascii"], "out.ply"),
                ((4,), "alike.ply", ["-t", "0.15", "--rule", "chain", *gone], "out.obj"),
                ((3,), "alike.ply", ["-t", "0.02", "--label", "group", "--map", "map.csv"],
                 "out.ply"),
                ((4,), "ends.ply", ["-t", "0.02", *gone], "out.ply"),
                ((2, 4), "in.stl", ["--removed", "gone.csv"], "out.ply"),
                ((3,), "in.stl", ["-t", "0.1", "--rule", "chain", *gone], "out.obj")):
            command = [name, *options, "-o", out, "--tile-points", 30]
            names = [out, *(o for o in options if o.endswith((".ply", ".csv")))]
            report = self.entry(*command, status=0)
            expected = self.written(*names)
            for size in sizes:
                with self.subTest(options=options, size=size):
                    entry = json.loads(self.mpi(size, *command, "-r", "-").text)["files"][0]
                    self.assertTrue(self.written(*names) == expected)
                    self.assertGreater(entry["tiles"]["count"], 0)
                    entry["tiles"] = report["tiles"] = 0
                    self.assertEqual(str(entry), str(report))  # NaN differs from itself
                    self.assertEqual(self.listing(), inputs)
        command = [small, "-t", "0.02", "-o", "-", "--output-format", "ply", "--removed",
                   "gone.ply",
                   "--tile-points", 60]
        alone = self.run_tool(*command, status=0).out
        expected = self.written("gone.ply")
        self.assertTrue(self.mpi(3, *command).out == alone)
        self.assertEqual(self.written("gone.ply"), expected)

    @unittest.skipIf(NO_MPI, NO_MPI)
    def test_what_ranks_cannot_do_is_said_once_and_nothing_is_written(self):
        points, faces = grid(5, self.rng)
        self.write("in.ply", mesh(self.rng, "ascii", points, faces))
        self.write("in.stl", stl(*soup(points, [f[:3] for f in faces], self.rng)))
        rows = [(*p, 0.0, 7, 0, 0.0) for p in points]
        self.write("far.ply", ply_mesh("binary_little_endian", [
            ("vertex", VERTEX, rows), ("face", FACE[:1], [(f,) for f in faces + [(0, 1, 36)]])]))
        self.write("cut.ply", self.read_bytes("far.ply")[:-9])
        self.write("cube.obj", obj_bytes(cube()))
        inputs = self.listing()
        for size, name, options, status, words in (
                (3, "far.ply", ["-o", "out.ply"], 3, "vertex index 36 is out of range"),
                (3, "cut.ply", ["-o", "out.ply", "--removed", "gone.ply"], 3, "cut.ply"),
                (2, "in.ply", ["-o", "out.off"], 2, "format off of a mesh needs the whole mesh"),
                (3, "in.ply", ["--keep-manifold", "-o", "out.ply", "--tile-points", 9], 2,
                 "--keep-manifold needs the whole mesh"),
                (2, "in.stl", ["-t", "0.1", "-o", "out.ply"], 2, "needs the whole mesh"),
                (2, "cube.obj", ["-o", "out.ply", "--tile-points", 9], 3,
                 "welded by one process, in memory")):
            run = self.mpi(size, name, *options, status=status)
            self.assertEqual(run.err.count(words), 1, msg=run.err)
            self.assertEqual(self.listing(), inputs)
        middle = [*faces, (0, 36, 1), *faces, (0, 1), (0, 1, 37), *faces]
        alike = [f[:3] for f in middle if len(f) > 2]
        self.write("mixed.ply", ply_mesh("binary_little_endian", [
            ("vertex", VERTEX, rows), ("face", FACE[:1], [(f,) for f in middle])]))
        self.write("middle.ply", triangles("binary_little_endian", points, alike, []))
        self.write("text.ply", triangles("ascii", points, alike, []))
        for name in ("far.ply", "two.ply", "cut.ply", "mixed.ply", "middle.ply", "text.ply"):
            said = self.run_tool(name, "-o", "out.ply", "--tile-points", 9, status=3).err
            last = said.splitlines()[-1]
            for size in (2, 4):
                self.assertIn(last, self.mpi(size, name, "-o", "out.ply", status=3).err)
        self.write("in.ply", self.read_bytes("in.ply") + b"1 2 3\n")
        said = [w["code"] for w in self.entry("in.ply", "-o", "out.ply", status=0)["warnings"]]
        run = self.mpi(3, "in.ply", "-o", "out.ply", "-f", "-r", "-")
        self.assertEqual([w["code"] for w in json.loads(run.text)["files"][0]["warnings"]], said)
        self.assertIn("trailing-bytes", said)

    @unittest.skipIf(NO_MPI, NO_MPI)
    def test_a_rank_that_is_killed_ends_the_run_and_any_number_goes_on(self):
        points, faces = soup(*grid(9, self.rng), self.rng, 0.002)
        self.write("in.ply", mesh(self.rng, "binary_little_endian", points, faces))
        self.write("alike.ply", triangles("binary_little_endian", points, [f[:3] for f in faces],
                                          []))
        for size, which, each in ((2, ["in.ply", "--ignore-seams", "normal,color"], 1),
                                  (3, ["in.ply", "--keep", "mean"], 1), (4, ["alike.ply"], 4)):
            command = ["-t", "0.02", *which, "--tile-points", 150, "-o", "out.ply",
                       "--removed", "gone.ply", "--work", "tiles"]
            self.run_tool(*command, status=0)
            expected = self.written("out.ply", "gone.ply")
            for step in range(1, 100, each):
                run = self.mpi(size, *command, status=None, last=["--stop-at", step])
                if run.status == 0:
                    break
                self.assertEqual(run.status, 128 + signal.SIGKILL)
                self.assertEqual(self.listing(), ["alike.ply", "in.ply", "tiles"])
                self.mpi(self.rng.choice((1, 2, 4)), *command)
                self.assertEqual(self.written("out.ply", "gone.ply"), expected)
            self.assertGreater(step, 5)
            self.written("out.ply", "gone.ply")

    def test_a_broken_file_is_said_to_be_broken_and_nothing_else(self):
        head = b"ply\nformat binary_little_endian 1.0\nelement vertex 8\nproperty float x\n"
        self.write("head.ply", head + b"property \0\0\n" + bytes(3 << 20))
        self.write("cut.ply", head + b"property float y\nproperty float z\nend_header\n"
                   + bytes(50))
        self.write("in.csv", "x,y,z\n" + "1,2,3\n" * 300000 + "1,2\n" + "1,2,3\n" * 300)
        for name, words in (("head.ply", "head.ply:5: "), ("cut.ply", "cut.ply: byte "),
                            ("in.csv", "in.csv:300002: ")):
            whole = self.run_tool(name, "-o", "out.ply", status=3).err
            self.assertIn(words, whole)
            for more in (["--tile-points", 3], ["--memory", "64M"]):
                self.assertEqual(self.run_tool(name, "-o", "out.ply", *more, status=3).err, whole)
        self.assertEqual(self.listing(), ["cut.ply", "head.ply", "in.csv"])

    @unittest.skipIf(NO_MPI or SANITIZED, "ranks of the tool itself, by MPI")
    def test_no_rank_reads_or_writes_much_more_than_its_share(self):
        n = 250  # 125,000 triangles
        points, faces = grid(n, self.rng)
        polygons = faces
        faces = [t for f in faces for t in ((f[:3], (f[0], *f[2:])) if len(f) > 3 else (f,))]
        self.write("alike.ply", triangles("binary_little_endian", points, faces, []))
        self.write("mixed.ply", triangles("binary_little_endian", points, polygons, []))
        where, corners = soup(points, faces, self.rng)
        self.write("in.stl", stl(where, corners))
        mine = "%s \"$@\"; s=$?; cat /proc/$$/io > $OMPI_COMM_WORLD_RANK.io; exit $s" % WELD
        for name in ("alike.ply", "mixed.ply", "in.stl"):
            for out in ("out.ply", "out.obj"):
                ranks = []
                for size in (1, 4):
                    subprocess.run([MPIRUN, "--oversubscribe", "--allow-run-as-root", "-n",
                                    str(size), "sh",
                                    "-c", mine, "sh", name, "-t", "0.001", "--rule", "chain", "-o",
                                    out, "-f",
                                    "--tile-points", "8000", "-j1"],
                                   cwd=self.folder, check=True, capture_output=True, timeout=300)
                    ranks.append([dict(line.split(": ")
                                       for line in self.read(f"{r}.io").splitlines())
                                  for r in range(size)])
                for what in ("rchar", "wchar"):
                    one, *several = (int(r[what]) for some in ranks for r in some)
                    with self.subTest(name=name, out=out, what=what):
                        self.assertGreater(one, 5_000_000)
                        self.assertLess(max(several), 1.5 * sum(several) / 4)

    @unittest.skipIf(SANITIZED, "shadow memory is no memory of the tool")
    def test_meshes_larger_than_the_memory_stay_within_it(self):
        n = 600
        # this process stays small: others begin as it
        with open(self.path("in.ply"), "wb") as file:
            file.write(b"ply\nformat binary_little_endian 1.0\nelement vertex %d\n"
                       b"property float x\nproperty float y\nproperty float z\nelement face %d\n"
                       b"property list uchar int vertex_indices\nend_header\n" % (4 * n * n, n * n))
            for i in range(n):
                for j in range(n):
                    file.write(struct.pack("<12f", i, j, 0, i + 1, j, 0, i + 1, j + 1, 0, i, j + 1,
                                           0))
            for f in range(n * n):
                file.write(struct.pack("<B4i", 4, *range(4 * f, 4 * f + 4)))
        self.run_tool("in.ply", "-o", "memory.ply", status=0)
        report = self.report("in.ply", "-o", "out.ply", "--memory", "56M", status=0)
        self.assertGreater(report["files"][0]["tiles"]["count"], 1)
        self.assertLess(report["peak_rss"], 56 << 20)
        self.assertEqual(report["files"][0]["points"]["out"], (n + 1) ** 2)
        self.assertEqual(self.read_bytes("out.ply"), self.read_bytes("memory.ply"))

    @unittest.skipUnless(MODELS, "needs TREEFORM_MODELS_DIR")
    def test_models_are_welded_as_in_memory(self):
        paths = sorted(glob.glob(os.path.join(MODELS, "*", "*.ply")))
        paths = [p for p in paths if os.path.getsize(p) < 3e6][:40]
        self.assertGreater(len(paths), 3)
        tiled = 0
        for path in paths:
            for tolerance in ("0", "0.5%"):
                command = [path, "-t", tolerance]
                run = self.run_tool(*command, "-o", "memory.ply", "-f")
                with self.subTest(path=path, t=tolerance):
                    if run.status != 0:
                        self.run_tool(*command, "-o", "out.ply", "-f", "--tile-points", 3000,
                                      status=run.status)
                        continue
                    entry = self.entry(*command, "-o", "out.ply", "-f", "--tile-points", 3000,
                                       status=0)
                    tiled += entry["tiles"] is not None
                    self.assertEqual(self.read_bytes("out.ply"), self.read_bytes("memory.ply"))
        self.assertGreater(tiled, 5)


if __name__ == "__main__":
    main()
