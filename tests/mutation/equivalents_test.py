"""Which faults of a file the entries of a list of equivalents mean, and which entries are refused."""

import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import equivalents
from mutation_test import faults


class Listing(unittest.TestCase):
    """Two faults of its first function are alike."""

    TEXT = (
        "int f(int a) { return a < 0 ? 0 : a; }\nint g(int a) {\n  return a < 0 ? a : 3;\n}\nconstexpr int kSize = 3;\n"
    )

    def meant(self, *entries: equivalents.Entry) -> tuple[list[tuple[int, str]], list[str]]:
        """The line and change of each fault that is meant, and the complaints without what they are of."""
        found, complaints = equivalents.faults_meant(list(entries), "some.cpp", faults(self.TEXT))
        return [(f.line, f.change) for f in found], [c.split(": ", 3)[3] for c in complaints]

    @staticmethod
    def entry(function: str, fault: str, site: str | None = None) -> equivalents.Entry:
        return equivalents.Entry("some.cpp", function, fault, "none", site)

    def test_means_the_one_fault_of_a_kind_in_a_function(self):
        self.assertEqual(self.meant(self.entry("f", "boundary")), ([(1, "a < 0: < -> <=")], []))
        self.assertEqual(self.meant(self.entry("g", "boundary")), ([(3, "a < 0: < -> <=")], []))

    def test_means_the_same_fault_when_its_line_is_written_anew(self):
        self.TEXT = "int g(int bearing)\n{\n  // no comment\n  return bearing <\n    0 ? bearing : 3;\n}\n"
        self.assertEqual(self.meant(self.entry("g", "boundary")), ([(4, "bearing < 0: < -> <=")], []))

    def test_means_one_of_several_by_its_site_and_refuses_it_when_there_are_more_or_fewer(self):
        self.assertEqual(self.meant(self.entry("g", "off by one", "2 of 2")), ([(3, "3 -> 3 + 1")], []))
        which = "".join(f'\n    site = "{n} of 2": line 1: 0 -> 0 + 1' for n in (1, 2))
        for site in (None, "1 of 3", "3 of 3"):
            refused = self.meant(self.entry("f", "off by one", site))
            self.assertEqual(refused, ([], [f"it has 2 such faults (by now); say which:{which}"]), site)
        refused = self.meant(self.entry("f", "boundary", "1 of 2"))
        self.assertEqual(refused, ([], ["it has one such fault (by now), which needs no site"]))

    def test_refuses_what_is_not_there_what_is_listed_twice_and_what_the_compiler_computes(self):
        self.assertEqual(self.meant(self.entry("h", "boundary")), ([], ["no such function (any more)"]))
        others = "boundary, comparison, early return, off by one"
        self.assertEqual(
            self.meant(self.entry("f", "units")), ([], [f"no such fault in it (any more); it has: {others}"])
        )
        twice = self.entry("f", "boundary")
        self.assertEqual(self.meant(twice, twice), ([(1, "a < 0: < -> <=")], ["listed twice"]))
        constant = self.entry("kSize", "off by one")
        self.assertEqual(self.meant(constant), ([], ["only the compiler computes this, so it is not tried"]))

    def test_reads_entries_of_just_their_fields_for_files_that_are_there(self):
        with tempfile.TemporaryDirectory() as place:
            root, listed = Path(place), Path(place) / "equivalents.toml"
            (root / "some.cpp").touch()
            whole = '[[equivalent]]\nfile = "some.cpp"\nfunction = "a"\nfault = "b"\nreason = "c"\n'
            listed.write_text(whole + 'site = "2 of 5"\n' + whole)
            there = equivalents.Entry("some.cpp", "a", "b", "c")
            second = equivalents.Entry("some.cpp", "a", "b", "c", "2 of 5")
            self.assertEqual(equivalents.read_entries(listed, root), [second, there])
            needs = r"equivalents.toml: an entry needs the texts file, function, fault, reason"
            for wrong, complaint in {
                whole.replace('reason = "c"\n', ""): needs,
                whole.replace('"c"', "3"): needs,
                whole + 'author = "d"\n': needs,
                whole + 'site = "0 of 2"\n': needs,
                whole + 'site = "1 of 1"\n': needs,
                whole + 'site = "3 of 2"\n': needs,
                whole + "site = 2\n": needs,
                whole + "occurrence = 2\n": needs,
                whole.replace("some.cpp", "other.cpp"): r"equivalents.toml: no such file \(any more\):\s+other.cpp: a",
                "[[equivalent\n": r"equivalents.toml: .*at line 1",
            }.items():
                listed.write_text(wrong)
                with self.assertRaisesRegex(equivalents.BadInput, complaint):
                    equivalents.read_entries(listed, root)


if __name__ == "__main__":
    unittest.main()
