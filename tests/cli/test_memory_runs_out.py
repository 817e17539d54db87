"""Memory that runs out ends a tool with status 5 and one sentence, and leaves nothing half-written:
of each tool, 200 allocations chosen at random fail, half of them with all that follow."""

from support import *

import random
from concurrent.futures import ThreadPoolExecutor

FAILING = os.environ.get("TREEFORM_FAILING_ALLOCATIONS", "")
PLACES = 200
TOOLS = {
    "TF_BOOLEAN": ["union", "a.obj", "b.obj", "-o", "o.stl", "--report", "r.json"],
    "TF_PLACE": ["drop", "a.obj", "-o", "o.stl", "--png", "p.png"],
    "TF_REPAIR": ["a.obj", "-o", "o.stl", "--report", "r.json"],
    "TF_SELFINTERSECT": ["both.obj", "-o", "o.ply", "--html", "s.html", "--report", "r.json"],
    "TF_WELD": ["both.obj", "-t", "0.01", "-o", "o.ply", "--report", "r.json"],
}


@unittest.skipIf(not FAILING, "allocations cannot be made to fail here")
class MemoryRunsOut(ToolTest):
    def setUp(self):
        super().setUp()
        points, faces = cube()
        moved = [tuple(x + 0.3 for x in p) for p in points]
        write(self.path("a.obj"), (points, faces))
        write(self.path("b.obj"), (moved, faces))
        write(self.path("both.obj"), together((points, faces), (moved, faces)))

    def run_in_folder(self, tool, words, settings):
        with tempfile.TemporaryDirectory(dir=self.folder) as folder:
            given = [self.path(word) if word.endswith(".obj") else word for word in words]
            done = subprocess.run([os.environ[tool], *given], cwd=folder, text=True, timeout=100,
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                  env={**os.environ, "LD_PRELOAD": FAILING, **settings})
            return done, [name for name in os.listdir(folder) if name.startswith(".")]

    def count_of(self, tool, words):
        at = self.path("count")
        done, _ = self.run_in_folder(tool, words, {"TREEFORM_COUNT_TO": at})
        self.assertIn(done.returncode, (0, 1), done.stderr)
        with open(at) as file:
            return int(file.read())

    def test_it_is_said_and_nothing_is_left(self):
        source = random.Random(44)
        for tool, words in TOOLS.items():
            most = self.count_of(tool, words)
            self.assertGreater(most, 1000)
            places = [(source.randint(1, most), alone) for alone in (True, False)
                      for _ in range(PLACES // 2)]

            def run(place):
                at, alone = place
                settings = {"TREEFORM_FAIL_AT": str(at)}
                if alone:
                    settings["TREEFORM_FAIL_ONCE"] = "1"
                return self.run_in_folder(tool, words, settings)

            with ThreadPoolExecutor(2) as pool:
                for (at, alone), (done, left) in zip(places, pool.map(run, places)):
                    with self.subTest(tool=tool, at=at, alone=alone):
                        self.assertEqual(left, [])
                        # Some do without that one; and threads ask for more or less.
                        self.assertIn(done.returncode, (0, 1, 5), done.stderr)
                        if done.returncode == 5:
                            self.assertEqual(done.stderr.count(": error: "), 1, done.stderr)
                            self.assertRegex(done.stderr, "memory")


if __name__ == "__main__":
    main()
