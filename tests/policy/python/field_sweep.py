"""1,000 random oceans and questions: `earshot.field` against `earshot field`, bit for bit. Minutes; not run by ctest.

usage: PYTHON tests/policy/python/field_sweep.py PROGRAMS [CASES [SEED]]
PYTHON: one into which policy/python/install-into has put the package
"""

import sys
import tempfile
from pathlib import Path

import numpy as np
from field_cases import random_ocean, random_question, require_same


def sweep(programs, cases=1_000, seed=1):
    rng, computed = np.random.default_rng(seed), 0
    with tempfile.TemporaryDirectory() as folder:
        for i in range(cases):
            ocean, (question, options) = random_ocean(rng), random_question(rng)
            try:
                computed += require_same(programs, Path(folder), ocean, question, options)
            except AssertionError:
                print(f"case {i} of seed {seed}: {ocean} {question}", file=sys.stderr)
                raise
    print(f"{cases} cases: {computed} fields equal bit for bit, {cases - computed} refused by both")


if __name__ == "__main__":
    sweep(sys.argv[1], *map(int, sys.argv[2:]))
