"""What is taken for a mesh or for points, without a copy where it fits; what is refused, and
how."""

import numpy as np
import pytest

import treeform as tf
from support import CUBE, SHEET, same_mesh

POINTS = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], float)
FACES = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]], np.uint32)


def test_what_fits_is_not_copied():
    mesh = tf.Mesh(POINTS, FACES)
    assert np.shares_memory(mesh.vertices, POINTS)
    assert np.shares_memory(mesh.faces, FACES)


def test_results_own_their_memory_and_can_be_written_to():
    pairs = tf.self_intersections(tf.read("data/two_spheres.stl")).pairs
    assert pairs.flags.writeable and pairs.flags.c_contiguous and pairs.dtype == np.uint32
    copy = pairs.copy()
    del copy
    pairs[:] = 0


@pytest.mark.parametrize("mesh", [
    CUBE, tf.Mesh(POINTS, FACES), tf.Mesh(POINTS.tolist(), FACES.tolist()), tf.Mesh(POINTS, []),
    tf.union(CUBE).mesh, tf.Mesh([], [])],
                         ids=["read", "arrays", "lists", "cloud", "made", "empty"])
def test_arrays_of_a_mesh_cannot_be_written_to_even_by_force(mesh):
    for array in (mesh.vertices, mesh.faces, mesh.vertices[:], *mesh):
        with pytest.raises(ValueError, match="read-only"):
            array[...] = 1
        with pytest.raises(ValueError, match="WRITEABLE"):
            array.setflags(write=True)
        with pytest.raises(ValueError, match="WRITEABLE"):
            array.flags.writeable = True
    assert mesh.vertices.shape[1:] == mesh.faces.shape[1:] == (3,)
    assert mesh.vertices.dtype == np.float64 and mesh.faces.dtype == np.uint32
    POINTS.setflags(write=True)  # those that it was made of are their owner's


def arrays_in(result):
    """All arrays of a result but those of a mesh."""
    if isinstance(result, np.ndarray):
        yield result
    elif isinstance(result, (list, tuple)):
        for one in result:
            yield from arrays_in(one)
    elif hasattr(result, "__dict__"):
        for one in vars(result).values():
            yield from arrays_in(one)
    elif isinstance(result, tf.Certificate):
        yield from (result.meeting, result.open_edges, result.open_faces)


MOVED = (CUBE.vertices + 0.5, CUBE.faces)


@pytest.mark.parametrize("result", [
    lambda: tf.union(CUBE, MOVED), lambda: tf.repair(CUBE), lambda: tf.clash([CUBE, MOVED]),
    lambda: tf.closest_point(CUBE, POINTS), lambda: tf.contains(CUBE, POINTS),
    lambda: tf.locate(CUBE, POINTS), lambda: tf.winding_number(CUBE, POINTS),
    lambda: tf.signed_distance(CUBE, POINTS), lambda: tf.raycast(CUBE, POINTS, POINTS + 1),
    lambda: tf.raycast_all(CUBE, POINTS, POINTS + 1),
    lambda: tf.raycast_any(CUBE, POINTS, POINTS + 1), lambda: tf.deviation(CUBE, MOVED),
    lambda: tf.weld(POINTS, 0.1), lambda: tf.convex_hull(CUBE), lambda: tf.rounded(POINTS),
    lambda: tf.lay_flat(CUBE), lambda: tf.align(CUBE, MOVED), lambda: tf.measure(CUBE, MOVED),
    lambda: tf.pack([CUBE], [9, 9]), lambda: tf.drop(CUBE), lambda: tf.find_features(CUBE),
    lambda: tf.self_intersections(tf.read("data/two_spheres.stl")),
    lambda: tf.face_components(CUBE), lambda: tf.find_invalid_faces(CUBE),
    lambda: tf.faces_in_box(CUBE, [0] * 3, [1] * 3), lambda: tf.closest_pair(CUBE, MOVED),
    lambda: tf.penetration_depth(CUBE, MOVED), lambda: tf.time_of_impact(CUBE, MOVED, [1, 0, 0]),
    lambda: tf.check_poses([CUBE, MOVED], np.eye(4)[None]), lambda: CUBE.bounds,
    lambda: tf.intersects(CUBE, CUBE, transform_b=np.eye(4)[None]),
    lambda: tf.distance(CUBE, CUBE, transform_b=np.eye(4)[None]),
    lambda: tf.PointTree(POINTS).query(POINTS, 2), lambda: tf.PointTree(POINTS).query_pairs(
        2, output_type="ndarray"), lambda: tf.BoxTree(POINTS, POINTS + 1).pairs()])
