"""Pictures of meshes, and interactive views."""

from __future__ import annotations

# made of uses:
import html
import os
import re
from typing import Any, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike

from . import _arrays, _core
from ._files import Path
from ._mesh import MeshLike, held_body

__all__ = ["Picture", "View", "plot", "show"]
# end

#: A mesh, or the points of a cloud.
_Shown = Union[MeshLike, ArrayLike]


class Picture(bytes):
    """The bytes of a PNG image. Notebooks display it."""

    def _repr_png_(self) -> bytes:
        return bytes(self)

    def __repr__(self) -> str:
        width, height = (int.from_bytes(self[at:at + 4], "big") for at in (16, 20))
        return f"Picture({width} x {height})"

    def __str__(self) -> str:
        return repr(self)


class View:
    """An interactive 3D view of meshes. Notebooks display it; `write` saves it as an HTML page."""

    def __init__(self, meshes: Sequence[_core.HeldMesh], look: dict[str, Any]) -> None:
        self._meshes = list(meshes)
        self._look = look

    @property
    def html(self) -> str:
        """The HTML page. It needs no network."""
        return _core.page(self._meshes, self._look)

    def write(self, path: Path) -> None:
        """Writes the page, for any browser. On an error, no incomplete file remains."""
        _put(path, self.html.encode())

    def _repr_html_(self) -> str:
        # The frame and the notebook cannot access each other.
        return ('<iframe sandbox="allow-scripts" style="width: 100%; height: 560px; border: 0" '
                f'srcdoc="{html.escape(self.html)}"></iframe>')

    def _repr_png_(self) -> bytes:
        """For viewers that do not run scripts."""
        return _core.picture(self._meshes, self._look, ["iso"], 800, 600)

    def __repr__(self) -> str:
        return f"View({self._look['verdict']}; a notebook shows it, write(path) makes a page)"


def plot(*meshes: _Shown, path: Path | None = None, view: str | Sequence[str] = "iso",
         size: tuple[int, int] = (800, 600), names: Sequence[str] = (),
         colors: Sequence[str] = (), marked: ArrayLike = (), values: ArrayLike | None = None,
         limits: tuple[float, float] | None = None, label: str = "value", title: str = "",
         y_is_up: bool = False) -> Picture:
    """A picture of meshes and clouds as a PNG. It needs no display, graphics card or browser.

    path: also write the PNG to this file, replacing an existing one.
    view: 'iso', 'top', 'bottom', 'front', 'back', 'left' or 'right'; or a list of these, side by
    side; or 'all': iso, top, front and right. All are parallel projections.
    size: width and height in pixels.
    names, colors: one for each mesh; colors are "#rrggbb".
    marked: numbers of faces of the first mesh, as an array of any shape, such as pairs. These faces
    are red, and visible through the faces in front of them.
    values: (V,) a value for each vertex of the first mesh, shown by colors; NaN: no value.
    limits: the lowest and highest value of the colors; default: those of `values`. If 0 is between
    them, it is white.
    y_is_up: the y axis points up, instead of the z axis.

    Faces with a coordinate that is not finite are not drawn. The result does not depend on the
    number of threads.

    >>> import treeform
    >>> m = treeform.read("data/two_spheres.stl")
    >>> treeform.plot(m, marked=treeform.self_intersections(m).pairs)
    Picture(800 x 600)
    """
    held, look = _look_of(meshes, names, colors, marked, values, limits, label, title, y_is_up)
    width, height = (int(side) for side in size)
    low, high = _core.PICTURE_SIDES
    if not all(low <= side <= high for side in (width, height)):
        raise ValueError(f"size: a side has {low} to {high} pixels, not {size}")
    picture = Picture(_core.picture(held, look, _views(view), width, height))
    if path is not None:
        _put(path, picture)
    return picture


