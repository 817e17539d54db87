"""The command line: help, version, everything it refuses."""

from support import *


class Usage(ToolTest):
    def setUp(self):
        super().setUp()
        self.part = write(self.path("part.obj"), CROSSING)

    def refused(self, *arguments):
        run = self.run_tool(*arguments, status=2)
        self.assertEqual(run.text, "")
        self.assertTrue(run.err.startswith("tf-selfintersect: error: "), msg=run.err)
        return run.err

    def test_help_fits_80_columns_and_names_what_is_accepted(self):
        run = self.run_tool("--help", status=0)
        self.assertTrue(run.text.startswith("Usage: tf-selfintersect [OPTIONS] INPUT..."))
        self.assertEqual([line for line in run.text.splitlines() if len(line) > 80], [])
        for group in ("What is searched:", "Output:", "Common options:", "Exit status:"):
            self.assertIn(group, run.text)
        self.assertIn("--repair", run.text)
        self.assertEqual(self.run_tool("-h").text, run.text)

    def test_version_names_tool_and_build(self):
        self.assertRegex(self.run_tool("--version", status=0).text,
                         r"^tf-selfintersect \(treeform\) \d+\.\d+\.\d+\nbuilt with ")

    def test_what_is_not_an_option_is_refused(self):
        self.assertIn("--nonsense", self.refused(self.part, "--nonsense"))
        self.refused()
        self.refused(self.part, "--mend")

    def test_nothing_is_replaced_but_by_a_repaired_mesh(self):
        self.assertIn("--in-place needs --repair", self.refused(self.part, "--in-place"))

    def test_a_log_is_a_file(self):
        self.assertIn("stderr", self.refused(self.part, "--log", "-"))
        self.assertNotIn("-", self.listing())

    def test_a_repair_that_gives_nothing_back_is_refused(self):
        self.assertIn("-o FILE", self.refused(self.part, "--repair"))
        self.run_tool(self.part, "--repair=split", "-n", status=0)

    def test_an_option_that_would_do_nothing_is_refused(self):
        for options in (["--ascii"], ["--binary"], ["--precision", "float"],
                        ["--output-format", "ply"]):
            self.assertIn("need -o", self.refused(self.part, *options))
        self.assertIn("needs -o", self.refused(self.part, "-n"))

    def test_contradictions_are_refused(self):
        self.refused(self.part, "-o", "m.ply", "--ascii", "--binary")
        self.refused(self.part, "-q", "-v")
        self.refused(self.part, "-o", "m.ply", "--output-dir", ".")
        self.refused(self.part, "-o", "-", "--output-format", "ply", "-r", "-")
        self.refused(self.part, "-r", "x", "--pairs", "x")
        self.refused("-", "-")
        self.refused(self.part, "-o", "-")

    def test_an_input_is_never_an_output(self):
        before = self.read_bytes("part.obj")
        self.assertIn("is an input", self.refused(self.part, "-r", self.part, "-f"))
        self.assertIn("is an input", self.refused("part.obj", "--curves", self.part, "-f"))
        self.assertIn("is an input", self.refused("part.obj", "--log", "./part.obj"))
        os.link(self.part, self.path("link.obj"))
        self.assertIn("is an input", self.refused("part.obj", "--log", "link.obj"))
        self.assertEqual(self.read_bytes("part.obj"), before)

    def test_no_file_is_written_twice_however_it_is_spelled(self):
        os.mkdir(self.path("sub"))
        os.symlink("sub", self.path("link"))
        before = self.listing()
        for one, other in (("m.ply", "./m.ply"), ("m.ply", self.path("m.ply")),
                           ("m.ply", "sub/../m.ply"), ("sub/m.ply", "link/m.ply")):
            for option in ("-r", "--html", "--pairs", "--log"):
                err = self.refused("part.obj", "-o", one, option, other, "-f")
                self.assertIn("two outputs", err)
        self.assertIn("two outputs",
                      self.refused("part.obj", "--html", "m.png", "--png", "./m.png"))
        self.assertIn("two outputs", self.refused("part.obj", "--output-dir", "sub", "--suffix", "",
                                                  "-r", "link/part.ply"))
        self.assertEqual(self.listing(), before)
        self.assertEqual(os.listdir(self.path("sub")), [])
        self.run_tool("part.obj", "-o", "m.ply", "-r", "sub/m.ply", "--log", "/dev/null", status=1)

    def test_one_output_for_several_inputs_is_refused(self):
        other = write(self.path("other.obj"), CLEAN)
        for option, name in (("-o", "m.ply"), ("--pairs", "p.csv"), ("--html", "h.html"),
                             ("--png", "h.png")):
            self.refused(self.part, other, option, name)

    def test_a_folder_stands_for_the_models_in_it(self):
        os.makedirs(self.path("in/sub"))
        for name in ("in/b.stl", "in/a.obj", "in/a10.obj", "in/sub/c.obj"):
            write(self.path(name), CLEAN)
        os.rename(self.path("in/b.stl"), self.path("in/b.STL"))
        for name in ("in/notes.txt", "in/points.xyz", "in/model"):
            self.put(name, "0 0 0\n")
        os.mkdir(self.path("in/folder.obj"))
        meshes = ["in/a.obj", "in/a10.obj", "in/b.STL"]
        report = self.report(self.part, "in", status=1)
        self.assertEqual([f["input"] for f in report["files"]], [self.part] + meshes)
        self.assertIn("3 inputs", self.refused("in", "--html", "h.html"))
        self.tool = WELD
        report = self.report("in/", "--check", status=1)
        self.assertEqual([f["input"] for f in report["files"]], meshes + ["in/points.xyz"])
        self.tool = BOOLEAN
        os.rename(self.path("in"), self.path("union"))  # also a word
        self.assertEqual(self.run_tool("union", "union", "-n", status=0).text.split(":")[0],
                         "3 inputs")
        self.tool = PLACE
        report = self.report("drop", "union", "-n", status=0)
        self.assertEqual([f["input"] for f in report["files"]],
                         [name.replace("in/", "union/", 1) for name in meshes + ["in/points.xyz"]])
        self.assertIn("union: is a folder\n",
                      self.run_tool("measure", self.part, "--fixed", "union", status=3).err)

    def test_formats_that_are_not_written_are_refused(self):
        self.assertIn("ply glb 3mf", self.refused(self.part, "-o", "m.stl"))
        self.refused(self.part, "-o", "m.ply", "--output-format", "stl")

    def test_values_are_checked(self):
        for options in (["-j", "0"], ["-j", "x"], ["--memory", "lots"], ["--memory", "0"],
                        ["--timeout", "0"], ["--timeout", "-1"], ["--units", "furlong"],
                        ["--limit", "1.5"]):
            self.refused(self.part, *options)

    def test_a_value_may_follow_an_equals_sign_and_inputs_a_double_dash(self):
        self.run_tool("--limit=3", "--", self.part, status=1)

    def test_an_unknown_format_is_refused_and_a_wrong_one_is_an_input_error(self):
        for extension in ("docx", "xxx"):
            self.assertIn(f"format '{extension}' is not supported",
                          self.refused(self.part, "--format", extension))
        self.run_tool(self.part, "--format", "ply", status=3)
        for extension in ("obj", "OBJ", ".obj"):
            self.run_tool(self.part, "--format", extension, status=1)


if __name__ == "__main__":
    main()
