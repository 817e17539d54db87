#!/usr/bin/env python3
"""The library in C as other languages load it: by ctypes, with arrays of their own."""

import array
import ctypes
import os
import threading
import unittest

from ctypes import (CFUNCTYPE, POINTER, Structure, addressof, byref, c_char_p, c_double, c_int,
                    c_int32, c_size_t, c_uint8, c_uint32, c_uint64, c_void_p)

LIBRARY = ctypes.CDLL(os.environ["TREEFORM_C"])
LIBRARY.treeform_last_error.restype = c_char_p
LIBRARY.treeform_version_string.restype = c_char_p
LIBRARY.treeform_code_name.restype = c_char_p
LIBRARY.treeform_free.argtypes = [c_void_p]
LIBRARY.treeform_free.restype = None

INVALID, FILE, CANCELLED = -1, -2, -5
PROGRESS = CFUNCTYPE(c_int, c_double, c_void_p)


class Arrays(Structure):
    _fields_ = [("points", POINTER(c_double)), ("point_count", c_size_t),
                ("faces", POINTER(c_uint32)), ("face_count", c_size_t)]


class FacePair(Structure):
    _fields_ = [("a", c_uint32), ("b", c_uint32), ("kind", c_uint8)]


class Pairs(Structure):
    _fields_ = [("owner", c_void_p), ("pairs", POINTER(FacePair)), ("count", c_size_t),
                ("counts", c_uint64 * 7), ("box_pairs", c_uint64)]


class FacePairOptions(Structure):
    _fields_ = [("struct_size", c_size_t),
                ("transform_a", POINTER(c_double)), ("transform_b", POINTER(c_double)),
                ("first_only", c_int32), ("kinds", c_uint32), ("limit", c_uint64),
                ("progress", PROGRESS), ("progress_data", c_void_p), ("vertices", c_int32),
                ("component_of_face", POINTER(c_uint32)), ("between", c_int32),
                ("within", c_int32)]


class Part(Structure):
    _fields_ = [("owner", c_void_p), ("mesh", Arrays), ("triangle_of_face", POINTER(c_uint32)),
                ("face_in_file", POINTER(c_uint32)), ("component", POINTER(c_uint32)),
                ("dropped", c_uint64), ("degenerate", c_uint64), ("joined", c_uint64)]


class BooleanStart(Structure):  # what is read here
    _fields_ = [("owner", c_void_p), ("mesh", Arrays)]


def call(name, *arguments, code=0):
    got = getattr(LIBRARY, name)(*arguments)
    if got != code:
        raise AssertionError(f"{name}: {got}, {LIBRARY.treeform_last_error().decode()}")


def numbers(typecode, values):
    """A Python array, and a pointer into it: nothing is copied."""
    data = array.array(typecode, values)
    kind = {"d": c_double, "I": c_uint32}[typecode]
    return data, ctypes.cast((kind * len(data)).from_buffer(data), POINTER(kind))


CUBE = [float(c) for i in range(8) for c in (i & 1, i >> 1 & 1, i >> 2)]
FACES = [0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
         2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5]


