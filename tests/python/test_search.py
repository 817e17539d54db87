"""Points, boxes, nearest points, rays: SciPy's cKDTree and brute force are the judges."""

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from scipy.spatial import cKDTree

import treeform as tf
from support import CUBE, SHEET, SPHERES, box, distances_from, moved, soup, sphere

lattice = st.integers(0, 10**6)


def cloud(seed, count, dimensions, size=6):
    """Points of a lattice: many are equal, many as near."""
    return np.random.default_rng(seed).integers(0, size, (count, dimensions)).astype(float)


@settings(max_examples=80)
@given(lattice, st.integers(1, 80), st.sampled_from([2, 3]), st.integers(1, 12),
       st.sampled_from([np.inf, 1.0, 2.0, 2.2]))
def test_nearest_points_are_those_of_scipy(seed, count, dimensions, k, bound):
    points, queries = cloud(seed, count, dimensions), cloud(seed + 1, 20, dimensions)
    d, i = tf.PointTree(points).query(queries, k, distance_upper_bound=bound)
    judged, j = cKDTree(points).query(queries, k, distance_upper_bound=bound)
    assert d.shape == judged.shape and np.array_equal(d, judged)
    assert np.array_equal(i == count, j == count)  # which of equally near ones is another matter
    found = i < count
    offsets = np.broadcast_to(queries[:, None] if k != 1 else queries,
                              i.shape + (dimensions,))[found] - points[i[found]]
    assert np.allclose(np.linalg.norm(offsets, axis=-1), d[found], rtol=1e-15)


@settings(max_examples=80)
@given(lattice, st.integers(1, 80), st.sampled_from([2, 3]), st.sampled_from([0.0, 1.0, 2.0, 2.5]))
def test_points_within_a_radius_are_those_of_scipy(seed, count, dimensions, r):
    points, queries = cloud(seed, count, dimensions), cloud(seed + 1, 10, dimensions)
    tree, judge = tf.PointTree(points), cKDTree(points)
    lists = tree.query_ball_point(queries, r)
    assert lists.tolist() == [sorted(one) for one in judge.query_ball_point(queries, r)]
    assert tree.query_ball_point(queries, r, return_length=True).tolist() == [*map(len, lists)]
    own = np.linspace(0, 2 * r, len(queries))
    lists = tree.query_ball_point(queries, own)
    assert lists.tolist() == [sorted(one) for one in judge.query_ball_point(queries, own)]
    assert tree.query_ball_point(queries, own, return_length=True).tolist() == [*map(len, lists)]
    assert tree.query_pairs(r) == judge.query_pairs(r)
    pairs = tree.query_pairs(r, output_type="ndarray")
    assert set(map(tuple, pairs.tolist())) == judge.query_pairs(r)
    arrays = tree.query_ball(queries, r)
    assert arrays.begin[-1] == len(arrays.ids) == len(arrays.distances)


def test_a_tree_has_a_copy_of_its_points():
    points = np.array([[0, 0, 0], [0, 0, 1], [9, 9, 9]], float)
    tree = tf.PointTree(points)
    points[:] = np.nan
    assert tree.query_pairs(1) == {(0, 1)} and tree.query_ball_point([0, 0, 0], 1) == [0, 1]
    with pytest.raises(ValueError, match="read-only"):
        tree.data[0] = 1
    with pytest.raises(AttributeError):
        tree.data = points


def test_shapes_are_those_of_scipy():
    points = np.random.default_rng(0).random((50, 3))
    tree, judge = tf.PointTree(points), cKDTree(points)
    for x in (points[0], points[:4], points[:4].reshape(2, 2, 3), points[:0]):
        for k in (1, 3, [1], [2, 4], 60):
            ours, theirs = tree.query(x, k), judge.query(x, k)
            for a, b in zip(ours, theirs):
                assert np.shape(a) == np.shape(b)
                assert np.allclose(a, b)
    assert tree.n == 50 and tree.m == 3 and len(tree) == 50
    assert isinstance(tree.query_ball_point(points[0], 0.1), list)
    for many in (2**61, 2**70):
        with pytest.raises(MemoryError):
            tree.query(np.zeros((8, 3)), many)
    for wrong in (dict(k=0), dict(p=1), dict(distance_upper_bound=-1.0)):
        with pytest.raises(ValueError):
            tree.query(points[0], **wrong)
    with pytest.raises(ValueError, match="x: the shape"):
        tree.query([[1, 2]])
    assert len(tf.PointTree(np.empty((0, 3)))) == 0


