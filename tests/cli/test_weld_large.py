"""Clouds welded in tiles on the disk: the bytes that memory gives, also after being killed."""

from weld_support import *

import random
import re
import signal

FORMATS = ("ply", "xyz", "pcd", "csv")


def cloud(count, seed=1, dense=False):
    """Points with a property each; a third of them near others."""
    rng = random.Random(seed)
    points = []
    for _ in range(count):
        if points and rng.random() < 0.35:
            near = rng.choice(points)
            points.append(tuple(x + rng.uniform(-0.01, 0.01) for x in near))
        elif points and rng.random() < 0.1:
            points.append(rng.choice(points))
        else:
            size = 0.3 if dense else 1.0
            points.append((3 * size * rng.random(), size * rng.random(), size * rng.random()))
    return points


def ply(points, ascii=True):
    head = ("ply\nformat %s 1.0\ncomment a cloud\nelement vertex %d\nproperty double x\n"
            "property double y\nproperty double z\nproperty int number\nend_header\n")
    if ascii:
        rows = "".join(f"{x!r} {y!r} {z!r} {i}\n" for i, (x, y, z) in enumerate(points))
        return (head % ("ascii", len(points)) + rows).encode()
    rows = b"".join(struct.pack("<dddi", *p, i) for i, p in enumerate(points))
    return (head % ("binary_little_endian", len(points))).encode() + rows


