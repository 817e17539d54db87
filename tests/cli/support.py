"""What the tests of the tools share: small meshes, a folder to work in, a way to run a tool."""

import json
import os
import resource
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest

TOOL = os.environ.get("TF_SELFINTERSECT", "tf-selfintersect")
BOOLEAN = os.environ.get("TF_BOOLEAN", "tf-boolean")
CUT = os.environ.get("TF_CUT", "tf-cut")
MEND = os.environ.get("TF_REPAIR", "tf-repair")
PLACE = os.environ.get("TF_PLACE", "tf-place")
WELD = os.environ.get("TF_WELD", "tf-weld")
MODELS = os.environ.get("TREEFORM_MODELS_DIR", "")
SANITIZED = os.environ.get("TREEFORM_SANITIZED", "") != ""
MPIRUN = os.environ.get("TREEFORM_MPIRUN", "")
NO_MPI = ("what MPI leaves behind is not ours" if SANITIZED else
          "built without MPI (libopenmpi-dev)" if not MPIRUN else "")


class Run:
    def __init__(self, done):
        self.status = done.returncode
        self.out = done.stdout
        self.err = done.stderr.decode(errors="replace")
        self.text = done.stdout.decode(errors="replace")


def for_rank(rank, size, head, *parts):
    """Bytes of a file as one of some ranks has to know them: the head, the first of each part's
    rows, and of each part, and of all bytes, its share with a quarter of that on either side. All
    others are other bytes; lines stay lines."""
    rows = [row for part in parts for row in part]
    whole = sum(map(len, rows))
    near = lambda at, count: (rank - 0.25) * count <= size * at <= (rank + 1.25) * count
    copy, at = [head], 0
    for part in parts:
        for i, row in enumerate(part):
            known = i == 0 or near(i, len(part)) or near(at, whole) or near(at + len(row), whole)
            copy.append(row if known else b"?" * (len(row) - 1) + row[-1:])
            at += len(row)
    return b"".join(copy)


class ToolTest(unittest.TestCase):
    tool = TOOL

    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="treeform-cli-")
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def path(self, name):
        return os.path.join(self.folder, name)

    def put(self, name, text):
        """Writes a file, with the folders that it is in."""
        os.makedirs(os.path.dirname(self.path(name)), exist_ok=True)
        with open(self.path(name), "w") as file:
            file.write(text)
        return name

    def mpi(self, size, *arguments, status=0, last=()):
        """As so many ranks, the last of which has further options."""
        return self.mpi_each([arguments] * (size - 1) + [(*arguments, *last)], status)

    def mpi_each(self, commands, status=0):
        """As ranks that have options of their own."""
        command = sum(([":", "-n", "1", self.tool, *map(str, one)] for one in commands), [])
        done = subprocess.run([MPIRUN, "--oversubscribe", "--allow-run-as-root", *command[1:]],
                              cwd=self.folder, capture_output=True, timeout=300)
        if status is not None:
            self.assertEqual(done.returncode, status, msg=f"{commands[0]}\n{done.stderr.decode()}")
        return Run(done)

    def run_tool(self, *arguments, status=None, stdin=b"", timeout=120):
        done = subprocess.run([self.tool, *map(str, arguments)], input=stdin, capture_output=True,
                              cwd=self.folder, timeout=timeout)
        run = Run(done)
        if status is not None:
            self.assertEqual(run.status, status, msg=f"{arguments}\n{run.text}\n{run.err}")
        return run

    def report(self, *arguments, status=None, stdin=b""):
        run = self.run_tool(*arguments, "-r", "-", status=status, stdin=stdin)
        return json.loads(run.text)

    def counts(self, *arguments):
        return self.report(*arguments)["files"][0]["pairs"]

    def read_bytes(self, name):
        with open(self.path(name), "rb") as file:
            return file.read()

    def read(self, name):
        return self.read_bytes(name).decode()

    def listing(self):
        return sorted(os.listdir(self.folder))


# ---- meshes: (points, faces) ----

def cube(at=(0.0, 0.0, 0.0), size=1.0):
    points = [(at[0] + size * (i & 1), at[1] + size * (i >> 1 & 1), at[2] + size * (i >> 2 & 1))
              for i in range(8)]
    faces = [(0, 2, 1), (1, 2, 3), (4, 5, 6), (5, 7, 6), (0, 1, 4), (1, 5, 4),
             (2, 6, 3), (3, 6, 7), (0, 4, 2), (2, 4, 6), (1, 3, 5), (3, 7, 5)]
    return points, faces


