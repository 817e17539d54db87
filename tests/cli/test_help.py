"""--help of modes: it lists what the mode accepts, and nothing else; its examples are real."""

import re

from support import *

HOME = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
TOOLS = {name: os.environ["TF_" + name.upper()]
         for name in ("boolean", "cut", "place", "repair", "selfintersect", "weld")}
MODES = {"place": {"drop": "drop", "lay": "lay", "slide": "slide", "mate": "mate", "turn": "turn",
                   "separate": "separate", "pack": "pack", "align": "align", "measure": "measure",
                   "clash": "clash", "check": "check"},
         "boolean": {mode: mode for mode in ("union", "intersection", "difference",
                                             "symmetric-difference", "split")},
         "cut": {mode: mode for mode in ("half", "section", "isolines", "pieces", "parts", "info",
                                         "simplify",
                                         "offset", "hollow", "thicken")}}
# What a mode needs beside the option that is tried, so that only this is refused.
NEEDED = {"half": ["--height", "1"], "isolines": ["--levels", "1"], "section": ["--height", "1"],
          "pieces": ["--height", "1"],
          "pack": ["--size", "9,9"], "check": ["--poses", "poses"],
          "simplify": ["--distance", "1"], "offset": ["--distance", "1"],
          "hollow": ["--wall", "1"], "thicken": ["--thickness", "1"]}
FIXED = ("slide", "mate", "turn", "separate", "align", "measure")
VALUES = {"X,Y,Z": "0,0,-1", "X,Y[,Z]": "9,9", "DIST": "1", "SEC": "1", "DEG": "45", "N": "1",
          "F": "0.5", "LO,HI": "0,1", "Z": "0", "FILE": "f.ply", "FILE:N": "a.obj:1", "U": "mm",
          "SIZE": "none", "DIR": "dir", "TEXT": "text", "A:B": "a:b", "RULE": "even-odd", "P": "p",
          "FACE|X,Y,Z": "1", "KIND": "plane", "EXT": "ply", "SET": "90", "EXPR": "a+b",
          "N:FILE": "1:m", "SHARE": "1%", "WHEN": "never", "V,...": "iso,top", "WxH": "90x60",
          "V": "1", "H,...": "1", "T": "1", "HALF": "below", "D": "1", "W": "1", "R": "0.1",
          "SIDE": "both", "HOW": "none", "NAME": "height", "MESH": "m.ply", "L,...": "1",
          "X,Y,Z,D": "0,0,0,1"}
WORDS = {"--precision": "float", "--png": "p.png", "--weights": "equal", "--metric": "plane"}
# Options that are refused without others, or beside -o.
WITH = {"--pick": ["--feature", "plane"], "--pick-fixed": ["--feature", "plane"],
        "--view": ["--png", "p.png"], "--png-size": ["--png", "p.png"],
        "--flip": ["--feature", "plane"], "--suffix": ["--output-dir", "dir"]}
# Options that choose the planes themselves.
PLANES = ("--bed", "--layers")
OUTPUTS = {"section": "out.svg", "isolines": "out.svg", "half": "out%d.ply", "pieces": "out%d.ply",
           "parts": "out%d.ply"}
WITHOUT_OUTPUT = ("--output-dir", "--in-place", "--suffix", "--check", "--output")


def options_of(text):
    """{name: value} of what a help lists: the long names."""
    found = {}
    for line in text.splitlines():
        if not re.match(r"  (-\w, |    )--", line):
            continue
        entry = line[2:26] if line[25:26] == " " else line
        name, value = re.match(r".*?(--[\w-]+)(?:\[=\w+\]|, --\w+)?(?: (\S+))?", entry).groups()
        found[name] = value
    return found


