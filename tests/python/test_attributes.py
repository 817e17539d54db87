"""What meshes have besides points and faces is carried over to what is made of them."""

import copy
import io
import pickle
import threading

import numpy as np
import pytest

import treeform as tf
from support import CUBE, SPHERES, moved, run_tool


def painted(mesh, seed=0, number=np.uint8):
    """The mesh with a color for each face, and a number for each vertex."""
    rng = np.random.default_rng(seed)
    extra = tf.Attributes()
    for channel in ("red", "green", "blue"):
        extra.set_face(channel, rng.integers(0, 255, len(mesh.faces)).astype(number))
    extra.set_vertex("quality", rng.random(len(mesh.vertices)))
    return tf.Mesh(mesh.vertices, mesh.faces, extra)


A, B = painted(CUBE, 1), painted(moved(CUBE, 0.5, 0.25, 0.125), 2)


def columns(mesh):
    extra = mesh.attributes
    return {**{("vertex", k): v for k, v in extra.vertex.items()},
            **{("face", k): v for k, v in extra.face.items()}}


@pytest.mark.parametrize("verb, letters", [
    (lambda a, b: tf.union(a, b), "union"), (lambda a, b: tf.difference(a, b), "difference"),
    (lambda a, b: tf.intersection(a, b, merge_coplanar=True), "intersection"),
    (lambda a, b: a ^ b, "symmetric-difference")])
def test_set_operations_carry_what_the_tool_does(tmp_path, verb, letters):
    paths = [tmp_path / f"{name}.ply" for name in ("a", "b", "out")]
    tf.write(paths[0], A)
    tf.write(paths[1], B)
    simplify = ["--merge-coplanar"] if letters == "intersection" else []
    run_tool("tf-boolean", letters, paths[0], paths[1], "-o", paths[2], *simplify)
    theirs = tf.read(paths[2])
    made = verb(A, B)
    mine = getattr(made, "mesh", made)
    assert np.array_equal(mine.vertices, theirs.vertices)
    assert np.array_equal(mine.faces, theirs.faces)
    there = {key: values for key, values in columns(theirs).items()
             if not key[1].startswith("source_")}
    assert there.keys() == columns(mine).keys() and len(there) == 4
    for key, values in columns(mine).items():
        assert values.dtype == there[key].dtype
        assert np.array_equal(values, there[key], equal_nan=True), key


def test_an_operand_without_values_gives_none():
    made = tf.union(CUBE, moved(CUBE, 0, 0.75, 0), B)
    lacks = made.face_source[:, 0] != 2
    assert lacks.any() and not lacks.all()
    assert (made.mesh.attributes.face["red"][lacks] == 0).all()
    taken = B.attributes.face["red"][made.face_source[~lacks, 1]]
    assert np.array_equal(made.mesh.attributes.face["red"][~lacks], taken)
    assert not columns(tf.union(CUBE, moved(CUBE, 0.5, 0, 0)).mesh)


@pytest.mark.parametrize("verb", [
    lambda m: tf.resolve_self_intersections(m), lambda m: tf.resolve_self_intersections(m, "split"),
    lambda m: tf.repair(m), lambda m: tf.repair(m, sheet=True)])
def test_mended_meshes_keep_values_of_faces_and_vertices(verb):
    mesh = painted(SPHERES)
    made = verb(mesh)
    known = made.face_source != tf.NONE
    assert known.any()
    for name, values in made.mesh.attributes.face.items():
        assert np.array_equal(values[known], mesh.attributes.face[name][made.face_source[known]])
    known = made.vertex_source != tf.NONE
    assert np.array_equal(made.mesh.attributes.vertex["quality"][known],
                          mesh.attributes.vertex["quality"][made.vertex_source[known]])


def test_clipped_and_split_meshes_keep_theirs():
    for made in (tf.clip(A, moved(CUBE, 0.5, 0.5, 0.5)), tf.split(A, moved(B, 0, 0, 0))):
        of_a = made.face_source[:, 0] == 0
        assert np.array_equal(made.mesh.attributes.face["red"][of_a],
                              A.attributes.face["red"][made.face_source[of_a, 1]])


def test_joined_points_have_the_value_of_the_first():
    soup = painted(tf.Mesh(CUBE.vertices[CUBE.faces].reshape(-1, 3),
                           np.arange(36, dtype=np.uint32).reshape(-1, 3)))
    made = tf.join_equal_points(soup)
    first = [int(np.flatnonzero((soup.vertices == p).all(axis=1))[0]) for p in made.vertices]
    assert np.array_equal(made.attributes.vertex["quality"],
                          soup.attributes.vertex["quality"][first])
    assert np.array_equal(made.attributes.face["red"], soup.attributes.face["red"])


