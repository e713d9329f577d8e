"""What is read of a file of results, and what is refused."""

import json
import tempfile
import unittest
from pathlib import Path

from bench_example import calm, deaf, results_of

from bench_results import BadResults, Place, read_results


class ReadsResults(unittest.TestCase):
    def test_every_case_in_order(self):
        read = results_of(deaf(), calm())
        self.assertEqual([(case.name, case.passed) for case in read], [("deaf", False), ("calm", True)])
        self.assertEqual(read[0].source, Place(north_m=4000.0, east_m=3000.0))
        self.assertEqual(read[0].track[1].place, Place(north_m=4000.0, east_m=2000.0))
        self.assertEqual(read[0].counts["frames_received"], 41000)

    def test_a_number_that_json_cannot_hold_as_none(self):
        (read,) = results_of(deaf())
        self.assertIsNone(read.events[0].limit)

    def test_the_first_rule_that_fired_and_not_one_that_ended(self):
        ends, fires = deaf()["events"][1], deaf()["events"][0]
        (read,) = results_of(deaf() | {"events": [ends, fires | {"rule": "battery_percent"}]})
        assert read.first_firing
        self.assertEqual(read.first_firing.rule, "battery_percent")

    def test_a_fault_from_its_beginning_until_just_before_its_end(self):
        (read,) = results_of(deaf())
        acts = [read.faults[0].acts_at(time) for time in (499.9, 500.0, 999.9, 1000.0)]
        self.assertEqual(acts, [False, True, True, False])


class Refuses(unittest.TestCase):
    def refused(self, text: str) -> str:
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder, "results.json")
            file.write_text(text)
            with self.assertRaises(BadResults) as refusal:
                read_results(file)
            self.assertIn(str(file), str(refusal.exception))
            return str(refusal.exception)

    def test_a_file_that_is_not_there(self):
        with self.assertRaisesRegex(BadResults, "/no/such/file: No such file or directory"):
            read_results(Path("/no/such/file"))

    def test_what_is_no_file_of_results(self):
        for text in ("", "{", "[]", "7", '{"cases": 7}', '{"cases": [7]}'):
            self.assertIn("not what earshot-bench writes", self.refused(text), text)

    def test_a_case_without_one_of_its_keys(self):
        for key in calm():
            entry = calm()
            del entry[key]
            self.assertIn(f"{key} is missing", self.refused(json.dumps({"cases": [entry]})))

    def test_a_case_that_passed_and_has_something_wrong(self):
        for entry in (calm() | {"passed": False}, deaf() | {"passed": True}):
            self.assertIn("contradict each other", self.refused(json.dumps({"cases": [entry]})))


if __name__ == "__main__":
    unittest.main()
