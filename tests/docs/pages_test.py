"""How pages of the site are made of READMEs, of --help, of messages and of wrong values. Run by ctest."""

import stat
import sys
import tempfile
import unittest
from pathlib import Path, PurePosixPath

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "toolchains/docs/generate"))
import command_pages
import key_pages
import message_pages
from tree_pages import TreePages, for_the_site

HELP = """Computes a field:
along one bearing.
Usage: earshot field [OPTIONS] [ENVIRONMENT]

Options:
  -h,--help                   Print this help
  --quiet Excludes: --verbose say nothing
  --max-range-km FLOAT:0.001 to 2000=25
                              how far from
                              the source
  -o,--output TEXT REQUIRED   file to write

Example: earshot field x
"""
DBC = """BO_ 2314277411 VesselHeading: 8 Vehicle
 SG_ Reference : 56|2@1+ (1,0) [0|2] "" Earshot

BO_ 2381315875 EarshotCommand: 53 Vehicle
 SG_ Kind M : 16|8@1+ (1,0) [0|252] "" Earshot
 SG_ Order m1 : 24|8@1+ (1,0) [0|252] "" Earshot
 SG_ AbortIssuer m3 : 24|16@1+ (1,0) [0|65535] "" Earshot

CM_ BO_ 2314277411 "PGN 127250; stale after 10000 ms";
VAL_ 2314277411 Reference 0 "True" 1 "Magnetic" 3 "not available" ;
"""
LCM = """// Generated: earshot lcm nav_t. Do not edit.
package earshot;

// Where it is.
struct nav_t {
  // Counted from
  // the origin.
  double north_m;
  double history[3];  // newest first
}
"""
JUDGE = """#!/usr/bin/env python3
import sys, tomllib
depth = tomllib.load(open(sys.argv[1], "rb")).get("search", {}).get("depth_m")
if depth is None:
    print("x.toml: search.depth_m: is missing", file=sys.stderr)
elif not isinstance(depth, float):
    print(f"x.toml:1: search.depth_m = {depth}: must be a finite number above 0 and at most 9", file=sys.stderr)
"""


class Markdown(unittest.TestCase):
    def test_has_a_blank_line_before_a_list_and_a_table_that_follow_text(self):
        self.assertEqual(for_the_site("Text:\n- a\n- b\n"), "Text:\n\n- a\n- b\n")
        self.assertEqual(for_the_site("# T\n| a |\n|---|\n"), "# T\n\n| a |\n|---|\n")

    def test_keeps_code_and_loses_the_marks_of_tests(self):
        self.assertEqual(for_the_site("<!-- test: long -->\n```sh\na\n- b\n```\n"), "```sh\na\n- b\n```\n")

    def test_names_of_pages_that_are_made_with_the_site_become_links(self):
        self.assertEqual(for_the_site("| *Run keys*<!-- page: run_keys.md --> |\n"), "| [Run keys](run_keys.md) |\n")
        self.assertEqual(for_the_site("*slanted* words\n"), "*slanted* words\n")

    def test_links_lead_to_pages_and_what_they_lead_to_becomes_one(self):
        with tempfile.TemporaryDirectory() as folder:
            tree, out = Path(folder, "tree"), Path(folder, "out")
            (tree / "sim").mkdir(parents=True)
            (tree / "sim/flat.toml").write_text("a = 1\n")
            (tree / "sim/README.md").write_text("# sim\n[up](../README.md), [data](flat.toml#a), [web](https://a.b)\n")
            (tree / "README.md").write_text("[sim](sim), `[no](sim)`\n```text\n[no](sim)\n```\n")
            pages = TreePages(tree, out)
            pages.add("README.md")
            pages.add_linked("")
            self.assertIn("[sim](sim/README.md)", (out / "tree/README.md").read_text())
            self.assertIn("```text\n[no](sim)\n```", (out / "tree/README.md").read_text())
            page = (out / "tree/sim/README.md").read_text()
            self.assertIn("[up](../README.md), [data](flat.toml.md), [web](https://a.b)", page)
            self.assertIn("a = 1", (out / "tree/sim/flat.toml.md").read_text())

    def test_of_a_hidden_folder_has_a_name_that_the_generator_does_not_leave_out(self):
        with tempfile.TemporaryDirectory() as folder:
            tree, out = Path(folder, "tree"), Path(folder, "out")
            (tree / ".github").mkdir(parents=True)
            (tree / ".github/HELP.md").write_text("# Help\n[up](../README.md)\n")
            (tree / "README.md").write_text("[help](.github/HELP.md)\n")
            pages = TreePages(tree, out)
            pages.add("README.md")
            pages.add_linked("")
            self.assertIn("[help](github/HELP.md)", (out / "tree/README.md").read_text())
            self.assertIn("[up](../README.md)", (out / "tree/github/HELP.md").read_text())

    def test_of_the_site_stands_at_its_top(self):
        with tempfile.TemporaryDirectory() as folder:
            pages = TreePages(Path(folder), Path(folder, "out"))
            pages.write("help/a.md", "[x](../../../../README.md)", PurePosixPath("toolchains/docs/site/help"))
            Path(folder, "README.md").write_text("")
            pages.write("help/b.md", "[x](../../../../README.md)", PurePosixPath("toolchains/docs/site/help"))
            self.assertEqual(Path(folder, "out/help/b.md").read_text(), "[x](../tree/README.md)")


