"""What tf-repair writes, judged by admesh: nothing to repair, and the volume is ours."""

import re

from boolean_support import *
from support import ToolTest

KINDS = ("selfint", "nonmanifold", "open", "degenerate", "duplicates", "clean", "coplanar")
NOTHING = ("Edges fixed", "Facets removed", "Facets added", "Facets reversed", "Backwards edges",
           "Degenerate facets")


def models():
    """Of the folders of TREEFORM_MODELS_DIR that are named after what is wrong."""
    for kind in KINDS:
        folder = os.path.join(MODELS, kind)
        for name in sorted(os.listdir(folder)):
            if name.rsplit(".")[-1] in ("stl", "obj", "ply", "off"):
                yield os.path.join(folder, name)


@unittest.skipUnless(shutil.which("admesh"), "admesh is not installed")
class Admesh(ToolTest):
    tool = MEND

    def judge(self, name, volume):
        header = self.read_bytes(name)[:80]
        self.assertIn(0, header)  # admesh prints it as text, as far as a NUL
        self.assertFalse(header.startswith(b"solid"))
        done = subprocess.run(["admesh", self.path(name)], capture_output=True, timeout=120)
        self.assertEqual(done.returncode, 0, msg=done.stderr)
        said = done.stdout.decode(errors="replace")  # the header may be any bytes
        for words in NOTHING:
            self.assertRegex(said, words + r" +: +0\n", msg=f"{name}\n{said}")
        self.assertRegex(said, r"Total disconnected facets +: +0 ", msg=said)
        # They add up floats, and print six digits behind the point.
        theirs = float(re.search(r"Volume +: +(\S+)", said)[1])
        self.assertAlmostEqual(theirs, volume, delta=1e-6 + 5e-5 * abs(volume), msg=name)

    def written(self, path, name, *options):
        """Whether there was something to write."""
        run = self.run_tool(path, "-o", name, "-r", "-", "-f", *options)
        self.assertIn(run.status, (0, 1), msg=run.err)
        if run.status == 1:
            return False
        self.judge(name, json.loads(run.text)["files"][0]["repair"]["volume"]["after"])
        return True

    def test_small_ones(self):
        points, faces = cube()
        for name, mesh in (
                ("cube", CLEAN), ("hole", (points, faces[2:])), ("two", TWO_CUBES),
                ("edge", together(cube(), cube((1.0, 1.0, 0.0)))),
                ("corner", together(cube(), cube((1.0, 1.0, 1.0)))),
                ("faces", together(cube(), cube((1.0, 0.0, 0.0)))),
                ("turned", (points, [(a, c, b) for a, b, c in faces[:4]] + faces[4:])),
                ("apart", together(cube((1 / 3, 0.1, 0.7)), cube((1.0, 1 / 3, 0.2))))):
            with self.subTest(name):
                self.assertTrue(self.written(write(self.path(name + ".obj"), mesh), name + ".stl"))

    def test_headers_that_have_no_end(self):
        model = stl_bytes(together(CLEAN, cube((0.5, 0.5, 0.5))))[80:]
        for header in (b"\xff" * 80, b"solid" + b"*" * 75, b" " * 80, b"COLOR=" + bytes(range(74))):
            with self.subTest(header):
                with open(self.path("in.stl"), "wb") as file:
                    file.write(header + model)
                self.assertTrue(self.written(self.path("in.stl"), "out.stl"))

    @unittest.skipUnless(MODELS, "needs TREEFORM_MODELS_DIR")
    def test_real_ones(self):
        count = 0
        for path in models():
            with self.subTest(path):
                count += self.written(path, "out.stl", "--timeout", "100")
        self.assertGreaterEqual(count, 36)


main()
