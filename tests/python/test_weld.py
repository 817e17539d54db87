"""Welding: the bytes of the tool, the definition by brute force, files larger than memory."""

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

import treeform as tf
from support import CUBE, model, moved, needs_models, run_tool, sphere


def test_bytes_are_those_of_the_tool(tmp_path):
    run_tool("tf-weld", "data/sphere.ply", "-t", "0.15", "-o", tmp_path / "tool.ply")
    tf.write(tmp_path / "own.ply", tf.weld(tf.read("data/sphere.ply"), 0.15))
    assert (tmp_path / "tool.ply").read_bytes() == (tmp_path / "own.ply").read_bytes()


@needs_models
@pytest.mark.parametrize("rule", ["first", "chain"])
def test_bytes_of_clouds_are_those_of_the_tool(tmp_path, rule):
    path = model("cloud/terrain_samp11_38k.ply")
    run_tool("tf-weld", path, "-t", "1", "--rule", rule, "-o", tmp_path / "tool.ply")
    tf.write(tmp_path / "own.ply", tf.weld(tf.read(path), 1.0, chain=rule == "chain"))
    assert (tmp_path / "tool.ply").read_bytes() == (tmp_path / "own.ply").read_bytes()


def first_rule(points, tolerance):
    """The definition: a point is dropped when an earlier kept one is within the tolerance."""
    kept, index = [], np.empty(len(points), int)
    for i, p in enumerate(points):
        near = [(np.sum((p - points[j]) ** 2), n) for n, j in enumerate(kept)
                if np.sum((p - points[j]) ** 2) <= tolerance**2]
        if near:
            index[i] = min(near)[1]
        else:
            index[i] = len(kept)
            kept.append(i)
    return kept, index


@settings(max_examples=60)
@given(st.integers(0, 10**6), st.integers(0, 60), st.sampled_from([0.0, 1.0, 2.0, 2.5]))
def test_a_cloud_is_welded_as_defined(seed, count, tolerance):
    points = np.random.default_rng(seed).integers(0, 8, (count, 3)).astype(float)
    made = tf.weld(points, tolerance)
    kept, index = first_rule(points, tolerance)
    assert np.array_equal(made.points, points[kept].reshape(-1, 3))
    assert np.array_equal(made.group_of_point, index)
    assert np.array_equal(made.vertex_source, kept)
    assert len(tf.weld(made.points, tolerance).points) == len(kept)


def test_the_forms_that_points_come_in():
    points = [[0, 0, 0], [0, 0, 0.5], [0, 0, 1]]
    for cloud in (points, np.array(points), tuple(map(tuple, points)), (points, [])):
        assert len(tf.weld(cloud, 0.6).points) == 2
    assert len(tf.weld(points, 0.6, chain=True).points) == 1
    assert tf.weld(points, 1.0, keep="mean").points.tolist() == [[0, 0, 0.5]]


def test_meshes_and_their_attributes():
    repeated = tf.read("data/cube.stl", join=False)
    made = tf.weld(repeated)
    assert len(made.vertices) == 8 and len(made.faces) == 12 and made.mesh.is_solid
    extra = tf.Attributes()
    extra.set_vertex("quality", np.arange(36.0))
    made = tf.weld(tf.Mesh(repeated.vertices, repeated.faces, extra), 0.0)
    assert np.array_equal(made.mesh.attributes.vertex["quality"], made.vertex_source)
    apart = tf.weld(tf.Mesh(repeated.vertices, repeated.faces, extra), 0.0, same={"quality": 0.5})
    assert len(apart.vertices) == 36
    kept = tf.weld(tf.Mesh(repeated.vertices, repeated.faces, extra), 0.0, keep="highest",
                   keep_by="quality")
    assert (kept.mesh.attributes.vertex["quality"] > made.vertex_source).any()


def test_labels_and_other_options():
    points = np.zeros((4, 3))
    assert len(tf.weld(points, 1.0, label=[0, 0, 1, 2]).points) == 3
    with pytest.raises(ValueError, match="label"):
        tf.weld(points, 1.0, label=[0, 0])
    with pytest.raises(ValueError, match="tolerance"):
        tf.weld(points, -1.0)
    with pytest.raises(ValueError, match="quality"):
        tf.weld(points, 1.0, keep="lowest", keep_by="quality")
    touching = tf.Mesh(np.vstack([CUBE.vertices, moved(CUBE, 1, 1, 0).vertices]),
                       np.vstack([CUBE.faces, CUBE.faces + 8]))
    assert len(tf.weld(touching).vertices) == 14
    assert len(tf.weld(touching, keep_manifold=True).vertices) == 16
    ball = sphere(2)
    thin = tf.weld(ball, 0.3)
    assert thin.statistics["collapsed"] + len(thin.faces) == len(ball.faces)
    assert np.array_equal(thin.group_of_point[ball.faces[thin.face_source]], thin.faces)


def test_how_many_are_nearly_equal():
    assert tf.count_nearly_equal([[0, 0, 0], [0, 0, 0], [0, 0, 1e-6], [5, 5, 5]], 1e-5) == 1
    for other in (np.nan, np.inf):  # is near nothing
        assert tf.count_nearly_equal([[other] * 3] * 5 + [[0, 0, 0], [0, 0, 1e-6]], 1e-5) == 1


