"""tf-weld by many processes: --plan, --tile and --finish, and mpirun. The bytes are those of
one."""

from weld_support import *

import hashlib
import random
import shutil
import signal
import time

NAN = float("nan")


def texts(points):
    """The same points, of four values each, as files that people have."""
    rows = [" ".join(map(repr, p)) for p in points]
    more = [row + " 0.5 7" for row in rows]  # as PTS has them: intensity and colors
    head = "".join(f"property double {name}\n" for name in ("x", "y", "z", "shade"))
    return {"in.xyz": "\n".join(["# by hand", *rows[:40], "", "  // 1 2 3 4", *rows[40:]]),
            "in.csv": "\r\n".join(["shade;x;y;z", *(";".join(row.split()) for row in rows), ""]),
            "in.pts": "\n".join([str(len(rows)), *more, ""]),
            "in.ply": "\n".join(["ply", "format ascii 1.0", f"element vertex {len(rows)}",
                                 head + "end_header", *rows, ""]),
            "in.pcd": "\n".join(["VERSION .7", "FIELDS x y z shade", "SIZE 8 8 8 8", "TYPE F F F F",
                                 "COUNT 1 1 1 1", f"WIDTH {len(rows)}", "HEIGHT 1",
                                 f"POINTS {len(rows)}", "DATA ascii", *rows, ""])}


def ply(points, rng, number="double"):
    head = (f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\n" +
            "".join(f"property {number} {axis}\n" for axis in "xyz") +
            "property float shade\nend_header\n")
    code = "<dddf" if number == "double" else "<ffff"
    return head.encode() + b"".join(struct.pack(code, *p, rng.randrange(4) / 4) for p in points)


def cloud(rng, count):
    kinds = (lambda: tuple(rng.random() for _ in range(3)),
             lambda: (0.5 + 0.02 * rng.random(), 0.5, 0.02 * rng.random()),
             lambda: (0.05 * rng.randrange(12), 0.05 * rng.randrange(12), 0.5),
             lambda: (NAN, 0.0, 1.0))
    return [rng.choices(kinds, (6, 3, 2, 0.1))[0]() for _ in range(count)]


# What ranks are asked for, and to what file: of each kind one, and the rest.
ASKED = [(["-t", "0.02", "--removed", "gone.ply"], "out.ply"),
         (["-t", "0.03", "--rule", "chain"], "out.csv"),
         (["-t", "0.02", "--keep", "mean", "--removed", "gone.las"], "out.xyz"),
         (["-t", "0.02", "--order", "y", "--map", "map.bin"], "out.laz")]
ASKED_TOO = [(["-t", "0.02", "--rule", "chain", "--same", "shade"], "out.pcd"),
             (["-t", "0.02", "--order", "shade", "--map", "map.csv"], "out.ply"),
             (["-t", "0.03", "--order", "max:x", "--rule", "chain", "--label", "group"], "out.ply"),
             (["-t", "0.02", "--precision", "float"], "out.ply"),
             (["-t", "0.02", "--keep", "max:shade", "--removed", "gone.ply", "--map", "map.csv"],
              "out.ply"),
             (["-t", "0.03", "--rule", "chain", "--label", "group"], "out.ply"),
             (["-t", "0.02", "--keep", "last"], "out.laz"), (["-t", "0.02"], "out.laz"),
             (["-t", "0.02"], "out.las"), (["-t", "0.02", "--removed", "gone.las"], "out.las"),
             (["-t", "0.02", "--withhold"], "out.las")]


