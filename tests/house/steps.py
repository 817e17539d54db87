#!/usr/bin/env python3
"""What each step of building and testing takes.

steps.py run STEP FOLDER COMMAND...   runs the command, which builds or tests in FOLDER, and notes
                                      what it took in build/steps.jsonl
steps.py slowest FOLDER               what a build folder took by kind, and its slowest 20 objects
and
                                      tests
steps.py report [--write]             the steps as a table, and which of them have grown by a fifth
                                      over the table in CONTRIBUTING.md, which --write replaces
steps.py yardstick                    CPU seconds of compiling one file

CPU time is that of all processes. Machines differ, so that it is compared as a multiple of what one
file of the project takes to compile. A step whose objects came from a compiler cache is not
compared, except for the number of its objects. Status 1: a step takes half as much again, or has
a fifth more objects: what one machine does faster than another differs by less."""

import json
import os
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree as xml

ROOT = pathlib.Path(__file__).resolve().parents[2]
NOTES = ROOT / "build/steps.jsonl"
TABLE = ROOT / "CONTRIBUTING.md"
GROWN, FAILED = 1.2, 1.5
YARDSTICK = "libtree/query/nearness_pair.cpp"


def cpu_of_children():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def edges(folder):
    """(seconds, output) of what ninja has made in the folder, the last time each."""
    log = folder / ".ninja_log"
    made = {}
    for line in log.read_text().splitlines() if log.exists() else []:
        parts = line.split("\t")
        if len(parts) == 5:
            made[parts[3]] = (int(parts[1]) - int(parts[0])) / 1000, parts[3], parts[2]
    return made


def compiled(output):
    return output.endswith((".o", ".gch"))


def tests_in(folder):
    """(seconds, name) of the last run of ctest there."""
    results = folder / "results.xml"
    if not results.exists():
        return []
    return [(float(test.get("time", 0)), test.get("name"))
            for test in xml.parse(results).getroot().iter("testcase")]


def run(step, folder, command):
    folder = pathlib.Path(folder)
    results = folder / "results.xml"
    before, stamp = edges(folder), results.stat().st_mtime if results.exists() else 0
    with tempfile.NamedTemporaryFile() as log:
        cpu, start = cpu_of_children(), time.time()
        status = subprocess.run(command, env=dict(os.environ, CCACHE_STATSLOG=log.name)).returncode
        cpu, wall = cpu_of_children() - cpu, time.time() - start
        cached = len(re.findall(r"cache_hit$", pathlib.Path(log.name).read_text(), re.MULTILINE))
    after = edges(folder)
    objects = sum(compiled(name) for name, made in after.items() if before.get(name) != made)
    ran = results.exists() and results.stat().st_mtime != stamp
    NOTES.parent.mkdir(exist_ok=True)
    with NOTES.open("a") as notes:
        notes.write(json.dumps({"step": step, "cpu": round(cpu, 1), "wall": round(wall, 1),
                                "objects": objects, "cached": min(cached, objects),
                                "tests": len(tests_in(folder)) if ran else 0}) + "\n")
    return status


KINDS = [("libtree/", "libtree"), ("libmesh/", "libmesh"), ("tools/python/", "Python"),
         ("tools/c/", "C"), ("tools/", "tools"), ("tests/unit/", "unit tests"),
         ("tests/oracle/", "oracle tests"), ("tests/stress/", "stress tests"), ("", "other tests")]


def kind_of(output):
    where = next(kind for prefix, kind in KINDS if output.startswith(prefix))
    if compiled(output):
        return f"{where}, compiled"
    if output.endswith((".a", ".so")) or ".so." in output or "." not in output.rsplit("/", 1)[-1]:
        return "linked"
    return "generated"