class Ctypes(unittest.TestCase):
    def cube(self, shift=0.0, flags=1):
        points, p = numbers("d", [c + shift for c in CUBE])
        faces, f = numbers("I", FACES)
        mesh = c_void_p()
        call("treeform_mesh_create", p, c_size_t(8), f, c_size_t(12), c_uint32(flags), byref(mesh))
        self.addCleanup(LIBRARY.treeform_free, mesh)
        return mesh, points, faces

    def model(self, path):
        file, part = c_void_p(), POINTER(Part)()
        call("treeform_read", path.encode(), None, byref(file))
        call("treeform_usable_faces", file, None, byref(part))
        LIBRARY.treeform_free(file)
        self.addCleanup(LIBRARY.treeform_free, part)
        arrays, mesh = part.contents.mesh, c_void_p()
        call("treeform_mesh_create", arrays.points, c_size_t(arrays.point_count), arrays.faces,
             c_size_t(arrays.face_count), c_uint32(0), byref(mesh))
        self.addCleanup(LIBRARY.treeform_free, mesh)
        return mesh

    def test_version(self):
        version = [int(n) for n in LIBRARY.treeform_version_string().split(b".")]
        self.assertEqual(LIBRARY.treeform_version(),
                         version[0] * 1000000 + version[1] * 1000 + version[2])
        self.assertEqual(LIBRARY.treeform_code_name(INVALID), b"invalid")

    def test_arrays_are_borrowed(self):
        mesh, points, _ = self.cube(flags=0)
        seen, volume = Arrays(), c_double()
        call("treeform_mesh_arrays", mesh, byref(seen))
        self.assertEqual(addressof(seen.points.contents), points.buffer_info()[0])
        for i in range(0, 24, 3):
            points[i] *= 4.0
        call("treeform_signed_volume", mesh, byref(volume))
        self.assertEqual(volume.value, 4.0)

    def test_self_intersections(self):
        pairs = POINTER(Pairs)()
        call("treeform_self_intersections", self.model("data/two_spheres.stl"), None, byref(pairs))
        found = pairs.contents
        self.assertEqual((found.count, found.counts[0]), (78, 78))
        listed = [(found.pairs[i].a, found.pairs[i].b) for i in range(found.count)]
        self.assertEqual(listed, sorted(set(listed)))
        LIBRARY.treeform_free(pairs)

    def test_progress_cancels(self):
        asked = []
        progress = PROGRESS(lambda done, data: asked.append(done) or 1)
        options, pairs = FacePairOptions(), POINTER(Pairs)()
        LIBRARY.treeform_face_pair_options_init(
            byref(options), c_size_t(ctypes.sizeof(options)))
        self.assertEqual((options.kinds, options.limit), (127, 2 ** 64 - 1))
        options.progress = progress
        call("treeform_self_intersections", self.model("data/two_spheres.stl"), byref(options),
             byref(pairs), code=CANCELLED)
        self.assertFalse(pairs)
        self.assertTrue(asked and 0.0 <= asked[0] <= 1.0)

    def test_boolean(self):
        made = POINTER(BooleanStart)()
        call("treeform_unite", self.cube()[0], self.cube(0.5)[0], None, byref(made))
        arrays, mesh, volume = made.contents.mesh, c_void_p(), c_double()
        call("treeform_mesh_create", arrays.points, c_size_t(arrays.point_count), arrays.faces,
             c_size_t(arrays.face_count), c_uint32(0), byref(mesh))
        call("treeform_signed_volume", mesh, byref(volume))
        self.assertEqual(volume.value, 1.875)
        LIBRARY.treeform_free(mesh)
        LIBRARY.treeform_free(made)

    def test_errors_are_of_their_thread(self):
        file = c_void_p()
        call("treeform_read", b"no_such.stl", None, byref(file), code=FILE)
        said = LIBRARY.treeform_last_error()
        others = []

        def another():
            others.append(LIBRARY.treeform_last_error())
            call("treeform_signed_volume", None, None, code=INVALID)
            others.append(LIBRARY.treeform_last_error())

        thread = threading.Thread(target=another)
        thread.start()
        thread.join()
        self.assertIn(b"no_such.stl", said)
        self.assertEqual(others[0], b"")
        self.assertIn(b"null", others[1])
        self.assertEqual(LIBRARY.treeform_last_error(), said)
        self.assertFalse(file)

    def test_two_threads_ask_one_mesh(self):
        mesh, inside = self.model("data/sphere.ply"), []
        _, queries = numbers("d", [0.001 * i for i in range(3000)])

        def ask():
            answers = (c_uint8 * 1000)()
            call("treeform_contains", mesh, queries, c_size_t(1000), answers)
            inside.append(bytes(answers))

        threads = [threading.Thread(target=ask) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(len(inside), 4)
        self.assertEqual(len(set(inside)), 1)
        self.assertIn(1, inside[0])
        self.assertIn(0, inside[0])


if __name__ == "__main__":
    unittest.main()
