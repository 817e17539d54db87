#!/usr/bin/env python3
"""thin_beside_others.py TF_WELD CLOUD DISTANCE [TIMES]: one cloud thinned from file to file by
tf-weld, by CloudCompare's spatial subsampling, and by Open3D's voxel_down_sample (Debian's
cloudcompare and python3-open3d), in turn, on all cores.

Prints the medians of the CPU seconds of whole processes and of the clock, and how many points each
has left. tf-weld keeps the first of any points within the distance in the file's order;
CloudCompare leaves no two within it, too, but keeps which it likes; cells of Open3D have one mean
each, and two of these may be as near as one likes. Programs that are not installed are left out."""

import os
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

VOXELS = """
import sys, open3d
cloud = open3d.io.read_point_cloud(sys.argv[1])
open3d.io.write_point_cloud(sys.argv[2], cloud.voxel_down_sample(float(sys.argv[3])))
"""


def commands(tool, cloud, distance):
    all_of_them = {"tf-weld": lambda out: [tool, cloud, "-t", distance, "-o", out, "-f", "-q"]}
    if shutil.which("CloudCompare"):
        all_of_them["CloudCompare"] = lambda out: [
            "CloudCompare", "-SILENT", "-AUTO_SAVE", "OFF", "-C_EXPORT_FMT", "PLY",
            "-PLY_EXPORT_FMT", "BINARY_LE", "-O", cloud, "-SS", "SPATIAL", distance,
            "-SAVE_CLOUDS", "FILE", out]
    if subprocess.run(["/usr/bin/python3", "-c", "import open3d"], check=False,
                      capture_output=True).returncode == 0:
        all_of_them["Open3D"] = lambda out: ["/usr/bin/python3", "-c", VOXELS, cloud, out, distance]
    return all_of_them


def measured(command):
    start = time.perf_counter()
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                               env={**os.environ, "QT_QPA_PLATFORM": "offscreen"})
    _, status, used = os.wait4(process.pid, 0)
    if status != 0:
        sys.exit(f"{command[0]} ended with status {os.waitstatus_to_exitcode(status)}")
    return used.ru_utime + used.ru_stime, time.perf_counter() - start, used.ru_maxrss / 1024


def points_in(path):
    with open(path, "rb") as file:
        for line in file:
            if line.startswith(b"element vertex"):
                return int(line.split()[2])
    return 0


def main():
    tool, cloud, distance = sys.argv[1:4]
    times = int(sys.argv[4]) if len(sys.argv) > 4 else 3
    runs = {}
    for _ in range(times):
        for name, command in commands(tool, cloud, distance).items():
            with tempfile.TemporaryDirectory() as folder:
                out = os.path.join(folder, "thin.ply")
                runs.setdefault(name, []).append((*measured(command(out)), points_in(out)))
    ours = statistics.median(one[0] for one in runs["tf-weld"])
    for name, all_runs in runs.items():
        cpu, clock, memory, _ = (statistics.median(column) for column in zip(*all_runs))
        print(f"{name:14} {cpu:7.2f} s of CPU {clock:7.2f} s {memory:7.0f} MB   tf-weld / it "
              f"{ours / cpu:5.2f}   {all_runs[-1][3]} points")


if __name__ == "__main__":
    main()
