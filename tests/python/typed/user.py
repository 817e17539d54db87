"""Fifteen kinds of calls as users write them, for mypy --strict and pyright."""

from __future__ import annotations

import io
from pathlib import Path
from typing import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

import treeform
import treeform as tf
from treeform import BooleanResult, Mesh, MeshLike


def read_and_write(folder: Path) -> tf.Written:
    parts: list[Mesh] = [tf.read(path) for path in sorted(folder.glob("*.stl"))]
    with open(folder / "a.ply", "rb") as file:
        parts.append(tf.read(file, format="ply"))
    tf.write(io.BytesIO(), parts[0], format="stl")
    tf.write(folder / "all.3mf", {"lid": parts[0], "base": parts[1]})
    try:
        return tf.write(folder / "all.3mf", parts)
    except FileNotFoundError as error:
        print(error.filename, error.errno)
    except tf.FileError as error:
        print(error.errno)
    return tf.write(str(folder / "b.3mf"), tf.union(parts), ascii=True)


def set_operations(plate: Mesh, cutters: list[Mesh], others: Sequence[MeshLike]) -> float:
    made: BooleanResult = tf.difference(plate, cutters)
    tf.union(cutters)
    tf.union(plate, *cutters, volumes=True)
    tf.intersection(plate, (m for m in cutters))
    tf.split([plate, made])
    tf.clip(plate, cutters, keep="inside")
    tf.union(others, [(plate.vertices, plate.faces)])
    tf.boolean("a - b", a=plate, b=cutters[0])
    both = (plate | made) - cutters[0]
    source: NDArray[np.uint32] = made.face_source
    return float(both.volume + made.mesh.area + source.size)


def intersections(mesh: MeshLike) -> int:
    found = treeform.self_intersections(mesh, kinds=["crossing"])
    curves: list[NDArray[np.float64]] = tf.intersection_curves(mesh, found)
    regions = tf.intersection_regions(mesh, found)
    return len(found.pairs) + len(curves) + sum(len(one.faces) for one in regions)


def mended(mesh: Mesh) -> Mesh:
    defects: tf.SolidDefects = tf.find_solid_defects(mesh)
    if not defects and defects.nonfinite_vertices == 0:
        return mesh
    try:
        return tf.repair(mesh, steps=["join", "fill"], gap=0.1).mesh
    except tf.NotClosedError as error:
        print(error.edges.shape, error.certificate.message)
    return tf.wrap(mesh, 0.5).mesh


def near(mesh: Mesh, points: NDArray[np.float64]) -> NDArray[np.float64]:
    closest, distance, triangle = tf.closest_point(mesh, points)
    inside: NDArray[np.bool_] = tf.contains(mesh, points.tolist())
    hits = tf.raycast(mesh, points, np.tile([0.0, 0.0, 1.0], (len(points), 1)))
    print(triangle[inside].sum(), closest.mean(), hits.t.min())
    return distance


def assembly(parts: dict[str, Mesh], poses: NDArray[np.float64]) -> list[tuple[str, float]]:
    names = list(parts)
    found = tf.clash(parts.values(), clearance=0.1, poses=poses)
    many = tf.check_poses(list(parts.values()), poses[None], ignored=[(0, 1)])
    print(many.in_collision, tf.RELATIONS)
    return [(names[one.a] + names[one.b], one.depth or 0.0) for one in found.pairs]


def placed(part: Mesh, others: list[Mesh]) -> Iterable[tf.Placement]:
    yield tf.drop(part, others)
    yield tf.slide(part, others, [0, 0, -1], clearance=0.1)
    yield tf.separate(part, others[0])
    flat = tf.lay_flat(part)
    plate = tf.pack([flat, *others], (200, 200), spacing=1)
    print([one.matrix for one in plate.parts], tf.align(part, others[0]).matrix)


def cloud(points: NDArray[np.float32]) -> int:
    thin: tf.WeldResult = tf.weld(points, 0.01, same={"red": 1.0})
    distances, ids = tf.PointTree(thin.points).query(points, k=1)
    tf.weld_stream([Path("a.ply"), "b.ply"], "out.ply", 0.1)
    return int(np.asarray(ids).max()) + len(np.asarray(distances))


def measured(a: Mesh, b: Mesh) -> str:
    map = tf.deviation(a, b, band=(-0.1, 0.1))
    hull = tf.convex_hull(a)
    return f"{tf.measure(a, b)} {map.p95} {hull.areas.sum()} {tf.distance(a, b)}"


def columns(mesh: Mesh) -> Mesh:
    extra = tf.Attributes()
    extra.set_vertex("quality", np.arange(len(mesh.vertices)))
    vertices, faces = mesh
    return tf.Mesh(vertices, faces, extra)


def pictures(mesh: Mesh, marked: NDArray[np.uint32]) -> tf.Picture:
    mesh.show(marked=marked)
    return tf.plot(mesh, view=["iso", "top"], marked=marked, size=(80, 60))


def others(mesh: Mesh) -> list[Mesh]:
    back = [tf.from_trimesh(mesh.to_trimesh()), tf.from_open3d(mesh.to_open3d(tensor=True)),
            tf.from_pyvista(mesh.to_pyvista()), tf.from_vtk(mesh.to_vtk()),
            tf.from_meshio(mesh.to_meshio())]
    return back


def watched(mesh: Mesh) -> bool:
    def progress(share: float) -> bool:
        return share < 0.5

    try:
        with tf.threads(2):
            return bool(tf.check_operand(mesh, progress=progress))
    except tf.Cancelled:
        return False


def counted(mesh: Mesh) -> int:
    features: list[tf.Feature] = tf.find_features(mesh, "plane")
    topology: tf.Topology = tf.count_topology(mesh)
    return topology.edges + len(features) + int(tf.NONE) + len(tf.face_components(mesh))
