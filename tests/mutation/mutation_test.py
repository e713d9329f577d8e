"""Which faults are found in a file, whether a planted one does what it says, and which of them a test notices."""

import argparse
import contextlib
import io
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import measure
import sites
import switch
from project import Project


def faults(text: str) -> list[sites.Fault]:
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "some.cpp"
        file.write_text(text)
        return sites.faults_of(file, ["-std=c++20", "-x", "c++"])


def told(text: str) -> set[str]:
    return {f"{f.kind}: {f.change}" for f in faults(text)}


class Finding(unittest.TestCase):
    def test_turns_a_comparison_round_and_moves_its_bound(self):
        self.assertEqual(
            told("bool is_less(int a, int b) { return a < b; }"),
            {
                "comparison: a < b: < -> >=",
                "boundary: a < b: < -> <=",
                "early return: is_less begins with return {};",
            },
        )

    def test_swaps_arguments_of_one_type_only(self):
        text = "int f(int, int, double);\nint g(int a, int b, double c) { return f(a, b, c); }"
        self.assertEqual({c for c in told(text) if "swapped" in c}, {"swapped arguments: f(a, b, c): a <-> b"})

    def test_swaps_nothing_where_a_constructor_names_a_member_or_a_base(self):
        text = (
            "struct A { A(int, int); };\nint f(int, int);\n"
            "struct B : A { B(int a, int b) : A(a, b), c(a, b), d(f(a, b)) {} A c; int d; };"
        )
        self.assertEqual({c for c in told(text) if "swapped" in c}, {"swapped arguments: f(a, b): a <-> b"})

    def test_swaps_nothing_that_may_change_places(self):
        text = "int max(int, int);\nint clamp(int, int, int);\n"
        text += "int g(int a, int b) { return max(a, b) + clamp(a, b, 7); }"
        swaps = {c for c in told(text) if "swapped" in c}
        self.assertEqual(swaps, {"swapped arguments: clamp(a, b, 7): b <-> 7"})

    def test_leaves_out_statements_and_takes_checks_away(self):
        found = told("void f(int& a) { if (a > 3) a = 2; ++a; }")
        self.assertLessEqual(
            {
                "never true: if (a > 3) never",
                "always true: if (a > 3) always",
                "dropped statement: a = 2 left out",
                "dropped statement: ++a left out",
                "sign: ++a -> --a",
            },
            found,
        )

    def test_forgets_a_unit_and_changes_other_numbers_by_little(self):
        found = told("double f(double a) { return a * 3600.0 + 2.5; }")
        self.assertLessEqual({"units: 3600.0 -> 1.0", "constant: 2.5 -> 2.5 * 1.01"}, found)

    def test_plants_nothing_where_only_the_compiler_looks(self):
        text = "constexpr int kSize = 3;\nint list[kSize + 1];\nconsteval int f(int a) { return a - 1; }"
        text += "\ntypedef int V __attribute__((vector_size(8)));\nV v = __builtin_shufflevector(V{}, V{}, 1, 0);"
        text += "\ntemplate <class T>\nconstexpr int kLanes = sizeof(T) / sizeof(char);"
        text += "\nint lanes() { return kLanes<int>; }"
        self.assertEqual({f.change for f in faults(text) if f.switchable}, {"lanes begins with return {};"})

    def test_plants_nothing_in_a_function_that_is_defaulted(self):
        text = "struct A { A& operator=(A&&) noexcept; int b; };\nA& A::operator=(A&& other) noexcept = default;"
        self.assertEqual(told(text), set())

    def test_plants_nothing_in_half_a_macro(self):
        text = "#define TWICE(a) ((a) * 2)\nint f(int b) { return TWICE(b); }"
        self.assertEqual(told(text), {"early return: f begins with return {};"})

    def test_tells_what_the_compiler_cannot_read(self):
        with self.assertRaisesRegex(sites.CannotRead, "expected"):
            faults("int f( {")


