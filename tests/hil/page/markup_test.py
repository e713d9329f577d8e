"""What no reader could take, and what would turn the direction of writing, in a text and in all texts of a page."""

import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "hil/page"))
from markup import printable_values


class PrintableValues(unittest.TestCase):
    def test_spell_out_marks_and_controls_and_keep_lines_numbers_and_all_other_letters(self):
        content = {
            "cases": [{"name": "\u202e\x1b[2J", "end": "a\n\tb", "limit": None, "passed": True, "time_s": 1.5}, "<ä✓>"]
        }
        told = {
            "cases": [
                {"name": "\\u202e\\u001b[2J", "end": "a\n\tb", "limit": None, "passed": True, "time_s": 1.5},
                "<ä✓>",
            ]
        }
        self.assertEqual(printable_values(content), told)


if __name__ == "__main__":
    unittest.main()
