"""The JSON report, several inputs, standard streams, the same answer on any number of threads."""

from support import *

import hashlib

NUMBER = (int, float)
OPTIONAL_COUNT = (int, type(None))

HEAD = {"schema": str, "tool": str, "version": str, "command": list, "exit": int, "unit": str,
        "files": list, "seconds": dict, "threads": int, "peak_rss": int}
FILE = {"input": str, "exit": int, "error": type(None), "format": str, "sha256": str,
        "precision_in": str, "tiles": type(None), "vertices": dict, "faces": int,
        "triangles": int, "searched": int, "box": dict, "skipped": dict, "work": dict,
        "tolerance": dict,
        "pairs": dict, "complete": bool,
        "faces_hit": int, "regions": list, "listed": int, "truncated": bool, "list": list,
        "repair": type(None), "output": (dict, type(None)), "warnings": list}
PAIRS = dict.fromkeys(["crossing", "overlap", "fold", "duplicate", "pierce", "touching",
                       "degenerate"], OPTIONAL_COUNT)
REGION = {"id": int, "faces": int, "pairs": int, "box": dict, "center": list, "components": list}
STEPS = dict.fromkeys(["read", "prepare", "tree", "pairs", "regions", "repair", "write"], NUMBER)


class Report(ToolTest):
    def assert_keys(self, value, schema):
        self.assertEqual(sorted(value), sorted(schema))
        for key, kind in schema.items():
            self.assertIsInstance(value[key], kind, msg=key)

    def timeless(self, report):
        for key in ("seconds", "peak_rss", "threads", "command"):
            del report[key]
        return report

    def test_every_key_is_there_and_of_its_type(self):
        part = write(self.path("part.obj"), TWO_CUBES)
        report = self.report(part)
        self.assert_keys(report, HEAD)
        self.assert_keys(report["seconds"], STEPS)
        entry = report["files"][0]
        self.assert_keys(entry, FILE)
        self.assert_keys(entry["pairs"], PAIRS)
        self.assert_keys(entry["vertices"], {"stored": int, "distinct": int})
        self.assert_keys(entry["skipped"], {"non_finite": int, "degenerate": int})
        self.assert_keys(entry["work"], {"box_pairs": int, "exact_pairs": int})
        self.assert_keys(entry["tolerance"], {"given": str, "used": NUMBER, "joined": int})
        for region in entry["regions"]:
            self.assert_keys(region, REGION)
            self.assert_keys(region["box"], {"min": list, "max": list})
        for a, b, kind, region in entry["list"]:
            self.assertLess(a, b)
            self.assertIn(kind, PAIRS)
            self.assertLess(region, len(entry["regions"]))

    def test_the_facts_are_those_of_the_file(self):
        part = write(self.path("part.stl"), TWO_CUBES)
        report = self.report(part, "--units", "mm")
        entry = report["files"][0]
        self.assertEqual((report["schema"], report["tool"], report["exit"], report["unit"]),
                         ("tf-selfintersect-report/1", "tf-selfintersect", 1, "mm"))
        self.assertEqual(entry["sha256"], hashlib.sha256(stl_bytes(TWO_CUBES)).hexdigest())
        self.assertEqual(entry["vertices"], {"stored": 72, "distinct": 16})
        self.assertEqual((entry["format"], entry["precision_in"]), ("stl-binary", "float"))
        self.assertEqual(entry["box"], {"min": [0, 0, 0], "max": [1.5, 1.5, 1.5]})
        self.assertEqual(len(entry["list"]), sum(n or 0 for n in entry["pairs"].values()))
        self.assertEqual(entry["faces_hit"], len({f for pair in entry["list"] for f in pair[:2]}))
        self.assertEqual([r["components"] for r in entry["regions"]], [[0, 1]])
        self.assertEqual(sum(r["pairs"] for r in entry["regions"]), len(entry["list"]))

    def test_numbers_read_back_as_the_doubles_of_the_file(self):
        points = [(0.1, 0.2, 0.30000000000000004), (1 / 3, 2.0, 5e-324), (1e300, 0.0, 0.0)]
        part = write(self.path("part.obj"), (points, [(0, 1, 2)]))
        box = self.report(part)["files"][0]["box"]
        self.assertEqual(box["min"], [0.1, 0.0, 0.0])
        self.assertEqual(box["max"], [1e300, 2.0, 0.30000000000000004])

    def test_two_runs_and_any_threads_give_the_same_report_and_files(self):
        part = write(self.path("part.obj"), together(TWO_CUBES, grid(40, 0.25), PIERCE, FOLD))
        reports, files = [], []
        for threads in (1, 2, 8, 2):
            report = self.report(part, "-j", threads, "--pairs", "p.csv", "--curves", "c.obj",
                                 "-o", "m.ply", "--html", "h.html", "-f")
            reports.append(self.timeless(report))
            files.append([self.read_bytes(name)
                          for name in ("p.csv", "c.obj", "m.ply", "h.html")])
        for other in reports[1:]:
            self.assertEqual(other, reports[0])
        for other in files[1:]:
            self.assertEqual(other, files[0])

    def test_several_inputs_give_an_entry_each_and_the_highest_status(self):
        clean = write(self.path("clean.obj"), CLEAN)
        crossing = write(self.path("crossing.stl"), CROSSING)
        report = self.report(clean, crossing, status=1)
        self.assertEqual([f["exit"] for f in report["files"]], [0, 1])
        report = self.report(crossing, self.path("missing.obj"), clean, status=3)
        self.assertEqual([f["exit"] for f in report["files"]], [1, 3, 0])
        error = report["files"][1]["error"]
        self.assertEqual(error["code"], "read")
        self.assertIn("missing.obj", error["text"])
        run = self.run_tool(clean, crossing, status=1)
        self.assertEqual(len(run.text.splitlines()), 2)

    def test_messages_name_the_input_once(self):
        run = self.run_tool("-", status=3)
        self.assertEqual(run.err.count("standard input"), 1, msg=run.err)
        with open(self.path("nan.obj"), "wb") as file:
            file.write(obj_bytes(CROSSING) + b"v nan 0 0\nf 1 2 -1\n")
        data = self.read_bytes("nan.obj")
        for given, name in (("nan.obj", "nan.obj"), ("-", "standard input")):
            for tool in ([PLACE, "drop", given, "-n"], [BOOLEAN, "union", given, "-n"]):
                err = subprocess.run(tool, cwd=self.folder, capture_output=True, input=data,
                                     timeout=120).stderr.decode()
                self.assertIn(f"warning: {name}: 1 face with a NaN", err)
                self.assertEqual([line for line in err.splitlines()
                                  if line.count(f"{name}: ") > 1 or " -: " in line], [])

    def test_standard_input_is_read_and_standard_output_carries_only_data(self):
        run = self.run_tool("-", stdin=obj_bytes(CROSSING), status=1)
        self.assertTrue(run.text.startswith("standard input: 1 self-intersecting pair"))
        report = self.report("-", "--format", "stl", stdin=stl_bytes(CROSSING))
        self.assertEqual(report["files"][0]["sha256"],
                         hashlib.sha256(stl_bytes(CROSSING)).hexdigest())
        run = self.run_tool("-", "-o", "-", "--output-format", "ply", stdin=obj_bytes(CROSSING))
        self.assertTrue(run.out.startswith(b"ply\n"))
        self.assertIn("1 crossing", run.err)
        run = self.run_tool("-", "--pairs", "-", stdin=obj_bytes(CROSSING))
        self.assertEqual(run.text, "face,face,kind,region\n0,1,crossing,0\n")

    def test_a_report_is_written_also_when_the_input_is_bad(self):
        with open(self.path("bad.obj"), "w") as file:
            file.write("v 0 0\nf 1 1 1\n")
        self.run_tool("bad.obj", "-r", "r.json", status=3)
        report = json.loads(self.read("r.json"))
        self.assertEqual((report["exit"], report["files"][0]["exit"]), (3, 3))
        self.assertIn("bad.obj:1", report["files"][0]["error"]["text"])

    def test_a_file_without_triangles_is_an_input_error(self):
        with open(self.path("points.obj"), "w") as file:
            file.write("v 0 0 0\nv 1 0 0\n")
        run = self.run_tool("points.obj", status=3)
        self.assertIn("points.obj: no triangles (2 points)", run.err)
        nan = float("nan")
        write(self.path("nan.stl"), ([(nan, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)]))
        self.assertIn("no triangle with finite coordinates",
                      self.run_tool("nan.stl", status=3).err)
        os.mkdir(self.path("empty"))
        self.assertEqual(self.run_tool("empty", status=3).err, "tf-selfintersect: error: empty: is "
                         "a folder without any file in a supported format\n")
        self.assertEqual(self.report("empty")["files"][0]["error"]["code"], "read")

    def test_quiet_verbose_and_log(self):
        part = write(self.path("part.obj"), CROSSING)
        run = self.run_tool(part, "-q", status=1)
        self.assertEqual((run.text, run.err), ("", ""))
        self.assertNotEqual(self.run_tool("missing.obj", "-q", status=3).err, "")
        self.assertIn("region 0:", self.run_tool(part, "-v").err)
        self.assertRegex(self.run_tool(part, "-v").err,
                         r"\ntf-selfintersect: \d+\.\d\d s: reading \d+\.\d\d, "
                         r"geometry \d+\.\d\d \(\d+ %\), writing \d+\.\d\d\n$")
        self.assertNotIn("geometry", self.run_tool(part).err)
        self.assertIn("debug:", self.run_tool(part, "-vv").err)
        self.assertNotIn("debug:", self.run_tool(part, "-v").err)
        self.run_tool(part, "-v", "--log", "log.txt")
        self.run_tool(part, "--log", "log.txt")
        log = self.read("log.txt")
        self.assertEqual(log.count("1 self-intersecting pair"), 2)
        self.run_tool(part, "--log", "no/such/folder", status=4)

    def test_progress_shows_only_when_asked_for_without_a_terminal(self):
        part = write(self.path("part.obj"), TWO_CUBES)
        self.assertNotIn("%", self.run_tool(part).err)
        self.assertIn("%", self.run_tool(part, "--progress").err)


if __name__ == "__main__":
    main()
