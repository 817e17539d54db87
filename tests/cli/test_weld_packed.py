"""tf-weld and compressed PCD: unpacked and packed by many, each its share, to the bytes of one."""

from weld_support import *

import hashlib
import random
import resource

FIELDS = "x y z t"  # doubles, and a float


def lzf_packed(data):
    """Packed in a way that is not the tool's: copies from where three bytes stood last."""
    out, last, literals, at = bytearray(), {}, 0, 0

    def put_literals(end):
        for i in range(literals, end, 32):
            some = data[i:min(i + 32, end)]
            out.append(len(some) - 1)
            out.extend(some)
    while at + 2 < len(data):
        found = last.get(data[at:at + 3])
        last[data[at:at + 3]] = at
        if found is None or at - found > 8192:
            at += 1
            continue
        count = 3
        while count < 264 and at + count < len(data) and data[found + count] == data[at + count]:
            count += 1
        put_literals(at)
        back = at - found - 1
        out.append(min(count - 2, 7) << 5 | back >> 8)
        if count >= 9:
            out.append(count - 9)
        out.append(back & 255)
        at += count
        literals = at
    put_literals(len(data))
    return bytes(out)


def lzf_unpacked(data, size, made=None):
    """`made` gets, of each packed byte, how many are unpacked ahead of what it belongs to."""
    out, at = bytearray(), 0
    while at < len(data):
        if made is not None:
            made.extend([len(out)] * (at - len(made) + 1))
        control = data[at]
        at += 1
        if control < 32:
            out += data[at:at + control + 1]
            at += control + 1
            continue
        count = control >> 5
        if count == 7:
            count += data[at]
            at += 1
        back = ((control & 31) << 8 | data[at]) + 1
        at += 1
        for _ in range(count + 2):
            out.append(out[-back])
    assert len(out) == size, (len(out), size)
    return bytes(out)


def by_fields(points):
    columns = list(zip(*points))
    return (b"".join(struct.pack(f"<{len(points)}d", *c) for c in columns[:3]) +
            struct.pack(f"<{len(points)}f", *columns[3]))


def head(count, packed, size):
    return (f"VERSION .7\nFIELDS {FIELDS}\nSIZE 8 8 8 4\nTYPE F F F F\nCOUNT 1 1 1 1\nWIDTH "
            f"{count}\n"
            f"HEIGHT 1\nPOINTS {count}\nDATA binary_compressed\n").encode() + struct.pack("<II",
                                                                                          packed,
                                                                                          size)


def pcd(points):
    values = by_fields(points)
    packed = lzf_packed(values)
    return head(len(points), len(packed), len(values)) + packed


def values_in(data):
    """Of a file that the tool has written: how many points, and the values of each."""
    text, _, rest = data.partition(b"DATA binary_compressed\n")
    words = {line.split()[0]: line.split()[1:] for line in text.decode().splitlines()}
    packed, size = struct.unpack("<II", rest[:8])
    assert len(rest) == 8 + packed, (len(rest), packed)
    count, values, at = int(words["POINTS"][0]), [], 0
    unpacked = lzf_unpacked(rest[8:], size)
    for width in map(int, words["SIZE"]):
        values.append(struct.unpack_from(f"<{count}{'d' if width == 8 else 'f'}", unpacked, at))
        at += width * count
    assert at == size
    return list(zip(*values))