@settings(max_examples=60)
@given(lattice, st.integers(1, 60), st.sampled_from([2, 3]))
def test_boxes_that_overlap(seed, count, dimensions):
    low = cloud(seed, count, dimensions)
    high = low + cloud(seed + 1, count, dimensions, 3)
    tree = tf.BoxTree(low, high)
    meet = ((low[:, None] <= high[None]) & (low[None] <= high[:, None])).all(axis=2)
    assert tree.pairs().tolist() == [[i, j] for i in range(count) for j in range(i + 1, count)
                                     if meet[i, j]]
    assert tree.pairs(tree).tolist() == np.argwhere(meet).tolist()
    with pytest.raises(MemoryError):
        tree.nearest(np.zeros((8, dimensions)), 2**61)
    begin, ids = tree.query(low[:5], high[:5])
    for q in range(min(5, count)):
        assert np.array_equal(ids[begin[q]:begin[q + 1]], np.flatnonzero(meet[q]))
        assert np.array_equal(tree.query(low[q], high[q]), np.flatnonzero(meet[q]))
    x = cloud(seed + 2, 8, dimensions)
    away = np.linalg.norm(np.maximum(np.maximum(low[None] - x[:, None], x[:, None] - high[None]),
                                     0),
                          axis=2)
    d, i = tree.nearest(x, k=3)
    assert d.shape == (8, 3)
    assert np.allclose(d[:, :count], np.sort(away, axis=1)[:, :3])
    assert (i[:, min(3, count):] == count).all()


def test_boxes_that_are_none():
    with pytest.raises(ValueError, match="1"):
        tf.BoxTree([[0, 0], [1, 1]], [[1, 1], [0, 0]])
    with pytest.raises(ValueError, match="maxs"):
        tf.BoxTree([[0, 0]], [[1, 1, 1]])


@settings(max_examples=40)
@given(lattice, st.integers(1, 30))
def test_closest_points_by_brute_force(seed, faces):
    mesh = tf.Mesh(*soup(seed, faces))
    points = np.random.default_rng(seed).random((20, 3)) * 10 - 1
    closest, distance, face = tf.closest_point(mesh, points)
    wanted = distances_from(mesh, points)
    assert np.allclose(distance, wanted, atol=1e-12)
    assert np.allclose(np.linalg.norm(points - closest, axis=1), distance, atol=1e-12)
    for point, number in zip(closest, face):
        assert distances_from(tf.Mesh(mesh.vertices, mesh.faces[[number]]), point[None]) < 1e-12
    near = tf.closest_point(mesh, points, radius=1.0)
    assert np.array_equal(np.isfinite(near.distance), distance <= 1.0)
    assert (near.face[distance > 1.0] == tf.NONE).all()


def test_many_queries_are_those_of_few():
    points = np.random.default_rng(5).random((100_000, 3)) * 3 - 1.5
    ball = sphere(3)
    whole = tf.closest_point(ball, points)
    few = tf.closest_point(ball, points[99_000:])
    assert np.array_equal(whole.distance[99_000:], few.distance)
    assert np.array_equal(whole.face[99_000:], few.face)


def test_inside_and_outside():
    points = np.random.default_rng(6).random((1000, 3)) * 3 - 1
    wanted = ((points >= 0) & (points <= 1)).all(axis=1)
    assert np.array_equal(tf.contains(CUBE, points), wanted)
    corners = CUBE.vertices
    assert tf.contains(CUBE, corners).all() and (tf.locate(CUBE, corners) == 0).all()
    assert not tf.winding_number(CUBE, corners).any()
    assert np.array_equal(tf.winding_number(CUBE, points), wanted.astype(int))
    inverted = tf.Mesh(CUBE.vertices, CUBE.faces[:, ::-1])
    assert np.array_equal(tf.winding_number(inverted, points), -wanted.astype(int))
    assert np.array_equal(tf.locate(CUBE, points) == 1, wanted)
    with pytest.raises(ValueError, match="edge"):
        tf.contains(SHEET, points)


def test_signed_distances():
    points = np.random.default_rng(7).random((200, 3)) * 3 - 1
    distance = tf.signed_distance(CUBE, points)
    assert np.allclose(np.abs(distance), distances_from(CUBE, points))
    assert np.array_equal(distance > 0, tf.contains(CUBE, points))
    assert not tf.signed_distance(CUBE, CUBE.vertices).any()
    with pytest.raises(tf.NotClosedError):
        tf.signed_distance(SHEET, points)


@settings(max_examples=40)
@given(lattice, st.integers(1, 30))
def test_rays_by_brute_force(seed, faces):
    mesh = tf.Mesh(*soup(seed, faces))
    rng = np.random.default_rng(seed)
    origins, directions = rng.random((20, 3)) * 8, rng.standard_normal((20, 3))
    hits = tf.raycast(mesh, origins, directions)
    locations, ray, face = tf.raycast_all(mesh, origins, directions)
    any_hit = tf.raycast_any(mesh, origins, directions)
    assert np.array_equal(any_hit, np.isfinite(hits.t))
    assert np.array_equal(np.isin(np.arange(20), ray), any_hit)
    a, b, c = (mesh.vertices[mesh.faces[:, k]] for k in range(3))
    for o, d, t in zip(origins, directions, hits.t):
        normal = np.cross(b - a, c - a)
        with np.errstate(all="ignore"):
            s = ((a - o) * normal).sum(axis=1) / (normal @ d)
            p = o + s[:, None] * d
            sides = [(np.cross(v - u, p - u) * normal).sum(axis=1)
                     for u, v in ((a, b), (b, c), (c, a))]
        inside = (np.min(sides, axis=0) > 1e-9) & (s > 1e-9)
        if inside.any():
            assert t <= s[inside].min() + 1e-9
        if np.isfinite(t):
            assert (np.abs(s - t) < 1e-9).any()
    for p, number in zip(locations, face):
        assert distances_from(tf.Mesh(mesh.vertices, mesh.faces[[number]]), p[None]) < 1e-9


