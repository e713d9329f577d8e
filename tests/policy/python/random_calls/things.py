"""All that is called at random.

Used as a module by random_calls.
"""

import functools
import inspect
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from material import Material
from of_search import OfSearch
from of_sound import OfSound
from random_values import Values
from thing import Thing


class Things:
    """All of them, and the files and objects that they take."""

    def __init__(self, programs: Path, folder: Path) -> None:
        material = Material(programs, folder)
        self.things = OfSound(material).things() + OfSearch(material).things()
        self.weights = np.array([thing.weight for thing in self.things])

    def drawn(self, values: Values, watch: Any) -> tuple[Thing, Callable[[], Any], dict[str, Any]]:
        """One of them; some of its arguments are made worse, of others there may be none."""
        thing = self.things[int(values.rng.choice(len(self.things), p=self.weights / self.weights.sum()))]
        arguments = thing.good(values)
        parameters = inspect.signature(thing.call).parameters.values()
        needed = {parameter.name for parameter in parameters if parameter.default is parameter.empty}
        for name in [name for name in arguments if name not in needed and name not in thing.always_given]:
            if values.chance(0.1):
                del arguments[name]
        for _ in range(values.one_of((0, 0, 1, 1, 1, 2))):
            if not arguments:
                break
            name = values.one_of(list(arguments))
            value = arguments[name]
            if isinstance(value, np.ndarray) and values.chance(0.6):
                arguments[name] = values.odd_array(value)
            elif isinstance(value, tuple) and value and values.chance(0.5):
                parts = list(value)
                parts[int(values.rng.integers(len(parts)))] = values.anything()
                arguments[name] = tuple(parts)
            elif isinstance(value, Path) and value.is_file() and values.chance(0.7):
                arguments[name] = values.damaged(value)
            else:
                arguments[name] = values.anything()
        told = dict(arguments)
        if thing.has_progress:
            told["progress"] = watch()
        return thing, functools.partial(thing.call, **told), arguments
