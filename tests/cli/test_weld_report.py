"""The report of tf-weld, standard streams, limits, the same answer on any number of threads."""

from weld_support import *

import hashlib
import random

NUMBER = (int, float)
HEAD = {"schema": str, "tool": str, "version": str, "command": list, "exit": int, "unit": str,
        "files": list, "seconds": dict, "threads": int, "peak_rss": int}
FILE = {"input": str, "exit": int, "error": type(None), "format": str, "sha256": str,
        "precision_in": str, "sources": list, "tiles": type(None), "points": dict, "faces": dict,
        "polygons": dict,
        "box": dict, "skipped": dict, "tolerance": dict, "rule": str, "keep": str, "order": str,
        "same": list, "displacement": dict, "nonmanifold_edges": dict, "kept_apart": type(None),
        "output": (dict, type(None)), "map": type(None), "removed": type(None),
        "label": type(None), "withheld": type(None), "warnings": list}


class Report(WeldTest):
    def assert_keys(self, value, schema):
        self.assertEqual(sorted(value), sorted(schema))
        for key, kind in schema.items():
            self.assertIsInstance(value[key], kind, msg=key)

    def test_every_key_is_there_and_of_its_type(self):
        write(self.path("cube.stl"), cube())
        report = self.report("cube.stl", "-o", "out.obj", status=0)
        self.assert_keys(report, HEAD)
        self.assert_keys(report["seconds"], dict.fromkeys(["read", "weld", "write"], NUMBER))
        entry = report["files"][0]
        self.assert_keys(entry, FILE)
        count = dict.fromkeys
        self.assert_keys(entry["points"],
                         count(["in", "out", "removed", "distinct", "groups"], int))
        self.assert_keys(entry["faces"],
                         count(["in", "out", "collapsed", "degenerate", "flipped"], int))
        self.assert_keys(entry["polygons"], count(["in", "out"], int))
        self.assert_keys(entry["nonmanifold_edges"], count(["before", "after"], int))
        self.assert_keys(entry["tolerance"], {"given": str, "used": NUMBER})
        self.assert_keys(entry["displacement"], {"max": NUMBER})
        self.assert_keys(entry["sources"][0], {"input": str, "format": str, "sha256": str,
                                               "precision_in": str, "points": int, "faces": int,
                                               "first_point": int})
        self.assert_keys(entry["output"], {"file": str, "format": str, "precision_out": str,
                                           "max_move": NUMBER, "within_tolerance": int})

    def test_the_facts_are_those_of_the_file(self):
        write(self.path("cube.stl"), cube())
        report = self.report("cube.stl", "--units", "mm", "--rule", "chain", "--keep", "max:z",
                             status=0)
        self.assertEqual((report["schema"], report["tool"], report["unit"]),
                         ("tf-weld-report/1", "tf-weld", "mm"))
        entry = report["files"][0]
        self.assertEqual(entry["sha256"], hashlib.sha256(stl_bytes(cube())).hexdigest())
        self.assertEqual(entry["points"],
                         {"in": 36, "out": 8, "removed": 28, "distinct": 8, "groups": 8})
        self.assertEqual((entry["format"], entry["precision_in"]), ("stl-binary", "float"))
        self.assertEqual((entry["rule"], entry["keep"]), ("chain", "max:z"))
        self.assertEqual(entry["box"], {"min": [0, 0, 0], "max": [1, 1, 1]})

    def test_the_displacement_is_that_of_the_furthest_point(self):
        self.cloud("in.xyz", [(0, 0, 0), (0.25, 0, 0), (0, 0.5, 0), (9, 9, 9)])
        entry = self.entry("in.xyz", "-t", "0.5", status=0)
        self.assertEqual((entry["displacement"], entry["points"]["groups"]), ({"max": 0.5}, 1))

    def test_a_report_is_written_also_when_the_input_is_bad(self):
        self.write("bad.obj", "v 0 0\nf 1 1 1\n")
        self.run_tool("bad.obj", "-r", "r.json", status=3)
        entry = json.loads(self.read("r.json"))["files"][0]
        self.assertIn("bad.obj:1", entry["error"]["text"])
        self.assertEqual(sorted(entry), sorted(FILE))
        self.write("empty.ply", ply_text(XYZ, []))
        self.assertIn("no points", self.run_tool("empty.ply", "--check", status=3).err)

    def test_two_runs_and_any_threads_give_the_same_report_and_files(self):
        generator = random.Random(5)
        self.cloud("in.xyz", [[generator.gauss(0, 1) for _ in range(4)] for _ in range(3000)])
        seen = []
        for threads in (1, 2, 8, 2):
            report = self.report("in.xyz", "-j", threads, "-t", "0.1", "--keep", "mean", "-o",
                                 "out.ply", "--map", "map.csv", "--removed", "gone.xyz", "-f",
                                 status=0)
            for key in ("seconds", "peak_rss", "threads", "command"):
                del report[key]
            seen.append((report, *(self.read_bytes(name)
                                   for name in ("out.ply", "map.csv", "gone.xyz"))))
        for other in seen[1:]:
            self.assertEqual(other, seen[0])

    def test_standard_streams_carry_data_alone(self):
        run = self.run_tool("-", "-o", "-", "--output-format", "xyz", status=0,
                            stdin=b"0 0 0\n0 0 0\n1 0 0\n")
        self.assertEqual(run.text, "0 0 0\n1 0 0\n")
        self.assertIn("standard input: 1 of 3 points merged, 2 kept (equal)", run.err)
        run = self.run_tool("--format", "stl", "-", "-o", "-", "--output-format", "ply", status=0,
                            stdin=stl_bytes(cube()))
        self.assertTrue(run.out.startswith(b"ply\n"))

    def test_quiet_says_nothing_and_verbose_more(self):
        self.cloud("in.xyz", [(0, 0, 0), (0, 0, 0)])
        run = self.run_tool("in.xyz", "--check", "-q", status=1)
        self.assertEqual((run.text, run.err), ("", ""))
        self.assertIn("1 group of two points", self.run_tool("in.xyz", "--check", "-v").err)

    def test_the_tolerance_used_is_told_in_file_units(self):
        self.cloud("in.xyz", [(0, 0, 0), (3, 4, 0)])
        self.assertIn("(within 2.5, 50% of the diagonal)",
                      self.run_tool("in.xyz", "--check", "-t", "50%", status=0).text)

    def test_a_time_limit_stops_with_5_and_leaves_nothing(self):
        self.cloud("in.xyz", [(i * 0.37 % 1, i * 0.61 % 1, i * 0.83 % 1) for i in range(200_000)])
        run = self.run_tool("in.xyz", "-t", "0.01", "-o", "out.ply", "--timeout", "0.01", status=5)
        self.assertIn("--timeout", run.err)
        self.assertEqual(self.listing(), ["in.xyz"])

    @unittest.skipIf(SANITIZED, "shadow memory is no memory of the tool")
    def test_a_memory_limit_stops_with_5_and_leaves_nothing(self):
        count = 6_000_000
        header = (f"ply\nformat binary_little_endian 1.0\nelement vertex {count}\n"
                  "property float x\nproperty float y\nproperty float z\nend_header\n")
        self.write("in.ply", header)
        os.truncate(self.path("in.ply"), len(header) + 12 * count)  # all of them in one place
        for memory, more in (("100M", ["--keep-manifold"]),
                             ("40M", ["--keep", "mean"])):  # too little for tiles, too
            run = self.run_tool("in.ply", "-o", "out.ply", "--memory", memory, *more, status=5)
            self.assertRegex(run.err, "--memory|would be enough")
            self.assertEqual(self.listing(), ["in.ply"])

    @unittest.skipIf(SANITIZED, "shadow memory is no memory of the tool")
    def test_a_limit_too_small_for_threads_is_no_bug(self):
        self.cloud("in.xyz", [(0, 0, 0)] * 100_000)
        self.run_tool("in.xyz", "--check", "--memory", "1M", status=5)


if __name__ == "__main__":
    main()