class Shared(WeldTest):
    def setUp(self):
        super().setUp()
        self.rng = random.Random(8)
        self.write("in.ply", ply(cloud(self.rng, 1500), self.rng))

    def written(self, names=("out.ply", "gone.ply", "map.csv")):
        found = {name: self.read_bytes(name) for name in names if os.path.exists(self.path(name))}
        for name in found:
            os.remove(self.path(name))
        return found

    def one(self, *options):
        self.run_tool("in.ply", *options, status=0)
        return self.written()

    def start(self, *arguments):
        return subprocess.Popen([WELD, *map(str, arguments)], cwd=self.folder,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE)

    def test_processes_that_share_a_folder_give_what_one_gives(self):
        outputs = ["-o", "out.ply", "--removed", "gone.ply", "--map", "map.csv"]
        for options in (["-t", "0.02"], ["-t", "0.03", "--rule", "chain", "--same", "shade"],
                        ["-t", "1%", "--order", "max:shade"], ["-t", "0.02", "--keep", "mean"]):
            expected = self.one(*options, *outputs)
            work = ["in.ply", *options, "--work", "tiles"]
            run = self.run_tool(*work, "--plan", "--tile-points", 250, status=0)
            tiles = int(run.text.split()[1])
            self.assertGreater(tiles, 4)
            run = self.run_tool(*work, "--finish", *outputs, status=3)
            self.assertIn(f"tiles {', '.join(map(str, range(min(tiles, 100))))}", run.err)
            self.assertIn("are unfinished or damaged", run.err)
            twice = [t for t in range(tiles) for _ in range(2)]  # at the same time
            for process in [self.start(*work, "--tile", t) for t in twice]:
                out, err = process.communicate()
                self.assertEqual((process.returncode, err), (0, b""))
                self.assertIn(f" of {tiles} done".encode(), out)
            for _ in range(2):
                self.run_tool(*work, "--finish", *outputs, status=0)
                self.assertEqual(self.written(), expected)
            shutil.rmtree(self.path("tiles"))

    def test_a_tile_that_was_killed_is_done_again(self):
        expected = self.one("-t", "0.02", "-o", "out.ply")
        work = ["in.ply", "-t", "0.02", "--work", "tiles"]
        run = self.run_tool(*work, "--plan", "--tile-points", 300, "--stop-at", 1)
        self.assertEqual(run.status, -signal.SIGKILL)  # when all was done
        tiles = int(self.run_tool(*work, "--plan", status=0).text.split()[1])
        self.run_tool(*work, "--tile", 2, status=0)
        entry = self.entry(*work, "--plan", status=0)
        self.assertEqual(entry["tiles"], {"count": tiles, "folder": "tiles",
                                          "unfinished": [t for t in range(tiles) if t != 2]})
        self.assertIn(f"{tiles} tiles in tiles, 1 finished",
                      self.run_tool(*work, "--plan", status=0).text)
        for t in range(tiles):
            process = self.start(*work, "--tile", t)
            time.sleep(self.rng.random() * 0.02)
            process.kill()
            process.communicate()
        for t in range(tiles):
            self.run_tool(*work, "--tile", t, status=0)
        self.run_tool(*work, "--finish", "-o", "out.ply", status=0)
        self.assertEqual(self.written(), expected)

    def test_las_of_another_format_is_that_of_one_also_after_a_kill(self):
        finite = [p for p in cloud(self.rng, 1500) if p[0] == p[0]]
        text = "".join("%.3f %.4f %r\n" % p for p in sorted(finite))
        self.write("in.xyz", text.encode())
        names = ("out.las", "gone.las")
        gives = ["-o", "out.las", "--removed", "gone.las"]
        self.run_tool("in.xyz", "-t", "0.02", *gives, status=0)
        expected = self.written(names)
        work = ["in.xyz", "-t", "0.02", "--work", "tiles"]
        share = [*work, "--output-format", "las"]
        run = self.run_tool(*share, "--plan", "--tile-points", 300, "--stop-at", 1)
        self.assertEqual(run.status, -signal.SIGKILL)
        for t in range(int(self.run_tool(*share, "--plan", status=0).text.split()[1])):
            self.run_tool(*share, "--tile", t, status=0)
        self.run_tool(*share, "--finish", *gives, status=0)
        self.assertEqual(self.written(names), expected)
        shutil.rmtree(self.path("tiles"))
        for stop in (1, 3, 5):
            run = self.run_tool(*work, *gives, "--tile-points", 300, "--stop-at", stop)
            self.assertEqual(run.status, -signal.SIGKILL)
            run = self.run_tool(*work, *gives, "--tile-points", 300, "-v", status=0)
            self.assertIn("finished earlier", run.err)
            self.assertEqual(self.written(names), expected)
        for size in (2, 5) if MPIRUN and not SANITIZED else ():
            self.mpi(size, *work, *gives, "--tile-points", 300)
            self.assertEqual(self.written(names), expected)
        self.assertEqual(self.listing(), ["in.ply", "in.xyz"])

    def test_who_puts_together_has_the_folder_alone(self):
        self.write("in.ply", ply(cloud(self.rng, 40000), self.rng))
        keep = ["-t", "0.002", "--keep", "mean"]
        expected = self.one(*keep, "-o", "out.ply", "--removed", "gone.ply")
        work = ["in.ply", *keep, "--work", "tiles"]
        self.run_tool(*work, "--plan", "--tile-points", 10000, status=0)
        tiles = len([n for n in os.listdir(self.path("tiles")) if n.endswith(".points")])
        for t in range(tiles):
            self.run_tool(*work, "--tile", t, status=0)
        refused = 0
        for _ in range(6):
            outs = [(f"out{k}.ply", f"gone{k}.ply") for k in range(3)]
            runs = [self.start(*work, "--finish", "-o", out, "--removed", gone)
                    for out, gone in outs]
            tile = self.start(*work, "--tile", 0)
            for run, (out, gone) in zip(runs, outs):
                err = run.communicate()[1].decode()
                if run.returncode == 0:
                    written = self.written((out, gone))
                    self.assertEqual(written, {out: expected["out.ply"],
                                               gone: expected["gone.ply"]})
                else:
                    refused += 1
                    self.assertEqual(run.returncode, 4, err)
                    self.assertIn("tiles: is in use by another process", err)
            self.assertLess(sum(run.returncode != 0 for run in runs), 3)
            tile.communicate()
            self.assertEqual(self.listing(), ["in.ply", "tiles"])
        self.assertGreater(refused, 0)

    def test_a_tile_that_is_damaged_is_named_and_done_again(self):
        expected = self.one("-t", "0.02", "-o", "out.ply")
        work = ["in.ply", "-t", "0.02", "--work", "tiles"]
        run = self.run_tool(*work, "--plan", "--tile-points", 300, status=0)
        tiles = int(run.text.split()[1])
        for t in range(tiles):
            self.run_tool(*work, "--tile", t, status=0)
        whole = {t: self.read_bytes(f"tiles/{t}.drops") for t in range(tiles)}
        victim = max(whole, key=lambda t: len(whole[t]))
        changed = bytes([whole[victim][0] ^ 1]) + whole[victim][1:]
        for damage in (b"", changed):
            self.write(f"tiles/{victim}.drops", damage)
            run = self.run_tool(*work, "--finish", "-o", "out.ply", status=3)
            self.assertIn(f"tile {victim} is unfinished or damaged", run.err)
            self.assertNotIn("is welded again", run.err)
            run = self.run_tool(*work, "--tile", victim, status=0)
            self.assertIn("are damaged; it is welded again", run.err)
            self.assertEqual(self.read_bytes(f"tiles/{victim}.drops"), whole[victim])
            self.run_tool(*work, "--finish", "-o", "out.ply", status=0)
            self.assertEqual(self.written(), expected)
        for name in os.listdir(self.path("tiles")):  # a tile needs its own files only
            if name[0].isdigit() and name.split(".")[0] != str(victim):
                os.remove(self.path("tiles/" + name))
        os.remove(self.path(f"tiles/{victim}.done"))
        self.run_tool(*work, "--tile", victim, status=0)
        self.assertEqual(self.read_bytes(f"tiles/{victim}.drops"), whole[victim])

    def test_what_cannot_be_shared_is_refused_in_words(self):
        work = ["--work", "tiles"]
        for arguments, status, words in (
                (["--plan"], 2, "need --work DIR"),
                (["--plan", "--finish", *work], 2, "exclude each other"),
                (["--tile", 0, *work, "-o", "out.ply"], 2, "--plan and --tile write no output"),
                (["--tile", 0, *work], 3, "contains no tiles of this input"),
                (["--finish", *work, "-o", "out.ply"], 3, "contains no tiles of this input"),
                (["--finish", *work], 2, "no output: -o FILE"),
                (["in.ply", "--plan", *work], 2, "take one INPUT")):
            run = self.run_tool("in.ply", "-t", "0.1", *arguments, status=status)
            self.assertIn(words, run.err)
            self.assertEqual(self.listing(), ["in.ply"])
        self.assertIn("expected files",
                      self.run_tool("-", "-t", "0.1", "--plan", *work, status=2).err)
        self.run_tool("in.ply", "-t", "0.02", "--plan", "--tile-points", 300, *work, status=0)
        self.assertIn("there are only",
                      self.run_tool("in.ply", "-t", "0.02", "--tile", 99, *work, status=2).err)
        run = self.run_tool("in.ply", "-t", "0.03", "--plan", *work, status=4)
        self.assertIn("contains tiles of another input or other options", run.err)
        self.write("cube.obj", obj_bytes(cube()))
        self.assertIn("other meshes can only be welded by one process",
                      self.run_tool("cube.obj", "--plan", "--work", "other", status=3).err)

    def check_ranks(self, cases):
        sizes = [(2, 7), (1, 4)]
        for options, out in cases:
            given = "in.ply"
            if out.startswith("out.la"):
                given = "in.las"
                finite = [p for p in cloud(self.rng, 1500) if p[0] == p[0]]
                self.run_tool(self.cloud("in.xyz", finite), "-o", given, "-f", status=0)
                os.remove(self.path("in.xyz"))
            names = (out, "gone.ply", "gone.las", "map.csv", "map.bin")
            report = self.entry(given, *options, "-o", out, status=0)
            expected = self.written(names)
            sizes.reverse()
            for size in sizes[0]:
                with self.subTest(options=options, size=size):
                    run = self.mpi(size, given, *options, "-o", out, "--tile-points", 200, "-r",
                                   "-")
                    self.assertEqual(self.written(names), expected)
                    entry = json.loads(run.text)["files"][0]
                    for key in ("points", "displacement", "box", "tolerance", "output"):
                        self.assertEqual(entry[key], report[key])
                    self.assertEqual(self.listing(), sorted({"in.ply", given}))

    @unittest.skipIf(NO_MPI, NO_MPI)
    def test_ranks_of_mpi_give_what_one_gives(self):
        self.check_ranks(ASKED)

    @slow
    @unittest.skipIf(NO_MPI, NO_MPI)
    def test_ranks_of_mpi_give_what_one_gives_whatever_is_asked_for(self):
        self.check_ranks(ASKED_TOO)

    def share_texts(self, names, sizes):
        """Of all kinds of text, those of such names."""
        points = [(*p, self.rng.randrange(4) / 4) for p in cloud(self.rng, 2500) if p[0] == p[0]]
        for name, text in texts(points).items():
            self.write(name, text)
            if name not in names:
                continue
            gives = [name, "-t", "0.02", "-o", "out.csv", "--removed", "gone.ply", "--map",
                     "map.csv"]
            outputs = ("out.csv", "gone.ply", "map.csv")
            report = self.entry(*gives, status=0)
            self.assertEqual(report["sha256"], hashlib.sha256(text.encode()).hexdigest())
            expected = self.written(outputs)
            for size in sizes:
                with self.subTest(name=name, size=size):
                    run = self.mpi(size, *gives, "--tile-points", 300, "-r", "-")
                    self.assertEqual(self.written(outputs), expected)
                    entry = json.loads(run.text)["files"][0]
                    for key in ("sha256", "format", "points", "box", "precision_in", "output"):
                        self.assertEqual(entry[key], report[key])

    @slow
    @unittest.skipIf(NO_MPI, NO_MPI)
    def test_any_text_is_shared_out_and_gives_what_one_gives(self):
        self.share_texts(texts([]), (2, 4, 7))

    @unittest.skipIf(NO_MPI, NO_MPI)
    def test_text_is_shared_out_and_gives_what_one_gives(self):
        self.share_texts(("in.csv", "in.pcd"), (4,))
        self.mpi(3, "in.xyz", "in.csv", "in.pts", "--join", "-o", "out.ply", "-r", "report.json")
        several = json.loads(self.read_bytes("report.json"))["files"][0]["sources"]
        self.run_tool("in.xyz", "in.csv", "in.pts", "--join", "-o", "one.ply", "-r", "one.json",
                      status=0)
        one = json.loads(self.read_bytes("one.json"))["files"][0]["sources"]
        self.assertEqual([s["sha256"] for s in several], [s["sha256"] for s in one])
        self.assertEqual(self.read_bytes("out.ply"), self.read_bytes("one.ply"))

    @unittest.skipIf(NO_MPI, NO_MPI)
    def test_of_text_that_is_shared_out_the_first_fault_is_said(self):
        self.check_faults(["in.csv"])

    @slow
    @unittest.skipIf(NO_MPI, NO_MPI)
    def test_of_any_text_that_is_shared_out_the_first_fault_is_said(self):
        self.check_faults(["in.xyz", "in.pts", "in.ply", "in.pcd"])

    def check_faults(self, names):
        points = [(*p, 0.5) for p in cloud(self.rng, 1500) if p[0] == p[0]]
        for name in names:
            lines = texts(points)[name].splitlines()
            for faults in ((len(lines) // 2,), (len(lines) - 300, len(lines) - 40)):
                cut = [line[:3] if n in faults else line for n, line in enumerate(lines)]
                self.write(name, "\n".join(cut) + "\n")
                one = self.run_tool(name, "-t", "0.01", "-o", "out.ply", "--tile-points", 300,
                                    status=3)
                said = one.err.splitlines()[-1]
                self.assertIn(f"{name}:{faults[0] + 1}: ", said)
                run = self.mpi(4, name, "-t", "0.01", "-o", "out.ply", status=3)
                self.assertEqual((run.err.count(said), run.err.count("error:")), (1, 1), run.err)
            os.remove(self.path(name))

    @unittest.skipIf(NO_MPI, NO_MPI)
    def test_no_rank_knows_much_more_of_a_file_than_its_share(self):
        self.check_shares(["in.csv", "listed.ply", "mesh.ply"])

    @slow
    @unittest.skipIf(NO_MPI, NO_MPI)
    def test_of_no_kind_of_file_a_rank_knows_much_more_than_its_share(self):
        self.check_shares(["in.xyz", "in.pts", "in.pcd", "in.ply", "binary.ply", "binary_mesh.ply",
                           "listed_mesh.ply"])

    def check_shares(self, chosen):
        points = [(100.0 + 0.5 * (i % 97), 100.0 + 0.25 * (i // 97), 100.0, 0.5)
                  for i in range(9000)]
        corners = [(3, i, i + 1, i + 97) for i in range(8800)]
        rows = [b"%.4f %.4f %.4f %.4f\n" % p for p in points]
        axes = "".join(f"property double {name}\n" for name in ("x", "y", "z", "t"))
        of_faces = "element face 8800\nproperty list uchar int vertex_indices\n"
        head = lambda form, more="": (f"ply\nformat {form} 1.0\nelement vertex 9000\n{axes}{more}"
                                      "end_header\n").encode()
        binary = [struct.pack("<4d", *p) for p in points]
        listed = [row + bytes([i % 3] * (1 + i % 3)) for i, row in enumerate(binary)]
        views = "property list uchar uchar views\n"
        for name, *parts in (
                ("in.xyz", b"# by hand\n", rows),
                ("in.csv", b"x,y,z,t\n", [row.replace(b" ", b",") for row in rows]),
                ("in.pts", b"9000\n", rows),
                ("in.pcd",
                 b"VERSION .7\nFIELDS x y z t\nSIZE 8 8 8 8\nTYPE F F F F\nCOUNT 1 1 1 1\n"
                 b"WIDTH 9000\nHEIGHT 1\nPOINTS 9000\nDATA ascii\n", rows),
                ("in.ply", head("ascii"), rows),
                ("binary.ply", head("binary_little_endian"), binary),
                ("listed.ply", head("binary_little_endian", views), listed),
                ("mesh.ply", head("ascii", of_faces), rows,
                 [b"%d %4d %4d %4d\n" % face for face in corners]),
                ("binary_mesh.ply", head("binary_little_endian", of_faces), binary,
                 [struct.pack("<B3i", *face) for face in corners]),
                ("listed_mesh.ply", head("binary_little_endian", views + of_faces), listed,
                 [struct.pack("<B3i", *face) for face in corners])):
            if name not in chosen:
                continue
            whole = parts[0] + b"".join(row for part in parts[1:] for row in part)
            self.write(name, whole)
            gives = ["-t", "0.3", "-o", "out.ply", "--removed", "gone.ply"]
            self.run_tool(name, *gives, status=0)
            expected = self.written()
            names = [f"{rank}.{name}" for rank in range(4)]
            for rank, copy in enumerate(names):
                self.write(copy, for_rank(rank, 4, *parts))
            with self.subTest(name=name):
                run = self.mpi_each([[copy, *gives, "-r", "-", "--tile-points", 900, "--work",
                                      "tiles"]
                                     for copy in names])
                self.assertEqual(self.written(), expected)
                self.assertEqual(json.loads(run.text)["files"][0]["sha256"],
                                 hashlib.sha256(whole).hexdigest())

    def check_killed(self, size, *more, between=1):
        gives = ["-t", "0.02", "-o", "out.ply", "--removed", "gone.ply", *more]
        work = ["in.ply", *gives, "--tile-points", 400, "--work", "tiles"]
        self.check_kills(size, work, self.one(*gives), between)
        self.assertEqual(self.listing(), ["in.ply"])

    @unittest.skipIf(NO_MPI, NO_MPI)
    def test_a_rank_that_is_killed_ends_the_run_and_any_number_goes_on(self):
        self.check_killed(3, "--keep", "mean", between=4)

    @slow
    @unittest.skipIf(NO_MPI, NO_MPI)
    def test_a_rank_that_is_killed_at_any_step_ends_the_run_and_any_number_goes_on(self):
        self.check_killed(2)
        self.check_killed(4, "--order", "max:shade", "--map", "map.csv")
        self.check_killed(3, "--keep", "mean")
        gives = ["-t", "0.02", "-o", "out.ply", "--removed", "gone.ply"]
        points = [(*p, 0.5) for p in cloud(self.rng, 1500) if p[0] == p[0]]
        self.write("in.csv", texts(points)["in.csv"])
        work = ["in.csv", *gives, "--tile-points", 400, "--work", "tiles"]
        self.run_tool("in.csv", *gives, status=0)
        expected = self.written()
        for step in (1, 2, 4):
            self.mpi(4, *work, status=128 + signal.SIGKILL, last=["--stop-at", step])
            self.mpi(self.rng.choice((1, 3)), *work)
            self.assertEqual(self.written(), expected)

    @unittest.skipIf(NO_MPI, NO_MPI)
    def test_what_fails_is_said_once_and_nothing_is_written(self):
        self.write("there.ply", b"mine")
        os.mkfifo(self.path("in.fifo"))
        for arguments, status, words in (
                (["none.ply", "-o", "out.ply"], 3, "none.ply: No such file"),
                (["in.ply", "-t", "0.1", "-o", "there.ply"], 4, "there.ply: exists"),
                (["in.ply", "-t", "0.1", "--map", "there.ply"], 4, "there.ply: exists"),
                (["in.ply", "--same", "color", "-o", "out.ply"], 3, "no such property"),
                (["in.ply", "-t", "0.1"], 2, "no output: -o FILE"),
                (["in.fifo", "-t", "0.1", "-o", "out.ply"], 2, "expected files")):
            run = self.mpi(3, *arguments, status=status)
            self.assertEqual(run.err.count(words), 1, msg=run.err)
            self.assertEqual(self.listing(), ["in.fifo", "in.ply", "there.ply"])
        self.assertEqual(self.read_bytes("there.ply"), b"mine")
        for more in ([], ["-r", "report.json"]):
            self.mpi(2, "in.ply", "-t", "0.1", "--check", *more, status=1)
        self.assertEqual(json.loads(self.read_bytes("report.json"))["exit"], 1)
        os.remove(self.path("report.json"))
        os.symlink("/dev/full", self.path("full.ply"))
        for arguments, status, words in (
                (["--help"], 0, "Exit status:"),
                (["--version"], 0, "built with"),
                (["in.ply", "--bogus"], 2, "--bogus"),
                (["in.ply", "-t", "0.1", "-o", "full.ply"], 4, "No space left"),
                (["in.ply", "-t", "0.1", "--map", "full.ply"], 4, "No space left"),
                (["in.ply", "-t", "0.1", "-o", "out.ply", "--timeout", "1e-9"], 5, "time limit"),
                (["in.ply", "-t", "0.1", "-o", "out.ply", "--memory", "20M"], 5,
                 "would be enough")):
            run = self.mpi(3, *arguments, status=status)
            self.assertEqual((run.text + run.err).count(words), 1, msg=run.text + run.err)
            self.assertNotIn("\033", run.text + run.err)
        self.assertTrue(os.path.islink(self.path("full.ply")))
        run = self.mpi(3, "in.ply", "-t", "0.1", "-o", "out.ply", "--log", "log")
        self.assertEqual(self.read_bytes("log").count(b"points merged"), 1)
        run = self.mpi(3, "in.ply", "-t", "0.1", "-o", "out.ply", status=4)

    @unittest.skipIf(NO_MPI, NO_MPI)
    def test_what_one_of_them_cannot_do_the_first_one_says(self):
        for rank in (0, 1, 2):
            options = [["--work", "tiles" if r != rank else "other/tiles"] for r in range(3)]
            run = self.mpi_each([["in.ply", "-t", "0.1", "-o", "out.ply", *more]
                                 for more in options],
                                status=4)
            self.assertEqual(run.err.count("other/tiles: cannot be created"), 1, run.err)
            self.assertNotIn("out.ply", self.listing())

    @unittest.skipIf(NO_MPI, NO_MPI)
    def test_tools_that_share_nothing_say_so(self):
        self.write("cube.obj", obj_bytes(cube()))
        for tool in (PLACE, MEND):
            done = subprocess.run([MPIRUN, "--oversubscribe", "--allow-run-as-root", "-n", "3",
                                   tool,
                                   "cube.obj"], cwd=self.folder, capture_output=True, timeout=300)
            self.assertEqual(done.returncode, 2)
            self.assertEqual(done.stderr.count(b"does not run under mpirun"), 1, done.stderr)
            self.assertEqual(done.stdout, b"")


if __name__ == "__main__":
    main()
