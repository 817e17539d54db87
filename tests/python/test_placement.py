"""Where meshes go: the coordinates of the tool, and that they do not penetrate."""

import numpy as np
import pytest

import treeform as tf
from support import CUBE, SHEET, SPHERES, box, moved, run_tool, sphere


def same_as_tool(folder, made, *arguments):
    run_tool("tf-place", *arguments, "-o", folder / "tool.off", "--precision", "double")
    tf.write(folder / "own.off", made.mesh)
    return (folder / "tool.off").read_bytes() == (folder / "own.off").read_bytes()


def test_coordinates_are_those_of_the_tool(tmp_path):
    ball = moved(tf.read("data/sphere.ply"), 0.3, 0.2, 6)
    tf.write(tmp_path / "ball.off", ball)
    path, fixed = tmp_path / "ball.off", ("--fixed", "data/cube.stl")
    assert same_as_tool(tmp_path, tf.drop(ball), "drop", path)
    assert same_as_tool(tmp_path, tf.drop(ball, CUBE), "drop", path, *fixed)
    assert same_as_tool(tmp_path, tf.slide(ball, CUBE, [0, 0, -1]), "slide", path, *fixed, "-d",
                        "0,0,-1")
    assert same_as_tool(tmp_path, tf.slide(ball, CUBE, [0, 0, -1], 0.03), "slide", path, *fixed,
                        "-d", "0,0,-1", "--clearance", "0.03")
    assert same_as_tool(tmp_path, tf.mate(ball, CUBE), "mate", path, *fixed)
    tf.write(tmp_path / "cube.off", CUBE)
    assert same_as_tool(tmp_path, tf.lay_flat(CUBE), "lay", tmp_path / "cube.off", "-t", "0")


def test_slide():
    ball = moved(sphere(3), 0.5, 0.5, 9)
    made = tf.slide(ball, CUBE, [0, 0, -5])
    assert made and made.outcome == "contact" and made.relation == "touching"
    assert made.direction.tolist() == [0, 0, -1] and made.travel == pytest.approx(7)
    assert tf.measure(made, CUBE).relation == "touching"
    assert np.allclose(made.vertices, ball.vertices + made.matrix[:3, 3])
    assert made.contacts.point.shape == (made.contact_count, 3)
    assert made.nearest_fixed == 0 and made.nearest.distance == 0
    gap = tf.slide(ball, CUBE, [0, 0, -1], 0.25)
    assert gap.relation == "clear" and tf.distance(gap, CUBE) == pytest.approx(0.25)
    none = tf.slide(ball, CUBE, [0, 0, 1])
    assert not none and none.outcome == "nothing_met" and none.message
    assert np.array_equal(none.vertices, ball.vertices)
    nearest_of = tf.slide(ball, [box([0, 0, 3], [1, 1, 4]), CUBE], [0, 0, -1])
    assert nearest_of.travel == pytest.approx(4) and nearest_of.nearest_fixed == 0
    with pytest.raises(ValueError, match="direction"):
        tf.slide(ball, CUBE, [0, 0, 0])


def test_drop():
    low = tf.drop(moved(SPHERES, 0, 0, 7))
    assert low.outcome == "bed" and low.mesh.bounds[0, 2] == 0
    single = tf.drop(moved(SPHERES, 0, 0, 7), bed=0.1, precision="float32")
    assert single.mesh.bounds[0, 2] == np.nextafter(np.float32(0.1), np.float32(1)) or \
        single.mesh.bounds[0, 2] == np.float32(0.1)
    up = tf.drop(moved(CUBE, 0, 0, -3))
    assert up.mesh.bounds[0, 2] == 0


def test_clouds_are_moved_too():
    points = np.random.default_rng(1).random((100, 3)) + [0, 0, 5]
    made = tf.drop(points)
    assert made.vertices[:, 2].min() == 0 and len(made.faces) == 0


def test_mate_separate_turn():
    other = moved(CUBE, 0.2, 3, 0.1)
    assert tf.mate(other, CUBE).travel == 2
    assert tf.mate(other, CUBE, clearance=0.5).relation == "clear"
    inside = moved(CUBE, 0.9, 0.1, 0)
    apart = tf.separate(inside, CUBE)
    assert apart.outcome == "moved_apart" and apart.travel == pytest.approx(0.1)
    assert tf.measure(apart, CUBE).relation != "penetrating"
    door = tf.turn(box([0, 0, 0], [4, 0.25, 1]), box([-5, 2, 0], [5, 3, 1]), [0, 0, 1])
    assert door and 20 < door.angle < 40 and door.relation in ("disjoint", "touching")
    assert tf.distance(door, box([-5, 2, 0], [5, 3, 1])) <= 2 * door.tolerance
    free = tf.turn(CUBE, moved(CUBE, 9, 9, 9), [0, 0, 1])
    assert not free and free.outcome == "nothing_met"


