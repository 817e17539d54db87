#!/usr/bin/env python3
"""icp_beside_open3d.py TF_PLACE MOVING FIXED [TIMES]: the same two clouds aligned by tf-place fit and
by Open3D's ICP (Debian's python3-open3d), in turn, on all cores.

Prints the median time of the alignment alone (of treeform's report; of Open3D's call, with its
search tree) and the root mean square of what is left, measured alike for both: from each point of
MOVING to the nearest of FIXED. Skipped, with status 77, where Open3D is not installed."""

import json
import statistics
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


def left_over(moving, fixed, matrix):
    """The root mean square of the nearest three quarters of the distances: both have no partner for
    the rest."""
    moved = open3d.geometry.PointCloud(moving).transform(matrix)
    distances = numpy.sort(numpy.asarray(moved.compute_point_cloud_distance(fixed)))
    return float(numpy.sqrt(numpy.mean(distances[: 3 * len(distances) // 4] ** 2)))


def by_treeform(tool, moving, fixed, *options):
    with tempfile.NamedTemporaryFile(suffix=".json") as report:
        subprocess.run([tool, "fit", moving, "--fixed", fixed, "-n", "-o", "x.ply", "-q", *options,
                        "-f", "-r", report.name], check=False)
        said = json.load(open(report.name))
    entry = said["files"][0]
    seconds = said["seconds"]["prepare"] + said["seconds"]["search"]
    return seconds, numpy.array(entry["matrix"]).reshape(4, 4)


def by_open3d(moving, fixed, distance, iterations):
    start = time.perf_counter()
    found = open3d.pipelines.registration.registration_icp(
        moving, fixed, distance, numpy.eye(4),
        open3d.pipelines.registration.TransformationEstimationPointToPoint(),
        open3d.pipelines.registration.ICPConvergenceCriteria(max_iteration=iterations))
    return time.perf_counter() - start, found.transformation


def main():
    tool, moving_name, fixed_name = sys.argv[1:4]
    times = int(sys.argv[4]) if len(sys.argv) > 4 else 5
    moving = open3d.io.read_point_cloud(moving_name)
    fixed = open3d.io.read_point_cloud(fixed_name)
    box = fixed.get_axis_aligned_bounding_box()
    reach = 0.05 * float(numpy.linalg.norm(box.get_extent()))
    ours, theirs = [], []
    for _ in range(times):
        ours.append(by_treeform(tool, moving_name, fixed_name, "--max-distance", str(reach)))
        theirs.append(by_open3d(moving, fixed, reach, 100))
    for name, runs in (("treeform", ours), ("Open3D " + open3d.__version__, theirs)):
        seconds = statistics.median(t for t, _ in runs)
        print(f"{name:16} {seconds:8.3f} s   rms {left_over(moving, fixed, runs[-1][1]):.6g}")


if __name__ == "__main__":
    main()
