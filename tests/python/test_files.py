"""Reading and writing: numbers of the file, attributes, what must not be rounded."""

import errno
import io
import os
import pickle
import warnings

import numpy as np
import pytest

import treeform as tf
from support import CUBE, MODELS, box, model, needs_models, same_mesh, truth

FORMATS = ["stl", "obj", "ply", "off", "3mf", "glb"]


@pytest.mark.parametrize("format", FORMATS)
def test_what_is_written_is_read(tmp_path, format):
    path = tmp_path / f"cube.{format}"
    written = tf.write(path, CUBE)
    assert written.max_displacement == 0
    again = tf.read(path)
    assert tf.check_operand(again) and again.volume == CUBE.volume
    assert len(again.vertices) == 8 and len(again.faces) == 12


def test_a_truncated_file_is_read_with_a_warning(tmp_path):
    tf.write(path := tmp_path / "cut.stl", CUBE)
    content = path.read_bytes()[:84 + 10 * 50]
    path.write_bytes(content)
    text = "announces 12 triangles, the file has 10"
    for given, name in ((path, "cut.stl"), (io.BytesIO(content), "bytes")):
        with pytest.warns(UserWarning, match=f"{name}: .*{text}") as w:
            mesh = tf.read(given, "stl")
        assert [one.filename for one in w] == [__file__] and len(mesh.faces) == 10
        assert len(mesh.attributes.warnings) == 1 and ", warnings=1)" in repr(mesh.attributes)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert ", warnings=0)" in repr(tf.read("data/cube.stl").attributes)


def test_doubles_survive(tmp_path):
    points = np.random.default_rng(1).standard_normal((300, 3)) * 10.0 ** np.arange(-150, 150)[:,
                                                                                               None]
    mesh = tf.Mesh(points, np.arange(300).reshape(-1, 3))
    for name in ("m.ply", "m.obj", "m.off", "m.3mf"):
        tf.write(tmp_path / name, mesh, precision="float64")
        assert same_mesh(tf.read(tmp_path / name, join=False), mesh), name


def test_corners_of_an_stl_are_joined_and_faces_keep_their_numbers(tmp_path):
    tf.write(tmp_path / "m.stl", CUBE)
    joined, soup = tf.read(tmp_path / "m.stl"), tf.read(tmp_path / "m.stl", join=False)
    assert len(soup.vertices) == 36
    assert np.array_equal(joined.vertices[joined.faces], soup.vertices[soup.faces])


def test_attributes_travel(tmp_path):
    extra = tf.Attributes()
    quality = np.arange(8, dtype=np.float32)
    extra.set_vertex("quality", quality)
    extra.set_face("label", np.arange(12, dtype=np.int32))
    assert list(extra.vertex) == ["quality"]
    extra.vertex["weight"] = list(range(8))
    extra.face["label"] = extra.face["label"] + 1
    with pytest.raises(ValueError, match="read-only"):
        extra.face["label"][0] = 5
    with pytest.raises(ValueError, match="weight: 3 values for 8 rows"):
        extra.vertex["weight"] = [1, 2, 3]
    with pytest.raises(TypeError, match="drop"):
        del extra.vertex["weight"]
    assert extra.vertex["weight"].tolist() == list(range(8)) and len(extra.vertex) == 2
    kept = extra.vertex
    kept["weight"] = np.ones(8)
    assert kept["weight"].all() and extra.vertex["weight"].dtype == np.float64
    mesh = tf.Mesh(CUBE.vertices, CUBE.faces, extra)
    tf.write(tmp_path / "m.ply", mesh)
    again = tf.read(tmp_path / "m.ply")
    assert np.array_equal(again.attributes.vertex["quality"], quality)
    assert again.attributes.vertex["quality"].dtype == np.float32
    assert np.array_equal(again.attributes.face["label"], np.arange(12) + 1)
    assert again.attributes.vertex["weight"].all()
    assert again.attributes.format == "ply-binary-le"
    with pytest.raises(ValueError, match="label: 3 values for 12 rows"):
        extra.set_face("label", [1, 2, 3])


