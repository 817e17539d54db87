"""README.md and tools/README.md: what they show of the tools is what the tools say."""

import re

from support import *

HOME = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
DOCUMENTS = ("README.md", "tools/README.md", "tools/REPORTS.md")
TOOLS = {os.path.basename(path)[3:]: path for name, path in os.environ.items()
         if name.startswith("TF_") and os.path.basename(path).startswith("tf-")}


def lines_of(document):
    with open(os.path.join(HOME, document)) as file:
        return file.read().splitlines()


def runs_of(document):
    """(command, what it says) of each line "    $ command"."""
    runs = []
    for line in lines_of(document):
        if line.startswith("    $ tf-"):
            runs.append((line[6:], []))
            inside = True
        elif not line.startswith("    "):
            inside = False
        elif runs and inside:
            runs[-1][1].append(line[4:])
    return runs


def commands_in(lines):
    """The words of each command of ours, without comments."""
    for line in lines:
        for command in re.split(r" (?:\||&&|#) | xargs \S+ \S+ \S+ ",
                                line.strip().removeprefix("$ ")):
            if re.match(r"tf-[a-z]+ ", command.strip()):
                yield command.split()


class Documents(ToolTest):
    def setUp(self):
        super().setUp()
        os.symlink(os.path.join(os.path.abspath(HOME), "data"), self.path("data"))
        os.mkdir(self.path("bin"))
        for name, tool in TOOLS.items():
            os.symlink(tool, self.path("bin/tf-" + name))

    def run_line(self, command):
        paths = self.path("bin") + ":" + os.environ["PATH"]
        return subprocess.run(["bash", "-c", command], cwd=self.folder, timeout=120, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              env={**os.environ, "PATH": paths})

    def test_what_is_shown_is_what_is_said(self):
        for document in DOCUMENTS[:2]:
            runs = runs_of(document)
            self.assertGreater(len(runs), 4, msg=document)
            for command, said in runs:
                with self.subTest(document=document, command=command):
                    self.assertEqual(self.run_line(command).stdout.splitlines(), said)
            for name in os.listdir(self.folder):
                if name not in ("data", "bin"):
                    os.remove(self.path(name))

    def test_every_option_shown_is_one(self):
        help_of = {name: self.run_line(f"tf-{name} --help").stdout for name in TOOLS}
        own_help = {mode: self.run_line(f"tf-place {mode} --help").stdout
                    for mode in ("clash", "check")}
        texts = {document: lines_of(document) for document in DOCUMENTS}
        for name, text in help_of.items():
            texts["help of tf-" + name] = text[text.index("Examples:"):].splitlines()
        for mode, text in own_help.items():
            texts["help of tf-place " + mode] = text[text.index("Examples:"):].splitlines()
        count = 0
        for where, lines in texts.items():
            for words in commands_in(lines):
                self.assertIn(words[0][3:], help_of, msg=where)
                text = own_help.get(words[1], help_of[words[0][3:]])
                options = re.findall(r"(?<!\S)--?[a-z][a-z-]*", text)
                for word in words[1:]:
                    if re.match(r"--?[a-z]", word):
                        count += 1
                        self.assertIn(word.split("=")[0], options, msg=f"{where}: {words}")
        self.assertGreater(count, 50)


main()
