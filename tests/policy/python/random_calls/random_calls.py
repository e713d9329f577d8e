"""Random calls of all that the package offers, many of them wrong: each returns, or refuses in Earshot's own words.

A call that does neither is shown with its number, what it was told, and what came of it. The same seed makes the same
calls, and each has random numbers of its own, so that it can be made alone. .ci/slow makes 10 000.

usage: PYTHON tests/policy/python/random_calls/random_calls.py PROGRAMS COUNT [FIRST [SEED]]
PYTHON: one into which policy/python/install-into has put the package
"""

import dataclasses
import faulthandler
import os
import pickle
import sys
import tempfile
import time
import traceback
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
import pandas
import xarray
from random_values import Values
from things import Things

import earshot

_WAITED_S = 0.5  # for one call that tells how far it is; then it is let go
_LONGEST_S = 10.0  # of a call

# Of Python, as the docstrings of earshot.gym and Listener.push have them.
_OF_GYM = (ValueError, TypeError, FileNotFoundError, RuntimeError, AttributeError, gymnasium.error.Error)
_OWN_WARNINGS = (
    earshot.EvaluationWarning,
    earshot.FieldWarning,
    earshot.JournalWarning,
    earshot.RecordingWarning,
)


class Enough(Exception):
    """Raised by the callback that is told how far a call is."""


@dataclasses.dataclass
class Tally:
    """How calls ended, by function."""

    returned: dict[str, int] = dataclasses.field(default_factory=dict)
    refused: dict[str, int] = dataclasses.field(default_factory=dict)
    faults: list[str] = dataclasses.field(default_factory=list)


def touch(value: Any, deep: int = 0) -> None:
    """Reads all of a result, as whoever asked for it does: memory that is not its own would show."""
    if isinstance(value, xarray.Dataset):
        for name in value.variables:
            touch(value[name].values)
        value.attrs.values()
    elif isinstance(value, (pandas.DataFrame, xarray.DataArray)):
        touch(value.to_numpy())
    elif isinstance(value, np.ndarray):
        value.tobytes()
        if value.dtype.kind == "f" and value.size:
            np.nansum(np.where(np.isfinite(value), value, 0.0))
    elif isinstance(value, (dict, list, tuple)) and deep < 4:
        for each in value.values() if isinstance(value, dict) else value:
            touch(each, deep + 1)
    elif dataclasses.is_dataclass(value) and not isinstance(value, type):
        touch({field.name: getattr(value, field.name) for field in dataclasses.fields(value)}, deep + 1)
    elif isinstance(value, earshot.Environment):
        touch([value.name, value.frequency, value.source_depths, value.receiver_range, value.crc32, repr(value)])
        pickle.loads(pickle.dumps(value))
    elif isinstance(value, earshot.Tables):
        touch([value.to_xarray(), value.provenance, repr(value)])
    elif isinstance(value, earshot.Belief):
        touch([value.probabilities, value.summary, value.hypotheses, value.actions, value.declaration, repr(value)])


def watch() -> Callable[[float], None]:
    """A callback that lets a call go on for a while."""
    begin = time.monotonic()

    def progress(share: float) -> None:
        if not 0.0 <= share <= 1.0:
            raise AssertionError(f"told that a share of {share} is done")
        if time.monotonic() - begin > _WAITED_S:
            raise Enough

    return progress


def fault_of(thing: Any, call: Callable[[], Any], tally: Tally) -> str | None:
    """Makes the call; what is wrong with how it ended."""
    begin = time.monotonic()
    outcome = tally.returned
    try:
        touch(call())
    except Enough:
        pass
    except earshot.BadInput as bad:
        outcome = tally.refused
        if not str(bad) or len(str(bad)) > 20_000:
            return f"refused in {len(str(bad))} characters: {str(bad)[:200]}"
        repr(pickle.loads(pickle.dumps(earshot.BadInput(str(bad), key=bad.key))))
    except Exception as wrong:
        if not thing.is_gym or not isinstance(wrong, _OF_GYM):
            return traceback.format_exc(limit=-6)
        outcome = tally.refused
        if not str(wrong):
            return f"{type(wrong).__name__} without a word"
    took = time.monotonic() - begin
    if took > _LONGEST_S:
        return f"took {took:.0f} s"
    outcome[thing.name] = outcome.get(thing.name, 0) + 1
    return None


def shown(arguments: dict[str, Any]) -> str:
    def text(value: Any) -> str:
        if isinstance(value, np.ndarray):
            return f"array({value.shape}, {value.dtype}, {np.array2string(value.reshape(-1)[:6])})"
        try:
            return repr(value)[:200]
        except Exception as wrong:
            return f"<{type(value).__name__}: {wrong}>"

    return ", ".join(f"{name}={text(value)}" for name, value in arguments.items())


def run(programs: Path, count: int, first: int = 0, seed: int = 1, *, tell: bool = False) -> Tally:
    """Makes calls first, ..., first + count - 1; `tell` names each on the error output before it is made."""
    tally = Tally()
    programs = programs.resolve()
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)  # what is told to write writes there
        things = Things(programs, Path(folder))
        for i in range(first, first + count):
            values = Values(np.random.default_rng([seed, i]), Path(folder))
            thing, call, arguments = things.drawn(values, watch)
            if tell:
                print(f"\r{i} {thing.name:24}", end="", file=sys.stderr, flush=True)
            faulthandler.dump_traceback_later(60.0, exit=True)
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                for own in (*_OWN_WARNINGS, DeprecationWarning, FutureWarning):
                    warnings.simplefilter("ignore", own)
                if thing.is_gym:
                    warnings.simplefilter("ignore", UserWarning)
                wrong = fault_of(thing, call, tally)
            faulthandler.cancel_dump_traceback_later()
            if wrong is not None:
                tally.faults.append(f"call {i} of seed {seed}: {thing.name}({shown(arguments)})\n{wrong}")
    return tally


if __name__ == "__main__":
    ended = run(Path(sys.argv[1]), *map(int, sys.argv[2:]), tell=True)
    print("\n\n".join(["", *ended.faults]))
    for name in sorted({*ended.returned, *ended.refused}):
        print(f"{name:32} {ended.returned.get(name, 0):6} returned {ended.refused.get(name, 0):6} refused")
    print(f"{len(ended.faults)} faults")
    sys.exit(1 if ended.faults else 0)