def test_corners_of_a_glb_that_are_joined_keep_the_attributes_of_the_first(tmp_path):
    vertices = CUBE.vertices[CUBE.faces].reshape(-1, 3)
    extra = tf.Attributes()
    for name, value in zip(("nx", "ny", "nz"), (0, 0, 1)):
        extra.set_vertex(name, np.full(36, value, dtype=np.float32))
    extra.set_vertex("s", np.arange(36, dtype=np.float32))
    extra.set_vertex("t", np.zeros(36, dtype=np.float32))
    tf.write(tmp_path / "m.glb", tf.Mesh(vertices, np.arange(36).reshape(-1, 3), extra))
    joined, soup = tf.read(tmp_path / "m.glb"), tf.read(tmp_path / "m.glb", join=False)
    assert len(joined.vertices) == 8 and tf.check_operand(joined)
    assert joined.attributes.vertex["s"][0] == 0 and len(joined.attributes.vertex["nz"]) == 8
    assert len(soup.vertices) == 36 and soup.attributes.vertex["s"][35] == 35


def test_names_of_parts_and_polygons_travel(tmp_path):
    (tmp_path / "m.obj").write_text("o first\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n")
    mesh = tf.read(tmp_path / "m.obj")
    assert len(mesh.faces) == 2
    assert mesh.attributes.face_of_triangle.tolist() == [0, 0]
    assert mesh.attributes.parts[0][0] == "first"
    tf.write(tmp_path / "again.obj", mesh)
    text = (tmp_path / "again.obj").read_text()
    assert "o first" in text and "f 1 2 3 4" in text


def test_certified_coordinates_are_not_rounded_unless_told(tmp_path):
    third = tf.Mesh(CUBE.vertices / 3 + 0.9, CUBE.faces)
    made = tf.union(CUBE, third)
    told = 'the result with precision="float32", or write a format that.*; or set round=True$'
    for mesh in made, tf.repair(made):
        with pytest.raises(tf.FileError, match=told):
            tf.write(tmp_path / "m.stl", mesh)
    with pytest.raises(tf.FileError, match="round"):
        tf.write(tmp_path / "m.stl", CUBE | third)
    assert not (tmp_path / "m.stl").exists()
    assert tf.write(tmp_path / "m.stl", made, round=True).max_displacement > 0
    single = tf.union(CUBE, third, precision="float32")
    assert tf.write(tmp_path / "m.stl", single).max_displacement == 0
    tf.write(tmp_path / "m.ply", made)
    assert same_mesh(tf.read(tmp_path / "m.ply"), made.mesh)


def test_certified_coordinates_are_doubles_in_3mf_only_if_asked_for(tmp_path):
    made = tf.union(CUBE, (CUBE.vertices / 3 + 0.9, CUBE.faces))
    for mesh in (made, [made], {"a": made}):
        with pytest.raises(tf.FileError, match="or write with precision float64; or set round"):
            tf.write(tmp_path / "m.3mf", mesh)
        assert tf.write(tmp_path / "m.3mf", mesh, precision="float64").precision == "float64"
        assert same_mesh(tf.read(tmp_path / "m.3mf"), made.mesh)
        assert tf.write(tmp_path / "m.3mf", mesh, round=True).precision == "float32"
        (tmp_path / "m.3mf").unlink()


def test_what_cannot_be_read_is_an_os_error_that_names_it(tmp_path):
    with pytest.raises(OSError, match="no_such.stl"):
        tf.read(tmp_path / "no_such.stl")
    (tmp_path / "bad.obj").write_text("v 0 0 0\nf 0 1 2\n")
    with pytest.raises(tf.FileError, match="bad.obj:2"):
        tf.read(tmp_path / "bad.obj")
    with pytest.raises(tf.FileError, match="nowhere"):
        tf.write(tmp_path / "nowhere" / "m.ply", CUBE)
    with pytest.raises(tf.FileError):
        tf.write(tmp_path / "m.nothing", CUBE)
    assert os.listdir(tmp_path) == ["bad.obj"]


