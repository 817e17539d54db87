"""Search trees for points and boxes, in 2D and 3D."""

from __future__ import annotations

# made of uses:
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arrays, _core
from ._arrays import Floats
from ._progress import Progress, part
from ._results import tuple_repr

__all__ = ["BoxTree", "Neighbors", "PointTree"]
# end

Numbers = NDArray[np.int64]

_MOST = 2 ** 62  # more neighbors than fit into memory


def _table(values: ArrayLike, name: str) -> Floats:
    """`values` as (n, 2) or (n, 3)."""
    array = _arrays.floats(values, name)
    return _arrays.shaped(array, array.ndim == 2 and array.shape[1] in (2, 3), name,
                          "(n, 2) or (n, 3)")


class Neighbors(NamedTuple):
    """Lists of neighbors for many queries, concatenated: the neighbors of query q are
    `ids[begin[q]:begin[q + 1]]`.

    begin: (q + 1,) where the list of each query begins.
    ids: (n,) numbers of points.
    distances: (n,) their distances, not squared.
    """

    begin: Numbers
    ids: Numbers
    distances: Floats

    def __repr__(self) -> str:
        return tuple_repr(self)


def _shaped(d: Floats, i: Numbers, shape: tuple[int, ...]) -> tuple[Any, Any]:
    """Distances and numbers in this shape; for one neighbor of one query, as scalars."""
    return (d.reshape(shape), i.reshape(shape)) if shape else (float(d[0]), int(i[0]))


def _count(k: Any) -> int:
    return min(int(_arrays.expect(k >= 1, k, "k", "at least 1")), _MOST)


def _queries(x: ArrayLike, width: int, p: float = 2.0) -> tuple[Floats, tuple[int, ...]]:
    """Queries as an array (q, width), and the shape of the results. p: of the norm."""
    _arrays.expect(p == 2, p, "p", "2, the only one supported")
    array = _arrays.floats(x, "x")
    _arrays.shaped(array, array.ndim > 0 and array.shape[-1] == width, "x", f"(..., {width})")
    return np.ascontiguousarray(array.reshape(-1, width)), array.shape[:-1]


