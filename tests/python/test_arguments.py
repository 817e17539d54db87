"""Every argument of every function: what makes no sense is an error that says so, never a crash."""

import inspect
import re
import subprocess
import sys

import numpy as np
import pytest

import treeform as tf
from support import CUBE, SPHERES, moved

POINTS = np.random.default_rng(0).random((20, 3))
FAR, NEAR = moved(CUBE, 0, 0, 3), moved(CUBE, 0.5, 0.25, 0.125)
PLANE = tf.find_features(CUBE)[0]
FOUND = tf.self_intersections(SPHERES)
ONE, TWO = {"mesh": CUBE}, {"a": CUBE, "b": FAR}
AT = {"mesh": CUBE, "points": POINTS}
RAYS = {"mesh": CUBE, "origins": POINTS, "directions": POINTS}
PLACED = {"moving": FAR, "fixed": CUBE}

#: Arguments that each function takes; those without here take no data, or are tested elsewhere.
TAKES = {
    "align": PLACED, "boolean": {"expression": "a", "a": CUBE},
    "check_poses": {"parts": [CUBE, FAR], "poses": np.tile(np.eye(4), (3, 2, 1, 1))},
    "check_operand": ONE, "clash": {"parts": [CUBE, FAR]}, "closest_point": AT, "closest_pair": TWO,
    "clip": {"sheet": CUBE}, "contains": AT, "convex_hull": {"points": POINTS},
    "components": ONE, "concatenate": {"meshes": [CUBE]}, "cut": {**ONE, "at": [0.5, 0.5, 0.5]},
    "cut_to_fit": {"mesh": CUBE, "size": [1, 1, 0.5]}, "mass_properties": ONE,
    "file_parts": ONE, "submesh": {"mesh": CUBE, "faces": [0]},
    "transformed": {"mesh": CUBE, "matrix": np.eye(4)}, "count_inside_out": ONE,
    "count_nearly_equal": {"points": POINTS, "distance": 0.1}, "count_topology": ONE,
    "deviation": TWO, "distance": TWO, "drop": PLACED, "face_components": ONE,
    "faces_in_box": {"mesh": CUBE, "min": [0, 0, 0], "max": [1, 1, 1]}, "find_invalid_faces": ONE,
    "find_features": ONE, "find_rounding_defects": {"mesh": CUBE, "placed": CUBE.vertices},
    "find_solid_defects": ONE, "intersection_curves": {"mesh": SPHERES, "found": FOUND},
    "intersection_regions": {"mesh": SPHERES, "found": FOUND}, "intersects": TWO,
    "join_equal_points": ONE, "lay_flat": ONE,
    "layer_heights": {"mesh": CUBE, "thickness": 0.5}, "section": ONE, "locate": AT, "mate": PLACED,
    "mate_features": {**PLACED, "of_moving": PLANE, "of_fixed": PLANE}, "measure": TWO,
    "mesh_intersections": TWO, "pack": {"parts": [CUBE], "size": [5, 5]},
    "penetration_depth": {"a": CUBE, "b": NEAR}, "raycast": RAYS, "raycast_all": RAYS,
    "raycast_any": RAYS, "read": {"path": "data/cube.stl"}, "repair": ONE,
    "resolve_self_intersections": ONE, "rounded": {"points": POINTS}, "self_intersections": ONE,
    "self_intersections_of_file": {"path": "data/two_spheres.stl"},
    "separate": {"moving": NEAR, "fixed": CUBE}, "signed_distance": AT,
    "slide": {**PLACED, "direction": [0, 0, -1]}, "time_of_impact": {**TWO, "motion": [0, 0, -1]},
    "turn": {"moving": FAR, "fixed": CUBE, "axis": [0, 0, 1]}, "weld": {"mesh_or_points": CUBE},
    "winding_number": AT, "wrap": {"mesh": CUBE, "size": 0.5},
    "cut_along": {"mesh": CUBE, "values": CUBE.vertices[:, 2], "levels": [0.5]},
    "isolines": {"mesh": CUBE, "values": CUBE.vertices[:, 2], "levels": [0.5]},
    "offset": {"mesh": CUBE, "distance": 0.5}, "hollow": {"mesh": CUBE, "wall": 0.25},
    "thicken": {"mesh": CUBE, "thickness": 0.5}, "oriented_box": {"points": POINTS},
    "simplify": {"mesh": CUBE, "max_distance": 0.1}, "wall_thickness": ONE}
