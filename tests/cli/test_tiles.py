"""Meshes searched in tiles on the disk: the answers that memory gives, also after being killed."""

from support import *

import hashlib
import random
import re
import signal

# What is told of the way to the answer, not of the answer.
WAY = ("work", "seconds", "warnings", "tiles")


def heap(count, seed=1):
    """Boxes that overlap, touch and repeat, and single triangles among them."""
    rng = random.Random(seed)
    parts = [cube([rng.randrange(40) / 4 for _ in range(3)], rng.choice((0.5, 1, 2)))
             for _ in range(count)]
    for _ in range(2 * count):
        at = [rng.random() * 10 for _ in range(3)]
        parts.append(([tuple(x + rng.random() for x in at) for _ in range(3)], [(0, 1, 2)]))
    return together(*parts)


def ply_bytes(mesh, number="float"):
    points, faces = mesh
    head = ("ply\nformat binary_little_endian 1.0\nelement vertex %d\nproperty %s x\n"
            "property %s y\nproperty %s z\nelement face %d\n"
            "property list uchar int vertex_indices\nend_header\n")
    code = {"float": "<3f", "double": "<3d"}[number]
    return ((head % (len(points), number, number, number, len(faces))).encode() +
            b"".join(struct.pack(code, *p) for p in points) +
            b"".join(struct.pack("<B3i", 3, *f) for f in faces))


def ply_lines(mesh):
    """As text, with rows ahead of the points, between, and behind; and a polygon here and there."""
    points, faces = mesh
    rows = [" ".join(map(repr, p)) for p in points]
    polygons = ["%d %s" % (3 + i % 2, " ".join(map(str, (*f, f[0])[:3 + i % 2])))
                for i, f in enumerate(faces)]
    edges = [f"{i} {i + 1}" for i in range(9)]
    head = ["ply", "format ascii 1.0", "element camera 2", "property float view",
            f"element vertex {len(rows)}", *(f"property double {axis}" for axis in "xyz"),
            f"element edge {len(edges)}", "property int vertex1", "property int vertex2",
            f"element face {len(polygons)}", "property list uchar int vertex_indices",
            "element note 2", "property list uchar int text", "end_header"]
    return head + ["1", "", "0.5", *rows, *edges, *polygons[:9], " \t ", *polygons[9:], "0",
                   "2 1 1"]


def polygon_rows(faces, rng):
    """Those of a binary PLY: of several lengths, with a list and a number beside the corners."""
    for f in faces:
        corners = (*f, *rng.choices(f, k=rng.choice((0, 0, 1, 4))))
        marks = [rng.random() for _ in range(rng.randrange(3))]
        yield struct.pack(f"<B{len(corners)}iB{len(marks)}fh", len(corners), *corners, len(marks),
                          *marks,
                          rng.randrange(99))


def answers(report):
    file = dict(report["files"][0])
    for key in WAY:
        file.pop(key, None)
    file["vertices"] = file["vertices"]["stored"]  # how many are distinct takes the whole mesh
    for region in file["regions"]:
        region.pop("components")  # likewise
    return file


def segments(text):
    """Of curves as OBJ: the ends of each, in no order."""
    points, found = [], []
    for line in text.decode().splitlines():
        word, *rest = line.split() or [""]
        if word == "v":
            points.append(tuple(rest))
        elif word == "l":
            at = [points[int(i) - 1] for i in rest]
            found += [tuple(sorted(ends)) for ends in zip(at, at[1:])]
    return sorted(found)