class PointTree:
    """A search tree for points (n, 2) or (n, 3), with the interface of SciPy's cKDTree.

    Distances are Euclidean, computed in float64. Points may coincide. Points at the same distance
    are returned in the order of their numbers. Queries use all cores, and are thread-safe.

    >>> import treeform
    >>> tree = treeform.PointTree([[0, 0, 0], [1, 0, 0], [0, 2, 0]])
    >>> tree.query([0.9, 0, 0])
    (0.09999999999999998, 1)
    """

    __slots__ = ("_data", "_cloud")

    def __init__(self, data: ArrayLike) -> None:
        self._data = _table(data, "data").copy()
        self._data.flags.writeable = False
        make = _core.Cloud3 if self.m == 3 else _core.Cloud2
        self._cloud: _core.Cloud2 = _core.build(make, self._data)

    @property
    def data(self) -> Floats:
        """(n, m) a read-only copy of the points."""
        return self._data

    def __reduce__(self) -> tuple[type[PointTree], tuple[Floats]]:
        return type(self), (self._data,)

    @property
    def n(self) -> int:
        """Number of points."""
        return len(self._data)

    @property
    def m(self) -> int:
        """Number of dimensions, 2 or 3."""
        return int(self._data.shape[1])

    def __len__(self) -> int:
        return len(self._data)

    def query(self, x: ArrayLike, k: Any = 1, eps: float = 0.0, p: float = 2.0,
              distance_upper_bound: float = np.inf, workers: int = -1, *,
              progress: Progress = None) -> tuple[Any, Any]:
        """The k nearest points of each query: their distances and numbers, nearest first.

        x: (..., m) the queries. k: a number, or a list of ranks: 1 is the nearest point.
        distance_upper_bound: return only points nearer than this.
        eps, p and workers are those of SciPy: results are exact whatever `eps` is, only p = 2 is
        supported, and `treeform.threads` limits the number of threads.

        Returns d, i of shape (...) for k = 1, else (..., k). If there are fewer than k points, the
        rest is infinite in d, and n in i.

        >>> import treeform
        >>> tree = treeform.PointTree([[0, 0], [1, 0], [0, 2]])
        >>> tree.query([[0, 0], [0, 3]], k=2)
        (array([[0., 1.],
               [1., 3.]]), array([[0, 1],
               [2, 0]]))
        """
        queries, shape = _queries(x, self.m, p)
        wanted = None
        if not isinstance(k, (int, np.integer)):
            wanted = np.asarray(k, np.intp)
            _arrays.expect(wanted.ndim == 1 and wanted.min(initial=2) >= 1 and wanted.size > 0, k,
                           "k", "a number, or a list of numbers from 1")
        count = k if wanted is None else int(wanted.max())
        _arrays.expect(distance_upper_bound >= 0, distance_upper_bound, "distance_upper_bound",
                       "a number that is not negative or NaN")
        d, i = self._cloud.query(queries, _count(count), distance_upper_bound, progress=progress)
        if wanted is not None:
            d = d.reshape(-1, count)[:, wanted - 1]
            i = i.reshape(-1, count)[:, wanted - 1]
            shape += len(wanted),
        elif k != 1:
            shape += count,
        return _shaped(d, i, shape)

    def query_ball_point(self, x: ArrayLike, r: ArrayLike, p: float = 2.0, eps: float = 0.0,
                         workers: int = -1, return_sorted: bool | None = None,
                         return_length: bool = False, *, progress: Progress = None) -> Any:
        """The numbers of all points within `r` of each query, inclusive, ascending: a list, or an
        array of lists for many queries. `r` may be an array with a radius for each query. With
        `return_length`, only the lengths of the lists.

        `query_ball` returns the same as arrays, and is much faster.

        >>> import treeform
        >>> tree = treeform.PointTree([[0, 0], [1, 0], [0, 2]])
        >>> tree.query_ball_point([0, 0], 1)
        [0, 1]
        """
        queries, shape = _queries(x, self.m, p)
        radii = np.broadcast_to(_arrays.floats(r, "r"), shape).ravel()
        lists: list[Any] = [[]] * len(queries)
        different = np.unique(radii)
        for piece, radius in enumerate(different):
            at = np.flatnonzero(radii == radius)
            begin, ids, _ = self._cloud.query_ball(queries[at], float(radius), True,
                                                   progress=part(progress, piece, len(different)))
            found = np.diff(begin).tolist() if return_length else _core.lists(begin, ids)
            for i, one in zip(at.tolist(), found):
                lists[i] = one
        if return_length:
            return np.array(lists, np.int64).reshape(shape) if shape else lists[0]
        if not shape:
            return lists[0]
        made = np.empty(len(lists), object)
        made[:] = lists
        return made.reshape(shape)

    def query_ball(self, x: ArrayLike, r: float, *, progress: Progress = None) -> Neighbors:
        """All points within `r` of each query, inclusive, nearest first, as arrays.

        >>> import treeform
        >>> tree = treeform.PointTree([[0, 0], [1, 0], [0, 2]])
        >>> tree.query_ball([[0, 0], [5, 5]], 1).ids.tolist()
        [0, 1]
        """
        queries, _ = _queries(x, self.m)
        return Neighbors(*self._cloud.query_ball(queries, _arrays.number(r, "r"), False,
                                                progress=progress))

    def query_pairs(self, r: float, p: float = 2.0, eps: float = 0.0, output_type: str = "set", *,
                    progress: Progress = None) -> Any:
        """The pairs of points at most `r` apart, the lower number first: a set of tuples, or, with
        output_type='ndarray', an ascending array (n, 2).

        >>> import treeform
        >>> treeform.PointTree([[0, 0], [1, 0], [0, 2]]).query_pairs(1)
        {(0, 1)}
        """
        _arrays.expect(p == 2, p, "p", "2, the only one supported")
        _arrays.one_of(output_type, "output_type", ("set", "ndarray"))
        pairs = self._cloud.query_pairs(_arrays.number(r, "r"), progress=progress)
        return pairs if output_type == "ndarray" else set(map(tuple, pairs.tolist()))

    def __repr__(self) -> str:
        return f"PointTree({self.n:,} points, {self.m} dimensions)"


