#!/usr/bin/env python3
"""links.py [SOURCE | --self-test]: every link of the documents leads somewhere.

Prints a line for each link of an .md file to a file or heading that is not there, and fails if
there is one. `site_faults` does the same for the pages of the API reference. Links to other sites
are not followed."""

import html
import pathlib
import re
import subprocess
import sys
import tempfile
import urllib.parse

LINK = re.compile(r"!?\[(?:[^][]|\[[^]]*\])*\]\(([^()\s]*)\)")
ELSEWHERE = re.compile(r"[a-z]+:")


def lines_of(text):
    """(number, line, whether it is prose): lines of code have no links and no headings."""
    fence = None
    for number, line in enumerate(text.splitlines(), 1):
        mark = re.match(r"\s*(```+|~~~+)", line)
        if mark and (fence is None or mark[1].startswith(fence)):
            fence = mark[1] if fence is None else None
            yield number, line, False
        else:
            yield number, line, fence is None and not line.startswith("    ")


def anchor_of(heading):
    """The name that GitHub gives a heading."""
    words = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", heading).strip().lower()
    return re.sub(r"[^\w\- ]", "", words).replace(" ", "-")


def anchors_of(text):
    return {anchor_of(match[1]) for _, line, prose in lines_of(text)
            if prose and (match := re.match(r"#+ (.*)", line))}


def links_of(text):
    prose = "\n".join(line if prose else "" for _, line, prose in lines_of(text))
    prose = re.sub(r"`[^`\n]*`", lambda code: "`" * len(code[0]), prose)
    for match in LINK.finditer(prose):
        yield prose.count("\n", 0, match.start()) + 1, match[1]


def documents(root):
    listed = subprocess.run(["git", "ls-files", "-z", "*.md"], cwd=root, capture_output=True)
    names = listed.stdout.decode().split("\0")[:-1] if listed.returncode == 0 else []
    found = [root / name for name in names] or [
        path for path in root.rglob("*.md")
        if path.relative_to(root).parts[0] not in ("build", "out", ".git")]
    return sorted(path for path in found if path.exists())


def faults(root):
    for path in documents(root):
        for number, link in links_of(path.read_text()):
            name, _, anchor = link.partition("#")
            target = (path.parent / name).resolve() if name else path
            if ELSEWHERE.match(link):
                continue
            if not target.exists():
                yield f"{path.relative_to(root)}:{number}: there is no {link}"
            elif anchor and target.suffix == ".md" and anchor not in anchors_of(target.read_text()):
                yield f"{path.relative_to(root)}:{number}: no heading is {link}"


def site_faults(folder):
    """Links of the pages of a folder to pages or places in them that are not there."""
    pages = {path.relative_to(folder).as_posix(): path.read_text()
             for path in folder.rglob("*.html")}
    places = {name: set(map(html.unescape, re.findall(r'\b(?:id|name)="([^"]*)"', text)))
              for name, text in pages.items()}
    for name, text in sorted(pages.items()):
        for link in sorted(set(re.findall(r'\b(?:href|src)="([^"]*)"', text))):
            if ELSEWHERE.match(link):
                continue
            file, _, place = urllib.parse.unquote(html.unescape(link)).partition("#")
            target = (folder / name).parent / file if file else folder / name
            inside = target.resolve().relative_to(folder.resolve()).as_posix()
            if not target.exists():
                yield f"{name}: there is no {link}"
            elif place and inside in places and place not in places[inside]:
                yield f"{name}: no place is {link}"


def self_test():
    with tempfile.TemporaryDirectory() as name:
        root = pathlib.Path(name)
        (root / "a.md").write_text("# One `two`, three\n[b](b.md#no) [c](c.md) [d\n"
                                   "e](#one-two-three)\n"
                                   "[e](https://e) `[f](g)`\n```\n[h](i)\n# no\n```\n    [j](k)\n")
        (root / "b.md").write_text("## yes\n[a](a.md#one-two-three)\n")
        said = list(faults(root))
        assert said == ["a.md:2: no heading is b.md#no", "a.md:2: there is no c.md"], said
        (root / "a.html").write_text('<a id="x" href="b.html"/><a href="#y"/><a href="#x"/>')
        said = list(site_faults(root))
        assert said == ["a.html: no place is #y", "a.html: there is no b.html"], said
    print("broken links are found")
    return 0


def main():
    if sys.argv[1:] == ["--self-test"]:
        return self_test()
    broken = list(faults(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".").resolve()))
    print("\n".join(broken) if broken else "every link leads somewhere")
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main())