ELSEWHERE = {"BoxTree", "PointTree", "Attributes", "Mesh", "SharedSearch", "SharedWeld", "plot",
             "show", "thread_count", "threads", "difference", "intersection", "union", "split",
             "symmetric_difference", "from_meshio", "from_open3d", "from_pyvista", "from_trimesh",
             "from_vtk", "read_urdf", "write", "write_curves", "weld_stream"}

BROKEN = CUBE.vertices.copy()
BROKEN[3] = np.nan
BAD = {
    "mesh": ["cube", 3, None, {}, (CUBE.vertices, CUBE.faces + 0.5),
             (CUBE.vertices[:, :2], CUBE.faces),
             (CUBE.vertices, CUBE.faces[:, :2]), (np.array([["a"] * 3]), CUBE.faces),
             (CUBE.vertices + 1j, CUBE.faces), (CUBE.vertices, CUBE.faces.astype(int) - 1)],
    "points": ["abc", None, 3, POINTS[:, :2], POINTS[0], np.array([[1, 2, None]]), POINTS + 1j,
               [[1, 2, 3], [1, 2]]],
    "vector": ["abc", None, [1, 2, 3, 4], np.eye(3), [np.nan, 0, 0]],
    "matrix": ["abc", np.eye(3), np.ones((4, 4)), np.eye(4) * np.nan],
    "float": ["x", [1, 2], np.zeros(3), 10**400], "int": ["x", -1, 1.5, 2**70, [1]],
    "str": [3, None, ["a"]], "bool": ["x", np.zeros(3)],
    "several": [3, 1.5],
    "found": ["x", 3, None], "feature": ["x", 3, None]}
KINDS = {"mesh": "mesh", "moving": "mesh", "fixed": "mesh", "a": "mesh",
         "b": "mesh",
         "sheet": "mesh", "mesh_or_points": "mesh", "points": "points", "origins": "points",
         "directions": "points", "placed": "points", "min": "vector", "max": "vector",
         "direction": "vector", "at": "vector", "normal": "vector", "axis": "vector",
         "origin": "vector", "motion": "vector",
         "transform_a": "matrix", "matrix": "matrix", "meshes": "several", "transform_b": "matrix",
         "start": "matrix", "parts": "several",
         "ignored": "several", "kinds": "several", "steps": "several", "ignored_seams": "several",
         "same": "several", "communicator": "several", "found": "found", "of_moving": "feature",
         "of_fixed": "feature"}
NOTHING = {"fixed"}  # may be None


def test_every_function_is_here():
    names = {name for name in tf.__all__ if inspect.isfunction(getattr(tf, name))}
    assert names - ELSEWHERE == set(TAKES)


def kind_of(name, annotation):
    if name == "check":  # is asked for truth alone
        return None
    kind = annotation.removesuffix(" | None")
    return kind if kind in BAD else KINDS.get(name)


@pytest.mark.parametrize("name", sorted(TAKES))
def test_what_makes_no_sense_is_named(name):
    function = getattr(tf, name)
    function(**TAKES[name])
    tried = 0
    for parameter in inspect.signature(function).parameters.values():
        kind = kind_of(parameter.name, parameter.annotation)
        if parameter.kind in (parameter.VAR_KEYWORD, parameter.VAR_POSITIONAL) or kind not in BAD:
            continue
        for value in BAD[kind]:
            if value is None and (parameter.default is None or parameter.name in NOTHING):
                continue
            tried += 1
            with pytest.raises((ValueError, tf.FileError)) as caught:
                function(**{**TAKES[name], parameter.name: value})
                pytest.fail(f"{parameter.name}={value!r} is taken")
            text = str(caught.value)
            assert "incompatible" not in text and "treeform::" not in text, parameter.name
            assert re.search(rf"\b({parameter.name}|mesh|vertices|faces|points|face|query|not "
                             rf"finite"
                             rf"|one of|there (is|are) no)\b", text), (parameter.name, text)
    assert tried


