"""Faces that meet: the same pairs as the tool and as known of real models; brute force."""

import csv

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

import treeform as tf
from support import (CUBE, SPHERES, box, model, moved, needs_models, run_tool, soup, truth)

CHOSEN = ["selfint", "coplanar", "degenerate", "duplicates", "clean", "cad"]


def pairs_of_tool(path, folder):
    report = run_tool("tf-selfintersect", path, "--touching", "--vertices", "equal",
                      "--pairs", folder / "pairs.csv")
    with open(folder / "pairs.csv", newline="") as file:
        rows = list(csv.reader(file))[1:]
    return report, np.array([[int(a), int(b)] for a, b, *_ in rows]).reshape(-1, 2), \
        [kind for _, _, kind, *_ in rows]


@needs_models
def test_pairs_are_those_of_the_tool(tmp_path):
    checked = 0
    for row in truth():
        if row["file"].split("/")[0] not in CHOSEN or int(row["triangles"]) > 60_000 or \
                int(row["nonfinite_triangles"]):
            continue
        mesh = tf.read(model(row["file"]))
        report, pairs, kinds = pairs_of_tool(model(row["file"]), tmp_path)
        if mesh.attributes.face_of_triangle is not None or report["files"][0].get("joined"):
            continue
        found = tf.self_intersections(mesh)
        assert np.array_equal(found.pairs, pairs), row["file"]
        assert [tf.KINDS[kind] for kind in found.kinds] == kinds, row["file"]
        assert sum(found.counts.values()) == len(pairs)
        checked += 1
    assert checked > 15


def test_options():
    every = tf.self_intersections(SPHERES)
    assert len(every) == 78 and every.counts["crossing"] == 78
    assert len(tf.self_intersections(SPHERES, kinds=["touching"])) == 0
    assert len(tf.self_intersections(SPHERES, kinds="touching")) == 0
    some = tf.self_intersections(SPHERES, limit=5)
    assert np.array_equal(some.pairs, every.pairs[:5]) and some.counts == every.counts
    assert len(tf.self_intersections(SPHERES, first_only=True)) == 1
    assert np.array_equal(every.of_kind("crossing", "pierce"), every.pairs)


def test_vertices_by_coordinates_or_by_index():
    repeated = tf.read("data/cube.stl", join=False)
    assert len(tf.self_intersections(repeated)) == 0
    assert len(tf.self_intersections(repeated, vertices="by_index")) > 0


@settings(max_examples=60)
@given(st.integers(0, 10**6), st.integers(2, 40))
def test_two_halves_meet_where_the_whole_does(seed, faces):
    points, all_faces = soup(seed, faces)
    half = faces // 2
    a, b = all_faces[:half], all_faces[half:]
    between = tf.mesh_intersections((points, a), (points, b))
    assert tf.intersects((points, a), (points, b)) == (len(between) > 0)
    # Each pair of the whole, except that faces of one mesh may share corners without meeting.
    whole = tf.self_intersections((points, all_faces))
    across = {(i, j) for i, j in whole.pairs.tolist() if i < half <= j}
    assert across <= {(i, j + half) for i, j in between.pairs.tolist()}


@settings(max_examples=60)
@given(st.integers(0, 10**6), st.integers(1, 40))
def test_the_order_of_faces_does_not_matter(seed, faces):
    points, all_faces = soup(seed, faces)
    order = np.random.default_rng(seed).permutation(faces)
    found = tf.self_intersections((points, all_faces))
    turned = tf.self_intersections((points * 2.0, np.roll(all_faces[order], 1, axis=1)))
    back = np.sort(order[turned.pairs.astype(int)].reshape(-1, 2), axis=1)
    assert sorted(map(tuple, back.tolist())) == list(map(tuple, found.pairs.tolist()))
    assert turned.counts == found.counts


def test_regions_and_curves():
    found = tf.self_intersections(SPHERES)
    regions = tf.intersection_regions(SPHERES, found)
    assert len(regions) == 1 and regions[0].pairs.tolist() == list(range(78))
    assert set(regions[0].faces.tolist()) == set(found.pairs.ravel().tolist())
    curves = tf.intersection_curves(SPHERES, found)
    assert len(curves) == 1 and np.array_equal(curves[0][0], curves[0][-1])


def test_curves_can_be_written(tmp_path):
    found = tf.self_intersections(SPHERES)
    tf.write_curves(tmp_path / "curves.obj", SPHERES, found)
    lines = (tmp_path / "curves.obj").read_text().splitlines()
    assert [line.split()[0] for line in lines] == ["v"] * 78 + ["l"]
    [curve] = tf.intersection_curves(SPHERES, found)
    points = np.array([line.split()[1:] for line in lines[:78]], float)
    assert np.array_equal(points[np.array(lines[78].split()[1:], int) - 1], curve)
    tf.write_curves(tmp_path / "curves.txt", SPHERES, found, "ply")
    assert (tmp_path / "curves.txt").read_text().startswith("ply")
    with pytest.raises(tf.FileError, match="obj or ply"):
        tf.write_curves(tmp_path / "curves.dxf", SPHERES, found)


def test_faces_in_box():
    assert np.array_equal(tf.faces_in_box(CUBE, [-1, -1, -1], [2, 2, 2]), np.arange(12))
    assert len(tf.faces_in_box(CUBE, [0.4, 0.4, 0.4], [0.6, 0.6, 0.6])) == 0
    with pytest.raises(ValueError, match="min"):
        tf.faces_in_box(CUBE, [1, 1, 1], [0, 0, 0])


@needs_models
def test_a_file_in_tiles_has_the_pairs_of_the_whole(tmp_path):
    path = tmp_path / "m.stl"
    tf.write(path, tf.read(model("cad/featuretype_3k.stl"), join=False))
    whole = tf.self_intersections(tf.read(path))
    tiled = tf.self_intersections_of_file(path, memory=200 << 20)
    assert np.array_equal(tiled.pairs_in_file, whole.pairs)
    assert np.array_equal(tiled.kinds, whole.kinds) and tiled.counts == whole.counts
    assert list(tmp_path.iterdir()) == [path]


def test_a_file_in_tiles_that_is_of_another_format_is_refused(tmp_path):
    (tmp_path / "m.obj").write_text("v 0 0 0\n")
    with pytest.raises(tf.FileError, match="m.obj"):
        tf.self_intersections_of_file(tmp_path / "m.obj")


def test_two_meshes_that_are_moved():
    away = np.eye(4)
    away[0, 3] = 3
    assert len(tf.mesh_intersections(CUBE, CUBE, transform_b=away)) == 0
    half = np.eye(4)
    half[:3, 3] = 0.5
    moved_b = tf.mesh_intersections(CUBE, CUBE, transform_b=half)
    assert np.array_equal(moved_b.pairs,
                          tf.mesh_intersections(CUBE, moved(CUBE, 0.5, 0.5, 0.5)).pairs)
    assert tf.mesh_intersections(CUBE, box([1, 0, 0], [2, 1, 1])).counts["crossing"] == 0
