"""No word that only Earshot's authors know is in what programs print and pages show. Run by ctest."""

import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import literals
import prose

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
GLOSSARY = (ROOT / "toolchains/docs/site/help/glossary.md").read_text()
WORDS = prose.read_words(HERE / "forbidden_words.txt")


def exceptions() -> list[tuple[str, str, str]]:
    lines = (HERE / "excepted_literals.txt").read_text().splitlines()
    rows = [line.split(" | ") for line in lines if line and not line.startswith("#")]
    return [(file, literal, reason) for file, literal, reason in rows]


class Literals(unittest.TestCase):
    def test_of_cpp_are_strings_and_neither_comments_nor_includes(self):
        text = '#include "told.hpp"\n// "told"\nsay("one \\" two", \'"\', R"(three\n"four")"); /* "five" */\n'
        self.assertEqual(literals.of_cpp(text), [(3, 'one \\" two'), (3, 'three\n"four"')])

    def test_of_python_are_strings_and_no_docstrings_but_that_which_is_printed(self):
        text = '"""Head."""\ndef f():\n    """Doc."""\n    return f"a {1} b"\n'
        self.assertEqual([t for _, t in literals.of_python(text)], ["a ", " b"])
        self.assertEqual(literals.of_python(text + "print(__doc__)\n")[0], (1, "Head."))

    def test_of_a_script_are_its_head_and_what_it_prints(self):
        text = "#!/bin/sh\n# Does it.\n\n# no word of this\necho done\nrm x\n"
        self.assertEqual(literals.of_script(text), [(2, "# Does it."), (5, "echo done")])

    def test_are_not_looked_for_in_tests_and_pages_of_results(self):
        self.assertEqual(literals.of_file("tests/a.cpp", 'f("told");'), [])
        self.assertEqual(literals.of_file("policy/experiments/a.py", "f('told')"), [])
        self.assertEqual(literals.of_file("sim/a.cpp", 'f("told");'), [(1, "told")])


class Programs(unittest.TestCase):
    def test_print_no_word_that_only_their_authors_know(self):
        excepted = {(file, literal) for file, literal, _ in exceptions()}
        problems = [
            f"{name}:{line}: {found.group()}: write {instead}: {text}"
            for name, lines in literals.of_tree(ROOT).items()
            for line, text in lines
            if (name, text) not in excepted
            for pattern, instead in WORDS
            for found in pattern.finditer(text)
        ]
        self.assertEqual(problems, [], "\n".join(problems))

    def test_keep_such_a_word_where_it_is_needed_and_the_glossary_maps_it(self):
        tree = literals.of_tree(ROOT)
        for file, literal, reason in exceptions():
            self.assertIn(literal, [text for _, text in tree.get(file, [])], f"{file}: no longer there")
            if reason.startswith("glossary: "):
                self.assertIn(f"`{reason.removeprefix('glossary: ')}`", GLOSSARY)


if __name__ == "__main__":
    unittest.main()
