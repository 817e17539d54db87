"""Robots from URDF files."""

from __future__ import annotations

# made of uses:
from dataclasses import dataclass
from typing import Iterable, Mapping, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from . import _arrays, _core
from ._arrays import Floats, Ids, path_of
from ._files import Path
from ._mesh import Mesh
from ._progress import Progress
from ._results import Result, tuple_repr

__all__ = ["Joint", "Robot", "read_urdf"]
# end


# made of headers:
#   Joint
class Joint(NamedTuple):
    """A joint of two links.

    name: Name in the file.
    kind: 'fixed', 'revolute', 'continuous' or 'prismatic'.
    parent: Name of the parent link.
    child: Name of the child link.
    limits: Least and greatest value, in radians or meters; None without limits.
    """

    name: str
    kind: str
    parent: str
    child: str
    limits: tuple[float, float] | None

    def __repr__(self) -> str:
        return tuple_repr(self)
# end


# made of headers:
#   Robot
@dataclass(frozen=True, repr=False)
class Robot(Result):
    """Links and joints, with a mesh for each link that has any.

    `clash(robot.parts, ...)` and `check_poses(robot.parts, robot.poses(values),
    ignored=robot.adjacent)` take its parts.

    name: Name in the file.
    links: Names of the links, in the order of the file.
    joints: Parents before their children.
    parts: One mesh for each link with faces, in the frame of the link.
    link_of_part: (N,) the link of each part.
    adjacent: (n, 2) pairs of parts connected by a joint, directly or through links without a mesh;
        the lower number first. They usually touch, so pass them as `ignored`.
    approximated: Cylinders and spheres replaced by triangles, a sentence each.
    skipped: Geometry that is not read, a sentence each.
    """

    name: str
    links: list[str]
    joints: list[Joint]
    parts: list[Mesh]
    link_of_part: Ids
    adjacent: Ids
    approximated: list[str]
    skipped: list[str]
    _data: _core.RobotData
# end

    def poses(self, values: Mapping[str, ArrayLike] | None = None) -> Floats:
        """(N, 4, 4) for each part, the transform from its own frame to the frame of the robot. If
        the values of joints are arrays (P,), the poses are (P, N, 4, 4).

        values: the positions of joints by name, in radians or meters. Other joints are at 0, or
        follow the joint that they mimic. Limits are not checked.

        Raises ValueError for an unknown or fixed joint, or a value that is not finite.
        """
        given = dict(values or {})
        columns = np.broadcast_arrays(*[_arrays.floats(v, name) for name, v in given.items()])
        shape = columns[0].shape if columns else ()
        if len(shape) > 1:
            raise ValueError(f"values: the shape is {shape}, not (P,)")
        count = shape[0] if shape else 1
        table = np.empty((count, len(given)))
        for j, column in enumerate(columns):
            table[:, j] = column
        made = self._data.poses(list(given), table)
        return made if shape else np.asarray(made[0])


# made of headers:
#   read_urdf
def read_urdf(path: Path, *, package_folders: Iterable[Path] = (), visual: bool = False,
              progress: Progress = None) -> Robot:
    """Reads a robot from a URDF file, with its meshes. Joints are fixed, revolute, continuous or
    prismatic. Boxes are exact. Cylinders and spheres become triangles around them, at most 0.13 %
    of the radius too large, so that no collision is missed. Faces that are not finite are dropped,
    and equal vertices merged.

    path: the path of the file.
    package_folders: where to look for packages: `package://name/rest` is FOLDER/name/rest or
        FOLDER/rest, otherwise relative to the folder of the file or one above it.
    visual: use the visual meshes instead of the collision meshes.

    Raises FileError naming the path and the reason: not XML, no robot, an unsupported joint, a link
    that is missing, has two parents or is its own ancestor, repeated names, invalid numbers, sizes
    that are not positive, a missing mesh file.

    >>> import pathlib, tempfile, treeform
    >>> mesh = f'<mesh filename="{pathlib.Path("data/cube.stl").resolve()}"/>'
    >>> shape = f'<collision><geometry>{mesh}</geometry></collision>'
    >>> text = (f'<robot name="r"><link name="a">{shape}</link><link name="b">{shape}</link>'
    ...         '<joint name="j" type="prismatic"><parent link="a"/><child link="b"/>'
    ...         '<axis xyz="1 0 0"/><limit lower="0" upper="3"/></joint></robot>')
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     _ = pathlib.Path(folder, "r.urdf").write_text(text)
    ...     robot = treeform.read_urdf(folder + "/r.urdf")
    >>> treeform.check_poses(robot.parts, robot.poses({"j": [0.5, 2.0]})).in_collision.tolist()
    [True, False]
    """
    return _core.read_urdf(path_of(path), _arrays.paths(package_folders, "package_folders"),
                           _arrays.flag(visual, "visual"), progress=progress)
# end
