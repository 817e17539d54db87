"""What the tests of packages share: runs the test cases of a script and closes with how many
passed, failed and were skipped, as the scripts in bash do."""

import sys
import unittest


def main(name):
    sys.dont_write_bytecode = True
    suite = unittest.defaultTestLoader.loadTestsFromModule(sys.modules["__main__"])
    result = unittest.TextTestRunner(stream=sys.stdout, verbosity=0).run(suite)
    failed = len(result.failures) + len(result.errors)
    for case, why in result.skipped:
        print(f"skipped: {case}: {why}")
    print(f"{result.testsRun - failed - len(result.skipped)} passed: {name}")
    if result.skipped:
        print(f"{len(result.skipped)} skipped")
    if failed:
        print(f"{failed} failed")
    sys.exit(failed > 0)
