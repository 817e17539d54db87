"""tf-place is stopped inside its long operations, with status 5 and nothing half-written."""

from place_support import *

import math
import signal
import time


def hills(n, height, phase):
    points, faces = grid(n)
    wave = lambda x, y: math.sin(0.9 * x + phase) * math.cos(1.1 * y) + 0.1 * math.sin(7 * x + y)
    return [(x, y, height + wave(x, y)) for x, y, _ in points], faces


class Stops(PlaceTest):
    """Each of these takes many seconds when it is not stopped."""

    def operations(self):
        # Sheets through each other, which must be taken out far.
        self.mesh("sheet.obj", hills(100, 0.0, 0.0))
        self.mesh("through.obj", hills(100, 0.2, 1.0))
        yield ["separate", "through.obj", "--fixed", "sheet.obj"]
        # Turned so far that many steps are needed.
        points, faces = hills(200, 0.0, 0.0)
        self.mesh("fixed.obj", (points, faces))
        self.mesh("turned.obj", ([(0.8 * x - 0.6 * y, 0.6 * x + 0.8 * y, z + 40)
                                  for x, y, z in points], faces))
        yield ["align", "turned.obj", "--fixed", "fixed.obj", "--starts", "100000"]
        # More parts than the plate holds, so that all orders are tried.
        parts = [self.mesh(f"part{i}.obj", hills(20 + i % 7, 0.0, i)) for i in range(300)]
        yield ["pack", *parts, "--size", "230,230", "--rotate", "any"]

    def test_a_time_limit_stops_inside_of_an_operation(self):
        for arguments in self.operations():
            run = self.run_tool(*arguments, "-o", "out.obj", "-r", "r.json", "-f", "--timeout",
                                "0.6", status=5)
            self.assertIn("--timeout", run.err)
            # Only who has stopped by himself writes a report: the guard that ends a tool does not.
            report = json.loads(self.read("r.json"))
            self.assertEqual((report["exit"], report["files"][0]["error"]["code"]), (5, "timeout"))
            left = [name for name in self.listing() if name.startswith((".", "out"))]
            self.assertEqual(left, [])

    def test_a_signal_stops_inside_of_an_operation(self):
        arguments = next(self.operations())
        process = subprocess.Popen([PLACE, *arguments, "-o", "out.obj", "-r", "r.json"],
                                   cwd=self.folder, stderr=subprocess.PIPE, stdout=subprocess.PIPE)
        time.sleep(0.6)
        process.send_signal(signal.SIGTERM)
        _, err = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 5, msg=err)
        self.assertIn("SIGTERM", err.decode())
        self.assertEqual(json.loads(self.read("r.json"))["exit"], 5)
        self.assertNotIn("out.obj", self.listing())

    def test_progress_is_shown_when_asked_for(self):
        self.mesh("low.obj", hills(30, 0.0, 0.0))
        self.mesh("high.obj", hills(20, 9.0, 2.0))
        run = self.run_tool("drop", "high.obj", "--fixed", "low.obj", "--progress", "-n", status=0)
        self.assertIn("high.obj: search", run.err)
        self.assertIn(" %", run.err)
        run = self.run_tool("drop", "high.obj", "--fixed", "low.obj", "-n", status=0)
        self.assertNotIn(" %", run.err)


if __name__ == "__main__":
    main()
