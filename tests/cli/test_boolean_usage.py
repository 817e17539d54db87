"""The command line of tf-boolean: help, refusals; its report; the same on any number of threads."""

from boolean_support import *

import hashlib

NUMBER = (int, float)
NULL = type(None)
FILE = {"input": (str, NULL), "error": NULL, "warnings": list, "operation": (str, NULL),
        "fill_rule": str, "check": bool, "inputs": list, "pairs": (int, NULL),
        "cut_faces": (int, NULL), "volumes": (dict, NULL),
        "separated_points": (int, NULL), "skipped": dict,
        "min_volume": dict, "gap": dict, "max_move": dict,
        "output": (dict, NULL), "exit": int}
INPUT = {"file": str, "part": (str, NULL), "format": str, "sha256": str, "precision_in": str,
         "matrix": (str, NULL),
         "faces": int, "triangles": int, "volume": NUMBER, "closed": (bool, NULL),
         "reason": (str, NULL), "repair": (dict, NULL), "open": dict, "skipped": dict}
OUTPUT = {"file": (str, NULL), "format": (str, NULL), "precision_out": str, "vertices": int,
          "cut_vertices": int, "faces": int, "components": int, "nonmanifold_edges": int,
          "volume": (*NUMBER, NULL), "closed": bool, "oriented": (bool, NULL),
          "self_intersections": int, "meeting": list, "exact_faces": int, "lost_parts": dict,
          "certified": bool, "max_move": NUMBER, "step": NUMBER, "rounding_repairs": int,
          "rounding_rounds": int}


