"""A few of the random calls that .ci/slow makes with AddressSanitizer, and what shows that they are looked at.

Run by ctest (../run).
"""

import os
import unittest
from pathlib import Path
from typing import Any

import numpy as np
from material import POLICY
from random_calls import Tally, fault_of, run
from thing import Thing

import earshot
import earshot.gym

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


def misaligned(array):
    """The same numbers, a byte beside where the processor wants them."""
    bytes_ = np.zeros(array.nbytes + 1, np.uint8)
    beside = bytes_[1:].view(array.dtype).reshape(array.shape)
    beside[...] = array
    assert beside.flags.c_contiguous and not beside.flags.aligned
    return beside


class Misaligned(unittest.TestCase):
    """Where UndefinedBehaviorSanitizer watches (.ci/slow), C++ that reads these as they are ends."""

    def test_arrays_are_read_as_others(self):
        rng = np.random.default_rng(1)
        policy, world = earshot.gym.FrozenPolicy(POLICY), earshot.gym.make_world()
        noise = rng.normal(0.0, 0.02, 130 * 200).astype(np.float32)
        reads: tuple[tuple[Any, Any], ...] = (
            (policy.logits, rng.normal(0.0, 1.0, (3, 58)).astype(np.float32)),
            (world.snr_db, rng.uniform(0.0, 3e4, 5)),
            (lambda samples: earshot.listen(samples, 200.0).noise_db, noise),
        )
        for read, array in reads:
            np.testing.assert_array_equal(read(misaligned(array)), read(array))
        envs = [earshot.gym.AcousticSearchVectorEnv(2) for _ in range(2)]
        for env in envs:
            env.reset(seed=1)
        actions = np.array([0, 2])
        np.testing.assert_array_equal(envs[0].step(misaligned(actions))[0], envs[1].step(actions)[0])


if __name__ == "__main__":
    unittest.main()