def test_what_the_system_refuses_is_what_python_raises(tmp_path):
    (tmp_path / "no").write_text("")
    gone, folder, below = tmp_path / "gone.ply", tmp_path, tmp_path / "no" / "m.ply"
    for verb, path, kind in (
            (tf.read, gone, FileNotFoundError), (tf.read, folder, IsADirectoryError),
            (tf.read, below, NotADirectoryError),
            (lambda p: tf.write(p, CUBE), tmp_path / "nowhere" / "m.ply", FileNotFoundError),
            (lambda p: tf.write(p, CUBE, format="ply"), folder, IsADirectoryError),
            (lambda p: tf.write(p, CUBE), below, NotADirectoryError),
            (lambda p: tf.weld_stream(p, tmp_path / "o.ply", 1), gone, FileNotFoundError),
            (tf.self_intersections_of_file, gone, FileNotFoundError),
            (tf.read_urdf, tmp_path / "gone.urdf", FileNotFoundError)):
        with pytest.raises(kind) as caught:
            verb(path)
        error = caught.value
        assert isinstance(error, tf.FileError) and error.filename == str(path)
        assert error.errno == kind_of(kind) and error.strerror == os.strerror(error.errno)
        assert str(path) in str(error)
        again = pickle.loads(pickle.dumps(error))
        assert type(again) is type(error) and str(again) == str(error)
        assert (again.errno, again.filename) == (error.errno, error.filename)
    (tmp_path / "bad.off").write_text("OFF 1")
    with pytest.raises(tf.FileError, match="bad.off") as caught:
        tf.read(tmp_path / "bad.off")
    assert caught.value.errno is None and not isinstance(caught.value, FileNotFoundError)
    assert str(pickle.loads(pickle.dumps(caught.value))) == str(caught.value)


def kind_of(kind):
    return {FileNotFoundError: errno.ENOENT, IsADirectoryError: errno.EISDIR,
            NotADirectoryError: errno.ENOTDIR, PermissionError: errno.EACCES}[kind]


@pytest.mark.skipif(os.geteuid() == 0, reason="root may do anything")
def test_what_may_not_be_opened_is_a_permission_error(tmp_path):
    path = tmp_path / "m.ply"
    tf.write(path, CUBE)
    path.chmod(0)
    with pytest.raises(PermissionError) as caught:
        tf.read(path)
    assert caught.value.errno == errno.EACCES


@pytest.mark.parametrize("format", FORMATS)
def test_files_that_are_open_are_read_and_written(tmp_path, format):
    memory = io.BytesIO()
    written = tf.write(memory, CUBE, format=format)
    tf.write(tmp_path / f"m.{format}", CUBE)
    assert memory.getvalue() == (tmp_path / f"m.{format}").read_bytes()
    assert written.format.startswith(format)
    memory.seek(0)
    assert tf.read(memory, format=format).volume == 1
    with open(tmp_path / f"o.{format}", "wb") as file:
        tf.write(file, CUBE)  # its name says the format
    with open(tmp_path / f"o.{format}", "rb") as file:
        assert tf.read(file).volume == 1


def test_what_is_no_file_for_bytes_is_refused(tmp_path):
    with pytest.raises(ValueError, match="format: required for a file object"):
        tf.write(io.BytesIO(), CUBE)
    with pytest.raises(ValueError, match="open for text"):
        tf.read(io.StringIO("OFF"), format="off")
    for wrong in (3, None, object()):
        with pytest.raises(ValueError, match="path: expected a path or a file"):
            tf.read(wrong)
        with pytest.raises(ValueError, match="path: expected a path or a file"):
            tf.write(wrong, CUBE, format="stl")
    with pytest.raises(tf.FileError):
        tf.read(io.BytesIO(b"OFF 1"), format="off")
    memory = io.BytesIO()
    with pytest.raises(tf.FileError, match="round=True"):
        tf.write(memory, tf.union(CUBE, (CUBE.vertices / 3 + 0.9, CUBE.faces)), format="stl")
    assert memory.getvalue() == b""


def test_several_meshes_are_parts(tmp_path):
    lid = box([0, 0, 2], [1, 1, 3])
    for format in ("3mf", "obj"):
        path = tmp_path / f"m.{format}"
        assert tf.write(path, [CUBE, lid, tf.union(lid)]).warnings == []
        assert [part[0] for part in tf.read(path).attributes.parts] == ["1", "2", "3"]
        tf.write(path, {"base": CUBE, "lid": lid})
        again = tf.read(path)
        assert [(p[0], p[3]) for p in again.attributes.parts] == [("base", 0), ("lid", 12)]
        assert again.volume == 2 and len(again.faces) == 24
        parts = tf.file_parts(again)
        assert list(parts) == ["base", "lid"] and parts["lid"].bounds[0].tolist() == [0, 0, 2]
    assert [len(one.faces) for one in tf.file_parts((CUBE.vertices, CUBE.faces)).values()] == [12]
    assert "not written to PLY" in tf.write(tmp_path / "m.ply",
                                            (m for m in (CUBE, lid))).warnings[0]
    assert len(tf.read(tmp_path / "m.ply").faces) == 24
    with pytest.raises(ValueError, match="mesh: the list is empty"):
        tf.write(tmp_path / "m.3mf", [])
    with pytest.raises(ValueError, match="mesh"):
        tf.write(tmp_path / "m.3mf", [CUBE, 3])


