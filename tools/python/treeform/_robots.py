"""Robots as URDF files describe them."""

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
    """A joint, which connects two links.

    name: As in the file.
    kind: 'fixed', 'revolute', 'continuous' or 'prismatic'.
    parent: Name of the parent link.
    child: Name of the child link.
    limits: Lowest and highest value, in radians or meters; None if unlimited.
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
    """The links and joints of a robot, with a mesh for each link that has geometry.

    Check it with `clash(robot.parts, ...)` or `check_poses(robot.parts, robot.poses(values),
    ignored=robot.adjacent)`.

    name: As in the file.
    links: Names of the links, in the order of the file.
    joints: The joints, parents before their children.
    parts: One mesh for each link that has geometry, in the frame of the link.
    link_of_part: (N,) the link of each part.
    adjacent: (n, 2) parts that are connected by a joint, the lower number first. These always
        touch.
    approximated: The cylinders and spheres that were approximated by triangles, a sentence each.
    skipped: Other geometry that is not a mesh and was skipped, a sentence each.
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
        """(N, 4, 4): where each part is, from its own frame to that of the robot; (P, N, 4, 4)
        where a value is an array (P,).

        values: of joints by name, radians or meters. Others are at 0, or follow the joint that they
        mimic. Limits are not looked at.

        Raises ValueError for a joint that is not there or fixed, or a value that is not finite.
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


def read_urdf(path: Path, *, package_folders: Iterable[Path] = (), visual: bool = False,
              progress: Progress = None) -> Robot:
    """The robot in a URDF file, with its meshes. Joints are fixed, revolute, continuous or
    prismatic. Boxes are exact; cylinders and spheres are triangles around them, up to 0.13 % of the
    radius too far out, so that no clash is missed.

    package_folders: where packages are: `package://name/rest` is FOLDER/name/rest or FOLDER/rest;
    else it is looked for in the file's folder and those above. visual: the meshes that are for
    show, not those for collisions. Faces that are not finite are left out, equal corners joined.

    Raises FileError naming the path and the reason.

    >>> import pathlib, tempfile, treeform
    >>> mesh = f'<mesh filename="{pathlib.Path("data/cube.stl").resolve()}"/>'
    >>> shape = f'<collision><geometry>{mesh}</geometry></collision>'
    >>> text = (f'<robot name="r"><link name="a">{shape}</link><link name="b">{shape}</link>'
    ...         '<joint name="j" type="prismatic"><parent link="a"/><child link="b"/>'
    ...         '<axis xyz="1 0 0"/><limit lower="0" upper="3"/></joint></robot>')
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     _ = pathlib.Path(folder, "r.urdf").write_text(text)
    ...     robot = treeform.read_urdf(folder + "/r.urdf")
    >>> treeform.check_poses(robot.parts, robot.poses({"j": [0.5, 2.0]})).in_collision(2).tolist()
    [True, False]
    """
    folders = _arrays.several(package_folders, "package_folders")
    return _core.read_urdf(path_of(path), [path_of(one) for one in folders], visual,
                           progress=progress)
