"""Offsets, fewer faces, thickness, boxes, isolines."""

import numpy as np
import pytest

import treeform as tf
from support import CUBE, SHEET, SPHERES


def test_solids_are_grown_shrunk_and_hollowed():
    grown = tf.offset(CUBE, 0.25, resolution=0.1)
    assert grown.certificate and grown.mesh.is_solid and 2.9 < grown.mesh.volume < 3.2
    assert 0.2 < grown.least_distance <= grown.greatest_distance < 0.3
    assert tf.offset(CUBE, -0.25, resolution=0.1).mesh.volume == pytest.approx(0.125, rel=0.1)
    shell = tf.hollow(CUBE, 0.1, resolution=0.05)
    drained = tf.hollow(CUBE, 0.1, drains=[[0.5, 0.5, 0, 0.2]], resolution=0.05)
    assert drained.sealed_cavities == 0 and len(drained.blind_drains) == 0
    assert shell.sealed_cavities == 1
    assert shell.mesh.is_solid and drained.mesh.is_solid
    assert drained.mesh.volume < shell.mesh.volume < 0.5
    with pytest.raises(tf.NotClosedError):
        tf.offset(SHEET, 0.1)
    with pytest.raises(ValueError, match="rows|shape|4"):
        tf.hollow(CUBE, 0.1, drains=[[0.5, 0.5, 0]])


def test_a_surface_is_made_thick():
    for shift in (0, 0.1, -0.1):
        assert tf.thicken(SHEET, 0.2, shift=shift).mesh.is_solid
    with pytest.raises(ValueError, match="shift"):
        tf.thicken(SHEET, 0.2, shift=np.nan)


def test_fewer_faces_stay_within_the_distance():
    fewer = tf.simplify(SPHERES, 0.05)
    assert fewer.certificate and len(fewer.mesh.faces) < len(SPHERES.faces)
    assert max(fewer.input_to_result_bound, fewer.result_to_input_bound) <= 0.05
    assert len(fewer.face_source) == len(fewer.mesh.faces)
    assert tf.deviation(SPHERES, fewer.mesh).max <= 0.05
    heights = tf.Attributes()
    heights.set_vertex("height", SPHERES.vertices[:, 2])
    made = tf.simplify(tf.Mesh(SPHERES.vertices, SPHERES.faces, heights), 0.05)
    assert np.abs(made.mesh.attributes.vertex["height"] - made.mesh.vertices[:, 2]).max() < 0.051
    stays = made.vertex_source != tf.NONE
    assert np.array_equal(made.mesh.vertices[stays], SPHERES.vertices[made.vertex_source[stays]])
    assert np.array_equal(stays, made.face_of_new_vertex == tf.NONE)
    assert len(tf.simplify(SPHERES, 0.5, target_faces=600).mesh.faces) >= 598


def test_borders_of_groups_and_values_stay():
    grid = [(x, y, 0) for x in range(9) for y in range(9)]
    faces = [f for p in range(80) if p % 9 < 8 and p < 72
             for f in ((p, p + 9, p + 10), (p, p + 10, p + 1))]
    groups = [int(f[0] >= 36) for f in faces]
    assert len(tf.simplify((grid, faces), 0.001).mesh.faces) == 2
    made = tf.simplify((grid, faces), 0.001, face_groups=groups)
    assert sorted(np.take(groups, made.face_source)) == [0, 0, 1, 1]
    values = tf.Attributes()
    values.set_face("side", np.array(groups))
    made = tf.simplify(tf.Mesh(grid, faces, values), 0.001)
    assert sorted(made.mesh.attributes.face["side"]) == [0, 0, 1, 1]
    with pytest.raises(ValueError, match="one entry of face_groups for each face"):
        tf.simplify((grid, faces), 0.001, face_groups=[1])


def test_walls_and_boxes_are_measured():
    assert tf.wall_thickness(CUBE).of_face.tolist() == [1.0] * 12
    assert tf.wall_thickness(CUBE, by="sphere").min <= 1.0
    box = tf.oriented_box([[0, 0, 0], [3, 4, 0], [1.5, 2, 0]])
    assert box.size == pytest.approx([5, 0, 0]) and box.center == pytest.approx([1.5, 2, 0])
    assert tf.oriented_box(np.zeros((0, 3))) is None
    hull = tf.convex_hull([[0, 0, 0], [9, 9, 9], [4, 4, 1], [0, 9, 0], [9, 0, 0]])
    assert hull.mesh.is_solid and tf.find_solid_defects(hull).message == "no defects"
    assert tf.convex_hull(CUBE).mesh.volume == 1.0


def test_lines_and_pieces_follow_values(tmp_path):
    values = CUBE.vertices[:, 2]
    lines = tf.isolines(CUBE, values, [0.25, 2])
    assert len(lines.lines) == 1 and lines.lines[0].closed
    assert set(lines.points_of(0)[:, 2]) == {0.25}
    lines.write(tmp_path / "lines.svg", normal=(1, 1, 0), unit="mm")
    assert '<svg xmlns="http://www.w3.org/2000/svg" width="' in (tmp_path / "lines.svg").read_text()
    lines.write(tmp_path / "lines.txt", format="obj")
    assert (tmp_path / "lines.txt").read_text().count("v ") == lines.lines[0].point_count
    low, high = tf.cut_along(CUBE, values, [0.25])
    assert low.mesh.area == pytest.approx(2) and high.mesh.area == pytest.approx(4)
    with pytest.raises(ValueError, match="values"):
        tf.isolines(CUBE, values[:3], [0.5])
