#!/usr/bin/env python3
"""bench.py [--cpu] [WORD...]: what a call costs, whether meshes are copied, how soon Ctrl-C stops,
and times beside SciPy, Open3D and VTK where they are installed. With words, only the parts whose
names have one: copies, calls, stops, points, open3d, vtk.

Medians of three runs, one library after the other in each round; of calls, the least. PYTHONPATH
names the package."""

import os
import resource
import signal
import statistics
import sys
import threading
import time

import numpy as np

import treeform as tf

ROUNDS = 3


def sphere(levels):
    """An octahedron, each face cut into four so often, on the unit sphere: 8 * 4^levels faces."""
    v = np.array([(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)], float)
    f = np.array([(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5),
                  (0, 3, 5)])
    for _ in range(levels):
        edges = np.sort(f[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
        one, back = np.unique(edges, axis=0, return_inverse=True)
        middle = (v[one].sum(axis=1))
        middle /= np.linalg.norm(middle, axis=1)[:, None]
        ab, bc, ca = (back.reshape(-1, 3) + len(v)).T
        a, b, c = f.T
        v = np.vstack([v, middle])
        f = np.concatenate([np.stack(t, axis=1) for t in
                            ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))])
    return v, f.astype(np.uint32)


CPU = "--cpu" in sys.argv  # the time of all threads together: for machines that others use as well
WORDS = [word for word in sys.argv[1:] if word != "--cpu"]


def seconds(run, clock=time.perf_counter):
    began = clock()
    run()
    return clock() - began


def row(name, runs):
    """Times each of {library: function} in turn, and prints medians and the ratio to ours."""
    times = {library: [] for library in runs}
    for round_ in range(ROUNDS + 1):
        for library, run in runs.items():
            taken = seconds(run, time.process_time if CPU else time.perf_counter)
            if round_:  # the first is to warm up
                times[library].append(taken)
    medians = {library: statistics.median(t) for library, t in times.items()}
    ours = medians.pop("treeform")
    others = ", ".join(f"{library} {1e3 * t:.1f} ms ({t / ours:.1f} times)"
                       for library, t in medians.items())
    print(f"{name}: treeform {1e3 * ours:.1f} ms; {others}", flush=True)


# ---- what a call costs ----

def each(run, count=1000):
    """The least of some runs: what others do meanwhile is no cost of the call."""
    run()
    return min(seconds(lambda: [run() for _ in range(count)]) / count
               for _ in range(4 * ROUNDS)) * 1e6


def calls():
    one = tf.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    arrays = (one.vertices, one.faces)
    point = np.zeros((1, 3))
    tree = tf.PointTree(np.random.default_rng(1).random((100, 3)))
    print("a call with all that the library does for so little, in microseconds:")
    for name, run in {
            "Mesh(vertices, faces)": lambda: tf.Mesh(*arrays),
            "volume of one face": lambda: one.volume,
            "count_topology of one face": lambda: tf.count_topology(one),
            "self_intersections of one face": lambda: tf.self_intersections(one),
            "the same of (vertices, faces)": lambda: tf.self_intersections(arrays),
            "closest_point of one point": lambda: tf.closest_point(one, point),
            "query of one point": lambda: tree.query(point)}.items():
        print(f"  {name}: {each(run):.1f}")
    from treeform import _core
    little, more = _core.HeldMesh(np.zeros((1000, 3))), _core.HeldMesh(np.zeros((4200, 3)))
    print(f"  bounds of 1000 points, on the calling thread: "
          f"{each(lambda: _core.bounds(little)):.1f}")
    print(f"  bounds of 4200 points, by a helper thread: {each(lambda: _core.bounds(more)):.1f}")


# ---- copies ----

def peak():
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def copies():
    v, f = sphere(9)
    tf.Mesh(v[:3], [[0, 1, 2]]).volume
    before = peak()
    mesh = tf.Mesh(v, f)
    mesh.volume, mesh.bounds
    print(f"a mesh of {len(f):,} faces, {(v.nbytes + f.nbytes) >> 20} MB: the peak grows by "
          f"{peak() - before:.1f} MB; shared memory: {np.shares_memory(mesh.vertices, v)}")


# ---- Ctrl-C ----

def stops():
    rng = np.random.default_rng(2)
    ball = sphere(5)
    crowd = [(ball[0] + c, ball[1]) for c in rng.random((400, 3)) * 2]
    soup = (rng.random((60_000, 3)), np.arange(60_000).reshape(-1, 3))
    cloud, far = rng.random((1_000_000, 3)), rng.random((3_000_000, 3)) * 50
    tree = tf.PointTree(cloud)
    print("from the signal to KeyboardInterrupt, in milliseconds:")
    for name, run in {
            "union of 400 spheres": lambda: tf.union(*crowd),
            "self_intersections of a soup": lambda: tf.self_intersections(soup),
            "wrap": lambda: tf.wrap(ball, 0.002),
            "repair of a soup": lambda: tf.repair(soup, max_loss=1, check=False),
            "weld of a million points": lambda: tf.weld(cloud, 0.05, chain=True),
            "query_pairs": lambda: tree.query_pairs(0.05, output_type="ndarray"),
            "closest_point of 3 million": lambda: tf.closest_point(ball, far)}.items():
        sent = []

        def send():
            sent.append(time.perf_counter())
            os.kill(os.getpid(), signal.SIGINT)

        threading.Timer(0.1, send).start()
        try:
            run()
            print(f"  {name}: ended before")
            time.sleep(0.2)
        except KeyboardInterrupt:
            print(f"  {name}: {1e3 * (time.perf_counter() - sent[0]):.0f}", flush=True)


# ---- beside others ----