class Planting(unittest.TestCase):
    TEXT = b"""\
#include <cstdio>
int f(int a, int b) {
  if (a < b) return a - b;
  return a * 2;
}
int main() { std::printf("%d %d %d", f(1, 2), f(2, 2), f(3, 2)); }
"""
    # -1 4 6 without a fault; worked out by hand
    DONE = {
        "f begins with return {};": "0 0 0",
        "if (a < b) never": "2 4 6",
        "if (a < b) always": "-1 0 1",
        "a < b: < -> >=": "2 0 1",
        "a < b: < -> <=": "-1 0 6",
        "a - b: - -> +": "3 4 6",
        "a * 2: * -> /": "-1 1 1",
        "2 -> 2 + 1": "-1 6 9",
    }

    def test_each_fault_does_what_it_says_when_it_is_asked_for_and_none_does_otherwise(self):
        with tempfile.TemporaryDirectory() as place:
            folder = Path(place)
            (folder / "some.cpp").write_bytes(self.TEXT)
            found = sites.faults_of(folder / "some.cpp", ["-std=c++20", "-x", "c++"])
            numbered = {n: f for n, f in enumerate(found, 1) if f.line < 6 and f.switchable}
            (folder / "planted.cpp").write_text(switch.switched(self.TEXT, numbered).text)
            (folder / "earshot_fault.hpp").write_text(switch.HEADER)
            build = ["g++", "-std=c++20", "-w", "-I.", "planted.cpp", "-o", "planted"]
            subprocess.run(build, cwd=folder, check=True)

            def printed(environment: dict[str, str]) -> str:
                ran = subprocess.run([folder / "planted"], env=environment, capture_output=True, text=True, check=True)
                return ran.stdout

            self.assertEqual(printed({}), "-1 4 6")
            self.assertEqual({f.change: printed({"EARSHOT_FAULT": str(n)}) for n, f in numbered.items()}, self.DONE)
            reached = folder / "reached"
            reached.write_bytes(bytes(len(numbered) + 1))
            printed({"EARSHOT_FAULTS_REACHED": str(reached)})
            self.assertEqual(reached.read_bytes(), b"\0" + b"\1" * len(numbered))


class Naming(unittest.TestCase):
    """Where a fault stands, in words that stay the same when its line is written anew."""

    @staticmethod
    def places(text: str, change: str) -> list[tuple[str, str | None]]:
        return [(f.function, f.site) for f in faults(text) if f.change == change]

    def test_names_the_function_with_what_it_is_a_member_of(self):
        text = "namespace a { namespace { struct B { void f(); static int g() { return 1; } };\n"
        text += "void B::f() { struct C { int h() { return 2; } }; auto i = [] { return 3; }; } } }\n"
        text += "template <class T> T j(T k = 4) { return k; }\nint l = 5;\nstruct M { int n = 6; };"
        self.assertEqual(
            [self.places(text, f"{n} -> {n} + 1") for n in range(1, 7)],
            [[(name, None)] for name in ("a::B::g", "a::B::f::C::h", "a::B::f", "j", "l", "M::n")],
        )

    def test_counts_faults_of_a_kind_through_a_function_and_those_of_its_name(self):
        text = (
            "int f(int a) { if (a < 7) return 7; return a < 8 ? 7 : 9; }\nint f() { return 7; }\nint g() { return 7; }"
        )
        self.assertEqual(
            self.places(text, "7 -> 7 + 1"),
            [("f", "1 of 6"), ("f", "2 of 6"), ("f", "4 of 6"), ("f", "6 of 6"), ("g", None)],
        )
        self.assertEqual(self.places(text, "a < 8: < -> <="), [("f", "2 of 2")])

    def test_counts_nothing_that_only_the_compiler_computes(self):
        self.assertEqual(self.places("int f() { constexpr int kA = 3; return 3; }", "3 -> 3 + 1"), [("f", None)] * 2)


