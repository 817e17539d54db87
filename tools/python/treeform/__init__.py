"""Exact, fast mesh processing.

NumPy arrays in, NumPy arrays out. A mesh is a `Mesh`, a pair (vertices, faces), or anything with
such arrays: of trimesh, PyVista, Open3D, meshio. Every yes or no is exact on the coordinates as
given; what operations return has been checked in the numbers returned.

>>> import treeform
>>> m = treeform.read("data/two_spheres.stl")
>>> len(treeform.self_intersections(m))
78
"""

from ._booleans import (BooleanResult, boolean, check_solid, clip, difference, intersection, split,
                        symmetric_difference, union)
from ._core import Certificate
from ._errors import (Cancelled, CertificateError, Error, FileError, NotCertifiedError,
                      NotSolidError)
from ._files import Written, read, write
from ._intersections import (KINDS, FacePairs, FilePairs, Region, faces_in_box,
                             intersection_curves, intersection_regions, mesh_intersections,
                             self_intersections, self_intersections_of_file)
from ._mesh import Attributes, Mesh, from_trimesh
