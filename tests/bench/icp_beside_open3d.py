#!/usr/bin/env python3
"""icp_beside_open3d.py TF_PLACE FOLDER [OPTION...]: the pairs that tests/stress writes to
TREEFORM_PAIRS_DIR, aligned by `tf-place align` and by Open3D's ICP (Debian's python3-open3d), in
turn, on all cores.

Open3D is told to look for partners within a tenth of the diagonal, as far as the pairs are apart,
to fit planes to the 20 nearest points, and to take up to 100 steps. A mesh that is fixed is for
Open3D a cloud of 20,000 points spread over it, made before its time is taken. Times are of planes,
index and search; of treeform as it reports them. Prints a table; the options go to tf-place.
Skipped, with status 77, where Open3D is not installed."""

import json
import pathlib
import subprocess
import sys
import tempfile
import time

try:
    import numpy
    import open3d
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

registration = open3d.pipelines.registration


class Pair:
    def __init__(self, start):
        name, right, scanner, *rows = start.with_suffix(".txt").read_text().splitlines()
        self.name = name
        self.right, self.turn = map(float, right.split())
        self.scanner = numpy.array([*map(float, scanner.split()), 1.0])
        self.truth = numpy.vstack([[float(x) for x in row.split()] for row in rows] +
                                  [[0, 0, 0, 1]])
        self.moving_name = f"{start}_moving.ply"
        self.fixed_name = f"{start}_fixed.ply"
        self.moving = open3d.io.read_point_cloud(self.moving_name)
        self.fixed = open3d.io.read_point_cloud(self.fixed_name)
        with open(self.fixed_name, "rb") as file:
            if b"element face" in file.read(1000):
                mesh = open3d.io.read_triangle_mesh(self.fixed_name)
                self.fixed = mesh.sample_points_uniformly(20000)

    def is_right(self, matrix):
        """As in tests/stress/fit_pairs.cpp."""
        off = matrix - self.truth
        if numpy.isfinite(self.turn):
            cosine = (numpy.trace(matrix[:3, :3].T @ self.truth[:3, :3]) - 1) / 2
            return (numpy.linalg.norm(off @ self.scanner) <= self.right and
                    numpy.arccos(numpy.clip(cosine, -1, 1)) <= self.turn)
        points = numpy.asarray(self.moving.points)
        moved = points @ off[:3, :3].T + off[:3, 3]
        return numpy.sqrt(numpy.mean(numpy.sum(moved**2, axis=1))) <= self.right


def by_treeform(tool, pair, options):
    with tempfile.NamedTemporaryFile(suffix=".json") as report:
        run = subprocess.run([tool, "align", pair.moving_name, "--fixed", pair.fixed_name, "-n",
                              "-q", "-o", "x.ply", *options, "-f", "-r", report.name], check=False)
        said = json.load(open(report.name))
    seconds = said["seconds"]["prepare"] + said["seconds"]["search"]
    return seconds, numpy.array(said["files"][0]["matrix"]).reshape(4, 4), run.returncode == 0


def by_open3d(pair, planes_of_both):
    moving = open3d.geometry.PointCloud(pair.moving)
    fixed = open3d.geometry.PointCloud(pair.fixed)
    box = fixed.get_axis_aligned_bounding_box()
    reach = 0.1 * float(numpy.linalg.norm(box.get_extent()))
    criteria = registration.ICPConvergenceCriteria(max_iteration=100)
    start = time.perf_counter()
    if planes_of_both:
        found = registration.registration_generalized_icp(
            moving, fixed, reach, numpy.eye(4),
            registration.TransformationEstimationForGeneralizedICP(), criteria)
    else:
        fixed.estimate_normals(open3d.geometry.KDTreeSearchParamKNN(20))
        found = registration.registration_icp(
            moving, fixed, reach, numpy.eye(4),
            registration.TransformationEstimationPointToPlane(), criteria)
    return time.perf_counter() - start, found.transformation, None


def main():
    tool, folder, *options = sys.argv[1:]
    starts = sorted(pathlib.Path(folder).glob("*.txt"), key=lambda path: int(path.stem))
    name = "Open3D " + open3d.__version__
    ways = {
        "tf-place align " + " ".join(options): lambda pair: by_treeform(tool, pair, options),
        name + ", point to plane": lambda pair: by_open3d(pair, False),
        name + ", generalized": lambda pair: by_open3d(pair, True),
    }
    found = dict.fromkeys(ways, 0)
    mistaken = dict.fromkeys(ways, 0)
    seconds = {way: [] for way in ways}
    for start in starts:
        pair = Pair(start.with_suffix(""))
        for way, fit in ways.items():
            took, matrix, said_right = fit(pair)
            right = pair.is_right(matrix)
            found[way] += right
            mistaken[way] += bool(said_right) and not right
            seconds[way].append(took)
    print(f"| of {len(starts)} pairs | found | wrong, status 0 | s, all | s, median |")
    print("|---|---:|---:|---:|---:|")
    for way in ways:
        wrong = mistaken[way] if way.startswith("tf-place") else "says nothing"
        print(f"| {way} | {found[way]} | {wrong} | {sum(seconds[way]):.1f} | "
              f"{numpy.median(seconds[way]):.3f} |")


if __name__ == "__main__":
    main()
