"""What a person at a terminal sees: colors, a table of many files, progress; and none of it in
pipes."""

import pty
import re
import select
import time

from support import *

RED, YELLOW, BOLD, PLAIN = "\033[1;31m", "\033[1;33m", "\033[1m", "\033[0m"


class Terminal(ToolTest):
    def on_terminal(self, *arguments, **variables):
        """(status, all that is shown) of a run whose stdout and stderr are a terminal."""
        environment = {name: value for name, value in os.environ.items()
                       if name not in ("NO_COLOR", "TERM")}
        environment.update({"TERM": "xterm"} | variables)
        try:
            leader, follower = pty.openpty()
        except OSError as error:  # such as in a container without /dev/pts
            self.skipTest(f"no pseudo-terminals: {error}")
        process = subprocess.Popen([self.tool, *arguments], cwd=self.folder, env=environment,
                                   stdin=subprocess.DEVNULL, stdout=follower, stderr=follower)
        os.close(follower)
        shown, limit = b"", time.monotonic() + 120
        while time.monotonic() < limit:
            if not select.select([leader], [], [], 1)[0]:
                continue
            try:
                piece = os.read(leader, 65536)
            except OSError:  # closed
                break
            if not piece:
                break
            shown += piece
        os.close(leader)
        return process.wait(timeout=60), shown.decode().replace("\r\n", "\n")

    def setUp(self):
        super().setUp()
        write(self.path("clean.obj"), CLEAN)
        write(self.path("two.obj"), TWO_CUBES)

    def test_colors_on_a_terminal(self):
        status, shown = self.on_terminal("two.obj", "missing.obj")
        self.assertEqual(status, 3)
        self.assertIn(f"{BOLD}two.obj{PLAIN}: ", shown)
        self.assertIn(f"{BOLD}tf-selfintersect:{PLAIN} {RED}error: {PLAIN}", shown)
        shown = self.on_terminal("two.obj", "--no-such")[1]
        self.assertIn(f"{RED}error: {PLAIN}", shown)
        write(self.path("nan.obj"), ([*CLEAN[0][:-1], (float("nan"), 0, 0)], CLEAN[1]))
        self.assertIn(f"{YELLOW}warning: {PLAIN}", self.on_terminal("nan.obj")[1])

    def test_none_where_they_are_not_wanted(self):
        for words, variables in ((["--color", "never"], {}), ([], {"NO_COLOR": "1"}),
                                 ([], {"TERM": "dumb"})):
            shown = self.on_terminal("two.obj", "missing.obj", *words, **variables)[1]
            self.assertNotIn("\033[1", shown)
        self.assertIn(BOLD, self.on_terminal("two.obj", NO_COLOR="")[1])  # empty says nothing
        self.assertIn(BOLD, self.on_terminal("two.obj", "--color", "always", NO_COLOR="1")[1])

    def test_none_in_a_pipe_unless_asked_for(self):
        run = self.run_tool("two.obj", "missing.obj", status=3)
        self.assertNotIn("\033", run.text + run.err)
        run = self.run_tool("two.obj", "missing.obj", "--color", "always", status=3)
        self.assertIn(f"{BOLD}two.obj{PLAIN}: ", run.text)
        self.assertIn(f"{RED}error: {PLAIN}", run.err)
        self.run_tool("two.obj", "--color", "blue", status=2)
        self.run_tool("two.obj", "--color", "always", "--log", "log", status=1)
        with open(self.path("log")) as file:
            self.assertNotIn("\033", file.read())

    def test_a_table_of_many_files(self):
        status, shown = self.on_terminal("clean.obj", "two.obj", "missing.obj", "--color", "never")
        self.assertEqual(status, 3)
        shown = re.sub(r"\r\033\[K[^\r]*(?=\r\033\[K)|\r\033\[K", "", shown)
        table = shown[shown.index("\nfile "):].splitlines()[1:]
        heading, clean, two, missing, total = table
        self.assertEqual(heading.split()[:4], ["file", "faces", "hit", "crossing"])
        self.assertEqual(clean.split()[:4], ["clean.obj", "12", "0", "0"])
        self.assertTrue(clean.endswith("  ok") and two.endswith("  found, or not done"))
        self.assertEqual(missing.split()[0::3][:2], ["missing.obj", "-"])
        pairs = int(two.split()[3])
        self.assertGreater(pairs, 0)
        self.assertEqual(total.split()[:5], ["3", "files", "36", two.split()[2], str(pairs)])
        self.assertTrue(total.endswith("1 ok, 1 found, or not done, 1 error"))
        end = heading.index("faces") + len("faces")  # numbers end below each other
        for line in (clean, two, missing, total):
            self.assertEqual((line[end - 1] == " ", line[end]), (False, " "), msg=line)

    def test_columns_of_a_table_end_below_each_other_whatever_the_letters(self):
        names = ("clean.obj", "größe.obj", "e\u0301.obj", "部品.obj")
        for name in names[1:]:
            write(self.path(name), CLEAN)
        shown = self.on_terminal(*names, "--color", "never")[1]
        rows = shown[shown.index("\nfile "):].splitlines()[2:6]
        ends = []
        for name, row, more in zip(names, rows, (0, 0, -1, 2)):
            self.assertTrue(row.startswith(name + " "), msg=row)
            ends.append(row.index(" 12 ") + more)
        self.assertEqual(len(set(ends)), 1, msg=rows)

    def test_no_table_of_one_file_or_in_a_pipe(self):
        self.assertNotIn("file ", self.on_terminal("two.obj")[1])
        run = self.run_tool("clean.obj", "two.obj", status=1)
        self.assertEqual(len(run.text.splitlines()), 2)

    def test_progress_is_cleared_at_the_end(self):
        write(self.path("large.stl"), grid(200))
        status, shown = self.on_terminal("large.stl", "--color", "never")
        self.assertEqual(status, 0)
        self.assertRegex(shown, r"\r\033\[Ktf-selfintersect: large\.stl: \w+ \d+ %")
        last = shown.rindex("\r\033[K")
        self.assertRegex(shown[last + 4:], r"\Alarge\.stl: [^\r]*\n\Z")
        self.assertNotIn(" %", shown[last:])
        self.assertNotIn("\033", self.on_terminal("large.stl", "-q")[1])

    def test_progress_says_how_fast_and_how_long(self):
        write(self.path("large.stl"), grid(600))
        shown = self.on_terminal("large.stl", "-j", "1", "--touching")[1]
        lines = [line for line in shown.split("\r\033[K") if " left" in line]
        for line in lines:  # a fast machine may be done before there is anything to say
            self.assertRegex(line, r"^tf-selfintersect: large\.stl: \w+ \d+ %, [\d.,e+]+ faces/s, "
                                   r"(\d+ h )?(\d+ min)?( ?\d+ s)? left$")


main()
