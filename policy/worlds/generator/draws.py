"""Numbers drawn from a seed, the same on every machine and in every version of Python."""

from __future__ import annotations

import math
import random
from collections.abc import Sequence
from typing import TypeVar

T = TypeVar("T")


class Draws:
    """Takes from Python's generator nothing but random(), which alone is promised to stay as it is."""

    def __init__(self, seed: str) -> None:
        self._random = random.Random(seed)

    def fraction(self) -> float:
        """At least 0, less than 1."""
        return self._random.random()

    def uniform(self, low: float, high: float) -> float:
        return low + self.fraction() * (high - low)

    def log_uniform(self, low: float, high: float) -> float:
        return low * math.pow(high / low, self.fraction())

    def one_of(self, values: Sequence[T]) -> T:
        return values[int(self.fraction() * len(values))]

    def happens(self, probability: float) -> bool:
        return self.fraction() < probability


def van_der_corput(index: int, base: int) -> float:
    """The digits of index in this base, mirrored about the point: 1, 2, 3 in base 2 are 0.5, 0.25, 0.75.

    Over every base^k indices in a row, each base^k-th part of [0, 1) is met once.
    Source: van der Corput, Proc. Kon. Ned. Akad. v. Wetensch. 38 (1935) 813; one base a dimension: Halton, Numer.
    Math. 2 (1960) 84.
    """
    value, place = 0.0, 1.0 / base
    while index > 0:
        index, digit = divmod(index, base)
        value += digit * place
        place /= base
    return value