class BoxTree:
    """A search tree for axis-aligned boxes with the lower corners `mins` (n, 2) or (n, 3) and the
    upper corners `maxs`. Boxes that touch overlap. Exact for the given coordinates.

    >>> import treeform
    >>> tree = treeform.BoxTree([[0, 0], [2, 0], [1, 1]], [[1, 1], [3, 1], [2, 2]])
    >>> tree.pairs().tolist()
    [[0, 2], [1, 2]]
    """

    __slots__ = ("_boxes", "_dimensions")

    def __init__(self, mins: ArrayLike, maxs: ArrayLike) -> None:
        low, high = _table(mins, "mins"), _table(maxs, "maxs")
        if low.shape != high.shape:
            raise ValueError(f"maxs: the shape is {high.shape}, that of mins {low.shape}")
        self._dimensions = int(low.shape[1])
        make = _core.Boxes3 if self._dimensions == 3 else _core.Boxes2
        self._boxes: _core.Boxes2 = _core.build(make, low, high)

    def __reduce__(self) -> tuple[type[BoxTree], tuple[Floats, Floats]]:
        return type(self), self._boxes.bounds()

    def __len__(self) -> int:
        return len(self._boxes)

    def pairs(self, other: BoxTree | None = None, *, progress: Progress = None) -> Numbers:
        """(n, 2) the pairs of boxes that overlap, ascending, the lower number first; with `other`,
        pairs of a box of this tree and a box of the other one.

        >>> import treeform
        >>> a = treeform.BoxTree([[0, 0, 0]], [[1, 1, 1]])
        >>> a.pairs(treeform.BoxTree([[5, 5, 5], [1, 1, 1]], [[6, 6, 6], [2, 2, 2]])).tolist()
        [[0, 1]]
        """
        if other is None:
            return self._boxes.pairs(progress=progress)
        if other._dimensions != self._dimensions:
            raise ValueError("other: the tree has a different number of dimensions")
        return self._boxes.pairs_with(other._boxes, progress=progress)

    def query(self, min: ArrayLike, max: ArrayLike, *, progress: Progress = None) -> Any:
        """(n,) the numbers of the boxes that overlap the box from `min` (m,) to `max`, ascending.
        For many boxes (q, m), a pair (begin, ids): those for box i are `ids[begin[i]:begin[i +
        1]]`.

        >>> import treeform
        >>> tree = treeform.BoxTree([[0, 0], [2, 0], [1, 1]], [[1, 1], [3, 1], [2, 2]])
        >>> tree.query([0, 0], [0.5, 0.5]).tolist()
        [0]
        """
        low, high = _arrays.floats(min, "min"), _arrays.floats(max, "max")
        one = low.ndim == 1
        low, high = np.atleast_2d(low), np.atleast_2d(high)
        if low.shape != high.shape or low.ndim != 2 or low.shape[1] != self._dimensions:
            raise ValueError(f"min, max: the shapes are {low.shape} and {high.shape}, "
                             f"not (n, {self._dimensions})")
        begin, ids = self._boxes.query(low, high, progress=progress)
        return ids if one else (begin, ids)

    def nearest(self, x: ArrayLike, k: int = 1, *, radius: float = np.inf,
                progress: Progress = None) -> tuple[Any, Any]:
        """The k boxes nearest to each query (..., m): distances, which are 0 inside a box, and
        numbers, as `PointTree.query` returns them for points.

        >>> import treeform
        >>> treeform.BoxTree([[0, 0], [2, 0]], [[1, 1], [3, 1]]).nearest([1.25, 0.5])
        (0.25, 0)
        """
        queries, shape = _queries(x, self._dimensions)
        radius = _arrays.number(radius, "radius")
        d, i = self._boxes.nearest(queries, _count(k), radius, progress=progress)
        return _shaped(d, i, shape if k == 1 else (*shape, k))

    def __repr__(self) -> str:
        return f"BoxTree({len(self):,} boxes, {self._dimensions} dimensions)"
