"""Two bodies and many; in many poses."""

import numpy as np
import pytest

import treeform as tf
from support import CUBE, SHEET, SPHERES, box, moved, sphere


def matrices(offsets):
    made = np.tile(np.eye(4), (len(offsets), 1, 1))
    made[:, :3, 3] = offsets
    return made


def test_two_bodies():
    away = moved(CUBE, 3, 0, 0)
    assert tf.distance(CUBE, away) == 2 and not tf.intersects(CUBE, away)
    assert tf.distance(CUBE, away, radius=1) == np.inf
    near = tf.closest_pair(CUBE, away)
    assert near.distance == 2 and near.on_a[0] == 1 and near.on_b[0] == 3
    assert tf.closest_pair(CUBE, away, radius=1) is None
    assert tf.closest_pair(CUBE, ([], [])) is None
    how = tf.measure(CUBE, box([0.25] * 3, [0.75] * 3))
    assert how.relation == "penetrating" and how.b_inside_a and how.distance == 0
    assert how.surface_distance == 0.25
    assert tf.measure(CUBE, away, radius=1) is None
    assert tf.measure(np.array([[0.5, 0.5, 0.5]]), CUBE).relation == "penetrating"
    depth, move, effort = tf.penetration_depth(CUBE, moved(CUBE, 0.75, 0, 0))
    assert 0 < effort.pairs < effort.bound and effort.skipped_candidates == 0
    bounded = tf.penetration_depth(CUBE, moved(CUBE, 0.75, 0, 0), effort=64)
    assert bounded.effort.skipped_candidates > 0
    assert depth == 0.25 and move.tolist() == [-0.25, 0, 0]
    assert tf.penetration_depth(CUBE, away) is None


def test_the_first_contact_is_exact():
    met = tf.time_of_impact(CUBE, moved(CUBE, 3, 0, 0), [2, 0, 0])
    assert met.outcome == "contact" and met.time == 1 and len(met.faces) == len(met.points) > 0
    never = tf.time_of_impact(CUBE, moved(CUBE, 3, 0, 0), [-1, 0, 0])
    assert never.outcome == "nothing_met" and never.time == np.inf
    assert tf.time_of_impact(CUBE, moved(CUBE, 1, 0, 0), [1, 0, 0]).outcome == "starts_touching"


def test_many_positions_are_as_one_by_one():
    offsets = np.random.default_rng(1).random((600, 3)) * 4 - 2
    moves = matrices(offsets)
    ball = sphere(2)
    hit = tf.intersects(ball, ball, transform_b=moves)
    far = tf.distance(ball, ball, transform_b=moves)
    assert hit.shape == far.shape == (600,) and hit.dtype == bool
    assert np.array_equal(hit, far == 0)
    for i in range(0, 600, 60):
        assert tf.intersects(ball, ball, transform_b=moves[i]) == hit[i]
        assert tf.distance(ball, ball, transform_b=moves[i]) == far[i]
        other = tf.Mesh(ball.vertices + offsets[i], ball.faces)
        assert tf.intersects(ball, other) == hit[i]
    with pytest.raises(ValueError, match="3 positions of a, 2 of b"):
        tf.intersects(ball, ball, transform_a=moves[:3], transform_b=moves[:2])


def test_parts_of_an_assembly():
    parts = [CUBE, moved(CUBE, 0.5, 0.5, 0.5), moved(CUBE, 1, 0, 0), moved(CUBE, 5, 0, 0),
             box([5.25, 0.25, 0.25], [5.75, 0.75, 0.75])]
    found = tf.clash(parts)
    assert {(one.a, one.b): one.relation for one in found.pairs} == {
        (0, 1): "penetrating", (0, 2): "touching", (1, 2): "penetrating", (3, 4): "penetrating"}
    first = found.pairs[0]
    assert first.volume == 0.125 and first.depth == 0.5 and len(first.regions) == 1
    assert found.pairs[-1].b_inside_a and found.clashes == 3
    assert found.counts["penetrating"] == 3 and found.counts["touching"] == 1
    near = tf.clash([CUBE, moved(CUBE, 1.5, 0, 0)], 1.0)
    assert near.pairs[0].relation == "closer_than_clearance" and near.pairs[0].distance == 0.5
    assert near.pairs[0].nearest.shape == (2, 3)
    assert [(one.a, one.b) for one in tf.clash(parts, ignored=[(1, 0), (3, 4)]).pairs] == [
        (0, 2), (1, 2)]
    with pytest.raises(ValueError, match="-1"):
        tf.clash(parts, ignored=[(0, -1)])
    with pytest.raises(ValueError, match="clearance"):
        tf.clash(parts, -1.0)


