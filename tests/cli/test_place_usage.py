"""The command line of tf-place: help, refusals; its report; the same on any number of threads."""

from place_support import *

NUMBER = (int, float)
NULL = type(None)
FILE = {"input": str, "error": NULL, "format": str, "sha256": str, "precision_in": str,
        "faces": int, "triangles": int, "box": dict, "mode": str, "fixed": list, "skipped": dict,
        "work": dict,
        "clearance": dict, "max_travel": (str, NULL), "bed": (dict, NULL), "placed": (bool, NULL),
        "reason": (str, NULL), "status_at_start": str, "status": str, "inside": (str, NULL),
        "distance": (*NUMBER, NULL), "surface_distance": (*NUMBER, NULL), "closest": (dict, NULL),
        "direction": (list, NULL), "travel": (*NUMBER, NULL), "backed_off": (int, NULL),
        "matrix": (list, NULL), "contacts": list, "contact_count": int, "sides": list,
        "chosen": (int, NULL), "corrected": (*NUMBER, NULL), "tolerance": dict,
        "align": (dict, NULL),
        "center_of_mass": (dict, NULL), "turn": (dict, NULL), "features": (dict, NULL),
        "tries": (int, NULL), "plates": (int, NULL), "density": (*NUMBER, NULL),
        "fits": (bool, NULL), "parts": list, "not_placed": list, "rounding": (dict, NULL),
        "matrix_file": (str, NULL),
        "effort": (dict, NULL), "depth": (dict, NULL), "points": (dict, NULL),
        "deviation": (dict, NULL),
        "output": (dict, NULL), "warnings": list, "exit": int}