def test_features():
    sides = tf.find_features(CUBE)
    assert len(sides) == 6 and all(side.area == 1 and len(side.faces) == 2 for side in sides)
    other = moved(CUBE, 5, 0, 0)
    made = tf.mate_features(other, CUBE, tf.find_features(other)[0], sides[0])
    assert made and made.relation == "touching" and made.angle in (0, 90, 180)
    angles = np.linspace(0, 2 * np.pi, 33)[:-1]
    ring = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    tube = np.vstack([np.column_stack([ring, np.zeros(32)]), np.column_stack([ring, np.ones(32)])])
    walls = [[i, (i + 1) % 32, 32 + i] for i in range(32)]
    walls += [[(i + 1) % 32, 32 + (i + 1) % 32, 32 + i] for i in range(32)]
    axis, = tf.find_features((tube, walls), "axis", tolerance=1e-3)
    assert axis.radius == pytest.approx(1, abs=1e-2) and abs(axis.direction[2]) == pytest.approx(1)
    with pytest.raises(ValueError, match="of_fixed"):
        tf.mate_features(other, CUBE, sides[0], axis)


def test_lay_flat():
    turned = tf.Mesh(CUBE.vertices @ np.linalg.qr(np.arange(9).reshape(3, 3) + np.eye(3))[0],
                     CUBE.faces)
    laid = tf.lay_flat(turned, tolerance=1e-9)
    assert laid.mesh.bounds[0, 2] == 0 and len(laid.on_bed) == 4
    assert len(laid.areas) == 6 and laid.areas[laid.chosen] == pytest.approx(1)
    assert laid.tip_angles[laid.chosen] == pytest.approx(45)
    assert laid.mass_dimension == 3 and laid.certificate
    assert np.allclose(laid.center_of_mass, turned.vertices.mean(axis=0))
    up = tf.lay_flat(CUBE, normal=[0, 0, 1])
    assert up.normals[up.chosen].tolist() == [0, 0, 1]
    with pytest.raises(ValueError, match="no flat side"):
        tf.lay_flat(([[0, 0, 0]], []))