def test_what_is_inside_out_is_the_same_solid():
    turned = tf.Mesh(CUBE.vertices + [0.5, 0, 0], CUBE.faces[:, ::-1])
    assert (tf.count_inside_out(turned), tf.count_inside_out(CUBE)) == (1, 0)
    assert tf.count_inside_out(tf.Mesh(CUBE.vertices, CUBE.faces[1:, ::-1])) == 0
    one, = tf.clash([CUBE, turned]).pairs
    assert one.relation == "penetrating" and one.volume == 0.5
    assert tf.measure(CUBE, turned).relation == "penetrating"
    assert tf.contains(turned, [[1, 0.5, 0.5], [0.25, 0.5, 0.5]]).tolist() == [True, False]
    poses = matrices([[0, 0, 0], [0.5, 0, 0], [0, 0, 0], [1, 0, 0]]).reshape(2, 2, 4, 4)
    assert tf.check_poses([turned, CUBE], poses).in_collision.all()
    poses[:, 1, 0] = [[-1, 0, 0, 1.5], [-1, 0, 0, 2.5]]  # a mirror, from 0.5 to 1.5, or from 1.5
    assert tf.check_poses([turned, CUBE], poses).in_collision.tolist() == [True, False]


def test_a_mirror_turns_faces_over():
    mirror = np.diag([-1.0, 1, 1, 1])
    found = tf.align(SPHERES, SPHERES, start=mirror, max_iterations=1)
    assert np.linalg.det(found.matrix[:3, :3]) < 0 and found.mesh.volume > 0


def test_poses_are_as_one_by_one():
    rng = np.random.default_rng(2)
    parts = [sphere(2), CUBE, box([0, 0, 0], [2, 0.5, 0.5])]
    poses = matrices(rng.random((120, 3)) * 3).reshape(40, 3, 4, 4)
    found = tf.check_poses(parts, poses, 0.1)
    there = {(p, a, b): tf.RELATIONS[h] for p, (a, b), h
             in zip(found.pose.tolist(), found.parts.tolist(), found.relation)}
    bad = np.zeros(40, bool)
    for p in range(0, 40):
        placed = [tf.Mesh(part.vertices + m[:3, 3], part.faces) for part, m in zip(parts, poses[p])]
        for one in tf.clash(placed, 0.1).pairs:
            assert there.pop((p, one.a, one.b)) == one.relation
            bad[p] |= one.relation != "touching"
    assert not there
    assert np.array_equal(found.in_collision, bad) and found.clashing == bad.sum()
    first = tf.check_poses(parts, poses, 0.1, first_only=True)
    assert len(first.pose) == len(set(first.pose.tolist()))
    with pytest.raises(ValueError, match="poses"):
        tf.check_poses(parts, poses[:, :2])
    single = tf.check_poses([CUBE, CUBE], matrices([[0.5, 0, 0], [4, 0, 0]]))
    assert single.pose.tolist() == [0]


def test_rings_in_each_other_do_not_clash():
    thin = tf.difference(box([0, 0, 0], [4, 4, 1]), box([1, 1, -1], [3, 3, 2]))
    other = tf.Mesh(thin.vertices[:, [2, 1, 0]] + [1.5, 1.5, -1.5], thin.faces[:, ::-1])
    assert tf.check_operand(thin) and tf.check_operand(other)
    found = tf.clash([thin, other])
    assert found.pairs == [] and found.boxes_apart == 0 and found.counts["disjoint"] == 1
    assert not tf.intersects(SHEET, moved(SPHERES, 50, 0, 0))


def test_parts_clash_where_their_poses_put_them():
    poses = matrices([[0, 0, 0], [0.5, 0, 0], [0, 0, 9]])
    found = tf.clash([CUBE, CUBE, CUBE], poses=poses)
    there = tf.clash([moved(CUBE, *pose[:3, 3]) for pose in poses])
    assert [(one.a, one.b, one.relation, one.volume, one.depth) for one in found.pairs] == [
        (0, 1, "penetrating", 0.5, 0.5)]
    assert str(found) == str(there) and str(found.pairs) == str(there.pairs)
    assert len(tf.check_poses([CUBE] * 3, poses[None]).pose) == 1
    turned = np.eye(4)
    turned[:3, :3] = [[0, -1, 0], [1, 0, 0], [0, 0, 1]]
    assert tf.clash([CUBE, CUBE], poses=[np.eye(4), turned]).pairs[0].relation == "touching"
    mirror = np.diag([-1.0, 1, 1, 1])
    mirror[0, 3] = 1.5
    one, = tf.clash([CUBE, CUBE], poses=[np.eye(4), mirror]).pairs
    assert one.relation == "penetrating" and one.volume == 0.5
    assert tf.clash([CUBE, [[0.5, 0.5, 5.0]]],
                    poses=[np.eye(4), matrices([[0, 0, -4.5]])[0]]).clashes
    for wrong in (np.eye(4), poses[:2], poses[:, :3], np.full((3, 4, 4), np.nan), "x"):
        with pytest.raises(ValueError, match="poses"):
            tf.clash([CUBE, CUBE, CUBE], poses=wrong)
