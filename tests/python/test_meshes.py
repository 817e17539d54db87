"""Mesh: what it says of itself, its operators, what it keeps."""

import copy
import gc
import pickle

import numpy as np
import pytest

import treeform as tf
from support import CUBE, SHEET, SPHERES, box, moved, same_mesh, sphere


def test_what_a_mesh_says_of_itself():
    assert CUBE.is_solid and not SHEET.is_solid
    assert not SPHERES.is_solid and tf.check_operand(SPHERES)
    assert not tf.Mesh(CUBE.vertices).is_solid
    assert CUBE.volume == 1 and CUBE.area == 6
    assert tf.Mesh(CUBE.vertices, CUBE.faces[:, ::-1]).volume == -1
    with pytest.raises(ValueError, match="face 0"):
        tf.Mesh(CUBE.vertices, [[0, 1, 9]]).area
    assert CUBE.bounds.tolist() == [[0, 0, 0], [1, 1, 1]]
    assert tf.Mesh([], []).bounds is None
    assert repr(CUBE) == "Mesh(8 vertices, 12 faces)"
    vertices, faces = CUBE
    assert vertices.shape == (8, 3) and faces.shape == (12, 3)
    assert tf.check_operand(SHEET).open_count == 3


def test_operators_are_set_operations():
    b = moved(CUBE, 0.5, 0.5, 0.5)
    for made, wanted in ((CUBE | b, tf.union), (CUBE & b, tf.intersection),
                         (CUBE - b, tf.difference), (CUBE ^ b, tf.symmetric_difference)):
        assert same_mesh(made, wanted(CUBE, b).mesh)
        assert made.certificate


def test_a_formula_is_computed_at_once_when_it_is_looked_at():
    a, b, c = CUBE, moved(CUBE, 0.3, 0.2, 0.1), box([0.2] * 3, [0.7] * 3)
    made = (a | b) - c
    assert repr(made) == "Mesh(of 3 meshes, not computed yet)"
    assert same_mesh(made, tf.boolean("(a|b)-c", a=a, b=b, c=c).mesh)
    assert "vertices" in repr(made)
    assert same_mesh((a | b) & a, tf.boolean("(a|b)*a", a=a, b=b).mesh)


def test_the_other_side_may_be_arrays():
    arrays = (CUBE.vertices + 0.5, CUBE.faces)
    assert (CUBE | arrays).volume == (arrays | CUBE).volume == 1.875
    assert (arrays - CUBE).volume == 0.875 and (arrays & CUBE).volume == 0.125
    assert (arrays ^ CUBE).volume == 1.75
    with pytest.raises(TypeError):
        CUBE | 3


def test_an_open_operand_is_named_by_the_operator():
    with pytest.raises(tf.NotClosedError) as caught:
        CUBE - SHEET
    assert caught.value.edges.shape == (3, 2, 3)
    assert isinstance(caught.value, ValueError)


def test_a_formula_of_thousands_of_meshes_is_computed():
    row = tf.Mesh([], [])
    for i in range(3000):
        row = row | box([2 * i, 0, 0], [2 * i + 1, 1, 1])
    assert row.volume == 3000
    again = CUBE
    for _ in range(200):  # 2^200 meshes if they were counted one by one
        again = again | again
    assert again.volume == 1


def test_indexes_are_kept():
    mesh = sphere(3)
    tf.closest_point(mesh, [[0, 0, 0]])
    built = mesh._held.indexes_built
    assert built > 0
    tf.closest_point(mesh, [[0, 0, 1]])
    assert mesh._held.indexes_built == built


def test_arrays_outlive_what_they_came_from():
    vertices = sphere(1).vertices
    pairs = tf.self_intersections(SPHERES).pairs
    hull = tf.union(CUBE, moved(CUBE, 0.5, 0, 0)).mesh.vertices
    gc.collect()
    assert np.isfinite(vertices).all() and pairs.max() < 640 and hull.max() == 1.5


def test_copies():
    for made in (pickle.loads(pickle.dumps(SPHERES)), copy.deepcopy(SPHERES), copy.copy(SPHERES)):
        assert same_mesh(made, SPHERES)


COPIES = [copy.copy, copy.deepcopy, lambda one: pickle.loads(pickle.dumps(one))]


@pytest.mark.parametrize("again", COPIES)
def test_copies_keep_certificate_and_attributes(again, tmp_path):
    made = again(tf.union(CUBE, tf.Mesh(CUBE.vertices / 3 + 0.9, CUBE.faces)))
    assert made.mesh.certificate and str(made.certificate) == str(made.mesh.certificate)
    with pytest.raises(tf.FileError, match="round"):
        tf.write(tmp_path / "m.stl", again(made.mesh))
    (tmp_path / "m.obj").write_text("o first\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0.5 0.25\n"
                                    "f 1/1 2/1 3/1 4/1\n")
    mesh = tf.read(tmp_path / "m.obj")
    mesh.attributes.set_vertex("quality", np.arange(4, dtype=np.float32))
    other = again(mesh)
    tf.write(tmp_path / "a.obj", mesh)
    tf.write(tmp_path / "b.obj", other)
    assert (tmp_path / "a.obj").read_bytes() == (tmp_path / "b.obj").read_bytes()
    assert other.attributes.vertex["quality"].tolist() == [0, 1, 2, 3]
    extra = again(mesh.attributes)
    extra.set_vertex("quality", np.zeros(4))
    assert mesh.attributes.vertex["quality"][1] == 1


@pytest.mark.parametrize("again", COPIES)
def test_results_errors_and_trees_can_be_copied(again):
    with pytest.raises(tf.NotClosedError) as caught:
        tf.union(SHEET)
    error = again(caught.value)
    assert np.array_equal(error.edges, caught.value.edges) and str(error) == str(caught.value)
    assert isinstance(error, tf.NotClosedError) and error.certificate.open_count == 3
    tree = again(tf.PointTree(CUBE.vertices))
    assert tree.query([0, 0, 0.1])[1] == tf.PointTree(CUBE.vertices).query([0, 0, 0.1])[1]
    boxes = again(tf.BoxTree([[0, 0], [2, 0], [1, 1]], [[1, 1], [3, 1], [2, 2]]))
    assert boxes.pairs().tolist() == [[0, 2], [1, 2]]
    again(tf.clash([CUBE, SPHERES]))


def test_from_and_to_trimesh(monkeypatch):
    class Trimesh:
        def __init__(self, vertices, faces, process=True):
            self.vertices, self.faces = vertices, faces

    import sys
    import types
    monkeypatch.setitem(sys.modules, "trimesh", types.SimpleNamespace(Trimesh=Trimesh))
    there = CUBE.to_trimesh()
    assert there.faces.dtype == np.int64 and there.vertices.flags.writeable
    assert same_mesh(tf.from_trimesh(there), CUBE)


def test_boxes_and_shapes_that_do_not_fit():
    made = tf.union(tf.Mesh.box([0, 0, 0], [1, 2, 3]), tf.Mesh.box([0, 0, 3], [1, 2, 4]))
    assert made.mesh.volume == 8 and made.mesh.bounds.tolist() == [[0, 0, 0], [1, 2, 4]]
    with pytest.raises(ValueError, match=r"reshape\(-1, 3\)"):
        tf.Mesh(np.zeros(24), [[0, 1, 2]])
    with pytest.raises(ValueError, match=r"a single one is \[points\]"):
        tf.contains(CUBE, [0, 0, 0])