class Help(unittest.TestCase):
    def test_is_read_with_values_on_the_same_line_or_the_next(self):
        found = command_pages.read(HELP)
        self.assertEqual(found.about, "Computes a field:\nalong one bearing.")
        self.assertEqual([option.meaning for option in found.sections["Options"]],
                         ["Print this help", "say nothing", "how far from the source", "file to write"])  # fmt: skip
        self.assertEqual(found.rest, "Example: earshot field x")

    def test_values_are_put_in_words(self):
        page = command_pages.page("earshot field", HELP)
        self.assertIn("`--max-range-km` (number; 0.001 to 2000; default 25)", page)
        self.assertIn("`-o,--output` (text; must be given)", page)
        self.assertIn("`--quiet` (not with --verbose)", page)


class Messages(unittest.TestCase):
    def test_of_can_have_their_number_and_the_words_of_their_values(self):
        page = message_pages.can_page(DBC)
        self.assertIn("## VesselHeading (PGN 127250)", page)
        self.assertIn("Identifier 0x09F11223, 8 bytes, sent by a device of the vehicle.", page)
        self.assertIn("| `Reference` | 56 | 2 | 1 | 0 to 2 |  | 0 True, 1 Magnetic |", page)

    def test_of_can_say_which_signals_share_their_bits_and_when_each_is_there(self):
        page = message_pages.can_page(DBC)
        self.assertIn("| `Kind` | 16 | 8 |", page)
        self.assertIn("| `Order`, if Kind is 1 | 24 | 8 |", page)
        self.assertIn("| `AbortIssuer`, if Kind is 3 | 24 | 16 |", page)

    def test_of_lcm_have_the_comments_of_their_fields(self):
        with tempfile.TemporaryDirectory() as folder:
            Path(folder, "nav_t.lcm").write_text(LCM)
            page = message_pages.lcm_page(Path(folder))
        self.assertIn("## nav_t\n\nWhere it is.", page)
        self.assertIn("| `north_m` | `double` | Counted from the origin. |", page)
        self.assertIn("| `history` | `double[3]` | newest first |", page)


class Keys(unittest.TestCase):
    def asker(self, folder: str) -> key_pages.Asker:
        program = Path(folder, "judge")
        program.write_text(JUDGE)
        program.chmod(program.stat().st_mode | stat.S_IXUSR)
        return key_pages.Asker(Path(folder), ["judge", "{file}"], Path(folder))

    def test_are_asked_of_the_program(self):
        with tempfile.TemporaryDirectory() as folder:
            answer = self.asker(folder).ask({"search": {"depth_m": 1.0}}, "search", "depth_m")
        self.assertTrue(answer.is_required)
        self.assertEqual(key_pages.allowed(answer.allowed), "number, above 0 and at most 9")

    def test_that_the_program_does_not_read_are_an_error(self):
        with tempfile.TemporaryDirectory() as folder, self.assertRaises(key_pages.Unanswered):
            self.asker(folder).ask({"search": {"depth_m": 1.0}}, "search", "gone_m")

    def test_have_the_unit_that_their_name_ends_with(self):
        self.assertEqual(key_pages.unit_of("level_db_re_1upa_at_1m"), "dB re 1 uPa at 1 m")
        self.assertEqual(key_pages.unit_of("speed_mps"), "m/s")
        self.assertEqual(key_pages.unit_of("detection_m"), "")
        self.assertEqual(key_pages.unit_of("name"), "")

    def test_tables_are_written_as_toml_that_reads_back_the_same(self):
        import tomllib

        table = {"a": 1, "b": 'x \\ "y"', "c": {"d": [1.5, True]}, "e": [{"f": "g", "h": {"i": 2}}, {"f": "j"}]}
        self.assertEqual(tomllib.loads(key_pages.toml_of(table)), table)


if __name__ == "__main__":
    unittest.main()
