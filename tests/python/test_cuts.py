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
    loop = layers.loops(1)[0]
    assert layers.loops(-1) == [] and len(loop.points) == len(loop.faces)
    assert set(layers.in_space(1, layers.loops(1)[0].points)[:, 2]) == {0.4}
    with pytest.raises(IndexError):
        layers.loops(3)


def test_planes_may_lie_anywhere():
    tilted = tf.section(CUBE, (1, 1, 1), (0.5, 0.5, 0.5))
    assert tilted.areas[0] == pytest.approx(np.sqrt(27) / 4, rel=1e-14)
    assert np.allclose(tilted.axes @ tilted.axes.T, np.eye(3))
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


def test_halves_are_solids_that_add_up():
    below, above = tf.cut(SPHERES, (1, 2, 3), SPHERES.vertices.mean(axis=0))
    assert below.mesh.is_solid and above.mesh.is_solid and below.certificate
    whole = (SPHERES | SPHERES).volume
    assert below.mesh.volume + above.mesh.volume == pytest.approx(whole, rel=1e-12)
    for piece in (below, above):
        assert ((piece.cap == tf.NONE) == (piece.face_source != tf.NONE)).all()
    slices = tf.cut(CUBE, heights=[0.25, 0.5], precision="float32")
    assert [piece.mesh.volume for piece in slices] == [0.25, 0.25, 0.5]
    assert set(slices[1].cap) == {0, 1, tf.NONE}


def test_what_is_open_is_cut_without_caps_or_not_at_all():
    with pytest.raises(tf.NotClosedError):
        tf.cut(SHEET, (1, 0, 0), (0.5, 0, 0))
    assert tf.cut(SHEET, (1, 0, 0), (0.5, 0, 0), check=False) == []
    left, right = tf.cut(SHEET, (1, 0, 0), (0.5, 0, 0), caps=False)
    assert left.mesh.area + right.mesh.area == 0.5


def test_pieces_fit_and_keep_attributes():
    colors = tf.Attributes()
    colors.set_face("red", np.arange(12, dtype=np.uint8))
    painted = tf.Mesh(CUBE.vertices, CUBE.faces, colors)
    pieces = tf.cut_to_fit(painted, (0.5, np.inf, 0.75))
    assert len(pieces) == 4
    for piece in pieces:
        assert (np.ptp(piece.mesh.bounds, axis=0) == [0.5, 1, 0.5]).all()
        red = piece.mesh.attributes.face["red"]
        own = piece.cap == tf.NONE
        assert (red[own] == piece.face_source[own]).all() and (red[~own] == 0).all()


def test_pieces_say_whether_faces_met():
    assert tf.cut(SPHERES).resolved and not tf.cut(CUBE, at=(0, 0, 0.5)).resolved
    assert tf.cut_to_fit(CUBE, (0.5, 2, 2)).certificate


def test_parts():
    both = tf.concatenate([CUBE, moved(CUBE, 3, 0, 0), moved(SHEET, 9, 0, 0)])
    assert len(both.vertices) == 19 and tf.concatenate([]).faces.shape == (0, 3)
    parts = tf.components(both)
    assert [part.volume for part in parts] == [1.0, pytest.approx(1.0), 0.0]
    assert (parts[1].mesh.vertices == both.vertices[parts[1].vertex_source]).all()
    assert len(tf.components(both, min_volume=0.5)) == 2 and len(tf.components(both,
                                                                               largest=1)) == 1
    mask = np.zeros(25, bool)
    mask[24] = True
    assert tf.submesh(both, mask).mesh.area == tf.submesh(both, [24]).area == 0.5
    with pytest.raises(ValueError, match="faces: the shape of the mask"):
        tf.submesh(both, mask[:3])


def test_moved_and_weighed():
    turn = np.array([[0, -1, 0, 5], [1, 0, 0, 0], [0, 0, 2, 0], [0, 0, 0, 1.0]])
    tall = tf.transformed(CUBE, turn)
    mass = tf.mass_properties(tall)
    assert mass.volume == tall.volume == 2.0 and np.allclose(mass.center, [4.5, 0.5, 1])
    assert np.allclose(mass.inertia, np.diag([5 / 6, 5 / 6, 1 / 3]))
    assert tf.mass_properties(SHEET) is None
