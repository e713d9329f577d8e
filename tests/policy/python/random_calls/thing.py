"""A call that is made at random.

Used as a module by those beside it.
"""

import dataclasses
from collections.abc import Callable
from typing import Any

from random_values import Values


@dataclasses.dataclass(frozen=True)
class Thing:
    """A call, and how often it is made beside the others."""

    name: str
    good: Callable[[Values], dict[str, Any]]
    call: Callable[..., Any]
    weight: float = 1.0
    is_gym: bool = False
    has_progress: bool = False
    always_given: tuple[str, ...] = ()
