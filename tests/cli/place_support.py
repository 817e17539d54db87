"""What the tests of tf-place share."""

from support import *


def box(low, high):
    """The box between two corners, outward."""
    points, faces = cube()
    return [tuple(h if t else l for t, l, h in zip(p, low, high)) for p in points], faces


def read_stl(data):
    """The points of a binary STL, three a face."""
    count, = struct.unpack_from("<I", data, 80)
    return [struct.unpack_from("<3f", data, 84 + 50 * f + 12 * (1 + c))
            for f in range(count) for c in range(3)]


def read_obj(text):
    return [tuple(map(float, line.split()[1:4])) for line in text.splitlines()
            if line.startswith("v ")]


class PlaceTest(ToolTest):
    tool = PLACE

    def mesh(self, name, mesh):
        write(self.path(name), mesh)
        return name

    def entry(self, *arguments, status=None):
        """The report's entry of the one MOVING."""
        report = self.report(*arguments, status=status)
        self.assertEqual(len(report["files"]), 1)
        return report["files"][0]

    def points(self, name):
        return read_stl(self.read_bytes(name)) if name.endswith(".stl") else read_obj(
            self.read(name))

    def lowest(self, name):
        return min(p[2] for p in self.points(name))
