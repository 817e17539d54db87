"""What the tests of tf-boolean share."""

from place_support import *


def volume(points, faces):
    """Six times the signed volume, over 6."""
    total = 0.0
    for a, b, c in faces:
        (ax, ay, az), (bx, by, bz), (cx, cy, cz) = points[a], points[b], points[c]
        total += (ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx))
    return total / 6


def obj_mesh(text):
    faces = [tuple(int(c.split("/")[0]) - 1 for c in line.split()[1:4])
             for line in text.splitlines() if line.startswith("f ")]
    return read_obj(text), faces


class BooleanTest(PlaceTest):
    tool = BOOLEAN

    def setUp(self):
        super().setUp()
        self.mesh("a.obj", box((0, 0, 0), (2, 2, 2)))
        self.mesh("b.obj", box((1, 1, 1), (3, 3, 3)))
        self.mesh("c.obj", box((0, 0, 0), (1, 2, 2)))

    def solid(self, name):
        """The mesh written, once tf-selfintersect has found nothing in it."""
        done = subprocess.run([TOOL, "-q", name], cwd=self.folder, capture_output=True)
        self.assertEqual(done.returncode, 0, msg=done.stdout.decode())
        return obj_mesh(self.read(name))
