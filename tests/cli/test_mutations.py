"""Files that were damaged, tools that are stopped while they write: no tool crashes, and every
output is whole or absent.

Damaged files of data/ and, with TREEFORM_MODELS_DIR, of its folder hostile; 60 of them, or
$TREEFORM_STRESS_COUNT, from $TREEFORM_STRESS_SEED on; with --slow, the nine times as many after
those. """

from support import *

import random

DATA = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "data")
BOOLEAN = os.environ.get("TF_BOOLEAN", "tf-boolean")
COUNT = int(os.environ.get("TREEFORM_STRESS_COUNT", "60"))
SEED = int(os.environ.get("TREEFORM_STRESS_SEED", "1"))

WORDS = [b"nan", b"1e400", b"-1", b"4294967295", b"0", b"\n", b"\0\0\0\0", b"\xff\xff\xff\xff",
         b"\0\0\xc0\x7f", b"end_header\n", b"facet", b"f 1 2 3\n"]


def files_of(folder):
    paths = [os.path.join(folder, name) for name in sorted(os.listdir(folder))
             if name.endswith((".stl", ".obj", ".ply", ".off", ".xyz"))]
    return [path for path in paths if os.path.getsize(path) < 200_000]


def damaged(content, choose):
    """Up to two changes, as disks, editors and transfers make them."""
    content = bytearray(content)
    for _ in range(choose.randrange(3)):
        at = choose.randrange(len(content) + 1)
        upto = min(len(content), at + 1 + choose.randrange(40))
        kind = choose.randrange(6)
        if kind == 0 and at < len(content):
            content[at] ^= 1 << choose.randrange(8)
        elif kind == 1:
            del content[at:upto]
        elif kind == 2:
            content[at:at] = content[at:upto]
        elif kind == 3:
            content[at:at] = choose.choice(WORDS)
        elif kind == 4:
            word = choose.choice(WORDS)
            content[at:at + len(word)] = word
        elif choose.randrange(4) == 0:
            del content[at:]
    return bytes(content)


def commands(name):
    """Command lines with one output each, and its name."""
    return [([TOOL, name, "-q", "--exit-zero", "-o", "out.ply"], "out.ply"),
            ([TOOL, name, "-q", "--exit-zero", "--repair=split", "-o", "out.obj"], "out.obj"),
            ([WELD, name, "-q", "-t", "0.01%", "-o", "out.obj"], "out.obj"),
            ([BOOLEAN, "union", name, "other.obj", "-q", "-o", "out.stl"], "out.stl"),
            ([PLACE, "drop", name, "-q", "-o", "out.ply"], "out.ply")]


class Mutations(ToolTest):
    def run_in_folder(self, command, **more):
        done = subprocess.run(command, cwd=self.folder, capture_output=True, timeout=120, **more)
        return done.returncode, done.stderr.decode(errors="replace")

    def output(self, name):
        return self.read_bytes(name) if os.path.exists(self.path(name)) else None

    def check_stopped(self, command, name, whole, choose):
        """Once more, over an older file, with too little room on the disk or killed at some
        time."""
        with open(self.path(name), "wb") as file:
            file.write(b"older")
        if choose.randrange(2) == 0:
            room = choose.randrange(len(whole) + 1)
            limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (room, room))
            status, err = self.run_in_folder(command, preexec_fn=limit)
            self.assertIn(status, [0, 1, 4], msg=f"{command}\n{err}")
        else:
            process = subprocess.Popen(command, cwd=self.folder, stdout=subprocess.DEVNULL,
                                       stderr=subprocess.DEVNULL)
            try:
                process.wait(timeout=choose.random() * 0.02)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
        self.assertIn(self.output(name), [b"older", whole], msg=f"{command}: a part of a file")

    def test_outputs_of_damaged_files_are_whole_or_absent(self):
        self.check_outputs(range(SEED, SEED + COUNT))

    @slow
    def test_outputs_of_many_more_damaged_files_are_whole_or_absent(self):
        self.check_outputs(range(SEED + COUNT, SEED + 10 * COUNT))

    def check_outputs(self, seeds):
        folders = [files_of(DATA)]
        if MODELS:
            folders.append(files_of(os.path.join(MODELS, "hostile")))
        written = 0
        for i in seeds:
            choose = random.Random(i)
            source = choose.choice(choose.choice(folders))
            with open(source, "rb") as file:
                content = damaged(file.read(), choose)
            name = "in" + os.path.splitext(source)[1]
            with open(self.path(name), "wb") as file:
                file.write(content)
            write(self.path("other.obj"), cube((0.25, 0.25, 0.25)))
            command, output = choose.choice(commands(name))
            with self.subTest(seed=i, source=os.path.basename(source), command=command):
                status, err = self.run_in_folder(command)
                self.assertIn(status, range(6), msg=err)
                whole = self.output(output)
                if status > 1:
                    self.assertIsNone(whole, msg=err)
                self.assertLessEqual(set(self.listing()), {name, "other.obj", output})
                if whole is not None:
                    written += 1
                    self.check_stopped(command, output, whole, choose)
            for left in self.listing():
                os.remove(self.path(left))
        self.assertGreater(written, len(seeds) // 10)


if __name__ == "__main__":
    main()
