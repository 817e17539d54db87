"""How these tests are run: from the top of the tree, where data/ is; skipped cases are counted."""

import os
import sys

import hypothesis
import pytest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
hypothesis.settings.register_profile("tests", database=None, derandomize=True, deadline=None)
hypothesis.settings.load_profile("tests")
os.chdir(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))


def pytest_terminal_summary(terminalreporter):
    stats = terminalreporter.stats
    skipped = len(stats.get("skipped", []))
    count = sum(len(stats.get(kind, [])) for kind in ("passed", "failed", "skipped"))
    if skipped:
        terminalreporter.write_line(f"\n{skipped} of {count} test cases skipped, 0 in part")


def pytest_sessionfinish(session, exitstatus):
    """What CTest takes for a skipped test: nothing failed, nothing passed."""
    reporter = session.config.pluginmanager.getplugin("terminalreporter")
    if exitstatus == pytest.ExitCode.OK and not reporter.stats.get("passed"):
        session.exitstatus = 77
