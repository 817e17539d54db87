"""Set operations: the bytes of the tool, volumes, what is refused."""

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

import treeform as tf
from support import (CUBE, SHEET, SPHERES, box, model, moved, needs_models, run_tool, same_mesh,
                     sphere)

OPERATIONS = {"union": tf.union, "difference": tf.difference, "intersection": tf.intersection}


def same_as_tool(folder, verb, operation, *paths):
    """Whether the tool writes the same bytes as the package does."""
    run_tool("tf-boolean", operation, *paths, "-o", folder / "tool.off", "--precision", "double")
    made = verb(*map(tf.read, paths))
    tf.write(folder / "own.off", made.mesh)
    return (folder / "tool.off").read_bytes() == (folder / "own.off").read_bytes()


@pytest.mark.parametrize("operation", OPERATIONS)
def test_bytes_are_those_of_the_tool(tmp_path, operation):
    assert same_as_tool(tmp_path, OPERATIONS[operation], operation, "data/two_spheres.stl",
                        "data/cube.stl")


@needs_models
@pytest.mark.parametrize("operation", OPERATIONS)
def test_bytes_are_those_of_the_tool_on_real_models(tmp_path, operation):
    shifted = tmp_path / "b.ply"
    mesh = tf.read(model("clean/fertility_9k.off"))
    tf.write(shifted, moved(mesh, *(mesh.bounds[1] - mesh.bounds[0]) * [0.1, 0.05, 0.02]))
    assert same_as_tool(tmp_path, OPERATIONS[operation], operation,
                        model("clean/fertility_9k.off"), shifted)


def test_a_cloud_is_no_solid():
    points = tf.Mesh(CUBE.vertices)
    assert not points.is_solid and tf.Mesh([], []).is_solid
    for verb in (lambda: tf.union(CUBE, points), lambda: tf.clip(SHEET, points),
                 lambda: tf.intersection([CUBE, (CUBE.vertices, [])])):
        with pytest.raises(ValueError, match="operand 1: 8 points without faces"):
            verb()
    with pytest.raises(ValueError, match="b: 8 points"):
        tf.boolean("a - b", a=CUBE, b=points)
    for verb in (lambda: tf.check_operand(points), lambda: CUBE | points, lambda: points - CUBE):
        with pytest.raises(ValueError, match="8 points without faces"):
            verb()


def test_objects_of_one_mesh_are_the_operands(tmp_path):
    small, beside = moved(CUBE, 0.5, 0.5, 0.5), moved(CUBE, -0.5, 0, 0)
    tf.write(tmp_path / "all.3mf", [CUBE, small, beside])
    mesh = tf.read(tmp_path / "all.3mf")
    for verb, word in ((tf.difference, "difference"), (tf.intersection, "intersection"),
                       (tf.symmetric_difference, "symmetric_difference"), (tf.union, "union")):
        made = verb(mesh)
        assert np.isclose(made.mesh.volume, verb(CUBE, small, beside).mesh.volume), word
        if word != "union":
            assert np.isclose(verb([mesh]).mesh.volume, made.mesh.volume)
            assert set(made.face_source[:, 0]) <= {0, 1, 2}
    run_tool("tf-boolean", "difference", tmp_path / "all.3mf", "-o", tmp_path / "tool.off",
             "--precision", "double")
    tf.write(tmp_path / "own.off", tf.difference(mesh))
    assert (tmp_path / "tool.off").read_bytes() == (tmp_path / "own.off").read_bytes()
    plain = tf.Mesh(mesh.vertices, mesh.faces)
    assert np.isclose(tf.difference(plain).mesh.volume, tf.union(plain).mesh.volume)


coordinates = st.integers(0, 8)
corners = st.tuples(coordinates, coordinates, coordinates)


def boxes():
    return st.builds(lambda low, size: box(low, np.add(low, size)), corners,
                     st.tuples(*[st.integers(1, 6)] * 3))


