"""The script of pages is what tools/picture/viewer/bundle.sh makes of the modules, byte by byte."""

import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "cli"))

import support  # noqa: E402

VIEWER = ROOT / "tools" / "picture" / "viewer"
KNOWN = "0.17.0"  # of Debian 12; others may write it another way


def version():
    found = shutil.which("esbuild")
    return subprocess.run([found, "--version"], capture_output=True,
                          text=True).stdout.strip() if found else ""


class Bundle(unittest.TestCase):
    @unittest.skipUnless(version() == KNOWN, f"needs esbuild {KNOWN}: apt-get install esbuild")
    def test_the_bundle_is_made_of_the_modules(self):
        with tempfile.TemporaryDirectory() as folder:
            made = pathlib.Path(folder, "made.js")
            subprocess.run([VIEWER / "bundle.sh", made], check=True)
            self.assertEqual(made.read_bytes(), (VIEWER / "viewer.min.js").read_bytes(),
                             "run tools/picture/viewer/bundle.sh")

    def test_the_bundle_names_its_license_and_no_address(self):
        text = (VIEWER / "viewer.min.js").read_text()
        self.assertIn("Apache-2.0", text.splitlines()[0] + text.splitlines()[-1] + text[:200])
        for word in ("http:", "https:", "import(", "fetch(", "XMLHttpRequest", "WebSocket",
                     "eval("):
            self.assertNotIn(word, text)

    def test_modules_are_short(self):
        lines = {path.name: len(path.read_text().splitlines()) for path in VIEWER.glob("*.js")
                 if path.name != "viewer.min.js"}
        self.assertLess(max(lines.values()), 400, lines)
        self.assertLess(sum(lines.values()), 1500, lines)


if __name__ == "__main__":
    support.main()