def test_moved_meshes_keep_theirs_and_normals_turn():
    mesh = painted(moved(CUBE, 0, 0, 3))
    for name, value in zip(("nx", "ny", "nz"), (0.0, 0.0, 1.0)):
        mesh.attributes.set_vertex(name, np.full(8, value))
    slid = tf.slide(mesh, CUBE, [0, 0, -1]).mesh
    assert columns(slid).keys() == columns(mesh).keys()
    assert all(np.array_equal(columns(slid)[key], value) for key, value in columns(mesh).items())
    laid = tf.lay_flat(mesh, normal=[1, 0, 0])
    normals = np.column_stack([laid.mesh.attributes.vertex[name] for name in ("nx", "ny", "nz")])
    assert np.allclose(normals, laid.matrix[:3, :3] @ [0, 0, 1]) and abs(normals[0, 2]) < 1e-9
    assert np.array_equal(mesh.attributes.vertex["nz"], np.ones(8))
    packed = tf.pack([mesh, CUBE], [4, 4], spacing=0.5)
    assert np.array_equal(columns(packed.parts[0].mesh)[("face", "red")],
                          mesh.attributes.face["red"])
    assert not columns(packed.parts[1].mesh)


def test_textures_of_corners_are_carried(tmp_path):
    lines = [f"v {x} {y} {z}" for x, y, z in CUBE.vertices]
    lines += [f"vt {i / 36} {1 - i / 36}" for i in range(36)]
    lines += ["f " + " ".join(f"{v + 1}/{3 * f + c + 1}" for c, v in enumerate(face))
              for f, face in enumerate(CUBE.faces)]
    (tmp_path / "cube.obj").write_text("\n".join(lines) + "\n")
    mesh = tf.read(tmp_path / "cube.obj")
    made = tf.difference(mesh, moved(CUBE, 0.5, 0.5, 0.5))
    corners = made.mesh.attributes.corners
    for f in np.flatnonzero(made.face_source[:, 0] == 0):
        source = made.face_source[f, 1]
        a, b, c = CUBE.vertices[CUBE.faces[source]]
        for corner in range(3):
            p = made.vertices[made.faces[f, corner]]
            share = np.linalg.lstsq(np.column_stack([b - a, c - a]), p - a, rcond=None)[0]
            u = np.array([1 - share.sum(), *share]) @ (3 * source + np.arange(3)) / 36
            at = corners["texture"][corners["texture_of_corner"][f, corner]]
            assert abs(at[0] - u) < 1e-12 and abs(at[1] - (1 - u)) < 1e-12


def test_attributes_of_another_mesh_are_refused():
    wrong = tf.Mesh(SPHERES.vertices, SPHERES.faces, A.attributes)
    for verb in (lambda: tf.union(CUBE, wrong), lambda: tf.split(CUBE, wrong)):
        with pytest.raises(ValueError, match="operand 1: attributes: face has 12 rows; .* 640"):
            verb()
    with pytest.raises(ValueError, match="operand 0: attributes"):
        tf.repair(wrong)


def test_what_a_call_has_begun_with_is_not_changed_by_another_thread(tmp_path):
    """Neither by new values of a column, nor by others of another size of number."""
    count = 200_000
    points = np.random.default_rng(7).random((count, 3))
    extra = tf.Attributes()
    extra.set_vertex("quality", np.arange(count, dtype=np.float64))
    mesh = tf.Mesh(points, [[0, 1, 2]], extra)
    begun, ended, results = threading.Event(), threading.Event(), []

    def work():
        def progress(share):
            if share > 0.0:
                begun.set()
        results.append(tf.weld(mesh, 0.002, progress=progress))
        begun.set()
        tf.write(tmp_path / "m.ply", results[0])
        ended.set()

    thread = threading.Thread(target=work)
    thread.start()
    begun.wait()
    while not ended.is_set():
        for number in (np.uint8, np.float64):
            extra.set_vertex("quality", np.zeros(count, number))
    thread.join()
    made = results[0]
    assert len(made.points) < count and not extra.vertex["quality"].any()
    assert np.array_equal(made.mesh.attributes.vertex["quality"], made.vertex_source)
    again = tf.read(tmp_path / "m.ply").attributes.vertex["quality"]
    assert np.array_equal(again, made.vertex_source)


def textured(path, library):
    """A cube whose OBJ file names a material of that library."""
    path.parent.mkdir(exist_ok=True)
    rows = ["mtllib " + library, *("v %r %r %r" % tuple(p) for p in CUBE.vertices.tolist()),
            "vt 0 0", "vt 1 0", "vt 0 1", "usemtl paint",
            *("f %d/1 %d/2 %d/3" % tuple(f + 1) for f in CUBE.faces)]
    path.write_text("\n".join(rows) + "\n")
    return tf.read(path)


def libraries(text):
    return [line[7:] for line in text.splitlines() if line.startswith("mtllib ")]