def together(*meshes):
    points, faces = [], []
    for p, f in meshes:
        faces += [tuple(c + len(points) for c in face) for face in f]
        points += p
    return points, faces


CROSSING = together(([(0, 0, 0), (4, 0, 0), (0, 4, 0)], [(0, 1, 2)]),
                    ([(1, 1, -1), (1, 1, 1), (2, 1, 1)], [(0, 1, 2)]))
OVERLAP = together(([(0, 0, 0), (4, 0, 0), (0, 4, 0)], [(0, 1, 2)]),
                   ([(1, 1, 0), (5, 1, 0), (1, 5, 0)], [(0, 1, 2)]))
FOLD = ([(0, 0, 0), (4, 0, 0), (0, 4, 0), (1, 1, 0)], [(0, 1, 2), (1, 0, 3)])
DUPLICATE = ([(0, 0, 0), (4, 0, 0), (0, 4, 0)], [(0, 1, 2), (1, 0, 2)])
PIERCE = ([(0, 0, 0), (4, 0, 0), (0, 4, 0), (1, 1, -1), (1, 1, 1)], [(0, 1, 2), (0, 3, 4)])
TOUCHING = together(([(0, 0, 0), (4, 0, 0), (0, 4, 0)], [(0, 1, 2)]),
                    ([(1, 1, 0), (1, 1, 1), (2, 1, 1)], [(0, 1, 2)]))
DEGENERATE = together(([(0, 0, 0), (4, 0, 0), (0, 4, 0)], [(0, 1, 2)]),
                      ([(1, 1, -1), (1, 1, 0), (1, 1, 1)], [(0, 1, 2)]))
CLEAN = cube()
TWO_CUBES = together(cube(), cube((0.5, 0.5, 0.5)))


def grid(n, height=0.0):
    """2 n^2 faces in a plane."""
    points = [(float(i), float(j), height) for j in range(n + 1) for i in range(n + 1)]
    faces = []
    for j in range(n):
        for i in range(n):
            a = j * (n + 1) + i
            faces += [(a, a + 1, a + n + 2), (a, a + n + 2, a + n + 1)]
    return points, faces


# ---- files ----

def obj_bytes(mesh):
    points, faces = mesh
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in points]
    lines += ["f " + " ".join(str(c + 1) for c in face) for face in faces]
    return ("\n".join(lines) + "\n").encode()


def stl_bytes(mesh):
    points, faces = mesh
    records = [struct.pack("<12fH", 0, 0, 0, *[x for c in face for x in points[c]], 0)
               for face in faces]
    return b"\0" * 80 + struct.pack("<I", len(faces)) + b"".join(records)


def write(path, mesh):
    with open(path, "wb") as file:
        file.write(stl_bytes(mesh) if path.endswith(".stl") else obj_bytes(mesh))
    return path


def limit_memory(size):
    return lambda: resource.setrlimit(resource.RLIMIT_DATA, (size, size))


ALL_SKIPPED = 77  # SKIP_RETURN_CODE of the tests


def slow(test):
    """A test case that takes long: with --slow, `ctest -L slow`, these are run, and without it all
    others."""
    test.is_slow = True
    return test


class Loader(unittest.TestLoader):
    def __init__(self, wants_slow):
        super().__init__()
        self.wants_slow = wants_slow

    def getTestCaseNames(self, case):
        return [name for name in super().getTestCaseNames(case)
                if hasattr(getattr(case, name), "is_slow") == self.wants_slow]


def main():
    words = [word for word in sys.argv if word != "--slow"]
    result = unittest.main(argv=words, verbosity=1, exit=False,
                           testLoader=Loader("--slow" in sys.argv)).result
    skipped = len({getattr(test, "test_case", test).id() for test, _ in result.skipped})
    if skipped:  # tests/house/count_tests.py reads this line
        print(f"{skipped} of {result.testsRun} test cases skipped, 0 in part", flush=True)
    if result.wasSuccessful() and skipped and skipped == result.testsRun:
        sys.exit(ALL_SKIPPED)
    sys.exit(not result.wasSuccessful())