def test_a_ray_through_a_corner_names_it():
    hit = tf.raycast(CUBE, [[-1.0, -1, -1]], [[1, 1, 1]])
    assert hit.t[0] == 1 and hit.at[0] in (0, 1, 2) and hit.face[0] == min(
        np.flatnonzero((CUBE.vertices[CUBE.faces] == 0).all(axis=2).any(axis=1)))
    assert not tf.raycast_any(CUBE, [[-1.0, 0, 0]], [[1, 0, 0]], t_max=0.5)[0]
    both = tf.raycast(CUBE, [[0.25, 0.5, 0.75]], [[1, 0, 0], [0, 1, 0]])
    assert both.t.tolist() == [0.75, 0.5]
    every = tf.raycast_all(CUBE, [[-1, 0.5, 0.25], [-2, 0.25, 0.5]], [[1, 0, 0]])
    assert every.point.tolist() == [[0, 0.5, 0.25], [1, 0.5, 0.25], [0, 0.25, 0.5], [1, 0.25, 0.5]]
    with pytest.raises(ValueError, match="directions: 2 for 3"):
        tf.raycast(CUBE, np.zeros((3, 3)), [[1, 0, 0], [0, 1, 0]])


def test_deviation():
    points = np.random.default_rng(8).random((500, 3)) * 3 - 1
    found = tf.deviation(points, CUBE, band=(-0.25, 0.25), bins=10)
    assert np.allclose(np.abs(found.distances), distances_from(CUBE, points))
    assert np.array_equal(found.distances < 0, tf.contains(CUBE, points))
    assert found.histogram.sum() == 500 and sum(found.band_counts) == 500
    within = (np.abs(found.distances) <= 0.25).sum()
    assert found.band_counts[1] == within
    assert found.mean == pytest.approx(found.distances.mean())
    assert found.max == np.abs(found.distances).max() == np.abs(found.distances)[found.worst]
    both = tf.deviation(CUBE, moved(CUBE, 0, 0, 0.5))
    assert both.max == both.reverse_max == 0.5
    assert not tf.deviation(points, SHEET).is_signed
    assert tf.deviation(points, SHEET).side_counts is None
    where = tf.locate(CUBE, points)
    assert found.side_counts == tuple((where == side).sum() for side in (1, 0, -1))
    assert tf.deviation(CUBE, moved(CUBE, 0, 0, 0.5)).side_counts == (0, 4, 4)
    with pytest.raises(ValueError, match="no points"):
        tf.deviation(np.empty((0, 3)), CUBE)


def test_what_is_wrong_is_named_by_its_number():
    """Also in large inputs, which are worked on in pieces."""
    points = np.random.default_rng(4).random((20_000, 3))
    wrong = points.copy()
    wrong[15_000, 1] = np.nan
    along = np.ones_like(points)
    none = along.copy()
    none[15_000] = 0
    moves = np.tile(np.eye(4), (20_000, 1, 1))
    moves[15_000, 0, 3] = np.inf
    tree, boxes = tf.PointTree(points), tf.BoxTree(points, points)
    for call in (lambda: tf.closest_point(CUBE, wrong), lambda: tf.locate(CUBE, wrong),
                 lambda: tf.signed_distance(CUBE, wrong), lambda: tf.raycast(CUBE, wrong, along),
                 lambda: tf.raycast(CUBE, points, none), lambda: tf.raycast_all(CUBE, points, none),
                 lambda: tf.raycast_any(CUBE, points, none), lambda: tree.query(wrong),
                 lambda: tree.query_ball_point(wrong, 0.01), lambda: boxes.query(wrong, wrong),
                 lambda: boxes.nearest(wrong), lambda: tf.PointTree(wrong),
                 lambda: tf.intersects(CUBE, CUBE, transform_a=moves),
                 lambda: tf.BoxTree(wrong, wrong),
                 lambda: tf.deviation(wrong, CUBE)):
        with pytest.raises(ValueError, match=r"\b15000\b"):
            call()


def test_answers_do_not_depend_on_threads():
    points = np.random.default_rng(9).random((5000, 3))
    tree = tf.PointTree(points)
    d, i = tree.query(points, 5)
    found = tf.self_intersections(SPHERES).pairs
    with tf.threads(1):
        e, j = tf.PointTree(points).query(points, 5)
        assert np.array_equal(d, e) and np.array_equal(i, j)
        assert np.array_equal(found, tf.self_intersections(SPHERES).pairs)
        assert tf.union(SPHERES, box([0] * 3, [1] * 3)).mesh.volume == \
            tf.union(SPHERES, box([0] * 3, [1] * 3)).mesh.volume
