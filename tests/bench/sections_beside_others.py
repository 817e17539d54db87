#!/usr/bin/env python3
"""sections_beside_others.py TF_CUT MESH [TIMES]: a mesh, lying on z = 0 as STL, cut in 1,000 layers
across z by tf-cut section, by VTK's vtkCutter, whose segments vtkStripper joins, and by
PrusaSlicer, in turn, on all cores (Debian's python3-vtk9 and prusa-slicer; what is not installed is
left out).

Prints medians: seconds by the clock of the step that makes the loops, and of all of the process,
CPU seconds and memory of all of it. PrusaSlicer says itself when it slices: from "slice_mesh to
polygons" to the end of "make_slices", which closes and nests the loops on a lattice of nanometers;
before that it reads and repairs, after it a single perimeter and G-code are made, without infill.
Its mesh is scaled to a height of 100 mm, layers are 0.1 mm."""

import datetime
import json
import os
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

LAYERS = 1000
VTK = """
import sys, time, vtk
reader = vtk.vtkSTLReader()
reader.SetFileName(sys.argv[1])
reader.Update()
low, high = reader.GetOutput().GetBounds()[4:]
plane = vtk.vtkPlane()
plane.SetNormal(0, 0, 1)
cutter = vtk.vtkCutter()
cutter.SetCutFunction(plane)
cutter.SetInputConnection(reader.GetOutputPort())
layers = int(sys.argv[2])
for i in range(layers):
    cutter.SetValue(i, low + (i + 0.5) * (high - low) / layers)
start = time.perf_counter()
cutter.Update()
cut = time.perf_counter()
stripper = vtk.vtkStripper()
stripper.SetInputConnection(cutter.GetOutputPort())
stripper.SetMaximumLength(10**9)
stripper.Update()
print(cut - start, time.perf_counter() - cut, stripper.GetOutput().GetNumberOfLines())
"""


def run(command):
    """What it printed, and clock, CPU and memory of the process."""
    with tempfile.TemporaryFile() as said:
        start = time.perf_counter()
        process = subprocess.Popen(command, stdout=said, stderr=subprocess.STDOUT)
        _, status, used = os.wait4(process.pid, 0)
        clock = time.perf_counter() - start
        said.seek(0)
        text = said.read().decode(errors="replace")
    if status != 0:
        sys.exit(f"{command[0]} ended with status {os.waitstatus_to_exitcode(status)}: "
                 f"{text[-500:]}")
    return text, (clock, used.ru_utime + used.ru_stime, used.ru_maxrss / 1024)


def by_tool(tool, mesh, height, folder):
    report = os.path.join(folder, "report.json")
    _, whole = run([tool, "section", mesh, "--layers", repr(height / LAYERS), "-n", "-q", "-f",
                    "-r", report])
    with open(report, encoding="utf-8") as file:
        content = json.load(file)
    layers = content["files"][0]["layers"]
    loops = sum(layer["loops"] for layer in layers)
    return content["seconds"]["cut"], whole, f"{loops} loops, nested"


def by_vtk(mesh):
    text, whole = run(["/usr/bin/python3", "-c", VTK, mesh, str(LAYERS)])
    cut, join, lines = map(float, text.split())
    return cut + join, whole, f"{lines:.0f} polylines; segments alone {cut:.2f} s"


def by_slicer(mesh, height, folder):
    text, whole = run(["prusa-slicer", "--export-gcode", "--loglevel", "4", "--scale",
                       repr(100 / height),
                       "--layer-height", "0.1", "--first-layer-height", "0.1", "--perimeters", "1",
                       "--fill-density", "0%", "--top-solid-layers", "0", "--bottom-solid-layers",
                       "0",
                       "--skirts", "0", "--center", "100,100", "-o",
                       os.path.join(folder, "out.gcode"), mesh])
    def when(words):
        stamp = re.search(r"\[(\d+-\d+-\d+ [\d:.]+)\][^\n]*" + words, text).group(1)
        return datetime.datetime.fromisoformat(stamp)
    begin, repaired = when(r"repair\(\) started"), when(r"repair\(\) finished")
    start, end = when("slice_mesh to polygons"), when("make_slices in parallel - end")
    return ((end - start).total_seconds(), whole,
            f"polygons, nested; repair before {(repaired - begin).total_seconds():.2f} s")


def main():
    tool, mesh = sys.argv[1:3]
    times = int(sys.argv[3]) if len(sys.argv) > 3 else 3
    runs = {}
    with tempfile.TemporaryDirectory() as folder:
        report = os.path.join(folder, "info.json")
        run([tool, "info", "--measure-walls", "none", "-q", mesh, "-r", report])
        with open(report, encoding="utf-8") as file:
            box = json.load(file)["files"][0]["info"]["box"]
        height = box["max"][2] - box["min"][2]
        programs = {"tf-cut": lambda: by_tool(tool, mesh, height, folder)}
        if subprocess.run(["/usr/bin/python3", "-c", "import vtk"], check=False,
                          capture_output=True).returncode == 0:
            programs["VTK"] = lambda: by_vtk(mesh)
        if shutil.which("prusa-slicer"):
            programs["PrusaSlicer"] = lambda: by_slicer(mesh, height, folder)
        for _ in range(times):
            for name, program in programs.items():
                runs.setdefault(name, []).append(program())
    for name, all_runs in runs.items():
        step = statistics.median(one[0] for one in all_runs)
        clock, cpu, memory = (statistics.median(column)
                              for column in zip(*(one[1] for one in all_runs)))
        print(f"{name:12} {step:7.2f} s   process {clock:7.2f} s, {cpu:7.2f} s of CPU, "
              f"{memory:6.0f} MB   "
              f"{all_runs[-1][2]}")


if __name__ == "__main__":
    main()
