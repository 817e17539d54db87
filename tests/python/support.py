"""What the tests share: models, small meshes, the tools, brute force."""

import csv
import json
import os
import subprocess

import numpy as np
import pytest

import treeform as tf

MODELS = os.environ.get("TREEFORM_MODELS_DIR", "")
SANITIZED = os.environ.get("TREEFORM_SANITIZED", "") != ""
needs_models = pytest.mark.skipif(not MODELS, reason="TREEFORM_MODELS_DIR is not set")


def tool(name):
    """The path of a tool; the test is skipped where it was not built."""
    path = os.environ.get(name.upper().replace("-", "_"), "")
    if not os.path.exists(path):
        pytest.skip(f"no {name}")
    return path


def run_tool(name, *arguments, status=(0, 1)):
    """The report of a tool."""
    done = subprocess.run([tool(name), *map(str, arguments), "-f", "-r", "-"], capture_output=True)
    assert done.returncode in status, done.stderr.decode()
    return json.loads(done.stdout)


def truth():
    """Rows of TRUTH.csv of meshes that can be read, as they are in doubles."""
    if not MODELS:
        return []
    with open(os.path.join(MODELS, "TRUTH.csv"), newline="") as file:
        rows = csv.DictReader([line for line in file if not line.startswith("#")])
        return [row for row in rows
                if row["precision"] != "f32" and row["status"] == "ok"
                and row["file"].endswith((".stl", ".obj", ".ply", ".off"))
                and int(row["triangles"]) > int(row["nonfinite_triangles"])]


def model(name):
    return os.path.join(MODELS, name)


# ---- meshes ----

CUBE = tf.read("data/cube.stl")
SPHERES = tf.read("data/two_spheres.stl")


def moved(mesh, *offset):
    return tf.Mesh(mesh.vertices + np.asarray(offset, float), mesh.faces)


def box(low, high):
    low, high = np.asarray(low, float), np.asarray(high, float)
    return tf.Mesh(low + CUBE.vertices * (high - low), CUBE.faces)


def sphere(levels=2, radius=1.0, center=(0.0, 0.0, 0.0)):
    """An octahedron, its faces cut into four, with vertices moved onto the sphere."""
    points = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
    faces = [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]
    points = [np.array(p, float) for p in points]
    for _ in range(levels):
        middle, finer = {}, []

        def between(a, b):
            key = (min(a, b), max(a, b))
            if key not in middle:
                middle[key] = len(points)
                sum_of = points[a] + points[b]
                points.append(sum_of / np.linalg.norm(sum_of))
            return middle[key]

        for a, b, c in faces:
            ab, bc, ca = between(a, b), between(b, c), between(c, a)
            finer += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
        faces = finer
    return tf.Mesh(np.array(points) * radius + center, np.array(faces, np.uint32))


SHEET = tf.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])


def same_mesh(a, b):
    """Whether two meshes have the same arrays, bit for bit."""
    return (np.array_equal(a.vertices.view(np.uint64), b.vertices.view(np.uint64))
            and np.array_equal(a.faces, b.faces))


def soup(seed, faces, size=8):
    """Random triangles with corners on a lattice: full of contacts of every kind."""
    rng = np.random.default_rng(seed)
    points = rng.integers(0, size, (faces * 2, 3)).astype(float)
    return points, rng.integers(0, len(points), (faces, 3)).astype(np.uint32)


# ---- brute force ----

def point_triangle_distance(p, a, b, c):
    """Distances of points (n, 3) from one triangle, by the nearest of its plane's point and
    edges."""
    normal = np.cross(b - a, c - a)
    best = np.full(len(p), np.inf)
    for s, t in ((a, b), (b, c), (c, a)):
        along = t - s
        share = np.clip((p - s) @ along / (along @ along), 0,
                        1) if along @ along else np.zeros(len(p))
        best = np.minimum(best, np.linalg.norm(p - (s + share[:, None] * along), axis=1))
    if normal @ normal:
        inside = np.ones(len(p), bool)
        for s, t in ((a, b), (b, c), (c, a)):
            inside &= np.cross(t - s, p - s) @ normal >= 0
        height = np.abs((p - a) @ normal) / np.sqrt(normal @ normal)
        best = np.where(inside, np.minimum(best, height), best)
    return best


def distances_from(mesh, points):
    """Distances of points from a mesh, one face after the other."""
    best = np.full(len(points), np.inf)
    for face in mesh.faces:
        best = np.minimum(best, point_triangle_distance(points, *mesh.vertices[face]))
    return best
