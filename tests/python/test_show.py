"""Pictures and pages of meshes."""

import html
import json
import os
import re
import struct
import subprocess
import sys
import zlib

import numpy as np
import pytest

import treeform as tf
from support import CUBE, SHEET, SPHERES, box, moved, run_tool, sphere


def pixels(png):
    """(height, width, 3) of a PNG as the library writes it."""
    assert png[:8] == b"\x89PNG\r\n\x1a\n"
    width, height = struct.unpack(">II", png[16:24])
    at, data = 8, b""
    while at < len(png):
        size, = struct.unpack(">I", png[at:at + 4])
        if png[at + 4:at + 8] == b"IDAT":
            data += png[at + 8:at + 8 + size]
        at += 12 + size
    rows = np.frombuffer(zlib.decompress(data), np.uint8).reshape(height, 3 * width + 1)
    return rows[:, 1:].reshape(height, width, 3).astype(int)


def red(picture):
    """Pixels of findings, in the picture alone."""
    r, g, b = np.moveaxis(pixels(picture)[:180], 2, 0)
    return int(((r > g + 40) & (r > b + 40)).sum())


def scene_of(page):
    return json.loads(re.search(r'id="scene">(.*?)</script>', page, re.DOTALL).group(1))


def small(*meshes, **look):
    return tf.plot(*meshes, size=(200, 200), **look)


def test_a_picture_shows_the_mesh():
    picture = tf.plot(CUBE)
    seen = pixels(picture)
    assert seen.shape == (600, 800, 3) and repr(picture) == "Picture(800 x 600)"
    assert (seen != 255).any(axis=2).sum() > 100_000
    assert picture._repr_png_() == bytes(picture)


def test_a_path_gets_the_same_bytes(tmp_path):
    picture = small(CUBE, path=tmp_path / "cube.png")
    assert (tmp_path / "cube.png").read_bytes() == picture
    with pytest.raises(OSError):
        small(CUBE, path=tmp_path / "no" / "cube.png")


def test_a_file_appears_whole_or_stays_as_it_was(tmp_path):
    path = tmp_path / "cube.png"
    program = f"""
import resource, treeform as tf
cube = tf.read("data/cube.stl")
resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))
for work in (lambda: tf.plot(cube, path={str(path)!r}), lambda: cube.show().write({str(path)!r})):
    try:
        work()
    except OSError:
        print("full")
"""
    for there in ("", "mine"):
        path.write_text(there) if there else None
        done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
        assert done.stdout == "full\nfull\n", done.stderr
        assert [p.read_text() for p in tmp_path.iterdir()] == ([there] if there else [])
    small(CUBE, path=path)
    assert path.read_bytes() == small(CUBE)
    small(CUBE, path="/dev/null")
    assert not os.path.isfile("/dev/null")


def test_views_are_of_different_sides_and_stand_side_by_side():
    wedge = tf.Mesh([[0, 0, 0], [3, 0, 0], [0, 2, 0], [0, 0, 1]],
                    [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])
    views = ("iso", "top", "bottom", "front", "back", "left", "right")
    assert len({small(wedge, view=view) for view in views}) == 7
    assert small(wedge, view="all") == small(wedge, view=["iso", "top", "front", "right"])
    assert small(wedge, view="front", y_is_up=True) != small(wedge, view="front")


def test_marked_faces_are_red_even_behind_others():
    inner = box((-0.2, -0.2, -0.2), (0.2, 0.2, 0.2))
    assert red(small(CUBE)) == 0
    assert red(small(CUBE, marked=range(12))) > 5000
    pairs = tf.self_intersections(SPHERES).pairs
    assert red(small(SPHERES, marked=pairs)) > 100
    outer = moved(box((-1, -1, -1), (1, 1, 1)), 0, 0, 0)
    faint = pixels(small(inner, outer, marked=range(12)))[60:140, 60:140]
    assert (faint[..., 0] > faint[..., 2] + 8).sum() > 50  # through the box around it


def test_values_have_the_colors_of_the_scale():
    ball = sphere()
    plain, valued = small(ball, view="front"), small(ball, view="front", values=ball.vertices[:, 2])
    seen = pixels(valued)
    assert plain != valued
    assert seen[175, 100, 0] > 0 and seen[30, 100, 0] > seen[30, 100, 2] + 60  # red on top
    assert seen[165, 100, 2] > seen[165, 100, 0] + 40  # blue below: zero is white
    same = small(ball, view="front", values=ball.vertices[:, 2], limits=(-1, 1))
    assert same == valued
    nothing = np.full(len(ball.vertices), np.nan)
    assert (pixels(small(ball, values=nothing)) == pixels(small(ball))).all()