class Large(WeldTest):
    def weld_both(self, name, *arguments, suffix=".ply", size=300):
        """The output in memory and that in tiles of about `size` points."""
        self.run_tool(name, *arguments, "-o", "memory" + suffix, "-f", status=0)
        self.run_tool(name, *arguments, "-o", "tiles" + suffix, "-f", "--tile-points", size,
                      status=0)
        return self.read_bytes("memory" + suffix), self.read_bytes("tiles" + suffix)

    def assert_no_folder(self):
        self.assertFalse(any(n.endswith(".tf-weld-tiles") for n in self.listing()))

    def test_every_format_and_rule_gives_the_bytes_that_memory_gives(self):
        points = cloud(3000)
        self.write("in.ply", ply(points, ascii=False))
        for suffix in FORMATS:
            if suffix != "ply":
                self.run_tool("in.ply", "-o", f"in.{suffix}", status=0)
            for rule in ("first", "chain"):
                for tolerance in ("0", "0.01", "0.2"):
                    with self.subTest(format=suffix, rule=rule, tolerance=tolerance):
                        memory, tiles = self.weld_both(f"in.{suffix}", "-t", tolerance, "--rule",
                                                       rule, suffix="." + suffix)
                        self.assertEqual(memory, tiles)
        self.assert_no_folder()

    def test_text_and_single_precision_are_written_as_from_memory(self):
        single = [tuple(round(64 * x) / 64 for x in p) for p in cloud(800)]
        self.write("in.ply", ply(single))
        for suffix in (".ply", ".xyz", ".csv", ".pcd"):
            for more in ([], ["--ascii"], ["--precision", "double"]):
                memory, tiles = self.weld_both("in.ply", "-t", "0.05", *more, suffix=suffix)
                self.assertEqual(memory, tiles)
        self.write("in.xyz", "".join(f"{x!r} {y!r} {z!r}\n" for x, y, z in single).encode())
        memory, tiles = self.weld_both("in.xyz", "-t", "0.05", suffix=".ply")
        self.assertEqual(memory, tiles)

    def test_dense_clouds_and_wide_tolerances_give_the_same(self):
        self.write("in.ply", ply(cloud(2000, dense=True), ascii=False))
        for rule in ("first", "chain"):
            for tolerance in ("0.05", "0.3", "5", "2%"):
                memory, tiles = self.weld_both("in.ply", "-t", tolerance, "--rule", rule, size=100)
                self.assertEqual(memory, tiles)

    def test_all_that_can_be_given_back_is_the_same(self):
        self.write("in.ply", ply(cloud(2500), ascii=False))
        for rule in ("first", "chain"):
            for name, tiled in (("memory", []), ("tiles", ["--tile-points", 200])):
                common = ["in.ply", "-t", "0.02", "--rule", rule, "-f", *tiled]
                self.run_tool(*common, "-o", f"{name}.ply", "--map", f"{name}.csv", "--removed",
                              f"{name}-gone.ply", status=0)
                self.run_tool(*common, "--map", f"{name}.bin", status=0)
                self.run_tool(*common, "--label", "group", "-o", f"{name}-label.ply", status=0)
                self.run_tool(*common, "--label", "number", "-o", f"{name}-number.ply", status=0)
                self.run_tool(*common, "--check", status=1)
            for end in (".ply", ".csv", "-gone.ply", ".bin", "-label.ply", "-number.ply"):
                self.assertEqual(self.read_bytes("memory" + end), self.read_bytes("tiles" + end))
        self.assert_no_folder()

    def test_the_report_says_the_same(self):
        points = cloud(1500) + [(float("nan"), 0.0, 0.0), (0.0, float("inf"), 0.0)]
        self.write("in.ply", ply(points, ascii=False))
        for rule in ("first", "chain"):
            reports, moves = [], []
            for tiled in ([], ["--tile-points", 200]):
                command = ["in.ply", "-t", "0.03", "--rule", rule, "-o", "out.ply", "-f", *tiled]
                reports.append(self.report(*command, status=0)["files"])
                tiles = reports[-1][0].pop("tiles")
                said = self.run_tool(*command, "-v", status=0).err
                moves.append(said[said.index("largest move"):].split("\n")[0])
            self.assertEqual(*reports)
            self.assertEqual(*moves)
            self.assertEqual(tiles, {"count": tiles["count"], "folder": "out.ply.tf-weld-tiles",
                                     "unfinished": []})
            self.assertGreater(tiles["count"], 5)
            self.assertGreater(reports[0][0]["displacement"]["max"], 0.0)

    def test_points_that_are_not_finite_are_kept(self):
        points = cloud(500) + 3 * [(float("nan"), 1.0, 2.0), (float("inf"), 0.0, 0.0)]
        self.write("in.ply", ply(points, ascii=False))
        memory, tiles = self.weld_both("in.ply", "-t", "0.02", size=60)
        self.assertEqual(memory, tiles)

    def test_standard_input_is_welded_as_a_file(self):
        data = ply(cloud(900), ascii=False)
        self.write("in.ply", data)
        self.run_tool("in.ply", "-t", "0.02", "-o", "memory.ply", status=0)
        for more in (["--tile-points", 100], ["--memory", "400M"]):
            self.run_tool("-", "-t", "0.02", "-o", "out.ply", "-f", *more, stdin=data, status=0)
            self.assertEqual(self.read_bytes("memory.ply"), self.read_bytes("out.ply"))
            self.assertEqual(self.listing(), ["in.ply", "memory.ply", "out.ply"])

    def test_standard_input_of_a_killed_run_is_removed_by_the_next(self):
        data = ply(cloud(900), ascii=False)
        command = ["-", "-t", "0.02", "-o", "out.ply", "--tile-points", 100]
        run = self.run_tool(*command, "--stop-at", 2, stdin=data)
        self.assertEqual(run.status, -signal.SIGKILL)
        self.assertEqual(len(self.listing()), 2)  # what was read, and the tiles
        self.run_tool(*command, stdin=data, status=0)
        self.assertEqual(self.listing(), ["out.ply"])

    def test_what_only_memory_can_do_is_refused_in_words(self):
        self.write("in.ply", ply(cloud(200), ascii=False))
        for out, more in (("out.ply", ["--keep-manifold"]), ("out.ply", ["--borders"]),
                          ("-", ["--keep", "mean", "--output-format", "ply"])):
            run = self.run_tool("in.ply", "-t", "0.02", "-o", out, "--tile-points", 50, *more,
                                status=2)
            self.assertIn("memory", run.err)
        self.assertEqual(self.listing(), ["in.ply"])

    def test_after_being_killed_at_any_step_it_goes_on_to_the_same_bytes(self):
        self.write("in.ply", ply(cloud(1500), ascii=False))
        for rule in ("first", "chain"):
            self.run_tool("in.ply", "-t", "0.02", "--rule", rule, "-o", "memory.ply", "-f",
                          status=0)
            command = ["in.ply", "-t", "0.02", "--rule", rule, "-o", "out.ply", "--map",
                       "map.csv", "--removed", "gone.ply", "--tile-points", 250, "-j1"]
            killed = 0
            for step in range(1, 200):
                run = self.run_tool(*command, "--stop-at", step)
                if run.status == 0:
                    break
                killed += 1
                self.assertEqual(run.status, -signal.SIGKILL)
                self.assertNotIn("out.ply", self.listing())
                before = {n: os.stat(self.path("out.ply.tf-weld-tiles/" + n)).st_mtime_ns
                          for n in os.listdir(self.path("out.ply.tf-weld-tiles"))
                          if n.endswith(".done")}
                # Steps count from what is done: the next run gets as far again.
                again = self.run_tool(*command, "-v", "--stop-at", 1)
                self.assertIn(f"{len(before)} of", again.err)
                for n, time in before.items():
                    self.assertEqual(
                        os.stat(self.path("out.ply.tf-weld-tiles/" + n)).st_mtime_ns, time)
                run = self.run_tool(*command, "-f", status=0)
                self.assertEqual(self.read_bytes("memory.ply"), self.read_bytes("out.ply"))
                for name in ("out.ply", "map.csv", "gone.ply"):
                    os.remove(self.path(name))
                self.assertEqual(sorted(os.listdir(self.folder)), ["in.ply", "memory.ply"])
            self.assertGreater(killed, 5)
            for name in ("out.ply", "map.csv", "gone.ply"):
                os.remove(self.path(name))

    def test_a_damaged_tile_is_noticed(self):
        self.write("in.ply", ply(cloud(1500), ascii=False))
        self.run_tool("in.ply", "-t", "0.02", "-o", "memory.ply", status=0)
        folder = "out.ply.tf-weld-tiles/"
        for name, harm in (("0.drops", "cut"), ("0.border", "flip"), ("0.asked", "grow"),
                           ("0.done", "cut"), ("3.points", "cut"), ("plan", "cut")):
            command = ["in.ply", "-t", "0.02", "-o", "out.ply", "--tile-points", 250, "-j1", "-f"]
            self.assertEqual(self.run_tool(*command, "--stop-at", 3).status, -signal.SIGKILL)
            data = bytearray(self.read_bytes(folder + name))
            if harm == "grow":
                data += bytes(8)
            elif harm == "cut":
                data = data[:-5]
            else:
                data[len(data) // 2] ^= 1
            self.assertGreater(len(data), 7, msg=name)
            self.write(folder + name, bytes(data))
            self.run_tool(*command, status=0)
            self.assertEqual(self.read_bytes("memory.ply"), self.read_bytes("out.ply"), msg=name)
            self.assert_no_folder()

    def test_work_on_another_input_or_with_other_options_is_not_used(self):
        for change in ("file", "tolerance", "rule"):
            self.write("in.ply", ply(cloud(1000), ascii=False))
            command = ["in.ply", "-o", "out.ply", "--tile-points", 250, "-f"]
            self.assertEqual(self.run_tool(*command, "-t", "0.02", "--stop-at", 3).status,
                             -signal.SIGKILL)
            options = ["-t", "0.02"]
            if change == "file":
                self.write("in.ply", ply(cloud(1000, seed=2), ascii=False))
            elif change == "tolerance":
                options = ["-t", "0.03"]
            else:
                options += ["--rule", "chain"]
            run = self.run_tool(*command, *options, status=0)
            self.assertIn("started again", run.err)
            self.run_tool("in.ply", *options, "-o", "memory.ply", "-f", status=0)
            self.assertEqual(self.read_bytes("memory.ply"), self.read_bytes("out.ply"))

    def test_an_output_that_exists_is_refused_before_anything_is_made(self):
        self.write("in.ply", ply(cloud(500)))
        self.write("out.ply", b"here")
        self.run_tool("in.ply", "-t", "0.01", "-o", "out.ply", "--tile-points", 100, status=4)
        self.assertEqual(self.read_bytes("out.ply"), b"here")
        self.assert_no_folder()

    def test_a_folder_with_other_files_is_left_alone(self):
        self.write("in.ply", ply(cloud(300), ascii=False))
        os.mkdir(self.path("mine"))
        self.write("mine/letter.txt", b"dear\n")
        run = self.run_tool("in.ply", "-t", "0.02", "-o", "out.ply", "--tile-points", 50, "--work",
                            "mine", status=4)
        self.assertIn("mine", run.err)
        self.assertEqual(os.listdir(self.path("mine")), ["letter.txt"])

    def binary(self, name, points):
        head = (f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\n"
                "property double x\nproperty double y\nproperty double z\nend_header\n")
        return self.write(name, head.encode() + b"".join(struct.pack("<ddd", *p) for p in points))

    def check_beyond_the_limit(self, points, tolerance, rules=("first", "chain"), memory="48M"):
        """Whether memory and tiles within the limit give the same."""
        self.binary("in.ply", points)
        for rule in rules:
            with self.subTest(rule=rule):
                command = ["in.ply", "-t", tolerance, "--rule", rule, "-f"]
                whole = self.entry(*command, "-o", "memory.ply", status=0)
                run = self.run_tool(*command, "-o", "out.ply", "--memory", memory, "-v", "-j2",
                                    "-r", "report.json", status=0)
                self.assertRegex(run.err, " points in [0-9]+ tile")
                self.assertEqual(self.read_bytes("memory.ply"), self.read_bytes("out.ply"))
                tiles = json.loads(self.read("report.json"))["files"][0]
                for key in ("points", "displacement"):
                    self.assertEqual(whole[key], tiles[key])

    @unittest.skipIf(SANITIZED, "shadow memory is no memory of the tool")
    def test_a_cloud_beyond_the_memory_limit_is_welded_all_the_same(self):
        rng = random.Random(5)
        some = [(rng.random(), rng.random(), rng.random()) for _ in range(200000)]
        self.check_beyond_the_limit(some + [(x + 1e-7, y, z) for x, y, z in some], "2e-7")

    @unittest.skipIf(SANITIZED, "shadow memory is no memory of the tool")
    def test_orders_and_choices_beyond_the_memory_limit_give_the_same(self):
        rng = random.Random(9)
        some = [(rng.random(), rng.random(), rng.random()) for _ in range(200000)]
        points = some + [(x + 1e-7 * rng.random(), y, z) for x, y, z in some]
        for half in (0, 1):
            self.binary(f"{half}.ply", points[half::2])
        for more in (["--order", "max:x"], ["--keep", "mean"], ["--keep", "max:x"],
                     ["--same", "y=0.001", "--order", "x"]):
            for name, limit in (("memory", []), ("tiles", ["--memory", "52M"])):
                run = self.run_tool("0.ply", "1.ply", "--join", "-t", "5e-5", *more, "-f", *limit,
                                    "-o", f"{name}.ply", "--map", f"{name}.map", "--removed",
                                    f"{name}.xyz", "-v", status=0)
                self.assertEqual(bool(limit), " tiles, about" in run.err)
            for end in (".ply", ".map", ".xyz"):
                self.assertTrue(self.read_bytes("memory" + end) == self.read_bytes("tiles" + end))

    @unittest.skipIf(SANITIZED, "shadow memory is no memory of the tool")
    def test_a_heap_of_equal_points_beyond_the_memory_limit_is_welded_all_the_same(self):
        rng = random.Random(6)
        points = [(0.5, 0.5, 0.5) if i % 4 else (rng.random(), rng.random(), rng.random())
                  for i in range(600000)]
        for tolerance in ("0", "2e-3"):
            self.check_beyond_the_limit(points, tolerance)

    @unittest.skipIf(SANITIZED, "shadow memory is no memory of the tool")
    def test_a_crowd_nearer_than_the_tolerance_beyond_the_memory_limit_is_welded_all_the_same(self):
        self.check_beyond_the_limit(self.crowd(), "0.004")

    @slow
    @unittest.skipIf(SANITIZED, "shadow memory is no memory of the tool")
    def test_a_crowd_much_nearer_than_the_tolerance_beyond_the_memory_limit_is_welded_too(self):
        self.check_beyond_the_limit(self.crowd(), "0.03")

    def crowd(self):
        rng = random.Random(7)
        crowd = lambda: tuple(0.5 + 0.02 * rng.random() for _ in range(3))
        return [crowd() if i % 4 else (rng.random(), rng.random(), rng.random())
                for i in range(600000)]

    def check_rows(self, points, tolerance):
        self.check_beyond_the_limit(points, tolerance, rules=("first",))
        # A second look at the same place.
        self.check_beyond_the_limit(points[::2] + points[1::2], tolerance, rules=("first",))

    def sheet(self):
        rng = random.Random(8)
        return [(i % 700 + rng.random(), i // 700 + rng.random(), 0.0) for i in range(490000)]

    @unittest.skipIf(SANITIZED, "shadow memory is no memory of the tool")
    def test_rows_that_hang_on_those_before_are_welded_within_the_memory_limit(self):
        self.check_rows(self.sheet(), "1.3")

    @slow
    @unittest.skipIf(SANITIZED, "shadow memory is no memory of the tool")
    def test_long_rows_that_hang_on_those_before_are_welded_within_the_memory_limit(self):
        rng = random.Random(8)
        line = [(0.3 * (i % 200000) + 0.2 * rng.random(), 20.0 * (i // 200000), 0.0)
                for i in range(1000000)]
        self.check_rows(line, "0.52")
        self.check_rows(self.sheet(), "2")

    @unittest.skipIf(SANITIZED, "shadow memory is no memory of the tool")
    def test_what_is_welded_in_memory_says_so_where_memory_is_limited(self):
        corners = b"".join(struct.pack("<12fH", *(3 * [0.0]),
                                       *(float(i % 97 + k) for k in range(9)),
                                       0) for i in range(100000))
        self.write("in.stl", 80 * b" " + struct.pack("<I", 100000) + corners)
        command = ["in.stl", "-o", "out.off", "-f"]
        self.assertNotIn("--memory", self.run_tool(*command, status=0).err)
        report = self.report(*command, "--memory", "55M", status=0)
        self.assertIn("in-memory", [w["code"] for w in report["files"][0]["warnings"]])
        # What is over at once may end before the limit is looked at.
        corners = b"".join(struct.pack("<12fH", *(3 * [0.0]), *(1.1 * i + k for k in range(9)), 0)
                           for i in range(150000))
        self.write("in.stl", 80 * b" " + struct.pack("<I", 150000) + corners)
        run = self.run_tool(*command, "--memory", "8M", status=5)
        self.assertIn("the output format off of a mesh needs the whole mesh in memory", run.err)
        self.write("in.stl", 80 * b" " + struct.pack("<I", 800000))
        os.truncate(self.path("in.stl"), 84 + 50 * 800000)  # more than the memory
        run = self.run_tool(*command, "--memory", "32M", status=5)
        self.assertIn("--memory is not enough for a file of 41 MB", run.err)

    def check_too_little(self, cases, memories):
        """Of each (rule, tolerance, further options)."""
        rng = random.Random(8)
        self.binary("in.ply", [(rng.random(), rng.random(), rng.random()) for _ in range(500000)])
        for rule, tolerance, size in cases:
            command = ["in.ply", "-t", tolerance, "--rule", rule, "-f"]
            self.run_tool(*command, "-o", "memory.ply", status=0)
            for memory in memories:
                with self.subTest(rule=rule, tolerance=tolerance, size=size, memory=memory):
                    run = self.run_tool(*command, *size, "-o", "out.ply", "--memory", memory,
                                        status=5)
                    in_any_case = memory != "33M" and (rule == "chain" or size)  # not looked at
                    self.assertEqual("for any cloud" in run.err, bool(in_any_case))
                    self.assertEqual(self.listing(), ["in.ply", "memory.ply"])
                    self.check_enough(run, *command, *size)

    @unittest.skipIf(SANITIZED, "shadow memory is no memory of the tool")
    def test_memory_that_is_too_little_is_said_at_once_with_what_would_be_enough(self):
        self.check_too_little([(rule, "0.002", []) for rule in ("first", "chain")], ["20M"])

    @slow
    @unittest.skipIf(SANITIZED, "shadow memory is no memory of the tool")
    def test_of_any_tolerance_and_size_of_tiles_what_is_said_is_enough(self):
        self.check_too_little([(rule, *more) for rule in ("first", "chain") for more in (
            ("0.002", []), ("0.008", []), ("0.008", ["--tile-points", "500000"]))],
            ["1M", "20M", "33M"])

    def check_equal_points(self, share):
        """Of 400,000 points, one of `share` is equal to others."""
        rng = random.Random(8)
        kinds = [(*(rng.random() for _ in range(3)), i % 7) if i % share else (0.5, 0.5, 0.5, i % 7)
                 for i in range(400000)]
        head = (f"ply\nformat binary_little_endian 1.0\nelement vertex {len(kinds)}\nproperty "
                f"double x\n"
                "property double y\nproperty double z\nproperty uchar kind\nend_header\n")
        self.write("in.ply", head.encode() + b"".join(struct.pack("<dddB", *row) for row in kinds))
        for same, keep in (("kind=1", "first"), ("kind", "max:z")):
            command = ["in.ply", "-t", "0", "--rule", "chain", "--same", same, "--keep", keep, "-f"]
            self.run_tool(*command, "-o", "memory.ply", status=0)
            for memory in ("20M", "33M"):
                run = self.run_tool(*command, "-o", "out.ply", "--memory", memory, status=5)
                self.check_enough(run, *command)

    @unittest.skipIf(SANITIZED, "shadow memory is no memory of the tool")
    def test_of_chains_of_equal_points_too_what_is_said_is_enough(self):
        self.check_equal_points(40)

    @slow
    @unittest.skipIf(SANITIZED, "shadow memory is no memory of the tool")
    def test_of_long_chains_of_equal_points_too_what_is_said_is_enough(self):
        self.check_equal_points(2)

    def check_enough(self, refused, *command):
        """The memory that is said is enough the first time."""
        enough = re.search("([0-9]+M) would be enough", refused.err)[1]
        self.run_tool(*command, "-o", "out.ply", "--memory", enough, status=0)
        self.assertEqual(self.read_bytes("memory.ply"), self.read_bytes("out.ply"))
        os.remove(self.path("out.ply"))

    @unittest.skipIf(SANITIZED, "shadow memory is no memory of the tool")
    def test_too_little_memory_for_tiles_that_are_there_is_said_with_what_would_be_enough(self):
        rng = random.Random(8)
        self.binary("in.ply", [(rng.random(), rng.random(), rng.random()) for _ in range(500000)])
        for rule in ("first", "chain"):
            command = ["in.ply", "-t", "0.004", "--rule", rule, "-f"]
            self.run_tool(*command, "-o", "memory.ply", status=0)
            self.run_tool(*command, "-o", "out.ply", "--tile-points", "500000", "--stop-at", "1",
                          status=-signal.SIGKILL)
            run = self.run_tool(*command, "-o", "out.ply", "--memory", "46M", status=5)
            self.assertIn("for the tiles in", run.err)
            self.check_enough(run, *command)
            command += ["--work", f"tiles_{rule}"]
            shared = [*command, "--memory"]
            self.run_tool(*shared, "1G", "--tile-points", "500000", "--plan", status=0)
            run = self.run_tool(*shared, "46M", "--tile", "0", status=5)
            enough = re.search("([0-9]+M) would be enough", run.err)[1]
            self.run_tool(*shared, enough, "--tile", "0", status=0)
            run = self.run_tool(*shared, "20M", "--finish", "-o", "out.ply", status=5)
            self.assertNotIn("for the tiles", run.err)  # only borders are left
            self.check_enough(run, *command, "--finish")

    @slow
    @unittest.skipIf(SANITIZED, "shadow memory is no memory of the tool")
    def test_of_rows_that_hang_on_those_before_too_what_is_said_is_enough(self):
        rng = random.Random(9)
        line = [(0.3 * (i % 300000) + 0.2 * rng.random(), 20.0 * (i // 300000), 0.0)
                for i in range(2400000)]
        sheet = [(i % 2080 + 0.7 * rng.random(), i // 2080 + 0.7 * rng.random(), 0.0)
                 for i in range(2080 * 2080)]
        # The second one is looked at twice.
        for points, tolerance in ((line, "0.52"), (sheet[::2] + sheet[1::2], "2.5")):
            self.binary("in.ply", points)
            command = ["in.ply", "-t", tolerance, "-f"]
            self.run_tool(*command, "-o", "memory.ply", status=0)
            run = self.run_tool(*command, "-o", "out.ply", "--memory", "33M", status=5)
            enough = re.search("([0-9]+M) would be enough", run.err)[1]
            self.run_tool(*command, "-o", "out.ply", "--memory", enough, status=0)
            self.assertEqual(self.read_bytes("memory.ply"), self.read_bytes("out.ply"))
            if MPIRUN:
                self.mpi(3, *command, "-o", "out.ply", "--memory", enough)
                self.assertEqual(self.read_bytes("memory.ply"), self.read_bytes("out.ply"))

    @unittest.skipIf(SANITIZED, "shadow memory is no memory of the tool")
    def test_what_tiles_cannot_do_is_refused_where_memory_is_limited(self):
        self.binary("in.ply", [(i % 100, i // 100 % 100, i // 10000) for i in range(400000)])
        run = self.run_tool("in.ply", "-o", "out.ply", "--borders", "--memory", "40M", status=5)
        self.assertRegex(run.err, "--borders needs .* in memory, about")
        self.assertEqual(self.listing(), ["in.ply"])


if __name__ == "__main__":
    main()
