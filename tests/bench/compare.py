#!/usr/bin/env python3
"""compare.py OLD NEW [--pairs N] [--out DIR] [--] [BENCH OPTION...]: the times of two builds of the
bench, as ratios new / old.

OLD and NEW are bench programs, each run in turn N times (20), with `--only treeform` and the
options that follow: `--models DIR`, `--cache DIR` (required), `--quick`, ids such as B1 B5. Which
is first changes from pair to pair. A pair gives a ratio for each case; that of a workload is the
geometric mean of its cases. The median over the pairs is printed, with an interval that holds it in
95 of 100 series (by ranks, whatever the distribution). DIR/ratios.csv gets all of them."""

import argparse
import collections
import csv
import math
import pathlib
import statistics
import subprocess
import sys
import tempfile


def times_of(program, options):
    """{(id, case, size, threads): a time, or one over a rate}"""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, "--only", "treeform", "--out", folder, *options], check=True,
                       stdout=subprocess.DEVNULL)
        with open(pathlib.Path(folder) / "bench.csv") as file:
            rows = [row for row in csv.DictReader(file) if float(row["value"] or 0) > 0]
    found = {}
    for row in rows:
        key = tuple(row[name] for name in ("id", "case", "size", "threads", "unit"))
        value = float(row["value"])
        if row["unit"].endswith("/s"):
            found[key] = 1 / value
        elif row["unit"].split("/")[0] in ("s", "ms", "us", "ns"):
            found[key] = value
    return found


def interval(values):
    """The median, and the closest ranks between which it lies in 95 of 100 series."""
    ordered, n = sorted(values), len(values)
    low, below = 0, 0.5**n  # probability that at most `low` values are below the median
    while low + 1 < n // 2 and below + math.comb(n, low + 1) * 0.5**n <= 0.025:
        low += 1
        below += math.comb(n, low) * 0.5**n
    return statistics.median(ordered), ordered[low], ordered[n - 1 - low]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("old")
    parser.add_argument("new")
    parser.add_argument("--pairs", type=int, default=20)
    parser.add_argument("--out", type=pathlib.Path)
    options, bench = parser.parse_known_args()
    bench = [word for word in bench if word != "--"]

    ratios = collections.defaultdict(list)
    for pair in range(options.pairs):
        order = ("old", "new") if pair % 2 == 0 else ("new", "old")
        times = {which: times_of(getattr(options, which), bench) for which in order}
        workloads = collections.defaultdict(list)
        for key in sorted(times["old"].keys() & times["new"].keys()):
            ratio = times["new"][key] / times["old"][key]
            ratios[key].append(ratio)
            workloads[key[0]].append(math.log(ratio))
        for name, logs in workloads.items():
            ratios[(name, "all", str(len(logs)), "", "")].append(math.exp(statistics.mean(logs)))
        print(f"pair {pair + 1} of {options.pairs}", file=sys.stderr)

    slower = 0
    print("new / old, median of the pairs [95 % interval]")
    for key, values in sorted(ratios.items()):
        middle, low, high = interval(values)
        if key[1] == "all":
            slower += low > 1.0
            print(f"{key[0]:4} {key[2]:>3} cases  {middle:.3f} [{low:.3f}, {high:.3f}]")
    if options.out:
        options.out.mkdir(parents=True, exist_ok=True)
        with open(options.out / "ratios.csv", "w", newline="") as file:
            rows = csv.writer(file)
            rows.writerow(["id", "case", "size", "threads", "unit", "median", "low", "high"])
            for key, values in sorted(ratios.items()):
                rows.writerow([*key, *(f"{x:.4f}" for x in interval(values))])
    return 1 if slower else 0


if __name__ == "__main__":
    sys.exit(main())