def test_clouds_and_several_meshes():
    points = np.random.default_rng(1).random((500, 3))
    assert (pixels(small(points)) != 255).any(axis=2).sum() > 1000
    assert (pixels(small(points, values=points[:, 0])) != pixels(small(points))).any()
    page = tf.show(CUBE, moved(SPHERES, 3, 0, 0), points, names=["a", "<b>", "c"],
                   colors=["#010203", "#040506", "#070809"]).html
    classes = scene_of(page)["classes"]
    assert [(c["name"], c["color"]) for c in classes][:3] == [("a", "#010203"), ("<b>", "#040506"),
                                                             ("c", "#070809")]
    many = scene_of(tf.show(*[moved(CUBE, 2 * i, 0, 0) for i in range(300)]).html)
    assert len(many["classes"]) == 201 and len(many["meshes"]) == 300


def test_whatever_is_a_mesh_or_has_one():
    assert small((CUBE.vertices, CUBE.faces)) == small(CUBE)
    assert small(tf.union(CUBE)) == small(tf.union(CUBE).mesh)
    assert small(CUBE - moved(CUBE, 0.5, 0.5, 0.5)) != small(CUBE)


def test_a_view_is_one_page_in_a_frame_of_its_own(tmp_path):
    view = CUBE.show(title="</script><b>")
    frame = view._repr_html_()
    assert frame.startswith('<iframe sandbox="allow-scripts" ') and frame.endswith("</iframe>")
    assert html.unescape(re.search(r'srcdoc="([^"]*)"', frame).group(1)) == view.html
    assert frame.count("<") == 2 and frame.count('"') == 6
    assert "http" not in view.html.replace("http-equiv", "") and "</script><b>" not in view.html
    assert scene_of(view.html)["meshes"][0]["faces"] == 12
    assert view._repr_png_() == tf.plot(CUBE, title="</script><b>")
    view.write(tmp_path / "cube.html")
    assert (tmp_path / "cube.html").read_text() == view.html
    assert repr(view) == "View(12 faces; a notebook shows it, write(path) makes a page)"
    assert tf.show(CUBE).html == CUBE.show().html
    assert len(scene_of(CUBE.show(SHEET).html)["meshes"]) == 2


def test_faces_keep_their_numbers_and_those_without_a_place_are_left_out():
    points = np.vstack([CUBE.vertices, [[np.nan, 0, 0], [np.inf, 0, 0]]])
    faces = np.vstack([[[0, 1, 8], [9, 1, 2]], CUBE.faces])
    page = tf.show((points, faces), marked=[0, 5])
    scene = scene_of(page.html)
    assert scene["meshes"][0]["faces"] == 12
    assert small((points, faces)) == small(CUBE)
    assert red(small((points, faces), marked=[0, 1])) == 0
    assert red(small((points, faces), marked=range(14))) == red(small(CUBE, marked=range(12)))


def test_nothing_is_a_white_picture():
    for nothing in (tf.Mesh(np.empty((0, 3))), np.empty((0, 3)), np.full((3, 3), np.nan),
                    (np.full((3, 3), np.inf), [[0, 1, 2]])):
        assert (pixels(small(nothing)) == 255).all()
        assert scene_of(tf.show(nothing).html)["low"] == [0, 0, 0]
    assert (pixels(small([[1e308, 0, 0], [-1e308, 0, 0], [0, 1e308, 0]])) != 255).any()


@pytest.mark.parametrize("look, words", [
    ({"view": "above"}, "view: expected one of iso, top"), ({"view": []}, "view: expected 1 to 16"),
    ({"size": (0, 9)}, "size: a side has 16 to"), ({"size": (99999, 99)}, "size"),
    ({"names": ["a", "b"]}, "names: 2 of 1 meshes"), ({"colors": ["red"]}, "colors: 'red' is no"),
    ({"marked": [12]}, "marked: there is no face 12 of 12"), ({"marked": [0.5]}, "marked"),
    ({"values": [1.0]}, r"values: the shape is \(1,\)"), ({"limits": (1, 0)}, "limits: 1"),
    ({"limits": (0, float("nan"))}, "limits")])
def test_what_makes_no_sense_is_said(look, words):
    with pytest.raises(ValueError, match=words):
        tf.plot(CUBE, **look)
    with pytest.raises(ValueError, match="faces: face 0 has the vertex 3 of 3"):
        tf.plot((SHEET.vertices, [[0, 1, 3]]))
    with pytest.raises(ValueError, match="meshes"):
        tf.plot()


def test_threads_change_no_byte_and_the_tool_draws_the_same_surface(tmp_path):
    ball = sphere(4)
    with tf.threads(1):
        alone = tf.plot(ball, values=ball.vertices[:, 0], view="all")
    assert alone == tf.plot(ball, values=ball.vertices[:, 0], view="all")
    run_tool("tf-selfintersect", "data/sphere.ply", "--png", tmp_path / "p.png", "--png-size",
             "300x200")
    ours = pixels(tf.plot(tf.read("data/sphere.ply"), size=(300, 200)))
    theirs = pixels((tmp_path / "p.png").read_bytes())
    assert ((ours != 255).any(axis=2) == (theirs != 255).any(axis=2)).mean() > 0.999


def test_it_needs_no_other_package():
    assert not {"PIL", "matplotlib", "IPython"} & {name.split(".")[0] for name in sys.modules}