class Usage(PlaceTest):
    def setUp(self):
        super().setUp()
        self.mesh("a.obj", box((1, 1, 5.5), (2, 2, 6.5)))
        self.mesh("floor.obj", box((0, 0, 0), (4, 4, 1)))

    def refused(self, *arguments):
        run = self.run_tool(*arguments, status=2)
        self.assertEqual(run.text, "")
        self.assertTrue(run.err.startswith("tf-place: error: "), msg=run.err)
        self.assertEqual([name for name in self.listing() if name.startswith("out")], [])
        return run.err

    def test_help_fits_80_columns_and_names_what_is_accepted(self):
        run = self.run_tool("--help", status=0)
        self.assertIn("LAS and LAZ are read, but not written", run.text)
        self.assertTrue(run.text.startswith("Usage: tf-place MODE [OPTIONS] MOVING..."))
        self.assertEqual([line for line in run.text.splitlines() if len(line) > 80], [])
        for word in ("Modes:", "Options:", "Output:", "Common options:", "Examples:",
                     "Exit status:", "drop", "slide", "mate", "separate", "measure", "--fixed",
                     "--bed", "--direction", "--clearance", "--max-travel", "--start", "--scene",
                     "--matrix"):
            self.assertIn(word, run.text)

    def test_modes_and_values_are_checked(self):
        self.assertIn("not a mode", self.refused("fly", "a.obj"))
        self.refused()
        self.refused("drop")
        for options in (["-d", "0,0,0"], ["-d", "1,2"], ["-d", "x"], ["-d", "0,0,nan"],
                        ["--bed", "low"], ["--clearance", "-1"], ["--max-travel", "x"]):
            self.refused("drop", "a.obj", "-o", "out.obj", *options)

    def test_what_would_do_nothing_is_refused(self):
        fixed = ("--fixed", "floor.obj")
        self.assertIn("needs --fixed", self.refused("mate", "a.obj"))
        self.refused("mate", "a.obj", *fixed, "--bed", "0")
        self.refused("separate", "a.obj", *fixed, "-d", "1,0,0")
        self.refused("drop", "a.obj", "-d", "0,0,1")
        self.refused("drop", "a.obj", "--scene")
        self.refused("lay", "a.obj", "--scene", "-o", "out.obj")
        self.refused("pack", "a.obj", "--size", "9,9", "--scene", "-o", "out.obj")
        self.refused("drop", "a.obj", "--precision", "float")
        self.refused("measure", "a.obj", *fixed, "--matrix", "out.txt")
        self.refused("measure", "a.obj", *fixed, "--max-travel", "1")
        self.refused("measure", "a.obj", *fixed, "--in-place")
        self.refused("drop", "a.obj", "--keep-spin")
        self.refused("lay", "a.obj", *fixed)
        self.refused("lay", "a.obj", "--largest-face", "--face-point", "0,0,0")
        self.assertIn("needs --size", self.refused("pack", "a.obj"))
        self.refused("pack", "a.obj", "--size", "9,9", *fixed)
        self.refused("pack", "a.obj", "--size", "9,-9")
        self.refused("drop", "a.obj", "--seed", "1")
        self.refused("drop", "a.obj", "--scale")
        self.refused("align", "a.obj", *fixed, "--overlap", "2")
        for bad in (("--overlap", "0.5", "--trim", "0.5"), ("--trim", "1"), ("--trim", "-1"),
                    ("--starts", "0"),
                    ("--scale=2",), ("--scale=3,2",), ("--scale=0,2",), ("--scale=1,2,3",),
                    ("--scale=1,x",),
                    ("--iterations", "many"), ("--align-tolerance", "-1"), ("--metric", "line"),
                    ("--weights", "some")):
            self.refused("align", "a.obj", *fixed, *bad)
        for fits in (("--trim", "0.5"), ("--starts", "9"), ("--iterations", "9"),
                     ("--align-tolerance", "1e-3"),
                     ("--metric", "point"), ("--weights", "equal")):
            self.refused("measure", "a.obj", *fixed, *fits)
        self.refused("align", "a.obj", *fixed, *fixed)

    def test_a_flag_takes_no_value(self):
        for flag in ("--in-place", "--quiet", "--help", "--version"):
            self.assertIn(flag + " takes no value", self.refused("drop", "a.obj", flag + "=3"))

    def test_a_report_has_a_line_for_each_contact_and_row(self):
        self.mesh("plate.obj", grid(3))
        text = self.run_tool("slide", self.mesh("b.obj", grid(3, 3.0)), "--fixed", "plate.obj",
                             "-r", "-",
                             "-n", status=0).text
        entry = json.loads(text)["files"][0]
        self.assertGreater(len(entry["contacts"]), 50)
        lines = [line.strip().rstrip(",") for line in text.splitlines()]
        for contact in entry["contacts"]:
            self.assertIn(contact, [json.loads(line) for line in lines
                                    if line.startswith('{"point"')])
        for row in entry["matrix"]:
            self.assertIn(row, [json.loads(line) for line in lines if line.startswith("[")
                                and len(line) > 1
                                and line.endswith("]")])
        self.assertLess(len(lines), len(entry["contacts"]) + 150)

    def test_a_report_says_where_to_start(self):
        self.run_tool("drop", "a.obj", "--fixed", "floor.obj", "-o", "down.obj", "-r", "down.json",
                      status=0)
        down = self.entry("measure", "a.obj", "--fixed", "floor.obj", "--start", "down.json",
                          status=0)
        self.assertEqual((down["status"], down["distance"]), ("touching", 0))
        self.run_tool("pack", "a.obj", "floor.obj", "--size", "9,9", "-n", "-r", "plate.json",
                      status=0)
        for name, text, said in (("plate.json", None, "has 2 matrices"),
                                 ("none.json", '{"files": [{"matrix": null}]}', "has 0 matrices"),
                                 ("other.json", '{"x": 1}', "neither a matrix nor a report"),
                                 ("cut.json", '{"files": [', "neither a matrix nor a report"),
                                 ("odd.json", '{"files": [3, {"parts": 4, "matrix": [1, "x"]}]}',
                                  "expected 16 numbers")):
            if text:
                with open(self.path(name), "w") as file:
                    file.write(text)
            self.assertIn(said, self.run_tool("drop", "a.obj", "--start", name, "-n", status=3).err)

    def test_a_run_that_gives_nothing_back_is_refused(self):
        self.assertIn("-o FILE", self.refused("drop", "a.obj"))
        self.assertIn("dropped by 5.5", self.run_tool("drop", "a.obj", "-n", status=0).text)
        self.run_tool("drop", "a.obj", "--matrix", "m.txt", status=0)
        self.run_tool("measure", "a.obj", "--fixed", "floor.obj", status=0)

    def test_no_output_replaces_a_file_that_is_read(self):
        before = self.read_bytes("floor.obj")
        for option in ("-o", "--matrix", "-r"):
            err = self.refused("drop", "a.obj", "--fixed", "floor.obj", option, "floor.obj", "-f")
            self.assertIn("is an input", err)
        self.assertIn("is an input", self.refused("drop", "a.obj", "--fixed", "floor.obj", "-n",
                                                  "--log", "./floor.obj"))
        self.assertIn("is also read for other inputs",
                      self.refused("drop", "a.obj", "floor.obj", "--fixed", "./floor.obj",
                                   "--in-place"))
        self.assertEqual(self.read_bytes("floor.obj"), before)
        with open(self.path("m.txt"), "w") as file:
            file.write("1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n")
        before = self.read_bytes("m.txt")
        for option in ("--matrix", "-r", "--log"):
            self.assertIn("is an input",
                          self.refused("drop", "a.obj", "--start", "m.txt", "-n", option,
                                                      "./m.txt", "-f"))
        self.assertEqual(self.read_bytes("m.txt"), before)
        self.assertIn("two outputs", self.refused("drop", "a.obj", "-o", "out.obj", "--matrix",
                                                  "./out.obj"))

    def test_bad_files_are_named(self):
        self.assertIn("none.obj", self.run_tool("drop", "a.obj", "-n", "--fixed", "none.obj",
                                                status=3).err)
        with open(self.path("m.txt"), "w") as file:
            file.write("1 0 0 0\n0 1 0 0\n0 0 1\n")
        self.assertIn("found 11", self.run_tool("drop", "a.obj", "--start", "m.txt", "-n",
                                                status=3).err)
        with open(self.path("m.txt"), "w") as file:
            file.write("1 0 0 0 0 1 0 0 0 0 1 0 0 0 1 1")
        self.assertIn("last row", self.run_tool("drop", "a.obj", "--start", "m.txt", "-n",
                                                status=3).err)
        self.run_tool("drop", "a.obj", "-o", "out.obj", status=0)
        self.run_tool("drop", "a.obj", "-o", "out.obj", status=4)

    def test_every_key_is_there_and_of_its_type(self):
        fixed = ("--fixed", "floor.obj")
        for arguments in (["drop", "a.obj"], ["lay", "a.obj"],
                          ["drop", "a.obj", *fixed, "-o", "out.stl"],
                          ["slide", "a.obj", *fixed, "-d", "1,0,0"],
                          ["measure", "a.obj", *fixed], ["separate", "a.obj", *fixed],
                          ["mate", "a.obj", *fixed, "--clearance", "0.5"]):
            report = self.report(*arguments)
            self.assertEqual(report["schema"], "tf-place-report/1")
            self.assertEqual(sorted(report["seconds"]),
                             ["prepare", "read", "round", "search", "write"])
            entry = report["files"][0]
            self.assertEqual(sorted(entry), sorted(FILE))
            for key, kind in FILE.items():
                self.assertIsInstance(entry[key], kind, msg=f"{arguments} {key}")
            self.assertEqual(entry["mode"], arguments[0])

    def test_a_report_is_written_also_when_a_file_is_bad(self):
        entry = self.report("drop", "none.obj", status=3)["files"][0]
        self.assertEqual(sorted(entry), sorted(FILE))
        self.assertIn("none.obj", entry["error"]["text"])

    def test_each_of_several_moving_is_placed_on_its_own(self):
        self.mesh("b.obj", box((1, 1, 7), (2, 2, 8)))
        report = self.report("drop", "a.obj", "b.obj", "--fixed", "floor.obj", "--output-dir", ".",
                             status=0)
        self.assertEqual([f["travel"] for f in report["files"]], [4.5, 6])
        self.assertIn("b-place.obj", self.listing())
        self.refused("drop", "a.obj", "b.obj", "-o", "out.obj")
        self.refused("drop", "a.obj", "b.obj", "--matrix", "out.txt")

    def test_in_place_replaces_moving(self):
        self.run_tool("drop", "a.obj", "--in-place", status=0)
        self.assertEqual(self.lowest("a.obj"), 0)

    def test_any_number_of_threads_gives_the_same_bytes(self):
        points, faces = grid(30)
        hills = ([(x, y, (x * 7 + y * 13) % 5 / 4) for x, y, _ in points], faces)
        self.mesh("hills.obj", hills)
        self.mesh("small.stl", box((10.3, 11.1, 9), (12.7, 13.2, 10)))
        seen = set()
        for threads in (1, 2, 8):
            for mode in (["drop"], ["mate"], ["drop", "--clearance", "0.3"]):
                report = self.report(*mode, "small.stl", "--fixed", "hills.obj", "-o", "out.stl",
                                     "-f", "-j", threads, status=0)
                seen.add((tuple(mode), self.read_bytes("out.stl"), json.dumps(report["files"])))
        self.assertEqual(len(seen), 3)

    def test_the_seed_decides_an_arrangement_and_threads_do_not(self):
        for i in range(9):
            self.mesh(f"p{i}.obj", box((0, 0, 0), (1 + i * 0.7, 4 - i * 0.3, 1)))
        names = [f"p{i}.obj" for i in range(9)]
        reports = {}
        for seed in (0, 7):  # not all fit, so that orders by chance are tried
            for threads in (1, 2, 8, 2):
                report = self.report("pack", *names, "--size", "7,9", "--spacing", "0.3",
                                     "--seed", seed, "-j", threads, "-o", "out.obj", "-f",
                                     status=1)
                self.assertGreater(len(report["files"][0]["not_placed"]), 0)
                now = (json.dumps(report["files"]), self.read("out.obj"))
                self.assertEqual(reports.setdefault(seed, now), now)

    def test_standard_input_can_be_placed(self):
        run = self.run_tool("drop", "-", "-o", "-", "--output-format", "obj", status=0,
                            stdin=self.read_bytes("a.obj"))
        self.assertEqual(min(p[2] for p in read_obj(run.text)), 0)
        self.refused("drop", "-", "--fixed", "-")


if __name__ == "__main__":
    main()