def test_arrays_of_results_can_be_written_to(result):
    found = list(arrays_in(result()))
    assert found and all(one.flags.writeable for one in found)


@pytest.mark.parametrize("points", [
    POINTS.astype(np.float32), POINTS.astype(int), POINTS.astype(np.int8), POINTS.astype(">f8"),
    POINTS.astype(np.float16), POINTS.tolist(), np.asfortranarray(POINTS),
    np.repeat(POINTS, 2, axis=0)[::2], np.hstack([POINTS, POINTS])[:, :3]])
@pytest.mark.parametrize("faces", [
    FACES.astype(np.int64), FACES.astype(np.int32), FACES.astype(np.uint8), FACES.tolist(),
    FACES.astype(">i4"), np.asfortranarray(FACES), np.hstack([FACES, FACES])[:, :3]])
def test_other_numbers_are_converted(points, faces):
    mesh = tf.Mesh(points, faces)
    assert same_mesh(mesh, tf.Mesh(POINTS, FACES))
    assert mesh.volume == pytest.approx(1 / 6)


def test_memory_that_is_read_only_or_not_aligned_is_taken():
    points = POINTS.copy()
    points.flags.writeable = False
    assert tf.Mesh(points, FACES).is_solid
    bytes_of = np.zeros(POINTS.nbytes + 1, np.uint8)
    crooked = bytes_of[1:].view(float).reshape(POINTS.shape)
    crooked[:] = POINTS
    assert not crooked.flags.aligned
    assert tf.Mesh(crooked, FACES).is_solid


class Trimesh:
    """As trimesh.Trimesh: int64 faces."""
    vertices, faces = POINTS, FACES.astype(np.int64)


class Open3d:
    """As open3d.geometry.TriangleMesh: vectors that NumPy takes."""
    vertices, triangles = POINTS.tolist(), FACES.astype(np.int32).tolist()


class Pyvista:
    """As pyvista.PolyData: [3, a, b, c, 3, ...]."""
    points = POINTS.astype(np.float32)
    faces = np.hstack([np.full((4, 1), 3), FACES]).ravel()


class Meshio:
    """As meshio.Mesh."""
    points, cells_dict = POINTS, {"triangle": FACES.astype(np.int64)}


@pytest.mark.parametrize("mesh", [Trimesh(), Open3d(), Pyvista(), Meshio(), (POINTS, FACES),
                                  [POINTS.tolist(), FACES.tolist()], tf.Mesh(POINTS, FACES)])
def test_meshes_of_others_are_taken(mesh):
    assert tf.check_operand(mesh)
    assert tf.union(mesh).mesh.volume == pytest.approx(1 / 6)
    assert len(tf.self_intersections(mesh)) == 0


def test_cells_are_triangles_and_quads():
    class Cells:
        points = CUBE.vertices

        def __init__(self, cells):
            self.cells_dict = cells

    quads = np.array([[0, 1, 2, 3], [3, 2, 1, 0]])
    for kinds in (("quad", "triangle", "line", "vertex"), (9, 5, 3, 1)):
        made = tf.from_trimesh(Cells(dict(zip(kinds, (quads, [[4, 5, 6]], [[0, 1]], [[0]])))))
        assert made.faces.tolist() == [[0, 1, 2], [0, 2, 3], [3, 2, 1], [3, 1, 0], [4, 5, 6]]
    for kind in ("tetra", 10):
        with pytest.raises(ValueError, match=f": 1 cells of the kind '?{kind}"):
            tf.union(Cells({kind: [[0, 1, 2, 3]], "triangle": [[0, 1, 2]]}))