def cells(mesh):
    """The unit cubes of a lattice that a box fills."""
    (a, b, c), (d, e, f) = mesh.bounds.astype(int)
    filled = np.zeros((16, 16, 16), bool)
    filled[a:d, b:e, c:f] = True
    return filled


@settings(max_examples=40)
@given(boxes(), boxes(), boxes())
def test_volumes_are_those_of_cells(a, b, c):
    x, y, z = map(cells, (a, b, c))
    for made, filled in ((a | b, x | y), (a - b, x & ~y), (a & b, x & y), (a ^ b, x ^ y),
                         ((a | b) - c, (x | y) & ~z), ((a ^ b) & c, (x ^ y) & z),
                         ((a + b) * c, (x | y) & z), (tuple(a) * (b + c), x & (y | z))):
        if filled.any():
            assert made.volume == filled.sum()
            assert tf.check_operand(made) and len(tf.self_intersections(made)) == 0
        else:
            assert len(made.faces) == 0


def test_sources_name_the_faces_that_each_face_lies_in():
    a, b = CUBE, moved(CUBE, 0.5, 0.5, 0.5)
    made = tf.union(a, b)
    middles = made.vertices[made.faces].mean(axis=1)
    for middle, (operand, face) in zip(middles, made.face_source):
        source = (a, b)[operand]
        corners = source.vertices[source.faces[face]]
        normal = np.cross(corners[1] - corners[0], corners[2] - corners[0])
        assert abs((middle - corners[0]) @ normal) < 1e-12
    old = made.vertex_source[:, 0] != tf.NONE
    for vertex, (operand, number) in zip(made.vertices[old], made.vertex_source[old]):
        assert np.array_equal(vertex, (a, b)[operand].vertices[number])


def test_options():
    b = moved(CUBE, 0.5, 0, 0)
    assert tf.union(CUBE, b, volumes=True).volumes == (1, 1, 1.5, 0.5)
    assert len(tf.union(CUBE, b, merge_coplanar=True).faces) == 12
    single = tf.union(CUBE, moved(CUBE, 0.1, 0.1, 0.1), precision="float32")
    assert np.array_equal(single.vertices, single.vertices.astype(np.float32))
    twice = tf.Mesh(np.vstack([CUBE.vertices, CUBE.vertices + 0.5]),
                    np.vstack([CUBE.faces, CUBE.faces + 8]))
    assert tf.union(twice).mesh.volume == 1.875
    assert tf.union(twice, fill_rule="even_odd").mesh.volume == 1.75
    assert tf.union([CUBE, b, moved(CUBE, 1, 0, 0)]).mesh.volume == 2
    assert tf.symmetric_difference(CUBE, b).mesh.volume == 1
    assert tf.boolean("(body - hole) + 'pin'", body=CUBE, hole=b, pin=moved(CUBE, 3, 0, 0)) \
        .mesh.volume == 1.5
    with pytest.raises(ValueError):
        tf.boolean("a +", a=CUBE)
    with pytest.raises(ValueError):
        tf.boolean("a + z", a=CUBE)


def test_small_parts_are_left_out_and_gaps_filled_where_asked_for():
    speck, near = tf.Mesh(CUBE.vertices / 8 + 5, CUBE.faces), moved(CUBE, 1.125, 0, 0)
    made = tf.union(CUBE, speck, min_volume=0.01)
    assert made.mesh.volume == 1 and len(made.vertex_source) == 8
    assert (made.statistics["small_parts"], made.statistics["small_volume"]) == (1, 1 / 512)
    assert tf.boolean("a - b", a=CUBE, b=moved(speck, -4.75, -4.75, -4.75), min_volume=0.01) \
        .mesh.volume == 1
    made = tf.union(CUBE, near, gap=0.25)
    assert made.mesh.volume == 2.125 and made.statistics["filled_faces"] == 4
    assert made.face_source[:, 0].max() == 1
    assert tf.union(CUBE, near, gap=0.1).statistics["filled_faces"] == 0
    for wrong in ({"gap": -1.0}, {"gap": np.nan}, {"min_volume": np.inf}):
        with pytest.raises(ValueError, match="negative or not finite"):
            tf.union(CUBE, near, **wrong)