def test_links_to_materials_lead_to_the_same_files_from_other_folders(tmp_path):
    one = textured(tmp_path / "tex" / "a.obj", "a.mtl")
    above = tf.cut(pickle.loads(pickle.dumps(one)), at=[0, 0, 0.5])[1]
    (tmp_path / "res").mkdir()
    for folder, name in ("res", "../tex/a.mtl"), (".", "tex/a.mtl"), ("tex", "a.mtl"):
        assert not tf.write(tmp_path / folder / "above.obj", above).warnings
        assert libraries((tmp_path / folder / "above.obj").read_text()) == [name]
    memory = io.BytesIO()
    tf.write(memory, above, "obj")
    assert libraries(memory.getvalue().decode()) == ["a.mtl"]
    whole = textured(tmp_path / "tex" / "b.obj", "/lib/b.mtl")
    assert not tf.write(tmp_path / "res" / "b.obj", whole).warnings
    assert libraries((tmp_path / "res" / "b.obj").read_text()) == ["/lib/b.mtl"]


def test_materials_of_one_name_and_two_files_are_warned_of(tmp_path):
    one, other = (textured(tmp_path / f"{name}.obj", f"{name}.mtl") for name in "ab")
    whole = tf.union(one, other)
    for made in whole, tf.transformed(tf.simplify(whole, 0.1), np.eye(4)), [one, other]:
        with pytest.warns(UserWarning, match="same name for material paint;") as w:
            assert len(tf.write(tmp_path / "out.obj", made).warnings) == len(w) == 1
    assert not tf.write(tmp_path / "two.obj", tf.union(one, tf.read(tmp_path / "a.obj"))).warnings


def test_copies_of_attributes_are_changed_alone():
    one = tf.Attributes()
    one.set_face("red", np.arange(12))
    other = copy.copy(one)
    other.set_face("red", np.zeros(12))
    assert one.face["red"].tolist() == list(range(12)) and not other.face["red"].any()


def test_meshes_do_not_share_the_attributes_that_they_are_made_from():
    given = tf.Attributes()
    one, other = (tf.Mesh(CUBE.vertices, CUBE.faces, given) for _ in range(2))
    one.attributes.vertex["q"] = np.arange(8)
    assert list(one.attributes.vertex) == ["q"]
    assert not list(other.attributes.vertex) and not list(given.vertex)


def test_a_mesh_without_attributes_takes_columns():
    one = moved(CUBE, 0, 0, 0)
    one.attributes.vertex["q"] = np.arange(8)
    for same in one, pickle.loads(pickle.dumps(one)), tf.lay_flat(one).mesh:
        assert same.attributes.vertex["q"].tolist() == list(range(8))


def test_welded_polygons_keep_theirs(tmp_path):
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    lines = [f"{x} {y} {z} 0" for x in (0, 1) for y in (0, 1) for z in (0, 1)]
    rows = [f"4 {' '.join(map(str, quad))} {10 * i}" for i, quad in enumerate(quads)]
    # All of it twice: the second cube's corners become those of the first.
    rows += [f"4 {' '.join(str(v + 8) for v in quad)} {10 * i + 1}" for i, quad in enumerate(quads)]
    header = ["ply", "format ascii 1.0", "element vertex 16",
              *(f"property double {c}" for c in "xyz"),
              "property int tag", "element face 12", "property list uchar int vertex_indices",
              "property int material", "end_header"]
    (tmp_path / "cubes.ply").write_text("\n".join(header + 2 * lines + rows) + "\n")
    mesh = tf.read(tmp_path / "cubes.ply")
    assert len(mesh.faces) == 24 and len(mesh.attributes.face["material"]) == 12
    made = tf.weld(mesh, 0.1)
    run_tool("tf-weld", tmp_path / "cubes.ply", "-t", "0.1", "-o", tmp_path / "tool.ply")
    tf.write(tmp_path / "own.ply", made)
    assert (tmp_path / "own.ply").read_bytes() == (tmp_path / "tool.ply").read_bytes()
    assert len(made.vertices) == 8 and len(made.faces) == 24
    assert np.array_equal(made.mesh.attributes.face["material"],
                          mesh.attributes.face["material"])
    assert np.array_equal(made.mesh.attributes.face_of_triangle, mesh.attributes.face_of_triangle)
    assert np.array_equal(made.group_of_point[mesh.faces[made.face_source]], made.faces)
    with pytest.raises(ValueError, match="face_of_triangle is for 24 faces; there are 12"):
        tf.weld(tf.Mesh(CUBE.vertices, CUBE.faces, mesh.attributes), 0.1)
    with pytest.raises((ValueError, tf.FileError), match="faces"):
        tf.write(tmp_path / "wrong.ply", tf.Mesh(CUBE.vertices, CUBE.faces, mesh.attributes))
