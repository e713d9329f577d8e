"""Where the programs come from that hil/run flies."""

import os
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "hil/command_line"))
import programs
from bad_input import BadInput
from programs import BuildFailed, Programs, programs_for

# Stands in for toolchains/setup and toolchains/build: notes what it was told.
_NOTE = '#!/bin/sh\necho "$(basename "$0") $*" >>"$(dirname "$0")/told"\n'


class ProgramsFor(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        self.toolchains = self.root / "toolchains"
        self.toolchains.mkdir()
        self.write(self.toolchains / "setup", _NOTE)
        self.write(self.toolchains / "build", _NOTE)
        said = os.environ.pop("EARSHOT_PROGRAMS", None)
        self.addCleanup(lambda: os.environ.update({"EARSHOT_PROGRAMS": said} if said else {}))
        self.addCleanup(lambda: os.environ.pop("EARSHOT_PROGRAMS", None))

    @staticmethod
    def write(path: Path, text: str) -> Path:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        path.chmod(0o755)
        return path

    def told(self) -> list[str]:
        note = self.toolchains / "told"
        return note.read_text().splitlines() if note.exists() else []

    def test_without_a_word_are_built_after_what_they_need_is_set_up(self):
        there = self.root / "build/release/bin"
        self.assertEqual(programs_for(self.root, None), Programs(there / "earshot-bench", there / "earshotd"))
        self.assertEqual(self.told(), ["setup build hil", "build release earshot-bench earshotd"])

    def test_are_not_built_when_the_set_up_fails(self):
        self.write(self.toolchains / "setup", _NOTE + "exit 1\n")
        with self.assertRaises(BuildFailed):
            programs_for(self.root, None)
        self.assertEqual(self.told(), ["setup build hil"])

    def test_are_none_when_the_build_fails(self):
        self.write(self.toolchains / "build", _NOTE + "exit 1\n")
        with self.assertRaises(BuildFailed):
            programs_for(self.root, None)

    def test_are_those_of_the_folder_that_the_variable_names_and_before_these_that_on_the_command_line(self):
        for folder in ("a", "b"):
            for name in ("earshotd", "earshot-bench"):
                self.write(self.root / folder / name, "#!/bin/sh\necho earshotd 1.2.3\n")
        os.environ["EARSHOT_PROGRAMS"] = str(self.root / "a")
        found = programs_for(self.root, None)
        self.assertEqual(found, Programs(self.root / "a/earshot-bench", self.root / "a/earshotd"))
        self.assertEqual(found.version(), "earshotd 1.2.3")
        self.assertEqual(programs_for(self.root, self.root / "b/earshotd").bench, self.root / "b/earshot-bench")
        self.assertEqual(self.told(), [])

    def test_must_be_programs(self):
        earshotd = self.write(self.root / "a/earshotd", "")
        self.write(self.root / "a/earshot-bench", "").chmod(0o644)
        with self.assertRaisesRegex(BadInput, "a/earshot-bench: no such program"):
            programs_for(self.root, earshotd)

    def test_say_no_version_when_they_are_no_programs_or_never_end(self):
        unknown = "an earshotd that does not give its version"
        self.assertEqual(Programs(Path("bench"), self.write(self.root / "text", "no program")).version(), unknown)
        self.assertEqual(Programs(Path("bench"), self.write(self.root / "silent", "#!/bin/sh\n")).version(), unknown)
        programs._MOST_S_TO_PRINT_A_VERSION = 0.2
        endless = self.write(self.root / "endless", "#!/bin/sh\nexec sleep 60\n")
        self.assertEqual(Programs(Path("bench"), endless).version(), unknown)


if __name__ == "__main__":
    unittest.main()