def test_pairs_of_another_mesh_are_refused():
    for verb in (tf.intersection_curves, tf.intersection_regions):
        with pytest.raises(ValueError, match=r"\bface \d+\b|\bpair \d+\b"):
            verb(CUBE, FOUND)
    flat = tf.Mesh([[0, 0, 0], [1, 0, 0], [2, 0, 0], [0, 1, 0]], [[0, 1, 2], [0, 1, 3]])
    found = tf.FacePairs(np.array([[0, 1]], np.uint32), np.array([0], np.uint8), {})
    with pytest.raises(ValueError, match="face 0, which has no area"):
        tf.intersection_curves(flat, found)
    assert tf.intersection_curves(flat, tf.self_intersections(flat)) == []
    with pytest.raises(ValueError, match="kinds: 9 at 0"):
        tf.intersection_curves(SPHERES, tf.FacePairs(found.pairs, found.kinds + 9, {}))


def test_what_is_confused_is_said_with_the_way_out():
    for call, text in (
            (lambda: tf.closest_point(POINTS, CUBE), r"got a mesh; .*\(mesh, points\)"),
            (lambda: tf.signed_distance(POINTS, CUBE), r"the order is \(mesh, points\)"),
            (lambda: tf.raycast(CUBE, CUBE, POINTS), r"the order is \(mesh, origins\)"),
            (lambda: tf.union(tf.pack([CUBE], [5, 5])), "Packing.*: pass its `parts`"),
            (lambda: tf.Mesh(*CUBE, {"q": POINTS}), r"mesh.attributes.vertex"),
            (lambda: tf.self_intersections((BROKEN, CUBE.faces)), "drop_non_finite=True"),
            (lambda: tf.repair((BROKEN, CUBE.faces)), "drop_non_finite=True"),
            (lambda: tf.convex_hull(BROKEN), "drop_non_finite=True")):
        with pytest.raises(ValueError, match=text):
            call()
    with pytest.raises(ValueError, match="an entry of the transform is not finite$"):
        tf.mesh_intersections(CUBE, CUBE, transform_a=np.diag([np.inf, 1, 1, 1])[:3])


def test_files_that_cannot_be():
    for path in ("", "/no/such/place/x.xyz"):
        with pytest.raises((tf.FileError, ValueError)):
            tf.weld_stream(path, "out.xyz", 1.0)
    with pytest.raises(ValueError, match="communicator"):
        tf.weld_stream("x.xyz", "out.xyz", 1.0, communicator=3)
    with pytest.raises(ValueError, match="relative: expected True or False"):
        tf.weld_stream("x.xyz", "out.xyz", 1.0, relative="x")
    with pytest.raises(ValueError, match=r"label: the shape is \(\), not \(n,\)"):
        tf.weld(CUBE, label=3)
    with pytest.raises(ValueError, match="same"):
        tf.weld(CUBE, same={"quality": "x"})


@pytest.mark.parametrize("view", [lambda a: a[::-1], lambda a: np.asfortranarray(a),
                                  lambda a: np.repeat(a, 2, axis=0)[::2],
                                  lambda a: np.frombuffer(b"\0" + a.tobytes(), np.uint8)[1:].view(
                                      a.dtype).reshape(a.shape)])
def test_arrays_of_any_layout_are_as_good(view):
    """Reversed, by columns, every second row; not aligned, and read-only."""
    points = view(POINTS)
    same = np.array(points)
    for verb in (tf.closest_point, tf.locate, tf.winding_number, tf.signed_distance):
        mine, theirs = verb(CUBE, points), verb(CUBE, same)
        pairs = zip(mine, theirs) if isinstance(mine, tuple) else [(mine, theirs)]
        assert all(np.array_equal(one, other) for one, other in pairs)
    mesh = tf.Mesh(view(CUBE.vertices), view(CUBE.faces))
    assert mesh.volume == tf.Mesh(np.array(view(CUBE.vertices)), np.array(view(CUBE.faces))).volume
    assert np.array_equal(tf.rounded(points), tf.rounded(same))
    assert np.array_equal(tf.weld(points, 0.2).points, tf.weld(same, 0.2).points)
