#!/usr/bin/env python3
"""simplify_beside_meshlab.py TF_CUT MODEL FACES [TIMES]: one mesh with fewer faces, from file to
file, by MeshLab's quadric edge collapse (Debian's meshlab and xvfb) and by tf-cut simplify.

MeshLab is asked for a number of faces. How far its result is from the model, both ways, is then
what tf-cut is allowed, once with that number to stop at, and once as far as it goes. Distances of
all are measured by `treeform.deviation`, at samples: set PYTHONPATH to tools/python of the build.
Prints medians of the CPU seconds of whole processes on one thread, of MeshLab without what it takes
to copy the mesh."""

import os
import statistics
import subprocess
import sys
import tempfile

import treeform

COLLAPSE = """<filter name="Simplification: Quadric Edge Collapse Decimation">
%s</filter>
""" % "".join('<Param name="%s" type="Rich%s" value="%s"/>\n' % row for row in (
    ("TargetFaceNum", "Int", "FACES"), ("TargetPerc", "Float", "0"), ("QualityThr", "Float", "0.3"),
    ("PreserveBoundary", "Bool", "false"), ("BoundaryWeight", "Float", "1"),
    ("PreserveNormal", "Bool", "false"), ("PreserveTopology", "Bool", "false"),
    ("OptimalPlacement", "Bool", "true"), ("PlanarQuadric", "Bool", "false"),
    ("PlanarWeight", "Float", "0.001"), ("QualityWeight", "Bool", "false"),
    ("AutoClean", "Bool", "true"), ("Selected", "Bool", "false")))


def seconds(command):
    """Of CPU, of the process and those that it started."""
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, used = os.wait4(process.pid, 0)
    if status != 0:
        sys.exit(f"{command[0]} ended with status {os.waitstatus_to_exitcode(status)}")
    return used.ru_utime + used.ru_stime


def meshlab(model, out, steps):
    script = out + ".mlx"
    with open(script, "w") as file:
        file.write(f"<!DOCTYPE FilterScript>\n<FilterScript>\n{steps}</FilterScript>\n")
    return seconds(["xvfb-run", "-a", "meshlabserver", "-i", model, "-o", out, "-s", script])


def main():
    tool, path, faces = sys.argv[1:4]
    times = int(sys.argv[4]) if len(sys.argv) > 4 else 3
    with tempfile.TemporaryDirectory() as folder:
        given, out = os.path.join(folder, "given.ply"), os.path.join(folder, "out.ply")
        whole = treeform.read(path)
        whole = treeform.submesh(whole, range(len(whole.faces))).mesh  # without unused points
        treeform.write(given, whole, precision="float32")
        whole = treeform.read(given)

        def say(name, used, less=0.0):
            made = treeform.read(out)
            far = treeform.deviation(whole, made)
            print(f"{name:24} {statistics.median(used) - less:7.2f} s {len(made.faces):8} faces"
                  f"   {far.max:.4g} apart")
            return far.max

        copied = statistics.median(meshlab(given, out, "") for _ in range(times))
        used = [meshlab(given, out, COLLAPSE.replace("FACES", faces)) for _ in range(times)]
        distance = say("MeshLab", used, copied)
        for name, more in (("tf-cut, as many", ["--faces", faces]), ("tf-cut, fewest", [])):
            say(name, [seconds([tool, "simplify", given, "--distance", str(distance), "-o", out,
                                "-f", "-q", "-j", "1", *more]) for _ in range(times)])


if __name__ == "__main__":
    main()
