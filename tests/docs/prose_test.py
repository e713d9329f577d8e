"""What the check of prose must find, what it must leave, and that the documentation passes it. Run by ctest."""

import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import prose

ROOT = Path(__file__).resolve().parents[2]
SITE = "toolchains/docs/site"
GLOSSARY = f"{SITE}/help/glossary.md"
HERE = Path(__file__).resolve().parent
WORDS = prose.read_words(HERE / "forbidden_words.txt")
NOTES = ("policy/experiments/", "toolchains/changelog.md", GLOSSARY)  # besides folders called results
GENERATED = "policy/reproduce/results/reproduction.md"  # its cells are paragraphs
LONG = " ".join(["word"] * 46)


def markdown(*patterns: str) -> dict[str, str]:
    command = ["git", "ls-files", "-z", "-co", "--exclude-standard", *patterns]
    listed = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout
    names = sorted({name for name in listed.split("\0") if name and (ROOT / name).is_file()})
    return {name: (ROOT / name).read_text() for name in names}


def pages() -> dict[str, str]:
    return markdown("README.md", f"{SITE}/*.md", f"{SITE}/**/*.md")


class Prose(unittest.TestCase):
    def test_finds_a_sentence_of_46_words_in_a_paragraph_an_item_and_a_cell(self):
        for text in [f"Short. {LONG}.", f"- {LONG}", f"| a | {LONG} |", f"One line\n{LONG}"]:
            self.assertEqual(len(prose.long_sentences("page", text)), 1, text)

    def test_leaves_45_words_code_and_two_sentences_that_are_long_together(self):
        for text in [LONG.removesuffix(" word"), f"```text\n{LONG}\n```", f"{LONG[:100]}. {LONG[100:]}."]:
            self.assertEqual(prose.long_sentences("page", text), [], text)

    def test_finds_a_forbidden_word_and_its_line(self):
        problems = prose.forbidden_words("page", "# Title\n\nThe vehicle is told the SNR.\n", WORDS)
        self.assertEqual(len(problems), 1)
        self.assertIn("page:3: told: write report, publish, give", problems[0])

    def test_leaves_forbidden_words_in_code_links_and_larger_words(self):
        text = "`surprise_bits`, [a page](look.md), overlooked, pretold\n```text\ntold\n```\n"
        self.assertEqual(prose.forbidden_words("page", text, WORDS), [])

    def test_finds_a_row_of_301_characters_that_is_no_code(self):
        self.assertEqual(prose.long_rows("page", f"| {'a' * 299}\n"), ["page:1: 301 characters"])
        self.assertEqual(prose.long_rows("page", f"| {'a' * 298}\n```sh\n{'a' * 400}\n```\n"), [])


class Documentation(unittest.TestCase):
    def test_has_no_word_that_only_its_authors_know(self):
        texts = {n: text for n, text in markdown("*.md").items() if not n.startswith(NOTES) and "/results/" not in n}
        problems = [p for name, text in texts.items() for p in prose.forbidden_words(name, text, WORDS)]
        self.assertEqual(problems, [], "\n".join(problems))

    def test_has_no_row_that_no_screen_shows(self):
        texts = markdown("*.md")
        problems = [p for name, text in texts.items() if name != GENERATED for p in prose.long_rows(name, text)]
        self.assertEqual(problems, [], "\n".join(problems))

    def test_has_a_front_page_of_120_lines_at_most(self):
        self.assertLessEqual((ROOT / "README.md").read_text().count("\n"), 120)

    def test_has_no_sentence_that_must_be_read_twice(self):
        problems = [p for name, text in pages().items() for p in prose.long_sentences(name, text)]
        self.assertEqual(problems, [], "\n".join(problems))


if __name__ == "__main__":
    unittest.main()
