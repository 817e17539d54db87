"""What the tests of tf-place share."""

import math

from support import *


def box(low, high):
    """The box between two corners, outward."""
    points, faces = cube()
    return [tuple(h if t else l for t, l, h in zip(p, low, high)) for p in points], faces


def ball_of_lines():
    """A double cone around z, of many thin faces."""
    rim = [(math.cos(a), math.sin(a), 0.0) for a in (2 * math.pi * i / 90 for i in range(90))]
    points = rim + [(0.0, 0.0, 1.0), (0.0, 0.0, -1.0)]
    faces = [(i, (i + 1) % 90, 90) for i in range(90)] + [((i + 1) % 90, i, 91) for i in range(90)]
    return points, faces


def tube(outer, inner, height, corners=32, low=0.0):
    """Around the z axis, outward."""
    points, faces = [], []
    for i in range(corners):
        c, s = math.cos(2 * math.pi * i / corners), math.sin(2 * math.pi * i / corners)
        points += [(outer * c, outer * s, low), (outer * c, outer * s, low + height),
                   (inner * c, inner * s, low + height), (inner * c, inner * s, low)]
        j = (i + 1) % corners
        for k in range(4):
            l = (k + 1) % 4
            faces += [(4 * i + k, 4 * j + k, 4 * j + l), (4 * i + k, 4 * j + l, 4 * i + l)]
    return points, faces


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
