"""Arguments as people give them, made into what the C++ module takes; what cannot be made so is refused by its name."""

from __future__ import annotations

import errno
import os
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, Union

import numpy as np
from numpy.typing import NDArray

from earshot.errors import BadInput, BadType

__all__ = [
    "Numbers",
    "Place",
    "axis",
    "count",
    "is_labelled",
    "is_path",
    "number",
    "one_or_more",
    "path",
    "place",
    "rank",
    "require_callable",
    "text",
    "truth_value",
    "whole_number",
]

Place = tuple[float, float]  # north and east, m
Numbers = Union[float, Sequence[float], NDArray[Any]]


def is_labelled(value: Any) -> bool:
    """Whether it is an array of xarray, which need not be installed for those who have none."""
    return hasattr(value, "dims") and hasattr(value, "coords")


def _floats(name: str, value: Any) -> NDArray[np.float64]:
    if np.ma.is_masked(value):
        raise BadInput(f"{name}: must hold no masked numbers", key=name, value=value)
    try:
        given = np.asarray(value)
    except (TypeError, ValueError) as wrong:
        raise BadType(
            f"{name}: must be numbers, all rows as long as the first: {wrong}", key=name, value=value
        ) from None
    if given.dtype.kind not in "iuf":
        what = "text" if given.dtype.kind in "US" else given.dtype
        raise BadType(f"{name}: must be numbers, not {what}", key=name, value=value)
    with np.errstate(over="ignore"):  # of more than float64: infinite, as whoever bounds it sees
        return np.ascontiguousarray(given, dtype=np.float64).reshape(given.shape)


def number(name: str, value: Any) -> float:
    """One number, finite or not. BadType for what is none, also for a truth value."""
    found = _floats(name, value)
    if found.ndim != 0:
        raise BadType(f"{name}: must be one number, has the shape {found.shape}", key=name, value=value)
    return float(found)


def rank(name: str, value: Any) -> int:
    """How many axes the numbers have, 0 for one. BadType for what are none."""
    return int(_floats(name, value).ndim)


def whole_number(name: str, value: Any) -> int:
    """One whole number, 0 or more."""
    found = number(name, value)
    if not (0.0 <= found < 2**53 and found.is_integer()):
        raise BadInput(f"{name} = {value}: must be a whole number, 0 or more", key=name, value=value)
    return int(found)


def count(name: str, value: Any) -> int:
    """How many there are to be, one at least."""
    found = whole_number(name, value)
    if not 1 <= found < 2**31:
        raise BadInput(f"{name} = {value}: must be 1 or more, and less than 2^31", key=name, value=value)
    return found


def truth_value(name: str, value: Any) -> bool:
    if not isinstance(value, (bool, np.bool_)):
        raise BadType(f"{name}: must be True or False", key=name, value=value)
    return bool(value)


def require_callable(progress: Callable[[float], object] | None) -> None:
    if progress is not None and not callable(progress):
        raise BadType("progress: must be callable, or None", key="progress", value=progress)


def axis(name: str, value: Any, dimensions: int = 1) -> NDArray[np.float64]:
    """Numbers with `dimensions` axes, at least one number; float64, contiguous, a copy where it has to be."""
    found = _floats(name, value)
    if found.ndim != dimensions:
        raise BadType(
            f"{name}: must be an array of rank {dimensions}, has the shape {found.shape}", key=name, value=value
        )
    if found.size == 0:
        raise BadInput(f"{name}: must hold one number or more", key=name, value=value)
    return found


def place(name: str, value: Any) -> Place:
    """Two numbers, finite or not."""
    found = np.atleast_1d(one_or_more(name, value))
    if found.size != 2:
        raise BadInput(f"{name}: must be two numbers, north and east", key=name, value=value)
    return float(found[0]), float(found[1])


def one_or_more(name: str, value: Any) -> Any:
    """[n], or [] of one number."""
    return np.float64(number(name, value)) if rank(name, value) == 0 else axis(name, value)


def text(name: str, value: Any) -> str:
    """A text that others can be given, in UTF-8."""
    if not isinstance(value, str):
        raise BadType(f"{name}: must be a text", key=name, value=value)
    try:
        value.encode()
    except UnicodeEncodeError:
        raise BadInput(
            f"{name} = {value!r}: must be a text without halves of characters", key=name, value=value
        ) from None
    return value


def is_path(value: Any) -> bool:
    return isinstance(value, (str, os.PathLike))


def _is_too_long(file: str) -> bool:
    """For the computer's file system."""
    try:
        os.lstat(file)
    except (OSError, ValueError) as wrong:
        return isinstance(wrong, OSError) and wrong.errno == errno.ENAMETOOLONG
    return False


def path(name: str, value: Any) -> Path:
    """A file's or a folder's name, whether it is there or not."""
    if not is_path(value):
        raise BadType(f"{name}: must be a text or a path", key=name, value=value)
    try:
        given = os.fsdecode(value)
    except TypeError:  # a PathLike that gives neither
        raise BadType(f"{name}: must be a text or a path", key=name, value=value) from None
    try:
        os.fsencode(given)
    except UnicodeEncodeError:
        given = ""
    if not given or "\0" in given or _is_too_long(given):
        raise BadInput(f"{name} = {value!r}: must be the name of a file or a folder", key=name, value=value)
    return Path(given)