def points_beside():
    from scipy.spatial import cKDTree
    rng = np.random.default_rng(3)
    cloud, queries = rng.random((1_000_000, 3)), rng.random((100_000, 3))
    ours, theirs = tf.PointTree(cloud), cKDTree(cloud)
    row("a tree over 1,000,000 points", {"treeform": lambda: tf.PointTree(cloud),
                                         "SciPy": lambda: cKDTree(cloud)})
    row("10 nearest of 100,000 points", {
        "treeform": lambda: ours.query(queries, 10),
        "SciPy, all cores": lambda: theirs.query(queries, 10, workers=-1)})
    row("within 0.01, counted", {
        "treeform": lambda: ours.query_ball_point(queries, 0.01, return_length=True),
        "SciPy, all cores": lambda: theirs.query_ball_point(queries, 0.01, return_length=True,
                                                            workers=-1)})
    row("within 0.01, in lists", {
        "treeform": lambda: ours.query_ball_point(queries, 0.01),
        "SciPy, all cores": lambda: theirs.query_ball_point(queries, 0.01, workers=-1)})
    row("pairs within 0.005", {
        "treeform": lambda: ours.query_pairs(0.005, output_type="ndarray"),
        "SciPy": lambda: theirs.query_pairs(0.005, output_type="ndarray")})


def open3d_beside():
    import open3d as o3d
    core = o3d.core
    v, f = sphere(6)
    rng = np.random.default_rng(4)
    points = rng.random((50_000, 3)) * 3 - 1.5
    mesh = tf.Mesh(v, f)
    scene = o3d.t.geometry.RaycastingScene()
    scene.add_triangles(core.Tensor(v.astype(np.float32)), core.Tensor(f))
    as_float = core.Tensor(points.astype(np.float32))
    tf.closest_point(mesh, points[:1])
    row(f"closest points on {len(f):,} faces, of 50,000", {
        "treeform": lambda: tf.closest_point(mesh, points),
        "Open3D, float32": lambda: scene.compute_closest_points(as_float)})

    search = o3d.core.nns.NearestNeighborSearch(core.Tensor(v))
    search.knn_index()
    some = core.Tensor(points)
    tree = tf.PointTree(v)
    row("10 nearest of 50,000 points", {
        "treeform": lambda: tree.query(points, 10),
        "Open3D, float64": lambda: search.knn_search(some, 10)})

    angle = 0.05
    turn = np.eye(4)
    turn[:2, :2] = [[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]
    bump = v * (1 + 0.2 * np.sin(5 * v[:, :1]) * np.cos(4 * v[:, 1:2]))
    scan = bump @ turn[:3, :3].T + [0.01, 0.02, 0.0]
    a = o3d.geometry.PointCloud(o3d.utility.Vector3dVector(scan))
    b = o3d.geometry.PointCloud(o3d.utility.Vector3dVector(bump))
    icp = o3d.pipelines.registration
    limit = icp.ICPConvergenceCriteria(1e-9, 1e-9, 100)
    found = {}

    def theirs():
        b.normals = o3d.utility.Vector3dVector()
        b.estimate_normals()
        found["theirs"] = icp.registration_icp(
            a, b, 0.2, np.eye(4), icp.TransformationEstimationPointToPlane(), limit)

    row("ICP of 16,386 points, plane to cloud", {
        "treeform": lambda: found.update(ours=tf.align(scan, bump, method="point_to_plane",
                                                       max_samples=0)),
        "Open3D, normals included": theirs})
    if found:
        print(f"  rms: treeform {found['ours'].rms:.2g}, Open3D {found['theirs'].inlier_rmse:.2g}")


def vtk_beside():
    import vtk
    from vtk.util import numpy_support

    def poly(v, f):
        made = vtk.vtkPolyData()
        points = vtk.vtkPoints()
        points.SetData(numpy_support.numpy_to_vtk(v, deep=True))
        made.SetPoints(points)
        cells = np.hstack([np.full((len(f), 1), 3), f]).astype(np.int64).ravel()
        array = vtk.vtkCellArray()
        array.SetCells(len(f), numpy_support.numpy_to_vtkIdTypeArray(cells, deep=True))
        made.SetPolys(array)
        return made

    v, f = sphere(5)
    turned = v @ np.linalg.qr(np.random.default_rng(5).standard_normal((3, 3)))[0] + [0.5, 0.1, 0]
    a, b = poly(v, f), poly(turned, f)

    def union():
        made = vtk.vtkBooleanOperationPolyDataFilter()
        made.SetOperationToUnion()
        made.SetInputData(0, a)
        made.SetInputData(1, b)
        made.Update()

    locator = vtk.vtkStaticCellLocator()
    locator.SetDataSet(a)
    locator.BuildLocator()
    points = np.random.default_rng(6).random((5_000, 3)) * 3 - 1.5
    mesh = tf.Mesh(v, f)

    def closest():
        at, cell, sub, square = [0, 0, 0], vtk.reference(0), vtk.reference(0), vtk.reference(0.0)
        for p in points:
            locator.FindClosestPoint(p, at, cell, sub, square)

    vtk.vtkObject.GlobalWarningDisplayOff()
    row(f"union of two spheres of {len(f):,} faces", {
        "treeform": lambda: tf.union((v, f), (turned, f)), "VTK": union})
    row("closest points of 5,000, one by one in VTK", {
        "treeform": lambda: tf.closest_point(mesh, points), "VTK": closest})


if __name__ == "__main__":
    print(f"treeform {tf.__version__}, {tf.thread_count()} threads")
    for part in (copies, calls, stops, points_beside, open3d_beside, vtk_beside):
        if WORDS and not any(word in part.__name__ for word in WORDS):
            continue
        try:
            part()
        except ImportError as missing:
            print(f"left out: {missing}")
