"""The command line of tf-weld: help, version, everything it refuses."""

from weld_support import *


class Usage(WeldTest):
    def setUp(self):
        super().setUp()
        self.cloud("in.xyz", [(0, 0, 0), (0, 0, 0)])

    def refused(self, *arguments):
        run = self.run_tool(*arguments, status=2)
        self.assertEqual(run.text, "")
        self.assertTrue(run.err.startswith("tf-weld: error: "), msg=run.err)
        self.assertEqual([name for name in self.listing() if name.startswith("out")], [])
        return run.err

    def test_help_fits_80_columns_and_names_what_is_accepted(self):
        run = self.run_tool("--help", status=0)
        self.assertTrue(run.text.startswith("Usage: tf-weld [OPTIONS] INPUT..."))
        self.assertEqual([line for line in run.text.splitlines() if len(line) > 80], [])
        for word in ("What is merged:", "Which point of a group is kept:", "Output:", "Meshes:",
                     "Common options:", "Examples:", "Exit status:", "--join", "--tolerance",
                     "--rule", "--same", "--ignore-seams", "--borders", "--keep", "--order",
                     "--map", "--removed", "--label", "--withhold", "--check", "--keep-degenerate",
                     "--keep-manifold", "--in-place"):
            self.assertIn(word, run.text)
        self.assertIn("--html FILE", run.text)

    def test_version_names_tool_and_build(self):
        self.assertRegex(self.run_tool("--version", status=0).text,
                         r"^tf-weld \(treeform\) \d+\.\d+\.\d+\nbuilt with ")

    def test_a_run_that_gives_nothing_back_is_refused_with_advice(self):
        self.assertIn("--check", self.refused("in.xyz"))
        self.assertIn("-o FILE", self.refused("in.xyz", "-t", "0.5"))

    def test_values_are_checked(self):
        for options in (["-t", "-1"], ["-t", "x"], ["-t", "1%%"], ["-t", "nan"], ["-t", "inf"],
                        ["--rule", "nearest"], ["--keep", "best"], ["--keep", "min:"],
                        ["--order", "min:"], ["--order", ""], ["--order", "x", "--keep", "last"],
                        ["--keep", "min"], ["--same", ""], ["--same", "a,,b"], ["--same", "a=x"],
                        ["--same", "a=-1"], ["--same", "=1"], ["--ignore-seams", ",a"],
                        ["--label", "x"], ["--label", "a b"], ["-j", "0"]):
            self.refused("in.xyz", "-o", "out.ply", *options)

    def test_contradictions_are_refused(self):
        self.refused("in.xyz", "--check", "-o", "out.xyz")
        self.refused("in.xyz", "--check", "--removed", "out.xyz")
        self.refused("in.xyz", "--check", "--in-place")
        self.refused("in.xyz", "--same", "normal", "--ignore-seams", "normal", "--check")
        self.refused("in.xyz", "--label", "g")
        self.refused("in.xyz", "--label", "g", "-o", "out.ply", "--removed", "out.xyz")
        self.refused("in.xyz", "--label", "g", "-o", "out.ply", "--keep", "last")
        self.refused("in.xyz", "--label", "g", "-o", "out.obj")
        self.refused("in.xyz", "-o", "out.xyz", "--map", "out.xyz")
        self.refused("in.xyz", "-o", "-", "--output-format", "xyz", "--map", "-")
        self.refused("in.xyz", "-o", "-")
        self.refused("in.xyz", "--check", "--ascii")
        self.refused("in.xyz", "--check", "--output-format", "ply")
        self.refused("in.xyz", "--removed", "-")

    def test_in_place_stands_alone(self):
        self.cloud("b.xyz", [(0, 0, 0)])
        self.refused("in.xyz", "--in-place", "-o", "out.xyz")
        self.refused("in.xyz", "b.xyz", "--join", "--in-place")
        self.refused("in.xyz", "in.xyz", "--in-place")
        self.refused("-", "--in-place")
        self.refused("in.xyz", "--in-place", "--output-format", "ply")

    def test_one_output_for_several_inputs_needs_join(self):
        self.cloud("b.xyz", [(0, 0, 0)])
        for option in ("-o", "--map", "--removed"):
            self.refused("in.xyz", "b.xyz", option, "out.xyz")
        self.refused("in.xyz", "b.xyz", "--join", "--output-dir", ".")
        self.run_tool("in.xyz", "b.xyz", "--join", "-o", "both.xyz", status=0)

    def test_an_input_is_never_an_output(self):
        before = self.read_bytes("in.xyz")
        for option in ("-o", "--map", "--removed", "-r"):
            self.assertIn("is an input", self.refused("in.xyz", option, "in.xyz", "-f"))
        self.assertIn("is an input",
                      self.refused("in.xyz", "-o", "out.xyz", "--log", "./in.xyz"))
        self.assertEqual(self.read_bytes("in.xyz"), before)

    def test_no_file_is_written_twice_however_it_is_spelled(self):
        for option in ("--map", "--removed", "-r", "--log"):
            self.assertIn("two outputs",
                          self.refused("in.xyz", "-o", "out.ply", option, "./out.ply", "-f"))

    def test_an_output_that_cannot_be_written_is_named_itself(self):
        self.write("big.xyz", "1e300 0 0\n")
        for name in ("out.ply", self.path("out.ply")):
            err = self.run_tool("big.xyz", "-o", name, "--precision", "float", status=4).err
            self.assertIn(f"{name}: vertex 0 is beyond", err)
            self.assertNotIn("unfinished", err)
        self.write("big.obj", "v 1e300 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n")
        err = self.run_tool("big.obj", "-o", "out.stl", status=4).err
        self.assertIn(": out.stl: vertex 0 is beyond", err)
        self.assertNotIn("unfinished", err)

    def test_formats_that_are_not_written_are_refused(self):
        self.refused("in.xyz", "-o", "out.docx")
        self.refused("in.xyz", "--removed", "out.stl")
        self.assertIn("cannot hold points without faces", self.run_tool("in.xyz", "-o", "out.stl",
                                                                status=4).err)

    def test_mpirun_without_the_plug_in_says_what_to_install(self):
        for tool, give in ((WELD, ["in.xyz", "-t", "0.1", "-o", "out.ply"]),
                           (TOOL, ["in.obj", "--work", "tiles"])):
            # As where it is not: the same tool that looks for another name.
            with open(tool, "rb") as file:
                text = file.read()
            self.assertEqual(text.count(b"treeform-mpi.so\0"), 1)
            with open(self.path("alone"), "wb") as file:
                file.write(text.replace(b"treeform-mpi.so\0", b"treeform-noo.so\0"))
            os.chmod(self.path("alone"), 0o755)
            done = subprocess.run([self.path("alone"), *give], cwd=self.folder, capture_output=True,
                                  env=os.environ | {"OMPI_COMM_WORLD_SIZE": "2"}, timeout=60)
            said = done.stderr.decode()
            self.assertEqual((done.returncode, len(said.splitlines())), (5, 1), msg=said)
            self.assertTrue(said.startswith("error: started by mpirun, but without "
                                            "treeform-noo.so: "))
            for words in ("the Debian package libopenmpi-dev", "--target treeform_mpi"):
                self.assertIn(words, said)
            self.assertNotIn("cannot open", said)

    def test_pages_are_not_made_in_tiles(self):
        self.assertIn("--html needs the whole cloud in memory",
                      self.refused("in.xyz", "--tile-points", "2", "--html", "out.html", "-n"))


if __name__ == "__main__":
    main()
