"""How well policies find the source, in many simulated searches."""

from __future__ import annotations

import io
import os
import re
import warnings as python_warnings
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Union

import numpy as np

from earshot import core
from earshot.arguments import is_path, number, path, require_callable, text, truth_value, whole_number
from earshot.errors import BadInput, BadType
from earshot.ocean_tables import Tables
from earshot.oceans import PAPER_ENVIRONMENT, Environment

if TYPE_CHECKING:
    import pandas

__all__ = ["EvaluationWarning", "baselines", "evaluate"]

Path_ = Union[str, "os.PathLike[str]"]
Choose = Callable[[tuple[float, float], float, bool, int], int]

_UNITS = {"hours": "h", "us": "us"}  # by a word of the column's name; all else is a number or a share


class EvaluationWarning(UserWarning):
    """A policy is tested otherwise than it was trained."""


def baselines() -> dict[str, str]:
    """Name and purpose of every searcher that is not learned."""
    return dict(core.baselines())


def _bound(name: str, policy: Any) -> tuple[str, tuple[Any, Any, Any]]:
    choose = getattr(policy, "choose", None) or policy
    if not callable(choose) or isinstance(policy, (np.ndarray, np.generic)):  # NumPy's choose() is another one
        raise BadType(
            f"policies: {name} must be a name, a path, a callable, or an object with choose()",
            key="policies",
            value=policy,
        )
    begin, declares_found = getattr(policy, "begin", None), getattr(policy, "declares_found", None)
    for method, what in (("begin", begin), ("declares_found", declares_found)):
        if what is not None and not callable(what):
            raise BadType(f"policies: {method} of {name} must be callable", key="policies", value=policy)
    if not name or not name.isprintable():
        raise BadInput(f"policies: {name!r} must be a name of printable characters", key="policies", value=name)
    return name, (begin, choose, declares_found)


def _policies(given: Any) -> list[Any]:
    if isinstance(given, Mapping):
        if not given:
            raise BadInput("policies: must be one or more", key="policies", value=given)
        return [_bound(text("policies", name), policy) for name, policy in given.items()]
    each = given if isinstance(given, Sequence) and not isinstance(given, (str, bytes)) else [given]
    if not each:
        raise BadInput("policies: must be one or more", key="policies", value=given)
    found: list[Any] = []
    for policy in each:
        if isinstance(policy, Mapping):
            found += _policies(policy)
        elif is_path(policy):
            found.append(text("policies", str(path("policies", policy))))
        else:
            found.append(_bound(str(getattr(policy, "__name__", type(policy).__name__)), policy))
    names = [one if isinstance(one, str) else one[0] for one in found]
    twice = next((name for i, name in enumerate(names) if name in names[:i]), None)
    if twice is not None:
        raise BadInput(
            f"policies: {twice} stands there twice; {{name: policy}} gives names", key="policies", value=given
        )
    return found


def _ocean(name: str, given: Any) -> Any:
    if isinstance(given, Environment):
        return given._scenario()
    if is_path(given):
        return path(name, given)
    raise BadType(f"{name}: must be earshot.Environment, or a path", key=name, value=given)


def _as_argument(bad: BadInput, files: Sequence[tuple[str, Path]]) -> BadInput:
    """What is wrong, as the programs say it, with the name of the argument."""
    refusal = re.sub("^(--policies:|POLICY) ", "policies: ", str(bad))
    if argument := re.match("(policies|tables): ", refusal):
        return BadInput(refusal, key=argument[1], value=bad.value)
    for name, file in files:
        if refusal.startswith(f"{core.printable(file)}:"):
            return bad.about(str(file), core.printable(file), key=name, value=file)
    return bad


def _several(name: str, given: Any) -> list[Any]:
    if given is None:
        return []
    if isinstance(given, (Environment, Tables, str, os.PathLike)):
        return [given]
    if not isinstance(given, Sequence) or isinstance(given, bytes):
        raise BadType(f"{name}: must be one, or a list of them", key=name, value=given)
    if not given:
        raise BadInput(f"{name}: must be one or more, or None", key=name, value=given)
    return list(given)


def _tables(given: Any) -> list[tuple[str, core.Tables]]:
    found = []
    for one in _several("tables", given):
        if isinstance(one, Tables):
            found.append((repr(one), one._tables))
        elif is_path(one):
            place = path("tables", one)
            files = sorted(place.glob("*.tables")) if place.is_dir() else [place]
            if not files:
                raise BadInput(f"tables = {one}: holds no file of tables (.tables)", key="tables", value=one)
            found += [(core.printable(file), Tables.from_file(file)._tables) for file in files]
        else:
            raise BadType("tables: must be earshot.Tables, or paths", key="tables", value=one)
    return found


