#!/usr/bin/env python3
"""check_docs.py [SOURCE | --self-test]: docstrings of public headers are as they were written.

A tag (\\pre, \\throws, ...) starts its line, and what goes on in the next lines is indented, until
an empty line, the next tag or the end of the comment. Nor are there lines of a word or two within a
paragraph: they are what clang-format leaves of a line that has become too long."""

import pathlib
import re
import sys

TAGS = "file|pre|post|throws|cost|same|source|return|param|tparam|note|see|brief"
DOC = re.compile(r"^(\s*)///(?!<)(.*)$")
TAG = re.compile(rf"^ (\\(?:{TAGS})\b)(.*)$")
INSIDE = re.compile(rf"\S.*\\(?:{TAGS})\b")
SHORT = 25  # columns of a line, with the first word of the next one


def is_broken(line, following):
    """True for a line that ends after a word or two, in the middle of a sentence."""
    indentation = len(line) - len(line.lstrip())
    return (re.match(r"\s*[\w`]", following) is not None
            and indentation == len(following) - len(following.lstrip())
            and len(line) + len(following.split()[0]) < SHORT + indentation
            and not re.search(r"[.:;,|]$|^\s*$|\\", line))


def faults(text):
    """(line, what is wrong) of each line of a docstring that is not as it should be."""
    tag = None  # of the paragraph that the line belongs to
    before = "."
    for number, line in enumerate(text.splitlines(), 1):
        match = DOC.match(line)
        if not match:
            tag, before = None, "."
            if re.search(rf"//.*\\(?:{TAGS})\b", line):
                yield number, "a tag after code"
            continue
        words = match[2]
        if is_broken(before, words):
            yield number - 1, "a broken line"
        before = words
        found = TAG.match(words)
        if found:
            tag = found[1]
            words = found[2]
            if tag == "\\file" and words.strip():
                yield number, "\\file stands alone"
            elif tag != "\\file" and not words.strip():
                yield number, f"{tag} says nothing in its line"
            if re.search(rf"\\(?:{TAGS})\b", words):
                yield number, "a second tag in one line"
        elif INSIDE.search(words) or re.match(rf"\s*\\(?:{TAGS})\b", words):
            yield number, "a tag that does not start its line"
        elif not words.strip() or tag == "\\file":
            tag = None  # what follows \file is the text of the file
        elif tag and not words.startswith("    "):
            yield number, f"goes on with {tag}, and is not indented"
            tag = None


GOOD = r"""
/// \file
/// What the file is about.

/// What the caller gets.
///
/// \pre    every coordinate is finite, and
///         every corner is a vertex
/// \throws io_error
/// \same   on any number of threads
int f();  ///< a side note
"""
GARBLED = [
    r"/// The mesh. \throws io_error",
    "/// \\throws io_error when a point as written, or some square of a distance\n"
    "/// in about the\n"
    "///         diagonals of the mesh, is beyond the range of doubles",
    "/// The mesh of a file, as it is stored, with all of its\n/// points\n/// and all of its "
    "faces.",
    r"/// \pre    \throws as for the other",
    "/// \\throws\n///         io_error",
    r"///    \cost O(V)",
    r"int f();  ///< \pre nothing",
]


def self_test():
    assert not list(faults(GOOD)), list(faults(GOOD))
    for example in GARBLED:
        assert list(faults(example)), example
    print("what is garbled is found")


def main():
    if sys.argv[1:] == ["--self-test"]:
        return self_test()
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")
    broken = [f"{path.relative_to(root)}:{line}: {what}"
              for pattern in ("lib*/include/**/*.h*", "tools/*/include/**/*.h")
              for path in sorted(root.glob(pattern))
              for line, what in faults(path.read_text())]
    print("\n".join(broken) if broken else "every docstring is whole")
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main())