def test_what_is_certified_and_has_columns_is_not_rounded_either(tmp_path):
    extra = tf.Attributes()
    extra.set_face("label", np.arange(12))
    made = tf.union(tf.Mesh(CUBE.vertices, CUBE.faces, extra),
                    (CUBE.vertices / 3 + 0.9, CUBE.faces))
    assert made.mesh.attributes is not None
    for mesh in (made, [made, CUBE]):
        with pytest.raises(tf.FileError, match="round=True"):
            tf.write(tmp_path / "m.stl", mesh)
        assert os.listdir(tmp_path) == []
    assert tf.write(tmp_path / "m.stl", made, round=True).max_displacement > 0


def test_what_is_left_out_is_warned_of(tmp_path):
    extra = tf.Attributes()
    extra.vertex["heat"] = np.arange(8, dtype=np.float32)
    hot = tf.Mesh(CUBE.vertices, CUBE.faces, extra)
    for path, name in ((tmp_path / "m.stl", "m.stl"), (io.BytesIO(), "bytes")):
        with pytest.warns(UserWarning, match=f"{name}: not written to STL: heat of points") as w:
            written = tf.write(path, hot, "stl")
        assert [one.filename for one in w] == [__file__] and len(written.warnings) == 1
    with pytest.warns(UserWarning, match="m.stl: parts were merged"):
        tf.write(tmp_path / "m.stl", [CUBE, CUBE])
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        tf.write(tmp_path / "m.ply", hot)


def test_a_cloud_has_no_faces(tmp_path):
    points = np.random.default_rng(2).random((50, 3))
    for given in (points, []), points:
        tf.write(tmp_path / "c.xyz", given)
        cloud = tf.read(tmp_path / "c.xyz")
        assert np.array_equal(cloud.vertices, points) and cloud.faces.shape == (0, 3)


@needs_models
def test_every_file_has_its_triangles():
    for row in truth():
        mesh = tf.read(model(row["file"]))
        assert len(mesh.faces) == int(row["triangles"]), row["file"]


@needs_models
def test_hostile_files_are_read_or_refused():
    folder = os.path.join(MODELS, "hostile")
    refused = 0
    for name in sorted(os.listdir(folder)):
        try:
            tf.read(os.path.join(folder, name))
        except tf.FileError as error:
            refused += 1
            assert name in str(error)
    assert refused > 20


def test_columns_are_what_they_are_said_to_be(tmp_path):
    path = tmp_path / "t.csv"
    path.write_text("id;E;N;H\n7;1;2;3\n8;4;nan;6\n9;7;8;9\n")
    cloud = tf.read(path, columns={"x": "E", "y": "N", "z": 4}, drop_non_finite=True)
    assert cloud.vertices.tolist() == [[1, 2, 3], [7, 8, 9]]
    tf.write(tmp_path / "t.las", cloud, rename={"id": "number"}, las_scale=(0.5, 0.5, 0.5),
             las_offset=(1, 2, 3))
    assert "number" in tf.read(tmp_path / "t.las").attributes.vertex
    tf.write(tmp_path / "t.ply", cloud, drop=["id"])
    assert "id" not in tf.read(tmp_path / "t.ply").attributes.vertex
    with pytest.raises(ValueError, match="none"):
        tf.write(tmp_path / "t.ply", cloud, drop=["none"])
    path.write_text(f"x,y,z,gps_time,nx,ny,nz\n1,2,3,{2**60 + 1},0,0,1\n4,5,6,{2**60},0,0,1\n")
    cloud = tf.read(path)
    done = tf.write(tmp_path / "big.las", cloud, drop=["normal"])
    assert any("1 whole number of gps_time rounded" in text for text in done.warnings)
    assert "nx" not in tf.read(tmp_path / "big.las").attributes.vertex