class Tiles(ToolTest):
    def look(self, name, *arguments):
        """Report, pairs and curves. Where corners are joined by their coordinates, the order of
        the curves may be another one."""
        report = self.report(name, "--pairs", "pairs.csv", "--curves", "curves.obj", "-f",
                             *arguments)
        curves = self.read_bytes("curves.obj")
        if name.endswith(".stl") or "equal" in arguments:
            curves = segments(curves)
        return answers(report), self.read_bytes("pairs.csv"), curves

    def put_all(self, mesh):
        with open(self.path("in.stl"), "wb") as file:
            file.write(stl_bytes(mesh))
        for number in ("float", "double"):
            with open(self.path(number + ".ply"), "wb") as file:
                file.write(ply_bytes(mesh, number))
        return ("in.stl", "float.ply", "double.ply")

    def put_lines(self, lines):
        with open(self.path("text.ply"), "w") as file:
            file.write("\n".join(lines) + "\n")
        return "text.ply"

    def test_tiles_of_any_size_tell_what_memory_tells(self):
        for name in self.put_all(heap(60)):
            for more in ([], ["--touching"], ["--no-coplanar", "--vertices", "equal"],
                         ["--box", "1,1,1,4,5,6.5"]):
                memory = self.look(name, *more)
                self.assertGreater(memory[0]["faces_hit"], 10)
                for size in (10, 200):
                    with self.subTest(name=name, more=more, size=size):
                        self.assertEqual(self.look(name, "--tile-faces", size, *more), memory)
        self.assertEqual(self.listing(), ["curves.obj", "double.ply", "float.ply", "in.stl",
                                          "pairs.csv"])

    def test_the_time_of_searching_is_not_that_of_reading(self):
        self.put_all(heap(40))
        seconds = self.report("float.ply", "--tile-faces", 100)["seconds"]
        for step in ("read", "tree", "pairs"):
            self.assertGreater(seconds[step], 0, msg=step)

    def test_a_killed_run_goes_on(self):
        self.put_all(heap(40))
        expected = self.look("in.stl")
        for stop_at in range(1, 8):
            run = self.run_tool("in.stl", "--tile-faces", 100, "--work", "tiles", "--stop-at",
                                stop_at)
            self.assertEqual(run.status, -signal.SIGKILL)
            self.assertIn("tiles", self.listing())
            again = self.run_tool("in.stl", "--tile-faces", 100, "--work", "tiles", "-v")
            self.assertIn(f"{stop_at - 1} finished earlier" if stop_at > 1 else "searched in",
                          again.err)
            self.assertNotIn("tiles", self.listing())
        self.run_tool("in.stl", "--tile-faces", 100, "--work", "tiles", "--stop-at", 3)
        self.run_tool("in.stl", "--tile-faces", 99, "--work", "tiles", "--stop-at", 2)
        self.assertEqual(self.look("in.stl", "--tile-faces", 98, "--work", "tiles"), expected)

    def test_many_processes_share_the_tiles(self):
        self.put_all(heap(40))
        expected = self.look("float.ply")
        work = ["--work", "tiles"]
        run = self.run_tool("float.ply", *work, "--tile", 0, status=3)
        self.assertIn("contains no tiles of this input", run.err)
        self.assertNotIn("tiles", self.listing())
        run = self.run_tool("float.ply", *work, "--plan", "--tile-faces", 80, status=0)
        tiles = int(run.text.split()[1])
        self.assertGreater(tiles, 5)
        run = self.run_tool("float.ply", *work, "--finish", status=3)
        self.assertIn("tiles 0, 1, 2, 3, 4, 5", run.err)
        self.run_tool("float.ply", *work, "--tile", tiles, status=2)
        twice = [t for t in range(tiles) for _ in range(2)]  # two of each at the same time
        running = [subprocess.Popen([TOOL, "float.ply", *work, "--tile", str(t)], cwd=self.folder,
                                    stdout=subprocess.PIPE) for t in twice]
        for process in running:
            self.assertIn(b" done", process.communicate()[0])
            self.assertEqual(process.returncode, 0)
        self.run_tool("float.ply", *work, "--tile", 1, status=0)  # done already
        for _ in range(2):
            self.assertEqual(self.look("float.ply", *work, "--finish"), expected)
        run = self.run_tool("float.ply", *work, "--finish", "-v", "--exit-zero", status=0)
        self.assertIn(f"searched in {tiles} tiles", run.err)
        run = self.run_tool("float.ply", *work, "--plan", "--box", "0,0,0,1,1,1", status=4)
        self.assertIn("contains tiles of another input or other options", run.err)
        self.put("cloud.xyz", "".join(f"{i} 0 0\n" for i in range(100)))
        weld = subprocess.run([WELD, "cloud.xyz", "-t", "1", "-o", "out.xyz", "--tile-points", "10",
                               "--work", "tiles"], cwd=self.folder, capture_output=True)
        self.assertEqual(weld.returncode, 4)
        self.assertIn(b"contains files of other programs", weld.stderr)
        self.assertEqual(self.run_tool("float.ply", *work, "--plan", status=0).text.split()[1],
                         str(tiles))
        for arguments, words in (
                (["--plan"], "need --work DIR"),
            (["--plan", "--finish", *work], "exclude each other"),
                (["--tile", "0", *work, "--pairs", "p.csv"], "--plan and --tile write no output"),
                (["double.ply", "--plan", *work], "take one INPUT")):
            self.assertIn(words, self.run_tool("float.ply", *arguments, status=2).err)

    def test_a_tile_that_is_damaged_is_named_and_done_again(self):
        self.put_all(heap(40))
        expected = self.look("float.ply")
        work = ["--work", "tiles"]
        run = self.run_tool("float.ply", *work, "--plan", "--tile-faces", 80, status=0)
        tiles = int(run.text.split()[1])
        again = ["--plan", "-r", "-"]
        self.run_tool("float.ply", *work, "--tile", 2, status=0)
        run = self.run_tool("float.ply", *work, *again, status=0)
        self.assertEqual(json.loads(run.text)["files"][0]["tiles"],
                         {"count": tiles, "folder": "tiles",
                          "unfinished": [t for t in range(tiles) if t != 2]})
        for t in range(tiles):
            self.run_tool("float.ply", *work, "--tile", t, status=0)
        for what in ("pairs", "hits"):
            whole = {t: self.read_bytes(f"tiles/{t}.{what}") for t in range(tiles)}
            victim = max(whole, key=lambda t: len(whole[t]))
            changed = bytes([whole[victim][0] ^ 1]) + whole[victim][1:]
            for damage in (b"", changed):
                with open(self.path(f"tiles/{victim}.{what}"), "wb") as file:
                    file.write(damage)
                run = self.run_tool("float.ply", *work, "--finish", status=3)
                self.assertIn(f"tile {victim} is unfinished or damaged", run.err)
                self.run_tool("float.ply", *work, "--tile", victim, status=0)
                self.assertEqual(self.read_bytes(f"tiles/{victim}.{what}"), whole[victim])
                self.assertEqual(self.look("float.ply", *work, "--finish"), expected)

    @unittest.skipIf(NO_MPI, NO_MPI)
    def test_ranks_of_mpi_tell_what_one_tells(self):
        names = ("report.json", "pairs.csv", "curves.obj")
        for name in (*self.put_all(heap(40)), self.put_lines(ply_lines(heap(40)))):
            for more in ([], ["--touching", "--box", "1,1,1,4,5,6.5"]):
                expected = self.look(name, "--tile-faces", 100, *more)
                for size in (2, 4):
                    with self.subTest(name=name, more=more, size=size):
                        self.mpi(size, name, "-r", names[0], "--pairs", names[1], "--curves",
                                 names[2], "-f", "--tile-faces", 100, *more, status=1)
                        found = [self.read_bytes(n) for n in names]
                        self.assertEqual(answers(json.loads(found[0])), expected[0])
                        self.assertEqual(found[1], expected[1])
                        if name.endswith(".ply"):
                            self.assertEqual(found[2], expected[2])
        self.mpi(3, "in.stl", "-r", "report.json", "-f", status=1)  # some tiles for each
        self.assertEqual(self.listing(),
                         sorted({"in.stl", "float.ply", "double.ply", "text.ply", *names}))

    @unittest.skipIf(NO_MPI, NO_MPI)
    def test_of_text_that_is_shared_out_the_first_fault_is_said(self):
        whole = ply_lines(heap(40))
        first = whole.index("end_header") + 4
        joined = whole[:]
        joined[first + 40:first + 42] = [" ".join(joined[first + 40:first + 42])]
        for faults in ([first + 7], [first - 1], [len(whole) - 300, first + 30], [len(whole) - 200],
                       [len(whole) - 90, len(whole) - 60], [len(whole) - 1], []):
            lines = [line + "x" if n in faults else line for n, line in enumerate(whole)]
            name = self.put_lines(lines if faults else joined)
            said = self.run_tool(name, "--tile-faces", 50, status=3).err.splitlines()[-1]
            self.assertIn(f"text.ply:{min(faults, default=first + 40) + 1}: ", said)
            run = self.mpi(4, name, "--tile-faces", 50, status=3)
            self.assertEqual((run.err.count(said), run.err.count("error:")), (1, 1), run.err)

    @unittest.skipIf(NO_MPI, NO_MPI)
    def test_no_rank_knows_much_more_of_a_file_than_its_share(self):
        points, faces = together(grid(40, 10.0),
                                 *[cube((3 * i + 0.3, 2 * i + 0.3, 9.6)) for i in range(9)])
        elements = (f"element vertex {len(points)}\nproperty float x\nproperty float y\n"
                    f"property float z\nelement face {len(faces)}\n"
                    "property list uchar int vertex_indices\nend_header\n")
        more = elements.replace("end_header",
                                "property list uchar float texcoord\nproperty short mark\n"
                                "end_header")
        text = [["%8.4f %8.4f %8.4f\n" % p for p in points], ["3 %4d %4d %4d\n" % f for f in faces]]
        soup = stl_bytes((points, faces))
        for name, head, parts in (
                ("text.ply", f"ply\nformat ascii 1.0\n{elements}".encode(),
                 [[line.encode() for line in part] for part in text]),
                ("in.ply", f"ply\nformat binary_little_endian 1.0\n{elements}".encode(),
                 [[struct.pack("<3f", *p) for p in points],
                  [struct.pack("<B3i", 3, *f) for f in faces]]),
                ("polygons.ply", f"ply\nformat binary_little_endian 1.0\n{more}".encode(),
                 [[struct.pack("<3f", *p) for p in points],
                  list(polygon_rows(faces, random.Random(5)))]),
                ("lists.ply", f"ply\nformat binary_little_endian 1.0\n{elements}".replace(
                    "element face", "property list uchar uchar views\nelement face").encode(),
                 [[struct.pack("<3fB", *p, i % 3) + bytes(i % 3) for i, p in enumerate(points)],
                  [struct.pack("<B3i", 3, *f) for f in faces]]),
                ("in.stl", soup[:84], [[soup[i:i + 50] for i in range(84, len(soup), 50)]])):
            whole = head + b"".join(row for part in parts for row in part)
            for copy, data in [(name, whole)] + [(f"{rank}.{name}", for_rank(rank, 4, head, *parts))
                                                 for rank in range(4)]:
                with open(self.path(copy), "wb") as file:
                    file.write(data)
            expected = self.look(name)
            with self.subTest(name=name):
                run = self.mpi_each([[f"{rank}.{name}", "-r", "-", "--tile-faces", 300, "--pairs",
                                      "pairs.csv", "-f", "--work", "tiles"] for rank in range(4)],
                                    status=1)
                self.assertEqual(self.read_bytes("pairs.csv"), expected[1])
                self.assertEqual(json.loads(run.text)["files"][0]["sha256"],
                                 hashlib.sha256(whole).hexdigest())

    @unittest.skipIf(NO_MPI, NO_MPI)
    def test_of_faces_of_several_lengths_the_first_fault_is_said(self):
        points, faces = heap(40)
        head = (f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\nproperty "
                f"float x\n"
                f"property float y\nproperty float z\nelement face {len(faces)}\n"
                "property list uchar int vertex_indices\nproperty list uchar float texcoord\n"
                "property short mark\nend_header\n").encode()
        rows = list(polygon_rows(faces, random.Random(7)))
        none = lambda row: row[:1] + struct.pack("<i", 1 << 30) + row[5:]
        for faults in ([len(rows) - 1], [len(rows) // 2, len(rows) - 9], [3, len(rows) // 3]):
            bad = [none(row) if n in faults else row for n, row in enumerate(rows)]
            with open(self.path("in.ply"), "wb") as file:
                file.write(head + b"".join(struct.pack("<3f", *p) for p in points) + b"".join(bad))
            said = self.run_tool("in.ply", "--tile-faces", 50, status=3).err.splitlines()[-1]
            self.assertIn("vertex index 1073741824 is out of range", said)
            run = self.mpi(4, "in.ply", "--tile-faces", 50, status=3)
            self.assertEqual((run.err.count(said), run.err.count("error:")), (1, 1), run.err)
            self.assertEqual(self.listing(), ["in.ply"])

    @unittest.skipIf(NO_MPI, NO_MPI)
    def test_a_rank_that_is_killed_ends_the_run_and_any_number_goes_on(self):
        self.put_all(heap(40))
        expected = self.look("in.stl")
        work = ["in.stl", "--tile-faces", 30, "--work", "tiles", "--pairs", "pairs.csv", "-f"]
        for size, step in ((2, 2), (2, 3), (3, 2), (4, 3)):
            run = self.mpi(size, *work, status=None, last=["--stop-at", step])
            self.assertEqual(run.status, 128 + signal.SIGKILL)
            self.assertIn("tiles", self.listing())
            run = self.mpi((size + step) % 4 + 1, *work, "-v", status=1)
            self.assertIn("finished earlier", run.err)
            self.assertNotIn("tiles", self.listing())
            self.assertEqual(self.read_bytes("pairs.csv"), expected[1])

    @unittest.skipIf(NO_MPI, NO_MPI)
    def test_what_fails_under_mpirun_is_said_once(self):
        self.put_all(heap(10))
        for arguments, status, words in (
                (["none.stl"], 3, "none.stl"), (["in.stl", "--within"], 2, "needs the whole mesh"),
                (["in.stl", "--pairs", "none/p.csv"], 4, "no folder none"),
                (["in.stl", "--work", "none/tiles"], 4, "none/tiles: cannot be created"),
                (["in.stl", "float.ply"], 2, "under mpirun, expected one INPUT"),
                (["in.stl", "--work", "tiles", "--plan"], 2, "not for mpirun"),
                (["--help"], 0, "Exit status:")):
            run = self.mpi(3, *arguments, status=status)
            self.assertEqual((run.text + run.err).count(words), 1, msg=run.text + run.err)
            self.assertEqual(self.listing(), ["double.ply", "float.ply", "in.stl"])

    def test_a_folder_that_is_of_no_use_is_named(self):
        self.put_all(heap(10))
        run = self.run_tool("in.stl", "--work", "tiles")
        self.assertIn("--work is not used", run.err)
        self.assertNotIn("tiles", self.listing())

    @unittest.skipIf(SANITIZED, "shadow memory is no memory of the tool")
    def test_memory_decides(self):
        with open(self.path("big.stl"), "wb") as file:
            file.write(stl_bytes(grid(450)))
        run = self.run_tool("big.stl", "--memory", "64M", "-v", status=0)
        self.assertIn("tiles", run.err)
        run = self.run_tool("big.stl", "--memory", "1G", "-v", status=0)
        self.assertNotIn("tiles", run.err)
        run = self.run_tool("big.stl", "--memory", "64M", "--within", "-v")
        self.assertIn("--within needs the whole mesh in memory, about", run.err)
        run = self.run_tool("big.stl", "--memory", "20M", status=5)
        enough = re.search("([0-9]+M)(?: would be enough|, and memory)", run.err)[1]
        self.assertEqual(self.listing(), ["big.stl"])
        self.run_tool("big.stl", "--memory", enough, status=0)
        for memory in ("20M", "60M"):  # before and after faces have their tiles
            run = self.run_tool("big.stl", "--memory", memory, "--tile-faces", "400000", status=5)
            all_of_it = re.search("([0-9]+M)(?: would be enough|, and memory)", run.err)[1]
            self.run_tool("big.stl", "--memory", all_of_it, "--tile-faces", "400000", status=0)
        with open(self.path("short.ply"), "wb") as file:  # few bytes a face, as much memory
            file.write(ply_bytes(grid(550)))
        self.run_tool("short.ply", "--memory", enough, status=0)
        self.run_tool("big.stl", "--memory", enough, "--tile-faces", "1000", status=0)

    def test_what_tiles_cannot_do_is_refused(self):
        self.put_all(heap(3))
        with open(self.path("in.obj"), "wb") as file:
            file.write(obj_bytes(CROSSING))
        os.mkfifo(self.path("in.fifo"))
        for arguments, word in ((["in.stl", "--between"], "--between"),
                                (["in.stl", "-t", "0.1"], "-t"),
                                (["in.stl", "--first"], "--first"),
                                (["in.stl", "--repair", "-o", "out.stl"], "a mesh to write"),
                                (["in.obj"], "neither a binary STL nor a PLY"),
                                (["-"], "standard input"),
                                (["in.fifo"], "a pipe")):
            run = self.run_tool(*arguments, "--tile-faces", 10, status=2)
            self.assertIn(word + " needs the whole mesh in memory", run.err)
            self.assertEqual(word in ("standard input", "a pipe"), "MB" not in run.err, run.err)
        self.put("damaged.ply", "ply\nformat ascii 1.0\nelement vertex -1\nend_header\n")
        for name, fault in (("damaged.ply", "damaged.ply:3: an element needs"),
                            ("none.ply", "none.ply: No such file")):
            self.assertIn(fault, self.run_tool(name, "--tile-faces", 10, status=3).err)
        self.put("foreign/file.txt", "mine")
        run = self.run_tool("in.stl", "--tile-faces", 10, "--work", "foreign", status=4)
        self.assertIn("contains files of other programs", run.err)
        self.assertEqual(self.read("foreign/file.txt"), "mine")

    @unittest.skipIf(not MODELS, "TREEFORM_MODELS_DIR is not set")
    def test_real_models(self):
        for name in ("selfint/cow_6k.obj", "clean/turbineblade_199k.ply"):
            path = os.path.join(MODELS, name)
            if name.endswith(".obj"):
                run = subprocess.run([TOOL, path, "-o", self.path("in.ply"), "--output-format",
                                      "ply"], capture_output=True)
                self.assertEqual(run.returncode, 1)
                path = self.path("in.ply")
            memory = self.look(path)
            self.assertEqual(self.look(path, "--tile-faces", 2000), memory)


if __name__ == "__main__":
    main()
