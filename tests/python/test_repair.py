"""Meshes mended, wrapped, rounded; what is known of them."""

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from scipy.spatial import ConvexHull

import treeform as tf
from support import (CUBE, SHEET, SPHERES, model, moved, needs_models, run_tool, same_mesh, soup,
                     sphere)


def same_as_tool(folder, path):
    run_tool("tf-repair", path, "-o", folder / "tool.off", "--precision", "double",
             status=(0, 1))
    tf.write(folder / "own.off", tf.repair(tf.read(path)).mesh)
    return (folder / "tool.off").read_bytes() == (folder / "own.off").read_bytes()


def test_bytes_are_those_of_the_tool(tmp_path):
    assert same_as_tool(tmp_path, "data/dirty.stl")
    run_tool("tf-selfintersect", "--repair", "data/two_spheres.stl", "-o", tmp_path / "tool.off",
             "--precision", "double")
    tf.write(tmp_path / "own.off", tf.resolve_self_intersections(SPHERES).mesh)
    assert (tmp_path / "tool.off").read_bytes() == (tmp_path / "own.off").read_bytes()


@needs_models
@pytest.mark.parametrize("name", ["cad/tray_bottom_5k.stl", "coplanar/cubes_touching.stl",
                                  "degenerate/implant_42400_11k.stl"])
def test_bytes_are_those_of_the_tool_on_real_models(tmp_path, name):
    assert same_as_tool(tmp_path, model(name))


def test_a_dirty_mesh_becomes_a_solid():
    dirty = tf.read("data/dirty.stl")
    assert tf.find_solid_defects(dirty)
    mended = tf.repair(dirty)
    assert not tf.find_solid_defects(mended.mesh)
    assert mended.statistics["holes"] == 2 and mended.statistics["strays"] == 1
    filled = mended.face_source == tf.NONE
    assert filled.sum() == mended.statistics["filled"]


def test_a_solid_comes_back_bit_for_bit():
    assert same_mesh(tf.repair(CUBE).mesh, CUBE)


def test_coplanar_faces_that_were_cut_are_merged_unless_values_part_them():
    both = tf.Mesh(np.vstack([CUBE.vertices, CUBE.vertices + [0.5, 0, 0]]),
                   np.vstack([CUBE.faces, CUBE.faces + 8]))
    merged, as_cut = tf.repair(both), tf.repair(both, keep_cuts=True)
    assert len(merged.mesh.faces) == 12 < len(as_cut.mesh.faces)
    assert merged.is_kept.dtype == bool and merged.is_kept.sum() == 20
    assert np.array_equal(merged.is_kept, as_cut.is_kept)
    assert set(as_cut.face_source) == set(np.flatnonzero(merged.is_kept))
    outer = tf.resolve_self_intersections
    assert len(outer(both).mesh.faces) == 12
    assert len(outer(both, keep_cuts=True).mesh.faces) == len(as_cut.mesh.faces)
    numbers = tf.Attributes()
    numbers.set_face("number", np.arange(24))
    for verb in (tf.repair, outer):
        made = verb(tf.Mesh(both.vertices, both.faces, numbers))
        assert len(made.mesh.faces) == len(as_cut.mesh.faces)
        assert np.array_equal(made.mesh.attributes.face["number"], made.face_source)


def test_what_cannot_be_mended_is_said():
    with pytest.raises(tf.CertificateError) as caught:
        tf.repair(SHEET)
    assert caught.value.certificate.open_count == 3
    assert tf.repair(SHEET, sheet=True).certificate.status == "sheet"
    assert tf.repair(SHEET, check=False).certificate.status == caught.value.certificate.status
    with pytest.raises(ValueError, match="steps"):
        tf.repair(CUBE, steps=["join", "paint"])


def test_self_intersections_resolved():
    outer = tf.resolve_self_intersections(SPHERES)
    split = tf.resolve_self_intersections(SPHERES, "split")
    removed = tf.resolve_self_intersections(SPHERES, "remove", max_loss=1)
    for made in (outer, split, removed):
        assert made.certificate and len(tf.self_intersections(made)) == 0
    assert outer.mesh.volume == pytest.approx(tf.union(SPHERES).mesh.volume)
    assert split.mesh.area == pytest.approx(SPHERES.area)
    with pytest.raises(tf.NotClosedError):
        tf.resolve_self_intersections(SHEET)


@settings(max_examples=25)
@given(st.integers(0, 10**6), st.integers(1, 12))
def test_what_is_split_meets_nowhere(seed, faces):
    made = tf.resolve_self_intersections(soup(seed, faces), "split", check=False)
    if made.certificate:
        assert len(tf.self_intersections(made)) == 0


def test_a_wrap_holds_the_mesh():
    around = tf.wrap(SHEET, 0.2, offset=0.05)
    assert around.mesh.is_solid and around.certificate
    assert tf.contains(around, SHEET.vertices).all()
    assert not tf.intersects(around, SHEET)
    with pytest.raises(ValueError, match="size"):
        tf.wrap(SHEET, -1.0)


