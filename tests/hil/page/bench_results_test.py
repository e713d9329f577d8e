"""What is read of a file of results, and what is refused."""

import json
import tempfile
import unittest
from pathlib import Path

from bench_example import calm, deaf, results_of

from bench_results import BadResults, read_results


class ReadsResults(unittest.TestCase):
    def test_every_case_in_order(self):
        read = results_of(deaf(), calm())
        self.assertEqual([(case.name, case.passed) for case in read], [("deaf", False), ("calm", True)])
        self.assertEqual(
            (read[0].faults, read[0].wrong[1]), (["deaf from 500 s for 500 s"], "the rule leak fired at 600 s")
        )

    def test_all_that_was_written_for_the_page(self):
        self.assertEqual([case.written for case in results_of(deaf(), calm())], [deaf(), calm()])


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

    def test_a_case_without_a_key_that_junit_is_given(self):
        for key in ("name", "given", "when", "then", "bus", "passed", "wrong", "faults", "end", "wall_s"):
            entry = calm()
            del entry[key]
            self.assertIn(f"{key} is missing", self.refused(json.dumps({"cases": [entry]})))

    def test_a_case_that_passed_and_has_something_wrong(self):
        for entry in (calm() | {"passed": False}, deaf() | {"passed": True}):
            self.assertIn("contradict each other", self.refused(json.dumps({"cases": [entry]})))


if __name__ == "__main__":
    unittest.main()