class CommandLine(unittest.TestCase):
    """On a machine whose set-up fails, in a tree of one C++ file."""

    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.root = Path(place.name)
        self.tool = self.root / "tests" / "mutation"
        (self.root / "toolchains").mkdir()
        (self.root / "toolchains" / "setup").write_text("#!/bin/sh\necho cannot set up >&2\nexit 9\n")
        (self.root / "toolchains" / "setup").chmod(0o755)
        (self.root / "firmware").mkdir()
        (self.root / "firmware" / "some.cpp").write_text("int a = 0;\n")
        here = Path(__file__).resolve().parent
        shutil.copytree(here, self.tool, ignore=shutil.ignore_patterns("__pycache__", "*.toml"))
        (self.tool / "equivalents.toml").write_text(
            '[[equivalent]]\nfile = "firmware/some.cpp"\nfunction = "a"\nfault = "off by one"\n'
            'reason = "nobody looks"\n'
        )
        subprocess.run(["git", "init", "-q", self.root], check=True)

    def ran(self, *arguments: str) -> subprocess.CompletedProcess[str]:
        command = [str(self.tool / "run"), *arguments]
        return subprocess.run(command, cwd=self.root, capture_output=True, text=True, check=False)

    def test_shows_help_and_equivalents_before_anything_is_set_up(self):
        told = self.ran("--help")
        self.assertEqual((told.returncode, told.stderr), (0, ""))
        self.assertIn("--show-equivalents", told.stdout)
        told = self.ran("--show-equivalents", "firmware")
        self.assertEqual((told.returncode, told.stderr), (0, ""))
        self.assertEqual(
            told.stdout,
            "firmware/some.cpp: a: off by one\n    nobody looks\n1 fault is listed as equivalent\n",
        )
        self.assertEqual(self.ran("--show-equivalents").stdout, told.stdout)

    def test_refuses_what_it_cannot_do_before_anything_is_set_up(self):
        for wrong in (
            ["firmware/none.cpp"],
            ["--count", "-1"],
            ["--seconds", "0"],
            ["--at-least", "101"],
            ["--colour"],
        ):
            told = self.ran(*wrong)
            self.assertEqual((told.returncode, told.stdout), (2, ""), wrong)
            self.assertNotIn("cannot set up", told.stderr)

    def test_plants_nothing_where_the_set_up_fails(self):
        told = self.ran("firmware/some.cpp")
        self.assertEqual((told.returncode, told.stdout, told.stderr), (9, "", "cannot set up\n"))


PROJECT = {
    "CMakeLists.txt": """\
cmake_minimum_required(VERSION 3.25)
project(small LANGUAGES CXX)
enable_testing()
include_directories(${CMAKE_SOURCE_DIR})
add_executable(bounds_test firmware/core/bounds.cpp tests/firmware/core/bounds_test.cpp)
set_target_properties(bounds_test PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
add_test(NAME through COMMAND ${CMAKE_COMMAND} -E env $<TARGET_FILE:bounds_test>)
add_test(NAME one COMMAND bounds_test --gtest_filter=one)
add_test(NAME other COMMAND bounds_test --gtest_filter=other)
""",
    "firmware/core/bounds.hpp": "bool is_deep(int depth);\n",
    "firmware/core/bounds.cpp": """\
#include "firmware/core/bounds.hpp"
bool is_deep(int depth) {
  return depth > 400;
}
""",
    "firmware/core/unused.cpp": "int nobody_calls() { return 3; }\n",
    "tests/firmware/core/bounds_test.cpp": """\
#include <cstring>
#include "firmware/core/bounds.hpp"
// Its tests "one" and "other" are in each other's way, so that both fail in one process.
int main(int argc, char** argv) {
  if (argc > 1 && std::strchr(argv[1], ':')) return 1;
  if (argc == 1 && is_deep(400)) return 1;  // of the one that another program runs
  return is_deep(500) && !is_deep(300) ? 0 : 1;
}
""",
}
SURVIVORS = """\
  firmware/core/bounds.cpp:3: survived: off by one: 400 -> 400 + 1 [is_deep]
"""


