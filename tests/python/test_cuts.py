"""Sections of meshes."""

import json

import numpy as np
import pytest

import treeform as tf
from support import CUBE, SHEET, SPHERES, moved


def test_a_section_has_closed_loops_that_lie_in_each_other():
    shell = tf.difference(moved(CUBE, -0.5, -0.5, -0.5), tf.Mesh(
        (CUBE.vertices - 0.5) / 2, CUBE.faces)).mesh
    layers = tf.section(shell, heights=[0.0, 0.4, 2.0])
    assert len(layers) == 3 and layers.areas.tolist() == [0.75, 1.0, 0.0]
    assert not layers.open_counts.any() and repr(layers) == "Section(3 layers, 3 loops)"
    outer, hole = layers.loops(0)
    assert (outer.depth, hole.depth, hole.parent, outer.parent) == (0, 1, 0, None)
    assert outer.closed and outer.oriented and hole.area == -0.25 and hole.length == 2.0
    assert layers.loops(-1) == [] and len(layers.loops(1)[0].points) == len(layers.loops(1)[0].faces)
    assert set(layers.in_space(1, layers.loops(1)[0].points)[:, 2]) == {0.4}
    with pytest.raises(IndexError):
        layers.loops(3)


def test_planes_may_lie_anywhere():
    tilted = tf.section(CUBE, (1, 1, 1), (0.5, 0.5, 0.5))
    assert tilted.areas[0] == pytest.approx(np.sqrt(27) / 4, rel=1e-14)
    assert np.allclose(tilted.frame @ tilted.frame.T, np.eye(3))
    points = tilted.in_space(0, tilted.points)
    assert np.allclose(points.sum(axis=1), 1.5)


def test_an_open_mesh_has_open_polylines():
    found = tf.section(SHEET, (1, 0, 0), SHEET.vertices.mean(axis=0) + 1e-3)
    assert found.open_counts[0] == 1 and not found.loops()[0].closed


def test_files(tmp_path):
    layers = tf.section(SPHERES, heights=tf.layer_heights(SPHERES, 0.5))
    for name in ("a.svg", "a.dxf", "a.obj", "a.json"):
        layers.write(tmp_path / name)
    content = json.loads((tmp_path / "a.json").read_text())
    assert [layer["area"] for layer in content["layers"]] == layers.areas.tolist()
    assert content["layers"][0]["loops"][0]["points"] == layers.loops(0)[0].points.tolist()
    with pytest.raises(tf.FileError, match="svg, dxf, obj or json"):
        layers.write(tmp_path / "a.stl")
