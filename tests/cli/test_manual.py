"""Manual pages and completions: they name every option of --help, and shells take them as they
are."""

import re
import shutil

from support import *

TOOLS = {"tf-" + name: os.environ["TF_" + name.upper()]
         for name in ("boolean", "cut", "place", "repair", "selfintersect", "weld")}
OWN_LINES = {"tf-place": ("clash", "check")}


def needs(program):
    return unittest.skipUnless(shutil.which(program), f"no {program}")


class Manual(ToolTest):
    def say(self, tool, *arguments):
        return subprocess.run([TOOLS[tool], *arguments], cwd=self.folder, timeout=60, text=True,
                              check=True, stdout=subprocess.PIPE).stdout

    def options_of(self, tool):
        """The names that --help lists, of the tool and of modes with command lines of their own."""
        text = self.say(tool, "--help")
        for mode in OWN_LINES.get(tool, ()):
            text += self.say(tool, mode, "--help")
        names = set()
        for line in text.splitlines():
            if re.match(r"  (-\w, |    )--", line):
                names.update(re.findall(r"(?<!\S)--?[a-z][a-z-]*", line[:26]))
        self.assertGreater(len(names), 25, msg=tool)
        return names

    def generate(self, tool, kind, name):
        with open(self.path(name), "w") as file:
            file.write(self.say(tool, "--generate", kind))
        return self.path(name)

    def run_quietly(self, *command):
        run = subprocess.run(command, cwd=self.folder, timeout=60, text=True,
                             stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                             env={**os.environ, "LC_ALL": "C.UTF-8", "MANWIDTH": "80"})
        self.assertEqual((run.returncode, run.stderr), (0, ""), msg=command)
        return run.stdout

    @needs("groff")
    def test_manual_pages_name_every_option_without_a_warning(self):
        for tool in TOOLS:
            page = self.generate(tool, "man", tool + ".1")
            shown = self.run_quietly("groff", "-man", "-ww", "-Tutf8", "-P-c", "-P-b", "-P-u", page)
            words = set(re.findall(r"(?<![\w-])--?[a-z][a-z-]*", shown))
            self.assertLessEqual(self.options_of(tool), words)
            for heading in ("NAME", "SYNOPSIS", "DESCRIPTION", "OPTIONS", "EXAMPLES",
                            "EXIT STATUS"):
                self.assertRegex(shown, rf"(?m)^{heading}$")
            if shutil.which("man"):
                self.run_quietly("man", "--warnings", "-l", page)
            if shutil.which("mandoc"):  # it wants a date, which differs between builds
                lint = subprocess.run(["mandoc", "-Tlint", "-Wwarning", page], text=True,
                                      stdout=subprocess.PIPE).stdout
                said = [line for line in lint.splitlines() if "missing date" not in line]
                self.assertEqual(said, [])

    @needs("zsh")
    def test_zsh_has_every_option(self):
        for tool in TOOLS:
            script = self.generate(tool, "zsh", "_" + tool)
            self.run_quietly("zsh", "-n", script)
            with open(script) as file:
                text = file.read()
            self.assertTrue(text.startswith("#compdef " + tool + "\n"))
            for name in self.options_of(tool):
                self.assertRegex(text, rf"[)*]{name}[\[=+]", msg=tool)

    @needs("fish")
    def test_fish_has_every_option(self):
        for tool in TOOLS:
            script = self.generate(tool, "fish", tool + ".fish")
            self.run_quietly("fish", "-n", script)
            mode = {"tf-boolean": "union", "tf-cut": "half", "tf-place": "slide"}.get(tool, "")
            offered = self.run_quietly("fish", "--no-config", "-c",
                                       f"source {script}; complete -C '{tool} {mode} --'")
            with open(script) as file:
                text = file.read()
            for name in self.options_of(tool):
                dash = "-l " if name.startswith("--") else "-s "
                self.assertRegex(text, rf" {dash}{name.lstrip('-')} ", msg=tool)
            self.assertIn("--threads", offered)
            self.assertIn("--precision", offered)
            words = self.run_quietly("fish", "--no-config", "-c",
                                     f"source {script}; complete -C '{tool} {mode} --units '")
            self.assertEqual(sorted(line.split("\t")[0] for line in words.splitlines()),
                             ["cm", "ft", "in", "m", "mm"])

    def test_other_kinds_are_refused(self):
        run = subprocess.run([TOOLS["tf-weld"], "--generate", "csh"], text=True,
                             stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.assertEqual((run.returncode, run.stdout), (2, ""))
        self.assertIn("expected one of man, bash, zsh, fish", run.stderr)


@needs("bash")
class Bash(Manual):
    """What a real bash completes."""

    def setUp(self):
        super().setUp()
        for name in ("a.stl", "B.PLY", "c.txt", "d.obj", "report.json", "two words.stl"):
            self.write_text(name, "")
        os.mkdir(self.path("folder"))

    def write_text(self, name, text):
        with open(self.path(name), "w") as file:
            file.write(text)

    def complete(self, tool, *words):
        """For a command line whose last word is being typed."""
        script = self.generate(tool, "bash", tool)
        self.write_text("ask", f"""
            set -u
            source {script}
            complete -p {tool} >&2
            COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)) COMP_LINE="$*" COMP_POINT=${{#COMP_LINE}}
            _{tool.replace('-', '_')}
            printf '%s\\n' "${{COMPREPLY[@]}}"
            """)
        run = subprocess.run(["bash", "--norc", self.path("ask"), tool, *words], cwd=self.folder,
                             timeout=60, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.assertEqual((run.returncode, run.stderr),
                         (0, f"complete -F _{tool.replace('-', '_')} {tool}\n"))
        os.remove(script)
        os.remove(self.path("ask"))
        return sorted(run.stdout.split("\n")[:-1] if run.stdout.strip() else [])

    def test_every_option_is_offered(self):
        for tool in TOOLS:
            self.assertLessEqual(self.options_of(tool), set(self.complete(tool, "-")))
            self.run_quietly("bash", "-n", self.generate(tool, "bash", "script"))

    def test_modes(self):
        modes = {"drop", "lay", "slide", "mate", "turn", "separate", "pack", "align",
                 "measure", "clash", "check"}
        self.assertEqual(set(self.complete("tf-place", "")), modes)
        self.assertEqual(self.complete("tf-place", "me"), ["measure"])
        self.assertEqual(self.complete("tf-boolean", "int"), ["intersection"])
        self.assertIn("union", self.complete("tf-boolean", ""))
        self.assertEqual(self.complete("tf-place", "drop", "--st"), ["--start"])
        self.assertEqual(self.complete("tf-place", "lay", "--st"), ["--stable", "--start"])
        self.assertEqual(self.complete("tf-place", "align", "--st"), ["--start", "--starts"])
        self.assertEqual(self.complete("tf-place", "clash", "--no"), ["--no-depth"])
        self.assertEqual(self.complete("tf-place", "slide", "--no"), [])
        self.assertEqual(self.complete("tf-boolean", "split", "--s"), ["--source"])

    def test_options_of_a_mode_are_those_of_its_help(self):
        for tool, modes in (("tf-place", ("drop", "pack", "measure", "clash", "check")),
                            ("tf-boolean", ("union", "split"))):
            for mode in modes:
                text = self.say(tool, mode, "--help")
                listed = set()
                for line in text.splitlines():
                    if re.match(r"  (-\w, |    )--", line):
                        listed.update(re.findall(r"(?<!\S)--?[a-z][a-z-]*", line[:26]))
                offered = set(self.complete(tool, mode, "-"))
                self.assertEqual(offered, listed, msg=mode)

    def test_words(self):
        self.assertEqual(self.complete("tf-weld", "--precision", ""), ["double", "float", "keep"])
        self.assertEqual(self.complete("tf-weld", "--precision", "=", "d"), ["double"])
        self.assertEqual(self.complete("tf-weld", "--precision", "="), ["double", "float", "keep"])
        self.assertEqual(self.complete("tf-weld", "a.stl", "--keep", "m"),
                         ["max:", "mean", "min:"])
        self.assertEqual(self.complete("tf-weld", "--rule", ""), ["chain", "first"])
        self.assertEqual(self.complete("tf-weld", "--units", "c"), ["cm"])
        self.assertEqual(self.complete("tf-repair", "--fill-rule", "n"), ["nonzero"])
        self.assertEqual(self.complete("tf-place", "align", "--weights", ""), ["equal", "welsch"])
        self.assertEqual(self.complete("tf-place", "pack", "--rotate", ""),
                         ["45", "90", "any", "none"])
        self.assertEqual(self.complete("tf-selfintersect", "--repair=o"), ["--repair=outer"])
        self.assertEqual(self.complete("tf-place", "slide", "--output-format", "x"), ["xyz"])
        self.assertEqual(self.complete("tf-place", "clash", "--output-format", "x"), [])
        self.assertEqual(self.complete("tf-weld", "-j", ""), [])
        self.assertEqual(self.complete("tf-weld", "--view", ""),
                         ["all", "back", "bottom", "front", "iso", "left", "right", "top"])
        self.assertEqual(self.complete("tf-boolean", "--ex"), ["--exit-zero", "--expr"])
        self.assertEqual(self.complete("tf-boolean", "a.stl", "--ex"), ["--exit-zero", "--expr"])
        self.assertEqual(self.complete("tf-boolean", "union", "--ex"), ["--exit-zero"])
        self.assertEqual(self.complete("tf-boolean", "--units", "i"), ["in"])

    def test_files(self):
        meshes = ["B.PLY", "a.stl", "d.obj", "folder", "two words.stl"]
        self.assertEqual(self.complete("tf-selfintersect", ""), meshes)
        self.assertEqual(self.complete("tf-place", "slide", "x", "--fixed", ""), meshes)
        self.assertEqual(self.complete("tf-place", "slide", "a"), ["a.stl"])
        self.assertEqual(self.complete("tf-weld", "a.stl", "-r", "r"), ["report.json"])
        self.assertEqual(self.complete("tf-weld", "a.stl", "--output-dir", ""), ["folder"])
        self.assertEqual(self.complete("tf-selfintersect", "a.stl", "--curves", ""),
                         ["B.PLY", "d.obj", "folder"])
        self.assertIn("c.txt", self.complete("tf-weld", "a.stl", "--log", ""))


main()