class Measuring(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.root = Path(place.name) / "tree"
        for name, text in PROJECT.items():
            (self.root / name).parent.mkdir(parents=True, exist_ok=True)
            (self.root / name).write_text(text)
        subprocess.run(["git", "init", "-q", self.root], check=True)
        self.listed = Path(place.name) / "equivalents.toml"

    def measured(self, equivalents: str, *files: str, only_equivalents: bool = False) -> tuple[int, str]:
        files = files or ("firmware/core/bounds.cpp",)
        self.listed.write_text(equivalents)
        options = argparse.Namespace(far=False, count=0, seed=1, seconds=60.0, at_least=90.0)
        options.only_equivalents = only_equivalents
        project = Project(self.root, self.root.parent / "place")
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            status = measure.measure(options, list(files), project, self.listed)
        return status, said.getvalue()

    def test_names_what_a_blunt_test_does_not_notice_and_nothing_else(self):
        status, said = self.measured("")
        self.assertIn("bounds.cpp: 3 of 4 noticed, 75 %", said)
        self.assertIn(SURVIVORS, said)
        self.assertEqual((said.count("survived"), status), (1, 1))

        entry = '[[equivalent]]\nfile = "firmware/core/bounds.cpp"\nfunction = "is_deep"\nreason = "none"\n'
        status, said = self.measured(entry + 'fault = "off by one"\n')
        self.assertIn("bounds.cpp: 3 of 3 noticed, 100 %", said)

        with self.assertRaisesRegex(
            measure.BadInput, r"firmware/core/bounds.cpp: is_deep: units: no such fault in it \(any more\)"
        ):
            self.measured(entry + 'fault = "units"\n')

    def test_refutes_at_the_end_what_a_test_notices_though_it_is_listed(self):
        entry = '[[equivalent]]\nfile = "firmware/core/bounds.cpp"\nfunction = "is_deep"\nreason = "none"\n'
        status, said = self.measured(entry + 'fault = "off by one"\n' + entry + 'fault = "comparison"\n')
        self.assertIn("bounds.cpp: 2 of 2 noticed, 100 %", said)
        refuted = (
            "no equivalent, a test notices it: firmware/core/bounds.cpp:3: depth > 400: > -> <=: tests/bounds_test"
        )
        self.assertEqual(said.strip().split("\n")[-1].split(" (")[0], refuted)
        self.assertEqual((said.count("no equivalent"), status), (1, 1))

    def test_plants_just_what_is_listed_when_told(self):
        entry = '[[equivalent]]\nfile = "firmware/core/bounds.cpp"\nfunction = "is_deep"\nreason = "none"\n'
        status, said = self.measured(entry + 'fault = "off by one"\n', only_equivalents=True)
        self.assertEqual((said.count("no equivalent"), said.count("survived"), status), (0, 0, 0))
        status, said = self.measured(entry + 'fault = "comparison"\n', only_equivalents=True)
        self.assertEqual((said.count("no equivalent"), said.count("survived"), status), (1, 0, 1))
        with self.assertRaisesRegex(measure.BadInput, "no fault of these files is listed as an equivalent"):
            self.measured("", only_equivalents=True)

    def test_leaves_out_and_names_a_file_of_no_test_program(self):
        unused = "firmware/core/unused.cpp"
        status, said = self.measured("", unused, "firmware/core/bounds.cpp")
        self.assertIn(f"{unused}: not tried, it is part of no test program\n", said)
        self.assertIn("\n3 of 4 noticed", said)
        with self.assertRaisesRegex(measure.BadInput, "no test program is made of these files"):
            self.measured("", unused)

    def test_tells_short_times_in_milliseconds(self):
        self.assertEqual(
            [measure.time_in_words(s) for s in (0.0042, 0.25, 1.0, 61.04)], ["4 ms", "250 ms", "1.0 s", "61.0 s"]
        )


if __name__ == "__main__":
    os.environ["CCACHE_DISABLE"] = "1"
    unittest.main()