def slowest(folder):
    folder = pathlib.Path(folder)
    kinds = {}
    for seconds, output, _ in edges(folder).values():
        count, sum_of = kinds.get(kind_of(output), (0, 0))
        kinds[kind_of(output)] = count + 1, sum_of + seconds
    print(f"\nwhat was made in {folder}, and the seconds that it took, of which several run at a "
          f"time")
    for kind, (count, seconds) in sorted(kinds.items(), key=lambda one: -one[1][1]):
        print(f"{seconds:8.1f}  {count:4}  {kind}")
    for what, rows in ("objects", [made[:2] for made in edges(folder).values()
                                   if compiled(made[1])]), ("tests", tests_in(folder)):
        print(f"\nthe slowest {what} of {folder}, in seconds")
        for seconds, name in sorted(rows, reverse=True)[:20]:
            print(f"{seconds:8.1f}  {name}")


def yardstick():
    """CPU seconds of compiling one file; the least of three times."""
    compiler = os.environ.get("CXX") or shutil.which("c++")
    command = [compiler, "-std=c++20", "-O3", "-ffp-contract=off", "-I.", "-Ilibtree/include", "-c",
               YARDSTICK, "-o", os.devnull]
    times = []
    for _ in range(3):
        cpu = cpu_of_children()
        subprocess.run(command, cwd=ROOT, check=True)
        times.append(cpu_of_children() - cpu)
    return min(times)


def noted():
    """The last note of each step, in the order in which steps were first noted."""
    steps = {}
    for line in NOTES.read_text().splitlines():
        note = json.loads(line)
        steps[note["step"]] = note
    return steps


HEADING = ["| step | CPU s | wall s | objects | tests |", "|---|---:|---:|---:|---:|"]
ROW = re.compile(r"^\| ([^|]+) \| (\d+) \| (\d+) \| (\d+) \| (\d+) \|$", re.MULTILINE)
UNIT = re.compile(r"takes (\d+\.\d+) s of CPU")


def report(write):
    steps, unit = noted(), yardstick()
    text = TABLE.read_text()
    known = {row[0]: [int(cell) for cell in row[1:]] for row in ROW.findall(text)}
    known_unit = UNIT.search(text)
    print(f"\n{YARDSTICK} takes {unit:.2f} s of CPU")
    print("\n".join(HEADING))
    grown, failed = [], False
    for step, note in steps.items():
        row = [round(note["cpu"]), round(note["wall"]), note["objects"], note["tests"]]
        cold = note["cached"] <= 0.1 * note["objects"]
        print(f"| {step} | {' | '.join(map(str, row))} |"
              + ("" if cold else f" {note['cached']} objects from the cache"))
        if step in known and known_unit:
            scale = unit / float(known_unit[1])
            expected = scale * known[step][0]
            if cold and note["cpu"] > GROWN * expected:
                grown.append(f"{step}: {row[0]} s of CPU, {expected:.0f} expected")
                failed = failed or note["cpu"] > FAILED * expected
            if known[step][2] and note["objects"] > GROWN * known[step][2]:
                grown.append(f"{step}: {row[2]} objects, {known[step][2]} expected")
                failed = True
        if write and cold:
            known[step] = row
    for line in grown:
        print("grown by a fifth or more:", line)
    if write:
        rows = [f"| {step} | {' | '.join(map(str, row))} |" for step, row in known.items()]
        text = re.sub(re.escape(HEADING[0]) + r"\n(\|.*\n)*", "\n".join(HEADING + rows) + "\n",
                      text)
        TABLE.write_text(UNIT.sub(f"takes {unit:.2f} s of CPU", text))
    return failed


if __name__ == "__main__":
    if len(sys.argv) > 4 and sys.argv[1] == "run":
        sys.exit(run(sys.argv[2], sys.argv[3], sys.argv[4:]))
    if len(sys.argv) == 3 and sys.argv[1] == "slowest":
        sys.exit(slowest(sys.argv[2]))
    if sys.argv[1:] in (["report"], ["report", "--write"]):
        sys.exit(report("--write" in sys.argv))
    if sys.argv[1:] == ["yardstick"]:
        sys.exit(print(f"{yardstick():.2f}"))
    sys.exit(__doc__)
