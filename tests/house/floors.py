#!/usr/bin/env python3
"""floors.py [SOURCE] [--check]: the floors of libmesh as CONTRIBUTING.md shows them.

A line for each room, top down, with the rooms whose headers it includes. The floors are those of
check_layout.py, the includes those of the sources. With --check, fails unless the document has what
is printed, between its two marks."""

import pathlib
import sys

import check_layout

BEGIN, END = "<!-- floors -->\n", "<!-- end of floors -->\n"


def drawing(root):
    """A Markdown code block: it reads the same on GitHub and in a terminal."""
    used = {}
    for _, _, _, room, target in check_layout.room_includes(root):
        if room and target and room != target:
            used.setdefault(room, set()).add(target)
    floors = check_layout.FLOORS
    # of includes: from the bottom up
    order = [room for floor in reversed(floors) for room in floor]
    lines = ["floor  room        includes"]
    for number, floor in enumerate(floors):
        for room in floor:
            height = len(floors) - number if room == floor[0] else ""
            below = " ".join(other for other in order if other in used.get(room, ()))
            lines.append(f"{height:>5}  {room:<12}{below}".rstrip())
    return "```text\n" + "\n".join(lines) + "\n```\n"


def main():
    arguments = [argument for argument in sys.argv[1:] if argument != "--check"]
    root = pathlib.Path(arguments[0] if arguments else ".").resolve()
    drawn = drawing(root)
    if "--check" not in sys.argv:
        print(drawn, end="")
        return 0
    if BEGIN + drawn + END in (root / "CONTRIBUTING.md").read_text():
        print("CONTRIBUTING.md shows the floors as they are")
        return 0
    print("CONTRIBUTING.md does not show the floors as they are; between its marks it should say:")
    print(drawn, end="")
    return 1


if __name__ == "__main__":
    sys.exit(main())
