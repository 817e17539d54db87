"""Sections of meshes by planes."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Any, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arrays, _core
from ._arrays import NONE, Floats, Ids
from ._mesh import MeshLike, held
from ._progress import Progress
from ._results import Result

__all__ = ["Section", "SectionLoop", "layer_heights", "section"]


@dataclass(frozen=True, repr=False)
class SectionLoop(Result):
    """A closed polygon, or, where the mesh ends, an open polyline.

    points: (n, 2) in the frame of the section; the first is not repeated.
    faces: (n,) the face that the side from each point to the next lies in.
    closed: Whether it is a polygon.
    oriented: The faces along it agree: what is inside is to the left, seen from above the plane.
    parent: The innermost loop of the layer that is around it, by number; None for none.
    depth: How many loops are around it: of a solid, holes have an odd one.
    area: Positive where it runs counter-clockwise; 0 for open ones.
    length: Of its sides.
    """

    points: Floats
    faces: Ids
    closed: bool
    oriented: bool
    parent: int | None
    depth: int
    area: float
    length: float


@dataclass(frozen=True, repr=False)
class Section(Result):
    """What is in parallel planes: layers, in the order of their heights as given. Layer i has the loops
    `loops(i)`.

    heights: (K,) of the layers.
    origins: (K, 3) a point of each plane.
    areas: (K,) the area inside; of a solid, exact but for rounding.
    lengths: (K,) of all loops.
    open_counts: (K,) how many polylines are open; none of a solid.
    frame: (3, 3) the axes x and y of `points`, and the normal, each of length 1.
    points: (P, 2) of all loops, one after the other: (x . p, y . p) of p in space.
    faces: (P,) the face that the side from each point on lies in.
    """

    heights: Floats
    origins: Floats
    areas: Floats
    lengths: Floats
    open_counts: Ids
    frame: Floats
    points: Floats
    faces: Ids
    _data: _core.SectionData
    _loops: dict[str, NDArray[Any]]

    def __repr__(self) -> str:
        return f"Section({len(self.heights)} layers, {len(self._loops['closed'])} loops)"

    def __len__(self) -> int:
        return len(self.heights)

    def loops(self, layer: int = 0) -> list[SectionLoop]:
        """The loops of a layer.

        >>> import treeform
        >>> [loop.area for loop in treeform.section(treeform.read("data/cube.stl"), at=(0, 0, 0.5)).loops()]
        [1.0]
        """
        of = self._loops
        count = len(of["closed"])
        layer = range(len(self))[layer]
        first = int(of["first_loop"][layer])
        end = int(of["first_loop"][layer + 1]) if layer + 1 < len(self) else count
        found = []
        for i in range(first, end):
            last = int(of["first_point"][i + 1]) if i + 1 < count else len(self.points)
            points = slice(int(of["first_point"][i]), last)
            parent = int(of["parent"][i])
            found.append(SectionLoop(
                self.points[points], self.faces[points], bool(of["closed"][i]),
                bool(of["oriented"][i]), None if parent == NONE else parent - first,
                int(of["depth"][i]), float(of["loop_areas"][i]), float(of["loop_lengths"][i])))
        return found

    def in_space(self, layer: int, points: ArrayLike) -> Floats:
        """(n, 3) points (n, 2) of a layer in space, rounded."""
        x, y, normal = self.frame
        flat = _arrays.rows(points, 2, "points")
        up: Floats = normal * (normal @ self.origins[layer])
        made: Floats = flat[:, :1] * x + flat[:, 1:] * y + up
        return made

    def write(self, path: Union[str, os.PathLike[str]], *, format: str = "",
              progress: Progress = None) -> None:
        """Writes all layers as SVG, DXF, OBJ (lines in space) or JSON, by the extension or `format`."""
        _core.write_section(os.fspath(path), self._data, format, progress=progress)


def section(mesh: MeshLike, normal: ArrayLike = (0, 0, 1), at: ArrayLike = (0, 0, 0), *,
            heights: ArrayLike | None = None, progress: Progress = None) -> Section:
    """The loops in which planes meet a mesh: closed where the mesh is, outer ones counter-clockwise,
    holes clockwise, nested. What makes a loop, and what lies in it, is decided exactly.

    normal, at: (3,) of the plane. A vertex in a plane counts as above it: the section is that just
    below.
    heights: (K,) of planes above that one, along its normal at length 1: thousands take little longer
    than one. None is the plane itself.

    >>> import treeform
    >>> cube = treeform.read("data/cube.stl")
    >>> layers = treeform.section(cube, heights=treeform.layer_heights(cube, 0.25))
    >>> layers.areas.tolist(), layers.lengths.tolist()
    ([1.0, 1.0, 1.0, 1.0], [4.0, 4.0, 4.0, 4.0])
    """
    all_heights = np.zeros(1) if heights is None else np.atleast_1d(
        _arrays.floats(heights, "heights"))
    data, made = _core.section(held(mesh), _arrays.vector(at, "at"), _arrays.vector(normal, "normal"),
                               all_heights, progress=progress)
    kept = {name: made.pop(name) for name in ("first_loop", "first_point", "closed", "oriented",
                                              "parent", "depth", "loop_areas", "loop_lengths")}
    return Section(**made, _data=data, _loops=kept)


def layer_heights(mesh: MeshLike, thickness: float, normal: ArrayLike = (0, 0, 1),
                  at: ArrayLike = (0, 0, 0), *, progress: Progress = None) -> Floats:
    """(K,) heights for `section`: the middles of layers of this thickness, from the lowest vertex to the
    highest.

    >>> import treeform
    >>> treeform.layer_heights(treeform.read("data/cube.stl"), 0.5).tolist()
    [0.25, 0.75]
    """
    return _core.layer_heights(held(mesh), _arrays.vector(at, "at"),
                               _arrays.vector(normal, "normal"), thickness, progress=progress)
