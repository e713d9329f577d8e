"""Which commands are left out, and that no reason outlives its command. Run by ctest."""

import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import left_out
import markdown

COMMANDS = markdown.read(Path("a/README.md"), "```sh\nmpirun -n 2 x\nx --help\n```\n").commands


class LeavingOut(unittest.TestCase):
    def test_leaves_out_what_begins_as_a_line_says_in_that_readme_alone(self):
        reasons, problems = left_out.read("# why\n\na/README.md | mpirun -n | no MPI\n", "list")
        self.assertEqual(problems, [])
        kept, left, idle = left_out.split(COMMANDS, reasons)
        self.assertEqual([c.text for c in kept], ["x --help"])
        self.assertEqual([(c.text, why) for c, why in left], [("mpirun -n 2 x", "no MPI")])
        self.assertEqual(idle, [])

    def test_finds_a_reason_whose_command_is_gone(self):
        for line in ["a/README.md | mpirun -n 3 | no MPI", "b/README.md | mpirun | no MPI"]:
            kept, _, idle = left_out.split(COMMANDS, left_out.read(line, "list")[0])
            self.assertEqual(len(kept), 2)
            self.assertEqual(len(idle), 1)
            self.assertIn(": has no command that begins with: mpirun", idle[0])

    def test_refuses_a_line_without_a_reason(self):
        _, problems = left_out.read("a/README.md | mpirun\n", "list")
        self.assertEqual(problems, ["list:1: must be README | how the command begins | reason: a/README.md | mpirun"])


if __name__ == "__main__":
    unittest.main()
