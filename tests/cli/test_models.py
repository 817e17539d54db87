"""Real and hostile files, against what is known of them (TRUTH.csv of the models folder)."""

from support import *

import csv

# Malformed, but all that is there is whole triangles: read with a warning.
WHOLE = {f"hostile/{name}.stl": code for name, code in
         (("h_stl_count_max", "wrong-count"), ("invalid_triangle_count", "wrong-count"),
          ("truncated", "wrong-count"), ("halfdonut_trailing_byte", "trailing-bytes"))}
MESHES = (".stl", ".obj", ".ply", ".off")


def rows():
    if not MODELS:
        return []
    with open(os.path.join(MODELS, "TRUTH.csv"), newline="") as file:
        lines = [line for line in file if not line.startswith("#")]
    return [row for row in csv.DictReader(lines) if row["precision"] != "f32"]


@unittest.skipIf(not MODELS, "TREEFORM_MODELS_DIR is not set")
class Models(ToolTest):
    def run_limited(self, path, *arguments):
        # The time is there to end a hang, not to judge a slow or busy machine.
        done = subprocess.run([TOOL, path, *arguments], capture_output=True, timeout=600,
                              preexec_fn=None if SANITIZED else limit_memory(200 << 20))
        return Run(done)

    def test_hostile_files_end_in_the_named_status(self):
        for row in rows():
            if not row["file"].startswith("hostile/"):
                continue
            with self.subTest(file=row["file"]):
                run = self.run_limited(os.path.join(MODELS, row["file"]), "-r", "-")
                usable = (row["status"] == "ok" or row["file"] in WHOLE) and \
                    int(row["triangles"]) > int(row["nonfinite_triangles"])
                self.assertIn(run.status, (0, 1) if usable else (3,), msg=run.err)
                report = json.loads(run.text)
                if not SANITIZED:
                    self.assertLess(report["peak_rss"], 200 << 20)
                if not usable:
                    self.assertIn(os.path.basename(row["file"]), run.err)
                if row["file"] in WHOLE:
                    self.assertEqual([w["code"] for w in report["files"][0]["warnings"]],
                                     [WHOLE[row["file"]]])
                    self.assertEqual(report["files"][0]["faces"], int(row["triangles"]))

    def test_counts_are_those_of_the_truth(self):
        checked = 0
        for row in rows():
            if row["status"] != "ok" or not row["file"].endswith(MESHES) or \
                    int(row["triangles"]) <= int(row["nonfinite_triangles"]):
                continue
            with self.subTest(file=row["file"]):
                report = self.report(os.path.join(MODELS, row["file"]), "--touching", "--vertices",
                                     "equal", "--limit", "0")
                entry = report["files"][0]
                pairs = entry["pairs"]
                found = sum(n for kind, n in pairs.items() if kind != "degenerate")
                self.assertEqual(found, int(row["si_pairs"]))
                self.assertEqual(pairs["duplicate"], int(row["si_pairs_share3"]))
                self.assertEqual(entry["triangles"], int(row["triangles"]))
                self.assertEqual(entry["faces"], int(row["faces_stored"]))
                self.assertEqual(entry["vertices"]["stored"], int(row["vertices_stored"]))
                self.assertEqual(entry["skipped"]["non_finite"], int(row["nonfinite_triangles"]))
                self.assertEqual(entry["skipped"]["degenerate"], int(row["degenerate_triangles"]))
                checked += 1
        print(f"{checked} models checked", file=sys.stderr)
        self.assertGreater(checked, 50)


if __name__ == "__main__":
    main()
