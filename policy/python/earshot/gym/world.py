"""The choices that make a search, shared by the single and the vector environment."""

from __future__ import annotations

import copyreg
import functools
import os
from pathlib import Path
from typing import Any, TypedDict

from earshot.arguments import path
from earshot.core import BadInput, environment_crc32
from earshot.core import World as SearchWorld
from earshot.oceans import PAPER_ENVIRONMENT

__all__ = ["PAPER_ENVIRONMENT", "SearchWorld", "WorldOptions", "make_world"]


class WorldOptions(TypedDict, total=False):
    """Keyword arguments of `make_world`, and of the environments, which pass them on."""

    environment: str | os.PathLike[str]
    state: str
    remembered_steps: int
    source: str
    start: str
    directions: int
    vehicle_depth_m: float
    border_width_m: float
    max_steps: int
    listening: str
    listening_window_s: int


def make_world(
    *,
    environment: str | os.PathLike[str] = PAPER_ENVIRONMENT,
    state: str = "simple",
    remembered_steps: int = 2,
    source: str = "fixed",
    start: str = "domain",
    directions: int = 8,
    vehicle_depth_m: float = 300.0,
    border_width_m: float = 1_000.0,
    max_steps: int = 100,
    listening: str = "newest",
    listening_window_s: int = 0,
) -> SearchWorld:
    """A search with its ocean solved; the same choices give the same object: many environments solve it once.

    Where the environment file, or a file that it names, is another one than before, the ocean is solved anew.

    environment       TOML file: ocean, source, noise, conditions of the search (fluctuation, drift, pauses, ...)
    state             "simple": (x, y); "memory": (dx, dy, SNR) of each of the last `remembered_steps` steps;
                      "position_memory": both;
                      "belief": distances to the edges, where the source may be, and what each action promises
    source            "fixed" where the environment puts it, or "changing": uniform in the domain anew every episode
    start             vehicle starts uniformly in the "domain", or "inside_border", where the border costs nothing
    directions        actions: compass directions, clockwise, 0 is north; 1 to 32
    vehicle_depth_m   positive down
    border_width_m    b of the border in which the reward falls to -100
    max_steps         N, after which an episode is truncated
    listening         what an observation hears of its step, a look a second: the "newest" look, or the "loudest" or the
                      "mean" of those that were measured in the last `listening_window_s` seconds (1 to 120; 0 with
                      "newest")

    Raises FileNotFoundError, BadInput (a ValueError) that names what is wrong and what is allowed, or BadType for what
    is no path.
    """
    file = Path(os.path.realpath(path("environment", environment)))
    if not file.is_file():
        raise FileNotFoundError(f"environment: no such file: {file}")
    return _solved(
        file,
        environment_crc32(file),
        state=state,
        remembered_steps=remembered_steps,
        source=source,
        start=start,
        directions=directions,
        vehicle_depth_m=vehicle_depth_m,
        border_width_m=border_width_m,
        max_steps=max_steps,
        listening=listening,
        listening_window_s=listening_window_s,
    )


@functools.lru_cache(maxsize=16, typed=True)
def _solved(file: Path, crc32: int, **settings: Any) -> SearchWorld:
    """`crc32` is of what the file says now: the path alone would give what it said before."""
    return SearchWorld(environment=file, **settings)


def _unpickled(arguments: WorldOptions, crc32: int) -> SearchWorld:
    world = make_world(**arguments)
    if world.environment_crc32 != crc32:
        raise BadInput(
            f"environment: {world.arguments['environment']}, or a file that it names, is not what it was when this "
            f"search was pickled: CRC-32 {world.environment_crc32:08x}, then {crc32:08x}"
        )
    return world


def _pickled(world: SearchWorld) -> tuple[Any, ...]:
    """What the search was made with; the environment that comes with the package is found wherever it is installed."""
    arguments = world.arguments
    if arguments["environment"] == PAPER_ENVIRONMENT.resolve():
        del arguments["environment"]
    return _unpickled, (arguments, world.environment_crc32)


copyreg.pickle(SearchWorld, _pickled)