def test_open_operands_are_refused_or_told_of():
    with pytest.raises(tf.NotClosedError) as caught:
        tf.union(CUBE, SHEET)
    assert caught.value.edges.shape == (3, 2, 3)
    assert (caught.value.faces == [1, 0]).all()
    told = tf.union(CUBE, SHEET, check=False)
    assert not told.certificate and told.certificate.status == "open_input"
    assert told.certificate.open_count == 3 and "1" in repr(told.certificate)


def test_what_is_left_of_nothing_is_empty():
    assert len(tf.intersection(CUBE, moved(CUBE, 5, 0, 0)).faces) == 0
    assert len(tf.difference(CUBE, CUBE).faces) == 0


def test_clip_and_split():
    plane = tf.Mesh([[-2, -2, 0.5], [3, -2, 0.5], [3, 3, 0.5], [-2, 3, 0.5]],
                    [[0, 1, 2], [0, 2, 3]])
    inner, outer = tf.clip(plane, CUBE, keep="inside"), tf.clip(plane, CUBE)
    assert inner.mesh.area == 1 and outer.mesh.area == 24
    with pytest.raises(ValueError, match="keep"):
        tf.clip(plane, CUBE, keep="both")
    pieces = tf.split(SPHERES)
    assert pieces.certificate and pieces.mesh.area == pytest.approx(SPHERES.area)
    assert len(tf.self_intersections(pieces)) == 0


def test_a_sphere_of_many_directions():
    ball = sphere(3)
    rest = tf.difference(ball, box([0, -2, -2], [2, 2, 2]))
    assert rest.mesh.volume == pytest.approx(ball.volume / 2)
    assert tf.check_operand(rest)
    assert same_mesh(tf.union(ball).mesh, tf.union(ball).mesh)


def test_a_list_may_stand_among_operands():
    plate = box([0, 0, 0], [4, 1, 1])
    cutters = [box([k, -1, -1], [k + 0.5, 2, 2]) for k in (1, 2, 3)]
    pairs = [(one.vertices, one.faces) for one in cutters]
    for many in (cutters, tuple(cutters), iter(cutters), pairs, [tf.union(c) for c in cutters]):
        assert tf.difference(plate, many).mesh.volume == 2.5
    assert tf.difference([plate], *cutters).mesh.volume == 2.5
    assert tf.difference(plate, cutters[:1], cutters[1:]).mesh.volume == 2.5
    assert tf.difference(plate, cutters).face_source[:, 0].max() == 3
    assert tf.difference(plate, []).mesh.volume == 4
    assert tf.union([plate], cutters, cutters[0]).mesh.volume == tf.union(plate,
                                                                          *cutters).mesh.volume
    assert tf.intersection(plate, cutters[:1]).mesh.volume == 0.5
    assert tf.symmetric_difference(plate, cutters[:1]).mesh.volume == 3.5 + 4
    sheet = ([[-1, 0.5, 0.5], [9, 0.5, 0.5], [-1, 0.75, 0.5]], [[0, 1, 2]])
    assert tf.clip(sheet, cutters).mesh.area == tf.clip(sheet, *cutters).mesh.area
    for wrong in ([plate, 3], "plate", [[cutters]], {"a": 3}):
        with pytest.raises(ValueError, match="mesh"):
            tf.difference(plate, wrong)


def test_errors_name_operands_as_they_were_given():
    with pytest.raises(tf.NotClosedError, match="of drill$"):
        tf.boolean("body-drill", body=CUBE, drill=SHEET)
    with pytest.raises(tf.NotClosedError, match="of the right operand of -"):
        CUBE - SHEET
    with pytest.raises(tf.NotClosedError, match=r"of operand d \(the 4th\)"):
        tf.union(CUBE, CUBE, CUBE, SHEET)
    with pytest.raises(ValueError, match="at least one mesh"):
        tf.union([])