@settings(max_examples=40)
@given(st.integers(0, 10**6), st.integers(5, 200))
def test_a_convex_hull_is_that_of_qhull(seed, count):
    points = np.random.default_rng(seed).standard_normal((count, 3))
    hull, judge = tf.convex_hull(points), ConvexHull(points)
    assert hull.dimension == 3
    assert set(hull.faces.ravel().tolist()) == set(judge.vertices.tolist())
    assert tf.Mesh(points, hull.faces).volume == pytest.approx(judge.volume)
    assert hull.areas.sum() == pytest.approx(judge.area)


def test_hulls_that_are_flat():
    assert tf.convex_hull(np.empty((0, 3))).dimension == -1
    assert tf.convex_hull([[1, 2, 3]] * 3).dimension == 0
    assert tf.convex_hull([[0, 0, 0], [1, 1, 1], [2, 2, 2]]).dimension == 1
    assert tf.convex_hull(SHEET.vertices).dimension == 2


def test_rounding():
    third = CUBE.vertices / 3
    assert np.array_equal(tf.rounded(third), third.astype(np.float32).astype(float))
    assert np.array_equal(tf.rounded(third, "float64"), third)
    squashed = CUBE.vertices * [1, 1, 0]
    collapsed, meeting = tf.find_rounding_defects(CUBE, squashed)
    assert collapsed == 8 and meeting > 0
    with pytest.raises(ValueError):
        tf.find_rounding_defects(CUBE, squashed[:3])


def test_equal_points_are_joined():
    repeated = tf.read("data/cube.stl", join=False)
    joined = tf.join_equal_points(repeated)
    assert len(joined.vertices) == 8
    assert np.array_equal(joined.vertices[joined.faces], repeated.vertices[repeated.faces])


def test_defects_and_topology():
    points = [[0, 0, 0], [1, 1, 1], [3, 3, 3], [np.nan, 0, 0]]
    defects = tf.find_invalid_faces((points, [[0, 1, 2], [0, 1, 3], [0, 1, 9]]))
    assert defects.nonfinite_points.tolist() == [3] and defects.nonfinite_faces.tolist() == [1]
    assert defects.degenerate_faces.tolist() == [0] and defects.out_of_range_faces.tolist() == [2]
    counts = tf.count_topology(SHEET)
    assert counts.boundary_edges == 3 and not counts.closed_manifold
    ball = tf.count_topology(sphere(2))
    assert ball.closed_manifold and ball.points_used - ball.edges + ball.faces == 2
    both = tf.Mesh(np.vstack([CUBE.vertices, CUBE.vertices + 5]),
                   np.vstack([CUBE.faces, CUBE.faces + 8]))
    assert tf.face_components(both).tolist() == [0] * 12 + [1] * 12
    assert tf.count_topology(both).components_by_edge == 2


def test_what_is_not_finite_or_no_face_is_a_defect():
    nan = np.array([[np.nan, 0, 0]])
    inf = np.array([[0, np.inf, 0]])
    unused = tf.find_solid_defects((np.vstack([CUBE.vertices, nan, inf]), CUBE.faces))
    assert unused and unused.nonfinite_vertices == 2 and unused.unusable_faces == 0
    assert "2 vertices that are not finite" in unused.message
    used = tf.find_solid_defects((np.vstack([CUBE.vertices, nan]),
                                  np.vstack([CUBE.faces, [0, 1, 8]])))
    assert used.unusable_faces == 1 and used.boundary_edges == used.degenerate == 0
    beyond = tf.find_solid_defects((CUBE.vertices, np.vstack([CUBE.faces, [0, 1, 99]])))
    assert beyond and beyond.unusable_faces == 1 and beyond.nonfinite_vertices == 0
    for vertices in (CUBE.vertices, nan, np.full((8, 3), np.nan)):
        cloud = tf.find_solid_defects((vertices, []))
        assert cloud and cloud.without_faces
    assert tf.find_solid_defects((np.full((8, 3), np.nan), CUBE.faces)).without_faces
    assert not tf.find_solid_defects(([], []))


def test_help_has_the_keys_of_steps_and_what_is_raised():
    made = tf.repair(tf.read("data/dirty.stl"))
    assert made.message == "40 faces flipped, 1 stray face dropped, 2 holes filled (9 edges)"
    assert tf.repair(made).message == ""
    for key in made.statistics:
        assert f"'{key}'" in tf.RepairResult.__doc__
    assert "Mesh.volume" in tf.RepairResult.__doc__
    for key in tf.weld(CUBE).statistics:
        assert f"'{key}'" in tf.WeldResult.__doc__
    for function in (tf.repair, tf.resolve_self_intersections):
        assert "Check the certificate" not in function.__doc__
    assert "if the mesh stays open" in " ".join(tf.repair.__doc__.split())


def test_touching_pairs_and_equal_corners_count_unless_told():
    """As help says, unlike tf-selfintersect."""
    soup = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 0], [-1, 0, 1], [0, -1, 1]]
    faces = [[0, 1, 2], [3, 4, 5]]
    assert len(tf.self_intersections((soup, faces))) == 0
    assert tf.self_intersections((soup, faces), vertices="by_index").counts["touching"] == 1
    assert len(tf.self_intersections((soup, faces), vertices="by_index", kinds=["crossing"])) == 0
    text = " ".join(tf.self_intersections.__doc__.split())
    assert "degenerate pairs are included" in text
