"""What the tests of tf-weld share."""

from support import *

import signal


def xyz_bytes(points):
    return "".join(" ".join(repr(float(x)) for x in p) + "\n" for p in points).encode()


def ply_text(columns, rows, faces=(), face_columns=()):
    """An ASCII PLY. A column is "type name"; a face is its corners and further values behind."""
    lines = ["ply", "format ascii 1.0", f"element vertex {len(rows)}"]
    lines += [f"property {c}" for c in columns]
    if faces:
        lines += [f"element face {len(faces)}", "property list uchar int vertex_indices"]
        lines += [f"property {c}" for c in face_columns]
    lines.append("end_header")
    lines += [" ".join(map(str, row)) for row in rows]
    for face in faces:
        corners, more = (face[0], face[1:]) if isinstance(face[0], tuple) else (face, ())
        lines.append(" ".join(map(str, (len(corners), *corners, *more))))
    return "\n".join(lines) + "\n"


XYZ = ["double x", "double y", "double z"]


def read_obj(text):
    points, faces = [], []
    for line in text.splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            points.append(tuple(map(float, words[1:4])))
        elif words[:1] == ["f"]:
            faces.append(tuple(int(w) - 1 for w in words[1:]))
    return points, faces


class WeldTest(ToolTest):
    tool = WELD

    def write(self, name, content):
        with open(self.path(name), "wb") as file:
            file.write(content if isinstance(content, bytes) else content.encode())
        return name

    def cloud(self, name, points):
        return self.write(name, xyz_bytes(points))

    def entry(self, *arguments, status=None):
        """The report's entry of the one input."""
        report = self.report(*arguments, status=status)
        self.assertEqual(len(report["files"]), 1)
        return report["files"][0]

    def check_kills(self, size, work, expected, between=1):
        """Of so many ranks one is killed at each step, or each few; then any number goes on."""
        for step in range(1, 100, between):
            run = self.mpi(size, *work, status=None, last=["--stop-at", step])
            if run.status == 0:  # it had fewer steps
                self.assertEqual(self.written(), expected)
                return
            self.assertEqual(run.status, 128 + signal.SIGKILL)
            self.assertEqual(self.listing(), [work[0], "tiles"])
            run = self.mpi(self.rng.choice((1, 2, 4)), *work, "-v")
            self.assertIn("finished earlier", run.err)
            self.assertEqual(self.written(), expected)
        self.fail("more than 100 steps")

    def numbers(self, name):
        """The rows of a text file of numbers."""
        return [tuple(map(float, line.split())) for line in self.read(name).splitlines()]

    def ply_rows(self, name, element="vertex"):
        """Rows of an element of an ASCII PLY, as texts."""
        lines = self.read(name).split("\n")
        at, rows = lines.index("end_header") + 1, []
        for line in lines:
            words = line.split()
            if words[:1] == ["element"]:
                if words[1] == element:
                    rows = [tuple(row.split()) for row in lines[at:at + int(words[2])]]
                at += int(words[2])
        return rows
