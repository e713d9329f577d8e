"""What the reader of READMEs finds, and what it refuses. Run by ctest."""

import os
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import links
import markdown
import session

FILE = Path("README.md")


def read(text: str) -> markdown.Document:
    return markdown.read(FILE, text)


def failure_of(text: str):
    with tempfile.TemporaryDirectory() as folder:
        return session.failure_of(read(text).commands, Path(folder), dict(os.environ), 60.0)


class Reading(unittest.TestCase):
    def test_takes_each_line_of_a_block_as_a_command_word_for_word(self):
        found = read("Do:\n\n```sh\na  --b 'c d'   # why\n# a remark\n\ne \\\n  f\n```\n")
        self.assertEqual([(c.line, c.text) for c in found.commands], [(4, "a  --b 'c d'   # why"), (7, "e \\\n  f")])
        self.assertEqual(found.problems, [])

    def test_takes_a_block_of_python_whole(self):
        (command,) = read("```python\nimport os\n\nos.getcwd()\n```\n").commands
        self.assertEqual((command.language, command.text), ("python", "import os\n\nos.getcwd()"))

    def test_finds_long_commands_that_an_earlier_file_has(self):
        mark = "<!-- test: long -->\n"
        text = mark + "```sh\ntests/run    # every test\nexport A=b\n```\n```sh\nshort\n```\n"
        first = markdown.read(Path("first.md"), text)
        again = mark + "```sh\ntests/run\ntests/run -R x\nexport A=b\nk=$(tests/run)\n```\n```sh\nshort\n```\n"
        second = markdown.read(Path("second.md"), again)
        found = markdown.repeated_long_commands([first, second])
        self.assertEqual([(str(c.file), c.text) for c in found], [("second.md", "tests/run")])

    def test_refuses_fences_that_it_would_not_read(self):
        for text in ["- a\n  ```sh\n  b\n  ```\n", "~~~sh\nb\n~~~\n"]:
            with self.subTest(text=text):
                self.assertTrue(read(text).problems[0].endswith(": a fence must be ``` and begin its line"))

    def test_reads_the_marks_of_a_block(self):
        found = read("<!-- test: long, start -->\n```sh\na\n```\n```sh\nb\n```\n")
        self.assertEqual([c.marks for c in found.commands], [{"long", "start"}, set()])

    def test_lets_text_and_continued_list_entries_be(self):
        found = read("```text\na = b + c\n```\n- entry\n    goes on\n")
        self.assertEqual((found.commands, found.problems), ([], []))

    def test_refuses_what_it_cannot_tell_by_file_and_line(self):
        for text, problem in [
            ("Do:\n\n    sim/fly\n", "README.md:3: an indented block"),
            ("# Run\n    sim/fly\n", "README.md:2: an indented block"),
            ("```\nsim/fly\n```\n", "README.md:1: a block fenced with ```:"),
            ("```console\nsim/fly\n```\n", "README.md:1: a block fenced with ```console"),
            ("<!-- test: slow -->\n```sh\na\n```\n", "README.md:1: no such mark: slow"),
            ("```text\nsim/fly --seed 1\n```\n", "README.md:2: a command in a block of text"),
        ]:
            with self.subTest(text=text):
                problems = read(text).problems
                self.assertEqual(len(problems), 1)
                self.assertIn(problem, problems[0])

    def test_refuses_a_mention_that_no_block_runs(self):
        block = "```sh\nearshot field sea.toml -o sea.nc\n```\n"
        for mention, is_good in [
            ("`earshot field sea.toml`", True),
            ("`earshot field`", True),
            ("`earshot field ENV -o FILE.nc`", False),
            ("`cmake --preset release`", False),
            ("`ctest --preset dev -R 'Munk|^Leg'`", True),
            ("`ctest --preset dev -R 'Munk|Nothing'`", False),
        ]:
            with self.subTest(mention=mention):
                problems = markdown.problems_of_mentions(
                    [read(block + mention + "\n")], ["MunkProfile.IsRight", "Leg.IsStraight"]
                )
                self.assertEqual(problems == [], is_good, problems)