def test_align():
    ball = tf.resolve_self_intersections(SPHERES).mesh
    angle = 0.05
    matrix = np.eye(4)
    matrix[:2, :2] = [[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]
    matrix[:3, 3] = [0.05, -0.03, 0.02]
    scan = ball.vertices @ matrix[:3, :3].T + matrix[:3, 3]
    for moving in (scan, tf.Mesh(scan, ball.faces)):
        found = tf.align(moving, ball)
        assert np.allclose(found.matrix[:3, 3] + found.matrix[:3, :3] @ matrix[:3, 3], 0, atol=1e-4)
        assert found.rms < 1e-6 < found.rms_at_start
        assert np.allclose(found.vertices, ball.vertices, atol=1e-4)
    started = tf.align(scan, ball, start=np.linalg.inv(matrix))
    assert started.rms < 1e-12 and started.uncertainty < 1e-12
    for method in ("automatic", "plane_to_plane", "point_to_point"):
        cloud = tf.align(scan, ball.vertices, method=method, robust=False)
        assert np.allclose(cloud.vertices, ball.vertices, atol=1e-3)
    twice = tf.align(2 * scan, ball.vertices, scale=True)
    assert twice and twice.scale == pytest.approx(0.5, rel=1e-3)
    assert tf.align(2 * scan, ball.vertices, scale=(0.4, 0.6)).scale == twice.scale
    at_bound = tf.align(2 * scan, ball.vertices, scale=(0.7, 3))
    assert not at_bound and at_bound.scale == 0.7 and at_bound.outcome == "doubtful"
    for bad in (2.0, "some", (1, 2, 3), (2, 1), (-1, 1)):
        with pytest.raises(ValueError, match="scale"):
            tf.align(scan, ball, scale=bad)
    with pytest.raises(ValueError, match="overlap"):
        tf.align(scan, ball, overlap=2.0)


def test_what_has_no_place_is_not_written(tmp_path):
    stuck = tf.slide(moved(CUBE, 0.5, 0, 0), CUBE, [1, 0, 0])
    assert not stuck
    for what in (stuck, [CUBE, stuck], {"a": stuck}):
        with pytest.raises(tf.NotCertifiedError, match="no valid placement"):
            tf.write(tmp_path / "a.obj", what)
    tf.write(tmp_path / "a.obj", stuck.mesh)
    open_result = tf.union(tf.Mesh(CUBE.vertices, CUBE.faces[1:]), CUBE, check=False)
    with pytest.raises(tf.NotClosedError):
        tf.write(tmp_path / "a.obj", open_result)


def test_pack():
    parts = [box([0, 0, 0], [1 + i % 3, 1, 1]) for i in range(6)]
    packed = tf.pack(parts, [8, 8], spacing=0.25)
    assert packed and packed.plates_used == 1 and len(packed.parts) == 6
    for i, one in enumerate(packed.parts):
        assert one.placed and one.mesh.bounds[0, 2] == 0
        assert (one.mesh.bounds[0, :2] >= 0).all() and (one.mesh.bounds[1, :2] <= 8).all()
        for other in packed.parts[:i]:
            assert tf.distance(one.mesh, other.mesh) >= 0.25 - 1e-12
    full = tf.pack([box([0, 0, 0], [3, 3, 1])] * 3, [7, 3.5, 5])
    assert not full and len(full.not_placed) == 2
    assert full.message.startswith("1 of 3 parts placed")
    assert not tf.clash(packed.parts).pairs and tf.drop(packed.parts[0])    # parts as meshes
    held = tf.slide(packed.parts[0], packed.parts[1], [0, 0, 1])
    assert "contacts=Contacts(" in repr(held)
    again = tf.pack(parts, [8, 8], spacing=0.25)
    assert all(np.array_equal(a.matrix, b.matrix) for a, b in zip(packed.parts, again.parts))


def test_a_mesh_without_faces_is_a_cloud():
    read = tf.Mesh([[0.5, 0.5, 0.5], [2, 2, 2]], np.empty((0, 3), dtype=np.uint32))
    assert tf.measure(read, CUBE).relation == "penetrating"
    assert len(tf.clash([CUBE, read]).pairs) == 1


def test_queries_of_two_meshes_take_clouds_too():
    points = np.array([[0.5, 0.5, 3], [0.5, 0.5, 2]])
    for cloud in (points, points.tolist(), tf.Mesh(points), (points, [])):
        assert tf.distance(CUBE, cloud) == tf.distance(cloud, CUBE) == 1
        assert tf.distance(cloud, [[0.5, 0.5, 2.25]]) == 0.25
        assert not tf.intersects(cloud, CUBE)
        lower = np.eye(4)
        lower[2, 3] = -1
        assert tf.intersects(CUBE, cloud, transform_b=[np.eye(4), lower]).tolist() == [False, True]
        near = tf.closest_pair(CUBE, cloud)
        assert near.face_b == 1 and near.on_a.tolist() == [0.5, 0.5, 1]
        assert tf.closest_point(cloud, [[0.5, 0.5, 0]]).distance.tolist() == [2]
        assert tf.penetration_depth(cloud, CUBE) is None
        assert tf.time_of_impact(cloud, CUBE, [0, 0, -2]).time == 0.5
        assert tf.measure(cloud, CUBE).distance == 1
    assert tf.distance(CUBE, ([], [])) == np.inf


def test_a_dict_of_meshes_is_its_values():
    parts = {"a": CUBE, "b": moved(CUBE, 0.5, 0, 0)}
    assert tf.clash(parts).pairs[0].relation == "penetrating"
    assert tf.union(parts).mesh.volume == tf.boolean("a+b", **parts).mesh.volume == 1.5
    assert len(tf.concatenate(parts).faces) == 24 and len(tf.pack(parts, [8, 8]).parts) == 2
    with pytest.raises(ValueError, match="dict"):
        tf.repair(parts)


@pytest.mark.parametrize("call, name", [
    (tf.clash, "parts"), (tf.concatenate, "meshes"), (lambda some: tf.pack(some, [8, 8]), "parts"),
    (lambda some: tf.check_poses(some, np.tile(np.eye(4), (1, 2, 1, 1))), "parts")])
def test_a_mesh_is_not_a_list_of_bodies(call, name):
    """Its vertices and faces would be two clouds."""
    flat = np.insert(CUBE.faces, 0, 3, axis=1).ravel()
    for one, what in ((CUBE, "a Mesh"), ((CUBE.vertices, CUBE.faces), r"\(vertices, faces\)"),
                      ([CUBE.vertices.tolist(), CUBE.faces.tolist()], r"\(vertices, faces\)"),
                      ((CUBE.vertices, flat), r"\(vertices, faces\)"),
                      (tf.repair(CUBE), "a RepairResult")):
        with pytest.raises(ValueError, match=f"^{name}: expected a list of meshes, not {what}$"):
            call(one)
    with pytest.raises(ValueError, match=rf"^{name}\[1\]: int has no vertices and faces"):
        call([CUBE, 3])
    if call is not tf.concatenate:
        call((CUBE.vertices, CUBE.vertices + 1))      # two clouds