class Help(ToolTest):
    def say(self, tool, *arguments):
        return subprocess.run([TOOLS[tool], *arguments], cwd=self.folder, timeout=120, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE)

    def help_of(self, tool, *words):
        run = self.say(tool, *words, "--help")
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        said = False  # what a tool prints may be longer
        for line in run.stdout.splitlines():
            self.assertTrue(len(line) <= 80 or said, msg=line)
            said = line.startswith("  $ ")
        return run.stdout

    def test_each_mode_has_a_help_of_its_own(self):
        for tool, modes in MODES.items():
            whole = options_of(self.help_of(tool))
            for mode, other in modes.items():
                text = self.help_of(tool, mode)
                self.assertTrue(text.startswith(f"Usage: tf-{tool} {mode} "), msg=text)
                self.assertEqual(text, self.help_of(tool, other))
                self.assertEqual(text, self.say(tool, "--help", mode).stdout)
                self.assertRegex(text[text.index("Examples:"):], rf"tf-{tool} ({mode}|{other}) ")
                self.assertIn("Exit status: ", text)
                if mode not in ("clash", "check"):
                    self.assertLess(set(options_of(text)), set(whole))
                self.assertNotRegex(text, r"(?m)^.{26}(\w+, )*(" + "|".join(modes) + "): ")

    def test_a_mode_lists_only_exit_statuses_that_it_has(self):
        for mode in MODES["cut"]:
            text = self.help_of("cut", mode)
            self.assertEqual(text.count("Exit status: "), 1)
            self.assertEqual(" 1 the input" in text, mode not in ("info", "section", "isolines"),
                             msg=mode)
        for mode in MODES["place"]:
            self.assertEqual("--scene" in options_of(self.help_of("place", mode)),
                             mode not in ("lay", "pack", "clash", "check"), msg=mode)

    def test_a_mode_says_nothing_of_others_and_its_lines_are_full(self):
        output = {mode: " ".join(re.search(r"-o, --output FILE ((?s:.*?))\n +--",
                                           self.help_of("place", mode))
                                 .group(1).split()) for mode in MODES["place"] if mode != "check"}
        self.assertEqual(output["lay"], "MOVING at its new place")
        self.assertEqual(output["slide"],
                         "MOVING at its new place; in PLY and GLB, faces that penetrate --fixed "
                         "are red, touching ones yellow, those within --clearance cyan, "
                         "unless MOVING has colors")
        self.assertTrue(output["measure"].startswith("MOVING unchanged; in PLY and GLB, faces"))
        for mode in MODES["place"]:
            if mode != "drop":
                self.assertNotIn("drop with", self.help_of("place", mode))
            if mode not in ("pack", "align"):
                self.assertNotRegex(self.help_of("place", mode), "all parts are placed|converged")
        self.assertIn("drop with --fixed has a bed only", self.help_of("place", "drop"))
        self.assertIn("Translate along --direction until contact (minus --clearance).\n",
                      self.help_of("place", "slide"))

    def try_option(self, tool, mode, name, value):
        words = [name]
        if value:
            words.append(OUTPUTS[mode] if name == "--output" and mode in OUTPUTS else
                         WORDS.get(name) or VALUES[value])
        needed = [] if name in NEEDED.get(mode, []) else list(NEEDED.get(mode, []))
        if tool == "cut" and name in PLANES:
            needed = []
        if mode == "half" and name in ("--output-dir", "--in-place", "--suffix"):
            needed += ["--keep", "below"]
        if mode in FIXED and name != "--fixed":
            needed += ["--fixed", "none.obj"]
        if name not in WITHOUT_OUTPUT and mode not in ("check",):
            needed += ["-o", OUTPUTS.get(mode, "out.ply")] if mode != "info" else []
        inputs = ["a.obj"] if tool != "boolean" else ["a.obj", "b.obj"]
        return self.say(tool, mode, *words, *WITH.get(name, []), *needed, *inputs)

    def test_a_mode_lists_what_it_accepts(self):
        tried = 0
        for tool, modes in MODES.items():
            whole = options_of(self.help_of(tool))
            lists = {mode: options_of(self.help_of(tool, mode)) for mode in modes}
            of_all = set.intersection(*map(set, lists.values()))
            for mode, listed in lists.items():
                for name, value in {**whole, **listed}.items():
                    if name in ("--help", "--version", "--quiet", "--accept-open", "--package-dir"):
                        continue
                    if name in of_all and mode not in ("measure", "split", "info"):  # one will do
                        continue
                    with self.subTest(mode=mode, option=name):
                        run = self.try_option(tool, mode, name, value)
                        accepted = run.returncode != 2
                        self.assertEqual(accepted, name in listed, msg=run.stderr)
                        tried += 1
        self.assertGreater(tried, 300)

    def test_examples_are_what_is_said(self):
        os.symlink(os.path.join(os.path.abspath(HOME), "data"), self.path("data"))
        shown = 0
        for tool, modes in MODES.items():
            for mode in modes:
                text = self.help_of(tool, mode)
                lines = text[text.index("Examples:"):text.index("Exit status:")].splitlines()[1:-1]
                for line in lines:
                    if line.startswith("  $ "):
                        run = self.say(tool, *line.split()[2:], "-f")
                        said = run.stdout.splitlines()
                    elif any(one.startswith("  $ ") for one in lines):
                        self.assertEqual(line[2:], said.pop(0))
                        shown += 1
        self.assertGreaterEqual(shown, 12)


main()