class Usage(BooleanTest):
    def refused(self, *arguments):
        run = self.run_tool(*arguments, status=2)
        self.assertEqual(run.text, "")
        self.assertTrue(run.err.startswith("tf-boolean: error: "), msg=run.err)
        self.assertEqual([name for name in self.listing() if name.startswith("out")], [])
        return run.err

    def test_help_fits_80_columns_and_names_what_is_accepted(self):
        run = self.run_tool("--help", status=0)
        self.assertTrue(run.text.startswith("Usage: tf-boolean OP [OPTIONS] INPUT..."))
        self.assertEqual([line for line in run.text.splitlines() if len(line) > 80], [])
        self.assertNotIn("--in-place", run.text)
        for word in ("union", "intersection", "difference", "symmetric-difference", "split",
                     "--expr", "--matrix", "--fill-rule", "--check", "--accept-open",
                     "--merge-coplanar", "--max-move",
                     "--source", "--no-attributes", "--curves", "--min-volume", "--gap",
                     "Common options:", "Examples:", "Exit status:"):
            self.assertIn(word, run.text)

    def test_words_and_values_are_checked(self):
        self.refused()
        self.assertIn("no operation", self.refused("unite", "a.obj"))
        self.assertIn("expected an INPUT", self.refused("union"))
        both = ("a.obj", "b.obj")
        for name in ("a.stl", "b.stl"):
            self.run_tool("union", "a.obj", "-o", name, status=0)
        for inputs in (both, ("a.stl", "b.stl")):
            for formula, name in (("a-c", "c"), ("plate-hole", "plate"), ("A-hole", "hole")):
                self.assertIn(f"no operand is named {name}; the names are a, b",
                              self.refused("--expr", formula, *inputs, "-n"))
        self.assertIn("no operand is named b; the only one is a",
                      self.refused("--expr", "a-b", "a.stl", "-n"))
        self.assertIn("the names are a, b, c, d, e, f, g, h, i, j, ...",
                      self.refused("--expr", "a-bb", *["a.stl"] * 12, "-n"))
        self.assertIn("position 2", self.refused("--expr", "a)", *both))
        for options in (["--fill-rule", "even"], ["--max-move", "-1"], ["--matrix", "m.txt"],
                        ["--min-volume", "-1"], ["--min-volume", "1%"], ["--gap", "-1"],
                        ["--matrix", "3:m.txt"], ["--matrix", "0:m.txt"], ["--matrix", "1:"],
                        ["--matrix", "1:m.txt", "--matrix", "1:n.txt"]):
            self.refused("union", *both, "-o", "out.obj", *options)

    def test_an_input_that_the_formula_does_not_use_is_named(self):
        for formula, unused in (("a", ["b.obj"]), ("b", ["a.obj"]), ("a-b", []), ("b*A", [])):
            warnings = self.entry("--expr", formula, "a.obj", "b.obj", "-n", status=0)["warnings"]
            self.assertEqual([(w["code"], w["text"]) for w in warnings],
                             [("unused", f'{name}: ignored, since "{formula}" does not use it')
                              for name in unused])

    def test_common_options_are_taken(self):
        run = self.run_tool("union", "a.obj", "b.obj", "-o", "out", "--output-format", "ply",
                            "--ascii", "--precision", "double", "--units", "mm", "--format", "obj",
                            "-j", 2, "--memory", "1G", "--timeout", 60, "-v", "--log", "out.log",
                            "-r", "out.json", "--exit-zero", "--progress", status=0)
        self.assertIn("volume 15", run.text)
        self.assertTrue(self.read("out").startswith("ply\nformat ascii"))
        self.assertIn("faces meet", self.read("out.log"))
        self.assertEqual(json.loads(self.read("out.json"))["unit"], "mm")
        self.run_tool("union", "a.obj", "b.obj", "-o", "out", "--output-format", "stl", "--binary",
                      "-f", "-q", status=0)
        self.assertEqual(self.read_bytes("out")[:5], b"treef")
        self.assertIn("tf-boolean", self.run_tool("--version", status=0).text)

    def test_what_would_do_nothing_is_refused(self):
        self.refused("--check", "a.obj", "-o", "out.obj")
        self.refused("--check", "a.obj", "--max-move", "1")
        self.refused("--check", "a.obj", "--merge-coplanar")
        self.refused("--check", "a.obj", "--gap", "1")
        self.refused("split", "a.obj", "-o", "out.obj", "--min-volume", "1")
        self.assertIn("only a union", self.refused("--expr", "a+b", "a.obj", "b.obj", "-o",
                                                   "out.obj", "--gap", "1"))
        self.refused("--check", "a.obj", "--accept-open")
        self.refused("--check", "a.obj", "--curves", "out.obj")
        self.refused("split", "a.obj", "--fill-rule", "even-odd")
        self.refused("split", "a.obj", "--merge-coplanar")
        self.refused("union", "a.obj", "--curves", "out.stl")
        self.refused("union", "a.obj", "--ascii")
        self.refused("union", "a.obj", "-o", "out.obj", "--source", "from")
        self.refused("union", "a.obj", "-o", "out.xyz")
        self.refused("union", "a.obj", "--in-place")
        self.refused("union", "a.obj", "b.obj", "--output-dir", "out")

    def test_a_run_that_gives_nothing_back_is_refused(self):
        self.assertIn("-o FILE", self.refused("union", "a.obj", "b.obj"))
        self.assertIn("faces", self.run_tool("union", "a.obj", "b.obj", "-n", status=0).text)
        self.run_tool("union", "a.obj", "b.obj", "--curves", "where.obj", status=0)

    def test_a_formula_and_an_operation_exclude_each_other(self):
        self.assertIn("union", self.refused("--expr", "a-b", "union", "a.obj", "b.obj", "-n"))
        os.rename(self.path("b.obj"), self.path("union"))
        self.run_tool("--expr", "a-b", "a.obj", "union", "-n", status=0)
        self.run_tool("--expr", "a-b", "union", "a.obj", "-n", status=0)

    def test_no_output_replaces_a_file_that_is_read(self):
        before = self.read_bytes("b.obj")
        self.assertIn("is an input", self.refused("union", "a.obj", "b.obj", "-o", "b.obj", "-f"))
        self.assertEqual(self.read_bytes("b.obj"), before)
        with open(self.path("m.txt"), "w") as file:
            file.write("1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n")
        before = self.read_bytes("m.txt")
        for options in (["-o", "m.txt", "--output-format", "obj"], ["-r", "./m.txt"],
                        ["--log", "m.txt", "-n"]):
            self.assertIn("is an input",
                          self.refused("union", "a.obj", "--matrix", "1:m.txt", *options, "-f"))
        self.assertEqual(self.read_bytes("m.txt"), before)
        self.assertIn("is an input", self.refused("union", "a.obj", "--log", "./a.obj", "-n"))

    def test_no_file_is_written_twice_however_it_is_spelled(self):
        same = os.path.join("..", os.path.basename(self.folder), "out.obj")
        for option in ("-r", "--curves", "--log"):
            self.assertIn("two outputs",
                          self.refused("union", "a.obj", "-o", "out.obj", option, same, "-f"))
        self.run_tool("union", "a.obj", "-o", "union", "--output-format", "obj", status=0)

    def test_an_output_that_exists_needs_force(self):
        self.mesh("there.obj", cube())
        before = self.read_bytes("there.obj")
        self.run_tool("union", "a.obj", "b.obj", "-o", "there.obj", status=4)
        self.assertEqual(self.read_bytes("there.obj"), before)
        self.run_tool("union", "a.obj", "b.obj", "-o", "there.obj", "-f", status=0)
        self.assertNotEqual(self.read_bytes("there.obj"), before)

    def test_bad_files_are_named(self):
        self.assertIn("none.obj", self.run_tool("union", "a.obj", "none.obj", "-n", status=3).err)
        self.mesh("empty.obj", ([(0, 0, 0)], []))
        self.assertIn("empty.obj", self.run_tool("union", "a.obj", "empty.obj", "-n", status=3).err)
        with open(self.path("m.txt"), "w") as file:
            file.write("1 0 0")
        self.assertIn("m.txt", self.run_tool("union", "a.obj", "--matrix", "1:m.txt", "-n",
                                             status=3).err)

    def check_types(self, entry, types):
        self.assertEqual(list(entry), list(types))
        for key, kind in types.items():
            self.assertIsInstance(entry[key], kind, msg=key)

    def test_inputs_that_are_read_at_once_are_reported_in_their_order(self):
        for number in range(4):
            self.put(f"bad{number}.obj", f"v {number}\n")
        for threads in (1, 2):
            run = self.run_tool("union", "a.obj", "a.obj", "bad2.obj", "bad1.obj", "-n", "-j",
                                threads, "-r", "-", status=3)
            self.assertIn("bad2.obj:1:", run.err)
            self.assertNotIn("bad1", run.err)
            inputs = json.loads(run.text)["files"][0]["inputs"]
            digest = hashlib.sha256(self.read_bytes("a.obj")).hexdigest()
            self.assertEqual([i["sha256"] for i in inputs[:3]], [digest, digest, None])

    def test_the_report_has_its_keys_in_any_case(self):
        report = self.report("difference", "a.obj", "b.obj", status=0)
        self.assertEqual(report["schema"], "tf-boolean-report/1")
        self.assertEqual(list(report["seconds"]), ["read", "prepare", "cut", "check", "write"])
        entry, = report["files"]
        self.check_types(entry, FILE)
        self.check_types(entry["output"], OUTPUT)
        for one in entry["inputs"]:
            self.check_types(one, INPUT)
        self.check_types(self.entry("--check", "a.obj", status=0), FILE)
        points, faces = cube()
        self.mesh("open.obj", (points, faces[1:]))
        self.check_types(self.entry("union", "open.obj", status=1), FILE)

    def test_standard_input_and_output(self):
        data = self.read_bytes("b.obj")
        run = self.run_tool("union", "a.obj", "-", "-o", "-", "--output-format", "obj", stdin=data,
                            status=0)
        self.assertEqual(volume(*obj_mesh(run.text)), 15)

    def test_threads_do_not_show(self):
        written = set()
        for threads in (1, 2, 8):
            self.run_tool("symmetric-difference", "a.obj", "b.obj", "c.obj", "-o", "out.ply",
                          "-f", "-j", threads, status=0)
            written.add(self.read_bytes("out.ply"))
        self.assertEqual(len(written), 1)


if __name__ == "__main__":
    main()