def show(*meshes: _Shown, names: Sequence[str] = (), colors: Sequence[str] = (),
         marked: ArrayLike = (), values: ArrayLike | None = None,
         limits: tuple[float, float] | None = None, label: str = "value", title: str = "",
         y_is_up: bool = False) -> View:
    """An interactive view of meshes and clouds, in a notebook or, written to a file, in any
    browser: they can be rotated, cut by a plane, and clicked. The arguments are those of `plot`. Of
    more than 200,000 faces that are not marked, only some are shown.

    >>> import treeform
    >>> treeform.show(treeform.read("data/cube.stl"))
    View(12 faces; a notebook shows it, write(path) makes a page)
    """
    return View(*_look_of(meshes, names, colors, marked, values, limits, label, title, y_is_up))


def _put(path: Path, data: bytes) -> None:
    """Writes a file. On an error, an existing file is not changed."""
    to = os.path.realpath(path)
    if os.path.exists(to) and not os.path.isfile(to):  # a pipe or a device
        with open(to, "wb") as special:
            special.write(data)
        return
    beside = f"{to}.unfinished-{os.getpid()}"
    try:
        with open(beside, "wb") as file:
            file.write(data)
        os.replace(beside, to)
    except BaseException:
        if os.path.exists(beside):
            os.remove(beside)
        raise


def _views(view: str | Sequence[str]) -> list[str]:
    views: list[str] = []
    for name in [view] if isinstance(view, str) else view:
        _arrays.one_of(name, "view", [*_core.VIEWS, "all"])
        views += ["iso", "top", "front", "right"] if name == "all" else [name]
    if not 1 <= len(views) <= 16:
        raise ValueError(f"view: expected 1 to 16 views, not {len(views)}")
    return views


def _look_of(meshes: Sequence[Any], names: Sequence[str], colors: Sequence[str], marked: ArrayLike,
             values: ArrayLike | None, limits: tuple[float, float] | None, label: str, title: str,
             y_is_up: bool) -> tuple[list[_core.HeldMesh], dict[str, Any]]:
    if not meshes:
        raise ValueError("meshes: expected at least one")
    held = [held_body(mesh) for mesh in meshes]
    for name, given in (("names", names), ("colors", colors)):
        if len(given) not in (0, len(held)):
            raise ValueError(f"{name}: {len(given)} of {len(held)} meshes")
    for color in colors:
        if not re.fullmatch("#[0-9a-fA-F]{6}", color):
            raise ValueError(f"colors: {color!r} is not of the form '#rrggbb'")
    known = None
    if values is not None:
        known, count = _arrays.floats(values, "values"), len(held[0].vertices)
        _arrays.shaped(known, known.shape == (count,), "values", f"({count},)")
        finite = known[np.isfinite(known)]
        if limits is None:
            limits = (float(finite.min()), float(finite.max())) if finite.size else (0.0, 1.0)
    low, high = limits or (0.0, 1.0)
    if not (np.isfinite(low) and np.isfinite(high) and low <= high):
        raise ValueError(f"limits: {low} to {high}")
    faces = sum(len(one.faces) for one in held)
    points = sum(len(one.vertices) for one in held if one.is_cloud)
    counts = [f"{n:,} {word}" for n, word in ((faces, "faces"), (points, "points")) if n]
    first = "#8fa3bf" if len(held) == 1 else None
    look = {"names": [str(name) for name in names] or [_name(i, held) for i in range(len(held))],
            "colors": [str(c) for c in colors] or ([first] if first else _core.colors(len(held))),
            "title": title, "verdict": ", ".join(counts) or "nothing", "y_is_up": bool(y_is_up),
            "marked": np.ravel(_arrays.ids(marked, "marked")), "values": known,
            "limits": (float(low), float(high)), "label": label}
    return held, look


def _name(i: int, held: Sequence[_core.HeldMesh]) -> str:
    word = "points" if held[i].is_cloud else "mesh"
    return word if len(held) == 1 else f"{word} {i}"