@pytest.mark.parametrize("vertices, faces, message", [
    (POINTS[:, :2], FACES, r"vertices: the shape is \(4, 2\), not \(n, 3\)"),
    (POINTS.ravel(), FACES, r"vertices: the shape is \(12,\)"),
    (POINTS.astype(complex), FACES, "vertices: expected numbers, not complex128"),
    (POINTS.astype(str), FACES, "vertices: expected numbers"),
    (POINTS, FACES.astype(float), "faces: expected integers, not float64"),
    (POINTS, FACES[:, :2], r"faces: the shape is \(4, 2\), not \(n, 3\)"),
    (POINTS, [[0, 1, -1]], r"faces: -1 at \(0, 2\)"),
    (POINTS, [[0, 2**40, 1]], r"faces: 1099511627776 at \(0, 1\)"),
    (POINTS, [3, 0, 1, 2, 3], "faces: 5 numbers are not"),
    (POINTS, [9, 0, 1, 2, 3], "faces: 5 numbers are not"),
    (POINTS, [3, 0, 1, 2, 5, 0, 1, 2, 3, 0], "faces: face 1 has 5 corners, .* triangulate"),
    (POINTS, [2, 0, 1, 3, 0, 1, 2], "faces: face 0 has 2 corners, .* triangulate"),
    (POINTS, FACES.astype(bool), "faces: expected integers, not bool"),
])
def test_what_is_no_mesh_is_named(vertices, faces, message):
    with pytest.raises(ValueError, match=message):
        tf.Mesh(vertices, faces)


@pytest.mark.parametrize("verb", [
    tf.self_intersections, tf.check_operand, tf.union, tf.repair, tf.resolve_self_intersections,
    tf.drop, lambda m: tf.closest_point(m, POINTS),
    lambda m: tf.raycast(m, POINTS, POINTS + 1), lambda m: tf.contains(m, POINTS),
    lambda m: tf.distance(m, CUBE), lambda m: tf.intersects(m, CUBE), lambda m: tf.clash([m, CUBE]),
    lambda m: tf.measure(m, CUBE), lambda m: tf.slide(m, CUBE, [0, 0, 1]), lambda m: tf.wrap(m, 1),
    lambda m: tf.deviation(CUBE, m), lambda m: tf.align(CUBE, m), lambda m: tf.lay_flat(m),
    lambda m: tf.mesh_intersections(m, CUBE), lambda m: tf.pack([m], [9, 9]),
    lambda m: tf.find_features(m)])
@pytest.mark.parametrize("vertices, faces", [
    (POINTS, [[0, 1, 2], [0, 1, 7]]),
    (np.where(POINTS == 1, np.nan, POINTS), FACES),
    (np.where(POINTS == 1, np.inf, POINTS), FACES)])
def test_bad_elements_are_named(verb, vertices, faces):
    with pytest.raises(ValueError, match=r"\d"):
        verb((vertices, faces))


@pytest.mark.parametrize("verb", [
    lambda m: len(tf.self_intersections(m)), lambda m: len(tf.union(m).mesh.faces),
    lambda m: tf.count_topology(m).edges, lambda m: tf.Mesh(*m).volume,
    lambda m: len(tf.clash([m, m]).pairs), lambda m: len(tf.face_components(m)),
    lambda m: len(tf.closest_point(m, np.empty((0, 3))).distance),
    lambda m: len(tf.weld(m).mesh.faces)])
def test_empty_meshes_are_taken(verb):
    assert verb((np.empty((0, 3)), np.empty((0, 3), np.uint32))) == 0
    assert verb(([], [])) == 0


@pytest.mark.parametrize("mesh", [3, None, "mesh", object(), (POINTS,), (POINTS, FACES, FACES)])
def test_what_is_nothing_of_the_kind_is_refused(mesh):
    with pytest.raises(ValueError, match="mesh"):
        tf.self_intersections(mesh)


def test_points_that_are_not_finite_are_named():
    bad = POINTS.copy()
    bad[2, 1] = np.nan
    for verb in (lambda: tf.closest_point(CUBE, bad), lambda: tf.contains(CUBE, bad),
                 lambda: tf.PointTree(bad), lambda: tf.raycast(CUBE, bad, POINTS + 1),
                 lambda: tf.convex_hull(bad), lambda: tf.deviation(bad, CUBE)):
        with pytest.raises(ValueError, match="2") as caught:
            verb()
        assert "treeform" not in str(caught.value)


def test_words_that_are_none_are_refused_with_those_there_are():
    with pytest.raises(ValueError, match="outer"):
        tf.resolve_self_intersections(CUBE, "inner")
    with pytest.raises(ValueError, match="float32, float64"):
        tf.union(CUBE, precision="half")
    with pytest.raises(ValueError, match="crossing"):
        tf.self_intersections(CUBE, kinds=["crossed"])


V, F = CUBE.vertices, CUBE.faces


