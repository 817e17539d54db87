#!/usr/bin/env python3
"""run_clang_tidy.py BUILD [-j N] [REGEX]: clang-tidy over the sources of libtree, libmesh and tools
(whose path matches) that BUILD compiles with Ninja, which has to have been built.

A source without findings is not looked at again until it, a header that it includes, its command,
.clang-tidy or clang-tidy changes: BUILD/clang-tidy remembers. Ends with a line of how many sources
passed and failed."""

import argparse
import concurrent.futures
import functools
import hashlib
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
# BUILD may be by GCC; and what is asserted is what clang-tidy may take for granted.
ARGUMENTS = ["--extra-arg=-Wno-unknown-warning-option", "--extra-arg=-UNDEBUG"]
FOLDERS = ("libtree/", "libmesh/", "tools/")


@functools.cache
def digest_of(path):
    return hashlib.sha256(path.read_bytes()).hexdigest()


def headers_of(build):
    """The files that each object was made from, as the compiler told Ninja."""
    listing = subprocess.run(["ninja", "-C", build, "-t", "deps"], check=True, text=True,
                             capture_output=True).stdout
    found, current = {}, None
    for line in listing.splitlines():
        if line.startswith("    "):
            current.append(build / line.strip())
        elif line:
            current = found.setdefault(line.split(":")[0], [])
    return found


def key_of(entry, headers, tool):
    """What the findings depend on."""
    made_from = [f"{path} {digest_of(path)}" for path in headers if path.exists()]
    text = "\n".join([tool, *ARGUMENTS, digest_of(ROOT / ".clang-tidy"), entry["command"],
                      *made_from])
    return hashlib.sha256(text.encode()).hexdigest()


def findings(build, file):
    done = subprocess.run(["clang-tidy", "-p", build, "--quiet", *ARGUMENTS, file], text=True,
                          capture_output=True)
    return done.stdout.strip() if done.returncode or "warning:" in done.stdout else ""


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("build", type=lambda name: pathlib.Path(name).resolve())
    parser.add_argument("-j", dest="jobs", type=int, default=os.cpu_count())
    parser.add_argument("regex", nargs="?", default="")
    options = parser.parse_intermixed_args()
    if not shutil.which("clang-tidy"):
        print("skipped: no clang-tidy")
        return 77

    tool = subprocess.run(["clang-tidy", "--version"], text=True, capture_output=True).stdout
    clean = options.build / "clang-tidy"
    clean.mkdir(exist_ok=True)
    headers = headers_of(options.build)
    waiting, passed, failed = {}, 0, 0
    for entry in json.loads((options.build / "compile_commands.json").read_text()):
        file = pathlib.Path(entry["file"])
        name = file.relative_to(ROOT).as_posix() if file.is_relative_to(ROOT) else ""
        if not name.startswith(FOLDERS) or not re.search(options.regex, name):
            continue
        made = re.search(r" -o (\S+)", entry["command"])[1]
        if made not in headers:
            sys.exit(f"{name} has not been compiled in {options.build}")
        if (clean / (key := key_of(entry, headers[made], tool))).exists():
            passed += 1
        else:
            waiting[file] = key

    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        results = {pool.submit(findings, options.build, file): file for file in waiting}
        for result in concurrent.futures.as_completed(results):
            if result.result():
                failed += 1
                print(result.result(), flush=True)
            else:
                passed += 1
                (clean / waiting[results[result]]).touch()
    print(f"{passed} passed, {failed} failed")
    return 1 if failed or not passed else 0


if __name__ == "__main__":
    sys.exit(main())
