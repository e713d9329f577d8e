"""A few of the random calls that .ci/slow makes with AddressSanitizer, and what shows that they are looked at.

Run by ctest (../run).
"""

import os
import unittest
from pathlib import Path

from random_calls import Tally, fault_of, run
from thing import Thing

import earshot

PROGRAMS = Path(os.environ["EARSHOT_PROGRAMS"])


def raising(error):
    def call():
        raise error

    return call


class Calls(unittest.TestCase):
    def test_return_or_refuse_in_earshots_own_words(self):
        tally = run(PROGRAMS, 200)
        self.assertEqual(tally.faults, [])
        self.assertGreater(sum(tally.returned.values()), 30)
        self.assertGreater(sum(tally.refused.values()), 30)
        self.assertGreater(len({*tally.returned, *tally.refused}), 15)

    def test_that_end_otherwise_are_shown(self):
        ours = Thing("ours", lambda values: {}, len)
        of_gym = Thing("of gym", lambda values: {}, len, is_gym=True)
        for thing, error, is_fault in (
            (ours, earshot.BadInput("n: must be 1 or more", key="n"), False),
            (ours, earshot.BadType("n: must be a number", key="n"), False),
            (ours, earshot.BadInput(""), True),
            (ours, ValueError("of another"), True),
            (ours, KeyError("n"), True),
            (of_gym, RuntimeError("step() before reset()"), False),
            (of_gym, ValueError(""), True),
            (of_gym, KeyError("n"), True),
        ):
            with self.subTest(thing=thing.name, error=repr(error)):
                self.assertEqual(fault_of(thing, raising(error), Tally()) is not None, is_fault)


if __name__ == "__main__":
    unittest.main()