@pytest.mark.parametrize("verb, message", [
    (lambda: tf.Mesh(V, F, {"q": 1}), "attributes: expected Attributes .*, not"),
    (lambda: tf.weld(V, "x"), "tolerance: expected a number, not 'x'"),
    (lambda: tf.weld(V, 1, keep="max:q"), "keep: .*, highest .the last two with keep_by=., not"),
    (lambda: tf.weld_stream("a.ply", "b.ply", memory=-1),
     "memory: expected a non-negative integer"),
    (lambda: tf.weld_stream("a.ply", "b.ply", memory=0.5),
     "memory: expected a non-negative integer"),
    (lambda: tf.threads(-1), "most: expected a non-negative integer, not -1"),
    (lambda: tf.write("a\0b.ply", CUBE), "path: expected a path without null characters"),
    (lambda: tf.read("a\0b.ply"), "path: expected a path without null characters"),
    (lambda: tf.drop([CUBE, CUBE]), "mesh: expected one mesh or cloud, not .Mesh"),
    (lambda: tf.raycast(CUBE, V, V + 1, t_min="a"), "t_min: expected a number, not 'a'"),
    (lambda: tf.closest_point(CUBE, V, radius="a"), "radius: expected a number, not 'a'"),
    (lambda: tf.PointTree(V).query_pairs("a"), "r: expected a number, not 'a'"),
    (lambda: tf.self_intersections(CUBE, limit=-1),
     "limit: expected a non-negative integer"),
    (lambda: tf.repair(CUBE, gap="a"), "gap: expected a number, not 'a'"),
    (lambda: tf.union(CUBE, merge_coplanar="a"), "merge_coplanar: expected True or False, not 'a'"),
    (lambda: tf.union(CUBE, precision=3), "precision: expected a string, not 3"),
    (lambda: tf.deviation(CUBE, CUBE, band=3), "band: expected a pair of numbers, not 3"),
    (lambda: tf.raycast(CUBE, V + 3, V * 0 - 5e-324), "directions: that of ray 0 is too short"),
    (lambda: tf.raycast_all(CUBE, V + 3, V * 0 - 5e-324), "directions: that of ray 0 is too short"),
    (lambda: tf.boolean("a-fill_rule", a=CUBE, fill_rule=CUBE),
     "fill_rule: expected a string, not Mesh"),
    (lambda: tf.PointTree(V).query_ball_point(V, [1, 2]), "broadcast")])
def test_options_that_make_no_sense_are_named(verb, message):
    with pytest.raises(ValueError, match=message):
        verb()


@pytest.mark.parametrize("verb", [tf.contains, tf.locate, tf.winding_number, tf.signed_distance])
def test_an_open_mesh_has_no_inside(verb):
    with pytest.raises(tf.NotClosedError) as caught:
        verb(SHEET, [[0.1, 0.1, 2.0]])
    assert caught.value.edges.shape == (3, 2, 3)
    assert str(caught.value).endswith("at face 0")
    with pytest.raises(ValueError, match="finite") as caught:
        verb(CUBE, [[np.nan, 0, 0]])
    assert not isinstance(caught.value, tf.NotClosedError)


def test_meshes_may_come_in_anything_that_lists_them():
    two = [(V, F), (V + 0.5, F)]
    for many in (two, tuple(two), dict(enumerate(two)).values(), iter(two), map(list, two),
                 [list(one) for one in two], [(v.tolist(), f.tolist()) for v, f in two]):
        assert tf.union(many).mesh.volume == 1.875
    for one in ((V, F), [V, F], [V.tolist(), F.tolist()], CUBE, Trimesh()):
        assert len(tf.union(one).mesh.faces) in (4, 12)


def test_points_may_come_in_anything_that_lists_them():
    class Cloud:
        points = [[0.0, 0, 0], [0, 0, 0.5]]

    class Vertices:
        vertices = Cloud.points

    for cloud in ([np.array([0.0, 0, 0]), np.array([0, 0, 0.5])], np.array(Cloud.points), Cloud(),
                  Vertices(), Cloud.points):
        assert len(tf.weld(cloud, 1).points) == 1
        assert len(tf.deviation(cloud, CUBE).distances) == 2
        assert tf.measure(cloud, CUBE).relation == "touching"


def test_a_matrix_that_is_none_is_refused():
    for wrong in (np.eye(3), np.full((4, 4), 1.0), np.eye(4)[:2]):
        with pytest.raises(ValueError, match="transform_b"):
            tf.intersects(CUBE, SHEET, transform_b=wrong)