class Links(unittest.TestCase):
    def problems(self, text: str):
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            (root / "sim").mkdir()
            (root / "sim/README.md").write_text("# sim\n## What it does, and how\n```sh\n# no heading\n```\n")
            (root / "sim/picture.png").write_bytes(b"\x89PNG\xff")
            (root / "sim/a.md").write_text(text)
            return links.problems_of("sim/a.md", root)

    def test_lets_be_what_leads_somewhere(self):
        for link in [
            "[a](README.md)",
            "[a](../sim)",
            "[`a`](../sim/README.md#what-it-does-and-how)",
            "# Here it is\n[a](#here-it-is)",
            "[a](https://nowhere.invalid/x.md)",
            "`[a](none.md)`",
            "```text\n[a](none.md)\n```",
            "- entry\n  ```text\n  [a](none.md)\n  ```",
            "~~~\n[a](none.md)\n~~~",
            "[a](../sim#sim)",
            "[a][b]\n\n[b]: README.md#sim",
            '<a href="README.md">a</a>',
        ]:
            with self.subTest(link=link):
                self.assertEqual(self.problems(link + "\n"), [])

    def test_finds_by_file_and_line_what_leads_nowhere(self):
        for link, what in [
            ("[a](none.md)", "none.md: there is no such file"),
            ("[`a`](sim/README.md)", "sim/README.md: there is no such file"),
            ("[a](README.md#what)", "README.md#what: there is no such heading"),
            ("[a](README.md#no-heading)", "README.md#no-heading: there is no such heading"),
            ("![picture](none.png)", "none.png: there is no such file"),
            ("[a](../sim#none)", "../sim#none: there is no such heading"),
            ("[a](picture.png#none)", "picture.png#none: there is no such heading"),
            ('[a](none.md "title")', "none.md: there is no such file"),
            ('<a href="none.md">a</a>', "none.md: there is no such file"),
            ("<img width='3' src='none.png'>", "none.png: there is no such file"),
        ]:
            with self.subTest(link=link):
                self.assertEqual(self.problems("```sh\na\n```\nSee " + link + "\n"), ["sim/a.md:4: " + what])

    def test_finds_a_page_that_only_the_built_site_has(self):
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "toolchains/docs/site/reference").mkdir(parents=True)
            name = "toolchains/docs/site/reference/index.md"
            (Path(folder) / name).write_text("[a](run_keys.md)\n*b*<!-- page: run_keys.md -->\n")
            self.assertEqual(links.problems_of(name, Path(folder)), [f"{name}:1: run_keys.md: there is no such file"])

    def test_finds_where_the_definition_of_a_link_leads_nowhere(self):
        self.assertEqual(self.problems("[a][b]\n\n[b]: none.md\n"), ["sim/a.md:3: none.md: there is no such file"])


class Running(unittest.TestCase):
    def test_keeps_one_shell_from_command_to_command(self):
        self.assertIsNone(failure_of("```sh\nexport A=1 && mkdir b\ntest $A = 1 -a -d b\n```\n"))

    def test_names_the_command_that_fails_and_what_it_printed(self):
        failure = failure_of("```sh\ntrue\necho 'no such thing'; (exit 5)\ntrue\n```\n")
        self.assertIn("README.md:3: echo 'no such thing'; (exit 5)\n  status 5", failure)
        self.assertIn("no such thing", failure.splitlines()[-1])

    def test_finds_a_placeholder_and_a_program_that_is_not_there(self):
        self.assertIn("status 1", failure_of("```sh\ncat MISSION.toml\n```\n"))
        self.assertIn("status 127", failure_of("```sh\nearshoot\n```\n"))

    def test_runs_python(self):
        loop = "```python\nfor i in range(2):\n    open('made', 'a').write('x')\n```\n"
        self.assertIsNone(failure_of(loop + "```sh\ntest $(cat made) = xx\n```\n"))
        self.assertIn("ZeroDivisionError", failure_of("```python\n1 / 0\n```\n"))

    def test_ends_a_command_that_does_not_end_by_itself(self):
        self.assertIsNone(failure_of("<!-- test: start -->\n```sh\nsleep 1000\n```\n"))

    def test_finds_a_command_that_ends_though_it_is_marked_as_one_that_does_not(self):
        self.assertIn("ended by itself with status 3", failure_of("<!-- test: start -->\n```sh\n(exit 3)\n```\n"))


if __name__ == "__main__":
    unittest.main()
