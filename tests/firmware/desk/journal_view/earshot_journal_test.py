"""The journal that write_known_journal writes, read by Python's earshot_journal.

usage: earshot_journal_test.py EARSHOT_JOURNAL WRITE_KNOWN_JOURNAL
"""

import subprocess
import sys
import tempfile
import unittest
from collections import Counter
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[4] / "firmware/desk/journal_view"))
import earshot_journal

PROGRAM, WRITER = "", ""
BEGAN_S = 1_795_359_840  # 2026-11-22 15:04:00 UTC


class ReadInPython(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.journal = Path(folder.name) / "journal"

    def write(self, *options: str) -> None:
        subprocess.run([WRITER, self.journal, *options], check=True)

    def records(self) -> list[earshot_journal.Record]:
        return list(earshot_journal.records(self.journal, (PROGRAM,)))

    def test_has_every_record_with_its_number_date_topic_and_fields(self) -> None:
        self.write()
        records = self.records()
        self.assertEqual([record.number for record in records], list(range(len(records))))
        counts = Counter(record.topic for record in records)
        self.assertEqual((counts["mission"], counts["health"], counts["decision"], counts["journal_end"]), (1, 4, 1, 1))
        mission = records[0]
        self.assertEqual((mission.topic, mission.channel, int(mission.time_s)), ("mission", "EARSHOT_MISSION", BEGAN_S))
        health = [record.fields["state"] for record in records if record.topic == "health"]
        self.assertIn("SEARCH", health)

    def test_has_the_lines_of_the_program(self) -> None:
        self.write()
        printed = subprocess.run([PROGRAM, self.journal], check=True, capture_output=True, text=True).stdout
        events = earshot_journal.events(self.journal, (PROGRAM,))
        self.assertEqual(events, printed.splitlines())
        self.assertEqual(len(events), 13)

    def test_warns_of_a_journal_without_its_end_and_gives_what_is_there(self) -> None:
        self.write("3")
        with self.assertWarnsRegex(earshot_journal.JournalWarning, "end"):
            records = self.records()
        self.assertEqual([record.topic for record in records], ["health"] * 3)

    def test_refuses_what_is_no_journal_with_the_words_of_the_program(self) -> None:
        self.journal.write_text("no journal")
        with self.assertRaisesRegex(ValueError, "journal: "):
            self.records()


if __name__ == "__main__":
    WRITER, PROGRAM = sys.argv.pop(), sys.argv.pop()
    unittest.main()
