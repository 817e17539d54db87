#!/usr/bin/env python3
"""count_tests.py RESULTS.xml: how many tests of a `ctest --output-junit` passed, failed and were
skipped, and how many test cases were skipped within tests that passed: four numbers.

count_tests.py --skipped RESULTS.xml: the names of tests that were skipped, or of which cases were,
a line each; count_tests.py --failed RESULTS.xml: of those that failed."""

import re
import sys
import xml.etree.ElementTree as xml

# What tests/support/main.cpp and tests/cli/support.py print.
CASES = re.compile(r"^(\d+) of \d+ test cases skipped, (\d+) in part$", re.MULTILINE)

passed = failed = skipped = cases = 0
names, broken = [], []
for test in xml.parse(sys.argv[-1]).getroot().iter("testcase"):
    reason = test.find("skipped")
    before = skipped + cases
    if test.get("status") == "run":
        passed += 1
        for match in CASES.finditer(test.findtext("system-out") or ""):
            cases += int(match[1]) + int(match[2])
    elif reason is not None and reason.get("message", "").startswith("SKIP_"):
        skipped += 1
    else:  # failed, or could not be run
        failed += 1
        broken.append(test.get("name"))
    if skipped + cases > before:
        names.append(test.get("name"))
if "--failed" in sys.argv:
    names = broken
if sys.argv[1].startswith("--"):
    print("\n".join(names))
else:
    print(passed, failed, skipped, cases)
