"""Every test is of one tier, and the tier `unit` is large: tests/README.md."""

import json
import subprocess
import sys
import unittest
from collections import Counter

TIERS = ("unit", "integration", "long")
LEAST_UNIT_TESTS = 2500
BUILD = ""


def tiers() -> dict[str, list[str]]:
    """The tiers of each test that is built, by its name."""
    listed = subprocess.run(
        ["ctest", "--test-dir", BUILD, "--show-only=json-v1"], capture_output=True, text=True, check=True
    )
    found = {}
    for test in json.loads(listed.stdout)["tests"]:
        if test["name"].endswith("_NOT_BUILT"):
            continue
        properties = {one["name"]: one["value"] for one in test.get("properties", [])}
        words = [label.split()[0] for label in properties.get("LABELS", [])]
        found[test["name"]] = [word for word in words if word in TIERS]
    return found


class Tiers(unittest.TestCase):
    def test_every_test_has_one(self):
        self.assertEqual([name for name, of_test in tiers().items() if len(of_test) != 1], [])

    def test_unit_tests_are_many(self):
        counts = Counter(tier for of_test in tiers().values() for tier in of_test)
        if counts["unit"] < LEAST_UNIT_TESTS:
            self.skipTest(f"{counts['unit']} of them are built")  # of a build of a few programs nothing follows


if __name__ == "__main__":
    BUILD = sys.argv.pop(1)
    unittest.main()