def test_a_file_in_tiles_is_that_of_the_whole(tmp_path):
    points = np.random.default_rng(3).random((20_000, 3)) * 10
    tf.write(tmp_path / "a.ply", (points[:12_000], []))
    tf.write(tmp_path / "b.ply", (points[12_000:], []))
    done = tf.weld_stream([tmp_path / "a.ply", tmp_path / "b.ply"], tmp_path / "thin.ply", 0.2,
                          removed=tmp_path / "gone.ply", points_per_tile=2000)
    whole = tf.weld(points, 0.2)
    assert done.points == 20_000 and done.kept == len(whole.points) and done.tiles > 5
    assert np.array_equal(tf.read(tmp_path / "thin.ply").vertices, whole.points)
    assert len(tf.read(tmp_path / "gone.ply").vertices) == 20_000 - done.kept
    assert len(list(tmp_path.iterdir())) == 4
    with pytest.raises(tf.FileError, match="no_such"):
        tf.weld_stream(tmp_path / "no_such.ply", tmp_path / "x.ply", 1.0)


def test_a_mesh_in_tiles_is_that_of_the_whole(tmp_path):
    ball = sphere(4)
    extra = tf.Attributes()
    extra.set_vertex("s", np.float32(ball.vertices[:, 0] > 0))
    extra.set_vertex("t", np.zeros(len(ball.vertices), np.float32))
    tf.write(tmp_path / "ball.ply", tf.Mesh(ball.vertices, ball.faces, extra))
    for options in (dict(keep_seams=True), dict(keep_seams=True, ignored_seams=["s", "t"]),
                    dict(keep_degenerate=True)):
        done = tf.weld_stream(tmp_path / "ball.ply", tmp_path / "thin.ply", 0.2,
                              points_per_tile=500, **options)
        whole = tf.weld(tf.read(tmp_path / "ball.ply"), 0.2, **options)
        assert done.tiles > 1 and done.faces == len(whole.faces) > 0
        made = tf.read(tmp_path / "thin.ply")
        assert np.array_equal(made.faces, whole.faces)
        assert np.array_equal(made.vertices, whole.vertices)
        assert done.triangles == done.faces
        for what in ("collapsed", "degenerate", "nonmanifold_before", "nonmanifold_after",
                     "flipped"):
            assert done.statistics[what] == whole.statistics[what], what
        assert done.statistics["collapsed"] > 0


def test_points_are_withheld_in_las(tmp_path):
    points = np.random.default_rng(5).integers(0, 300, (2000, 3)) * 0.01
    tf.write(tmp_path / "a.las", (points, []))
    done = tf.weld_stream(tmp_path / "a.las", tmp_path / "b.las", 0.1, withhold=True, as_las=True)
    made = tf.read(tmp_path / "b.las")
    assert len(made.vertices) == 2000 > done.kept
    assert np.sum(made.attributes.vertex["withheld"] == 0) == done.kept


def test_what_las_rounds_is_said(tmp_path):
    points = np.random.default_rng(6).integers(0, 300, (50, 3)) * 0.01
    for name, scale in (("a.las", 0.01), ("b.las", 0.0075)):
        tf.write(tmp_path / name, (points, []), las_scale=(scale,) * 3)
    inputs = [tmp_path / "a.las", tmp_path / "b.las"]
    done = tf.weld_stream(inputs, tmp_path / "c.las", as_las=True)
    assert 0.001 < done.max_displacement < 0.005
    assert any("rounded to the scale of the LAS file" in text for text in done.warnings)
    with tf.SharedWeld(inputs, as_las=True, folder=tmp_path / "tiles") as work:
        for tile in range(work.scatter()):
            work.weld_tile(tile)
        again = work.finish(tmp_path / "d.las")
    assert (again.max_displacement, again.warnings) == (done.max_displacement, done.warnings)
    same = tf.weld_stream(tmp_path / "a.las", tmp_path / "e.las", as_las=True)
    assert (same.max_displacement, same.warnings) == (0, [])


def test_columns_of_text_are_named(tmp_path):
    (tmp_path / "a.csv").write_text("h,n,e\n1,2,3\n1,2,3\n4,5,6\n")
    columns = {"x": "e", "y": "n", "z": 1}
    tf.weld_stream(tmp_path / "a.csv", tmp_path / "b.ply", columns=columns)
    assert tf.read(tmp_path / "b.ply").vertices.tolist() == [[3, 2, 1], [6, 5, 4]]
    with tf.SharedWeld(tmp_path / "a.csv", columns=columns) as work:
        assert work.scatter() == 1
        work.remove_folder()
    with pytest.raises(tf.FileError, match="none"):
        tf.weld_stream(tmp_path / "a.csv", tmp_path / "b.ply", columns={"x": "none"})


def test_las_of_other_time_types_is_joined_where_that_is_asked_for(tmp_path):
    for name, step in (("a.las", 0), ("b.las", 1)):
        extra = tf.Attributes()
        extra.set_vertex("gps_time", np.array([1.5, 2.5]))
        tf.write(tmp_path / name, tf.Mesh([[step, 0, 0], [step, 1, 0]], [], extra))
    other = bytearray((tmp_path / "b.las").read_bytes())
    other[6] ^= 1  # the type of its times
    (tmp_path / "b.las").write_bytes(other)
    files = [tmp_path / "a.las", tmp_path / "b.las"]
    with pytest.raises(ValueError, match="time"):
        tf.weld_stream(files, tmp_path / "all.las")
    assert tf.weld_stream(files, tmp_path / "all.las", mixed=True).kept == 4
