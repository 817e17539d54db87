"""Signals, time and memory limits: status 5, and nothing half-written."""

from support import *

import signal
import time


def many_crossings(n):
    """2 n triangles, n^2 crossing pairs: long work from a short file."""
    points, faces = [], []
    for i in range(n):
        s = i / n
        for p in ((-1.0, s, -1.0), (2.0, s, -1.0), (0.5, s, 2.0)):
            points.append(p)
        for p in ((s, -1.0, -1.0), (s, 2.0, -1.0), (s, 0.5, 2.0)):
            points.append(p)
    faces = [(3 * i, 3 * i + 1, 3 * i + 2) for i in range(2 * n)]
    return points, faces


def many_blades(n, shift):
    """n thin boxes side by side, in turn along x and along y."""
    meshes = []
    for i in range(n):
        at = 2.0 * i / n + shift / n
        low, high = ((at, -1.0, shift), (at + 0.5 / n, 3.0, shift + 1.0))
        if i % 2:
            low, high = (low[1], low[0], low[2]), (high[1], high[0], high[2])
        points, faces = cube()
        meshes.append(([tuple(low[k] + (high[k] - low[k]) * p[k] for k in range(3))
                        for p in points], faces))
    return together(*meshes)


class Stops(ToolTest):
    def setUp(self):
        super().setUp()
        self.part = write(self.path("part.obj"), many_crossings(6000))  # 36 million pairs

    def assert_nothing_left(self, *allowed):
        self.assertEqual(self.listing(), sorted(["part.obj", *allowed]))

    def outputs(self):
        return ["--pairs", "p.csv", "-o", "m.ply", "-r", "r.json"]

    def test_a_time_limit_stops_with_5_and_a_report(self):
        began = time.monotonic()
        run = self.run_tool(self.part, *self.outputs(), "--timeout", "0.2", status=5)
        self.assertLess(time.monotonic() - began, 20)
        self.assertIn("--timeout", run.err)
        self.assertNotIn("p.csv", self.listing())
        self.assertNotIn("m.ply", self.listing())
        if "r.json" in self.listing():
            report = json.loads(self.read("r.json"))
            self.assertEqual((report["exit"], report["files"][0]["error"]["code"]),
                             (5, "timeout"))
        self.assertEqual([name for name in self.listing() if name.startswith(".")], [])

    def test_inputs_after_a_stop_are_named_as_not_started(self):
        other = write(self.path("other.obj"), CLEAN)
        self.run_tool(self.part, other, "-r", "r.json", "--timeout", "0.2", status=5)
        if "r.json" in self.listing():
            files = json.loads(self.read("r.json"))["files"]
            self.assertEqual([f["error"]["code"] for f in files], ["timeout", "not-started"])

    def test_signals_stop_with_5(self):
        for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
            process = subprocess.Popen(
                [TOOL, self.part, "--pairs", "p.csv", "-o", "m.ply"], cwd=self.folder,
                stderr=subprocess.PIPE, stdout=subprocess.PIPE,
                preexec_fn=lambda: signal.signal(number, signal.SIG_DFL))  # not as under nohup
            time.sleep(0.4)
            process.send_signal(number)
            _, err = process.communicate(timeout=60)
            self.assertEqual(process.returncode, 5, msg=err)
            self.assertIn(signal.Signals(number).name, err.decode())
            self.assert_nothing_left()

    def test_a_stop_while_waiting_for_input_is_heard(self):
        process = subprocess.Popen([TOOL, "-"], cwd=self.folder, stdin=subprocess.PIPE,
                                   stderr=subprocess.PIPE)
        time.sleep(0.3)
        process.terminate()
        self.assertEqual(process.wait(timeout=60), 5)
        process.stdin.close()
        process.stderr.close()

    @unittest.skipIf(SANITIZED, "shadow memory is no memory of the tool")
    def test_a_memory_limit_stops_with_5(self):
        run = self.run_tool(self.part, *self.outputs(), "--memory", "100M", status=5)
        self.assertIn("memory", run.err)
        self.assertNotIn("m.ply", self.listing())
        self.assertEqual([name for name in self.listing() if name.startswith(".")], [])

    @unittest.skipIf(SANITIZED, "shadow memory is no memory of the tool")
    def test_stacks_that_are_not_used_do_not_count(self):
        part = write(self.path("small.obj"), CROSSING)
        large = 256 << 20  # as those of many threads together
        hard = resource.getrlimit(resource.RLIMIT_STACK)[1]
        done = subprocess.run(
            [TOOL, part, "--memory", "64M"], cwd=self.folder, capture_output=True, timeout=120,
            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_STACK, (large, hard)))
        self.assertEqual(done.returncode, 1, msg=done.stderr)

    def test_a_generous_limit_changes_nothing(self):
        part = write(self.path("small.obj"), CROSSING)
        self.run_tool(part, "--memory", "1G", "--timeout", "100", status=1)
        self.run_tool(part, "--memory", "none", status=1)


class FreeMemory(ToolTest):
    """Without --memory, the limit is what is free: here, what the system lets the process have."""
    tool = BOOLEAN

    def setUp(self):
        super().setUp()
        for i in range(12):  # that meet each other everywhere: long lists from short files
            write(self.path(f"{i}.stl"), many_blades(150, i / 12))
        self.inputs = sorted(self.listing())

    def run_with(self, size, *options):
        return subprocess.run([self.tool, "union", *self.inputs, "-o", "u.stl", *options],
                              cwd=self.folder, capture_output=True, timeout=120,
                              preexec_fn=limit_memory(size))

    @unittest.skipIf(SANITIZED, "shadow memory is no memory of the tool")
    def test_what_needs_more_than_is_free_stops_with_5_and_says_so(self):
        for options in ((), ("-j", "1")):
            done = self.run_with(160 << 20, *options)
            self.assertEqual(done.returncode, 5, msg=done.stderr)
            self.assertRegex(done.stderr.decode(),
                             r"needs more memory than the 168 MB that was free when it started "
                             r"\(--memory sets another limit\)\n$")
            self.assertEqual(sorted(self.listing()), self.inputs)

    @unittest.skipIf(SANITIZED, "shadow memory is no memory of the tool")
    def test_a_limit_that_was_asked_for_is_named_as_that(self):
        done = self.run_with(resource.RLIM_INFINITY, "--memory", "160M")
        self.assertEqual(done.returncode, 5, msg=done.stderr)
        self.assertIn(b"stopped by the memory limit (--memory)\n", done.stderr)
        self.assertEqual(sorted(self.listing()), self.inputs)

    def test_a_reader_that_goes_away_is_an_output_error(self):
        part = write(self.path("cubes.obj"), many_crossings(300))
        read, sent = os.pipe()
        os.close(read)
        process = subprocess.Popen([TOOL, part, "--pairs", "-"], stdout=sent,
                                   stderr=subprocess.PIPE)
        os.close(sent)
        _, err = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 4, msg=err)


if __name__ == "__main__":
    main()