def evaluate(
    policies: str | os.PathLike[str] | Choose | Sequence[Any] | Mapping[str, Any],
    worlds: Environment | Path_ | Sequence[Environment | Path_] | None = None,
    n: int = 300,
    *,
    environment: Environment | Path_ = PAPER_ENVIRONMENT,
    tables: Tables | Path_ | Sequence[Tables | Path_] | None = None,
    seed: int | None = None,
    source: str | None = None,
    start: str | None = None,
    vehicle_depth: float | None = None,
    border_width: float | None = None,
    max_steps: int | None = None,
    declared: bool = False,
    progress: Callable[[float], object] | None = None,
) -> pandas.DataFrame:
    """Flies `n` simulated searches in each world with each policy: what `earshot evaluate` measures, number by number.

    policies      one, or several: the path of a `.policy` file, a name of `earshot.baselines()`, or a policy written in
                  Python; or {name: policy in Python}
    worlds        where they search: `Environment`s, or paths of environments and worlds; None: in `environment`
    environment   the ocean that baselines go by; the default is the paper's
    tables        `Tables`, or paths of files or folders, one or several: the oceans that beliefs think possible; of
                  several those for a world's depth and frequency. None: the environment's own ocean alone
    seed          of starts, sources and what policies draw; None: a world's own, or 1
    source        "changing" or "fixed"; start: "domain" or "inside_border"; vehicle_depth, border_width: m;
                  max_steps. None: as the policies were trained, or "changing", "inside_border", 300 m, 1000 m, 100;
                  `earshot.gym` starts in the "domain" where nothing is given
    declared      as at sea: a search of a policy that declares the source found ends when it rightly does
    progress      called with the share of the work that is done, 0 to 1

    A policy in Python is a function choose(position, snr, too_faint, step) -> action, or an object with that as a
    method. `position` is (north, east) in m from the area's south-west corner, where navigation believes the vehicle;
    `snr` in dB is what was heard there, or where `too_faint` the least that could have been measured; `step` is 0 at
    the start of each search. An action is a compass direction, clockwise, 0 is north, 8 of them where no learned policy
    has others. The object may have begin(seed), called before each search, and declares_found() -> bool.
    All policies meet the same searches.

    Returns a DataFrame, a row for each world and policy, with columns of the program's CSV: world, policy, episodes,
    found_fraction, median_hours_to_find, mean_steps, mean_reward and others, with quartiles and 95 % intervals (_low,
    _high). Times are in hours and in steps, shares from 0 to 1. In `attrs`: `units`, by column. Warns
    (EvaluationWarning) of policies that are tested otherwise than trained.

    Raises BadInput, BadType, and what a policy in Python raises. KeyboardInterrupt within some tenths of a second.

    >>> def north_then_west(position, snr, too_faint, step):
    ...     return 0 if step < 10 else 6
    >>> earshot.evaluate([north_then_west, "bayes"], n=20)[["policy", "found_fraction"]]
    """
    import pandas

    require_callable(progress)
    asked: dict[str, Any] = {
        "policies": _policies(policies),
        "worlds": [_ocean("worlds", world) for world in _several("worlds", worlds)],
        "environment": _ocean("environment", environment),
        "tables": _tables(tables),
        "episodes": whole_number("n", n),
        "seed": None if seed is None else whole_number("seed", seed),
        "vehicle_depth": None if vehicle_depth is None else number("vehicle_depth", vehicle_depth),
        "source": None if source is None else text("source", source),
        "start": None if start is None else text("start", start),
        "border_width": None if border_width is None else number("border_width", border_width),
        "max_steps": None if max_steps is None else whole_number("max_steps", max_steps),
        "declared": truth_value("declared", declared),
        "progress": progress,
    }
    try:
        csv, warned = core.evaluate(**asked)
    except BadType:
        raise  # of a policy in Python
    except BadInput as bad:
        of = [("environment", asked["environment"]), *(("worlds", world) for world in asked["worlds"])]
        raise _as_argument(bad, [(name, file) for name, file in of if isinstance(file, Path)]) from None
    for sentence in warned:
        python_warnings.warn(sentence, EvaluationWarning, stacklevel=2)
    frame = pandas.read_csv(
        io.StringIO(csv),
        dtype={"world": str, "policy": str},
        keep_default_na=False,
        na_values=[""],
        float_precision="round_trip",
    )
    frame.attrs["units"] = {
        str(column): next((unit for word, unit in _UNITS.items() if word in str(column).split("_")), "1")
        for column in frame
        if column not in ("world", "policy")
    }
    return frame
