"""No name in code holds a word that only Earshot's authors know. Run by ctest."""

import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import names

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
ROWS = names.read_rows(HERE / "forbidden_words.txt")
# Names that another library or a format gives.
EXCEPTED = {
    ("sim/recording/sound_file.cpp", "tell"): "libsndfile's",
    ("sim/link/runtime_end.cpp", "surprise_bits"): "of sim.idl",
    ("sim/link/simulator_end.cpp", "surprise_bits"): "of sim.idl",
}


def found(path: str, text: str) -> list[str]:
    return [name for _, name, _ in names.forbidden(path, text, ROWS)]


class Names(unittest.TestCase):
    def test_are_found_however_they_are_spelt(self):
        for name in [
            "HandOver",
            "hand_over",
            "kHandOver",
            "hand_over_",
            "looks_of_leg",
            "kNearLooks",
            "tell_chain",
            "ToldX",
        ]:
            self.assertEqual(found("sim/a.cpp", f"int {name} = 1;\n"), [name])
            self.assertEqual(found("sim/a.py", f"{name} = 1\n"), [name])
        self.assertEqual(found("sim/doorbell.hpp", "int a;\n"), ["doorbell"])

    def test_are_given_with_their_line_and_what_to_write(self):
        [(line, name, instead)] = names.forbidden("sim/a.cpp", "int a;\nint looks;\n", ROWS)
        self.assertEqual((line, name), (2, "looks"))
        self.assertIn("measurement", instead)

    def test_are_left_in_strings_comments_includes_and_larger_words(self):
        text = (
            '#include "a/doorbell.hpp"\n// looks\n/* told */ int overlooked = f("looks", R"(told)", \'t\', 1\'000);\n'
        )
        self.assertEqual(found("sim/a.cpp", text), [])
        self.assertEqual(found("sim/a.py", 'a = "looks"  # looks\n"""told"""\n'), [])

    def test_are_left_where_they_are_those_of_tests(self):
        self.assertEqual(found("tests/a.cpp", "TEST(One, LooksAtAll) {}\nTEST_F(Two, IsTold) {}\n"), [])
        self.assertEqual(found("tests/a.py", "def test_it_looks_at_all(): pass\n"), [])

    def test_may_say_in_tests_what_was_said(self):
        self.assertEqual(found("tests/a.cpp", "int told;\n"), [])
        self.assertEqual(found("hil/a.cpp", "int told;\n"), ["told"])


class Code(unittest.TestCase):
    def test_has_no_name_that_only_its_authors_know(self):
        command = ["git", "ls-files", "-z", "-co", "--exclude-standard"]
        listed = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout
        problems = []
        for path in sorted({name for name in listed.split("\0") if name}):
            if (ROOT / path).is_symlink() or not (ROOT / path).is_file():
                continue
            try:
                text = (ROOT / path).read_text()
            except UnicodeDecodeError:
                continue
            for line, name, instead in names.forbidden(path, text, ROWS):
                if (path, name) not in EXCEPTED:
                    problems.append(f"{path}:{line}: {name}: write {instead}")
        self.assertEqual(problems, [], "\n".join(problems))

    def test_keeps_a_name_of_another_only_where_it_is_needed(self):
        for path, name in EXCEPTED:
            self.assertIn(name, found(path, (ROOT / path).read_text()), f"{path}: no longer there")


if __name__ == "__main__":
    unittest.main()
