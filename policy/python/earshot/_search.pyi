"""A part of the interface of `earshot._core`: beliefs and evaluation. There is no module of this name."""

import os
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from earshot._core import Ocean, _Place

class Tables:
    """What a belief thinks possible of the ocean: SNR against range in each of some oceans. Nothing of it changes."""

    @staticmethod
    def from_file(path: os.PathLike[str] | str) -> Tables: ...
    @staticmethod
    def make(
        *,
        oceans: Sequence[Ocean | os.PathLike[str]],
        vehicle_depth: float,
        max_range: float,
        range_step: float,
        bearings: int,
        at_most: int,
        progress: Callable[[float], object] | None,
    ) -> Tables: ...
    @property
    def bytes(self) -> bytes:
        """Of a `.tables` file."""
    @property
    def described(self) -> dict[str, Any]:
        """frequency, Hz; vehicle_depth, range_step, m; source_depth, sea_depth, (least, most) in m; provenance, a text;
        name, prior, sea_floor_depth (m), lists [n_table]."""
    @property
    def snr_db(self) -> NDArray[np.float32]:
        """[n_table x n_range]"""

class BeliefState:
    """The belief that flies. A copy goes on as the original would; pickled are the measurements, and taken in again."""

    def __init__(
        self,
        *,
        tables: Tables,
        area: _Place,
        step_length: float,
        directions: int,
        border_width: float,
        detection_threshold: float,
    ) -> None: ...
    def __copy__(self) -> BeliefState: ...
    def __deepcopy__(self, memo: dict[int, Any]) -> BeliefState: ...
    def update(
        self, position: _Place, *, snr: float, too_faint: bool, bearing: tuple[float, float, float | None] | None
    ) -> None:
        """bearing: direction, deviation, and mirror axis or None, degrees"""
    @property
    def tables(self) -> Tables: ...
    @property
    def area(self) -> _Place: ...
    @property
    def measurements(self) -> int: ...
    @property
    def fingerprint(self) -> int: ...
    def probabilities(self) -> NDArray[np.float32]:
        """[n_north x n_east]"""
    def summary(self) -> dict[str, Any]: ...
    def hypotheses(self) -> list[dict[str, Any]]: ...
    def actions(self) -> list[dict[str, Any]]: ...
    def declaration(self) -> dict[str, Any] | None: ...

def baselines() -> dict[str, str]:
    """Name -> what it is, of every searcher that is not learned."""

def evaluate(
    *,
    policies: Sequence[str | tuple[str, tuple[Any, Any, Any]]],
    worlds: Sequence[Ocean | os.PathLike[str]],
    environment: Ocean | os.PathLike[str],
    tables: Sequence[tuple[str, Tables]],
    episodes: int,
    seed: int | None,
    vehicle_depth: float | None,
    source: str | None,
    start: str | None,
    border_width: float | None,
    max_steps: int | None,
    declared: bool,
    progress: Callable[[float], object] | None,
) -> tuple[str, list[str]]:
    """The table of `earshot evaluate --timing` as CSV, and what is warned of, as `earshot.evaluate` describes it.

    A policy in Python is (name, (begin or None, choose, declares_found or None)).
    """