class Packed(WeldTest):
    def setUp(self):
        super().setUp()
        self.rng = random.Random(9)

    def points(self, count):
        return [(*(self.rng.random() for _ in range(3)), self.rng.randrange(4) / 4)
                for _ in range(count)]

    def written(self, *names):
        names = names or ("out.pcd", "gone.pcd")
        found = {name: self.read_bytes(name) for name in names}
        for name in found:
            os.remove(self.path(name))
        return found

    def test_another_reader_reads_what_was_written(self):
        points = self.points(40000)  # 1.1 MB of values: more than a block
        self.write("in.pcd", pcd(points))
        outputs = ["-o", "out.pcd", "--removed", "gone.pcd"]
        for more in ([], ["--tile-points", 9000], [] if SANITIZED else ["--memory", "64M"]):
            self.run_tool("in.pcd", "-t", "0.01", *outputs, *more, status=0)
            written = self.written()
            kept, gone = map(values_in, (written["out.pcd"], written["gone.pcd"]))
            self.assertGreater(len(gone), 1000)
            self.assertEqual(sorted(kept + gone), sorted(points))
            self.assertEqual(self.listing(), ["in.pcd"])

    @unittest.skipIf(SANITIZED, "shadow memory is no memory of the tool")
    def test_padding_is_not_held(self):
        count, width = 9000, 20000
        zeros = count * width
        axes = struct.pack(f"<{3 * count}f", *(self.rng.random() for _ in range(3 * count)))
        packed = (lzf_packed(axes) + b"\0\0" + b"\xe0\xff\0" * (zeros // 264 - 1) +
                  b"\0\0" * (zeros % 264 + 263))
        self.write("in.pcd", (
            f"# .PCD v0.7\nVERSION 0.7\nFIELDS x y z _\nSIZE 4 4 4 1\nTYPE F F F U\n"
            f"COUNT 1 1 1 {width}\nWIDTH {count}\nHEIGHT 1\nPOINTS {count}\nDATA "
            f"binary_compressed\n"
        ).encode() + struct.pack("<II", len(packed), len(axes) + zeros) + packed)
        run = self.run_tool("in.pcd", "-t", "0.01", "-o", "out.ply", "--tile-points", 2000,
                            "--memory",
                            "64M", "-f", status=0)
        self.assertIn(f"{count:,} points", run.text)

    def test_few_of_many_files_are_open(self):
        names = [f"{i}.pcd" for i in range(60)]
        for name in names:
            self.write(name, pcd(self.points(5)))
        given = [WELD, *names, "--join", "-t", "0.01", "-o", "out.pcd", "-f"]
        found = []
        for more in ([], ["--tile-points", "50"]):
            run = subprocess.run([*given, *more], cwd=self.folder, capture_output=True,
                                 preexec_fn=lambda:
                                 resource.setrlimit(resource.RLIMIT_NOFILE, (40, 40)))
            self.assertEqual(run.returncode, 0, run.stderr)
            found.append(self.read_bytes("out.pcd"))
        self.assertEqual(found[0], found[1])

    @unittest.skipIf(NO_MPI, NO_MPI)
    def test_ranks_of_mpi_give_what_one_gives(self):
        self.check_ranks((3,), ((["few.pcd", "in.pcd", "few.pcd", "--join"],
                                 ["-t", "0.01", "--same", "t"]),
                                (["few.pcd"], ["-t", "2"])))

    @slow
    @unittest.skipIf(NO_MPI, NO_MPI)
    def test_ranks_of_mpi_give_what_one_gives_whatever_is_asked_for(self):
        self.check_ranks((1, 2, 4, 7), (
            (["in.pcd"], ["-t", "0.01"]),
            (["in.pcd"], ["-t", "0.01", "--keep", "mean"]),
            (["in.pcd"], ["-t", "0.01", "--order", "max:t"]),
            (["in.pcd"], ["-t", "0.01", "--rule", "chain"]),
            (["in.pcd"], ["-t", "0.01", "--precision", "float"]),
            (["few.pcd", "in.pcd", "few.pcd", "--join"], ["-t", "0.01", "--same", "t"]),
            (["few.pcd"], ["-t", "2"])))

    def check_ranks(self, sizes, cases):
        self.write("in.pcd", pcd(self.points(60000)))
        self.write("few.pcd", pcd(self.points(3)))
        outputs = ["-o", "out.pcd", "--removed", "gone.pcd"]
        for given, options in cases:
            self.run_tool(*given, *options, *outputs, status=0)
            expected = self.written()
            self.assertTrue(all(b"DATA binary_compressed\n" in one for one in expected.values()))
            for size in sizes:
                with self.subTest(given=given, options=options, size=size):
                    self.mpi(size, *given, *options, *outputs, "--tile-points", 9000)
                    self.assertEqual(self.written(), expected)
                    self.assertEqual(self.listing(), ["few.pcd", "in.pcd"])

    @unittest.skipIf(NO_MPI, NO_MPI)
    def test_no_rank_knows_much_more_of_a_file_than_its_share(self):
        points = [(100.0 + 0.5 * (i % 97), 100.0 + 0.25 * (i // 97), 100.0 + self.rng.random(), 0.5)
                  for i in range(9000)]
        whole = pcd(points)
        packed = whole[-struct.unpack_from("<I", whole, whole.index(b"compressed\n") + 11)[0]:]
        self.write("in.pcd", whole)
        gives = ["-t", "0.3", "-o", "out.pcd", "--removed", "gone.pcd"]
        self.run_tool("in.pcd", *gives, status=0)
        expected = self.written()
        names = [f"{rank}.pcd" for rank in range(4)]
        size, made = 28 * len(points), []
        lzf_unpacked(packed, size, made)
        made += [size] * (len(packed) - len(made))

        def near(rank, at, count):
            return (rank - 0.25) * count <= 4 * at <= (rank + 1.25) * count
        for rank, copy in enumerate(names):
            known = (byte if near(rank, at, len(packed))
                     or near(rank, at + made[at], len(packed) + size)
                     else 63 for at, byte in enumerate(packed))
            self.write(copy, whole[:-len(packed)] + bytes(known))
            self.run_tool(copy, *gives, status=3)  # of no use for one alone
        run = self.mpi_each([[copy, *gives, "-r", "-", "--tile-points", 900, "--work", "tiles"]
                             for copy in names])
        self.assertEqual(self.written(), expected)
        self.assertEqual(json.loads(run.text)["files"][0]["sha256"],
                         hashlib.sha256(whole).hexdigest())
        self.assertEqual(self.listing(), sorted(["in.pcd", *names]))

    @unittest.skipIf(NO_MPI or SANITIZED, "ranks of the tool itself, by MPI")
    def test_no_rank_reads_or_writes_much_more_than_its_share(self):
        count = 400000  # 11 MB of values
        values = b"".join(struct.pack("<d", self.rng.random())
                          for _ in range(3 * count)) + bytes(4 * count)
        literals = [b"\x1f" + values[at:at + 32] for at in range(0, len(values), 32)]
        packed = b"".join(literals)
        self.write("in.pcd", head(count, len(packed), len(values)) + packed)
        mine = "%s \"$@\"; s=$?; cat /proc/$$/io > $OMPI_COMM_WORLD_RANK.io; exit $s" % WELD
        subprocess.run([MPIRUN, "--oversubscribe", "--allow-run-as-root", "-n", "4", "sh", "-c",
                        mine, "sh",
                        "in.pcd", "-t", "0.001", "-o", "out.pcd", "--tile-points", "20000", "-j1"],
                       cwd=self.folder, check=True, capture_output=True, timeout=300)
        ranks = [dict(line.split(": ") for line in self.read(f"{r}.io").splitlines())
                 for r in range(4)]
        for what in ("rchar", "wchar"):
            several = [int(r[what]) for r in ranks]
            with self.subTest(what=what, several=several):
                self.assertGreater(sum(several), 3 * len(values))
                self.assertLess(max(several), 1.5 * sum(several) / 4)

    @unittest.skipIf(NO_MPI, NO_MPI)
    def test_a_rank_that_is_killed_ends_the_run_and_any_number_goes_on(self):
        self.check_killed(6, [])

    @slow
    @unittest.skipIf(NO_MPI, NO_MPI)
    def test_a_rank_that_is_killed_at_any_step_ends_the_run_and_any_number_goes_on(self):
        self.check_killed(2, [], ["--keep", "mean"], ["--order", "max:t"])

    def check_killed(self, between, *asked):
        self.write("in.pcd", pcd(self.points(20000)))
        gives = ["-t", "0.01", "-o", "out.pcd", "--removed", "gone.pcd"]
        for more in asked:
            self.run_tool("in.pcd", *gives, *more, status=0)
            expected = self.written()
            work = ["in.pcd", *gives, *more, "--tile-points", 4000, "--work", "tiles"]
            self.check_kills(3, work, expected, between)
        self.assertEqual(self.listing(), ["in.pcd"])

    def test_processes_that_share_a_folder_unpack_it_where_they_read_it(self):
        self.write("in.pcd", pcd(self.points(9000)))
        outputs = ["-o", "out.pcd", "--removed", "gone.pcd"]
        self.run_tool("in.pcd", "-t", "0.02", *outputs, status=0)
        expected = self.written()
        work = ["in.pcd", "-t", "0.02", "--work", "tiles"]
        run = self.run_tool(*work, "--plan", "--tile-points", 2500, status=0)
        left = lambda: [name for name in os.listdir(self.path("tiles"))
                        if name.startswith("unpacked")]
        self.assertEqual(left(), [])
        for tile in range(int(run.text.split()[1])):
            self.run_tool(*work, "--tile", tile, status=0)
        self.run_tool(*work, "--finish", *outputs, status=0)
        self.assertEqual((self.written(), left()), (expected, []))

    def test_damaged_data_are_said_once_by_any_number_and_nothing_stays(self):
        whole = pcd(self.points(9000))
        begin = whole.index(b"compressed\n") + 11
        for at in (begin + 8, len(whole) // 2, len(whole) - 40):
            self.write("in.pcd", whole[:at] + b"\xff" * 33 + whole[at + 33:])
            gives = ["in.pcd", "-t", "0.02", "-o", "out.pcd", "--tile-points", 900]
            said = f"in.pcd: byte {begin + 8}: the packed data are damaged"
            self.assertIn(said, self.run_tool("in.pcd", "-t", "0.02", "-o", "out.pcd",
                                              status=3).err)
            self.assertIn(said, self.run_tool(*gives, status=3).err)
            for size in (2, 4) if not NO_MPI else ():
                run = self.mpi(size, *gives, status=3)
                self.assertEqual((run.err.count(said), run.err.count("error:")), (1, 1), run.err)
            self.assertEqual(self.listing(), ["in.pcd"])

    def test_lengths_that_lie_take_no_room(self):
        packed = b"\0a" + b"\xe0\xff\0" * 1000
        for count in (9434, 10000, 153391689):  # of 28 bytes: nearly as many as it holds, and 4 GB
            self.write("in.pcd", head(count, len(packed), 28 * count) + packed)
            run = self.run_tool("in.pcd", "-t", "0.02", "-o", "out.pcd", "--tile-points", 900,
                                status=3)
            self.assertIn("in.pcd: byte ", run.err)
            self.assertEqual(self.listing(), ["in.pcd"])


if __name__ == "__main__":
    main()
