"""What PyPI's junitparser, as a CI server would, reads in a JUnit report."""

import unittest

from bench_example import calm, deaf, results_of
from junitparser import Failure, JUnitXml

from junit_report import junit_report


class JunitReport(unittest.TestCase):
    def setUp(self):
        self.read = JUnitXml.fromstring(junit_report(results_of(calm(), deaf()), []))
        (self.suite,) = self.read
        self.calm, self.deaf = self.suite

    def test_counts_what_passed_and_what_failed(self):
        for counted in (self.read, self.suite):
            self.assertEqual((counted.tests, counted.failures, counted.errors, counted.time), (2, 1, 0, 25.0))

    def test_agrees_with_a_count_of_its_cases(self):
        self.suite.update_statistics()
        self.assertEqual((self.suite.tests, self.suite.failures, self.suite.time), (2, 1, 25.0))

    def test_names_every_case_and_its_time(self):
        named = [(case.name, case.classname, case.time) for case in self.suite]
        self.assertEqual(named, [("calm", "hil.bench", 12.5), ("deaf", "hil.bench", 12.5)])

    def test_says_what_is_wrong(self):
        self.assertTrue(self.calm.is_passed)
        (failure,) = self.deaf.result
        self.assertIsInstance(failure, Failure)
        self.assertEqual(failure.message, "the rule hydrophone_deaf did not fire")
        self.assertEqual(failure.text, "the rule hydrophone_deaf did not fire\nthe rule leak fired at 600 s")

    def test_has_what_was_not_flown_as_skipped(self):
        (suite,) = JUnitXml.fromstring(junit_report(results_of(calm()), ["leak"]))
        self.assertEqual((suite.tests, suite.failures, suite.skipped), (2, 0, 1))
        _, leak = suite
        self.assertEqual((leak.name, leak.is_skipped), ("leak", True))

    def test_tells_the_story_of_a_case(self):
        self.assertIn("WHEN the hydrophone is open for a while\n", self.deaf.system_out)
        self.assertIn("deaf from 500 s for 500 s\n", self.deaf.system_out)

    def test_can_be_read_whatever_a_case_says(self):
        hostile = "]]><x> & \x00\x1b\ud800\uffff"
        entry = deaf() | {"name": hostile, "wrong": [hostile], "given": hostile}
        ((case,),) = JUnitXml.fromstring(junit_report(results_of(entry), []))
        self.assertEqual(case.name, "]]><x> & \\u0000\\u001b\\ud800\\uffff")
        self.assertEqual(case.result[0].text, case.name)


if __name__ == "__main__":
    unittest.main()
