"""Sound as people give it, made into what the C++ module takes: files, or samples of one channel."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from earshot.arguments import is_path, path, whole_number
from earshot.errors import BadInput, BadType

__all__ = ["array", "bits_of", "blocks_of", "files_of", "largest_magnitude", "one_channel", "scaled"]

_BLOCK = 1 << 24  # samples
_MOST_CHANNELS = 1024
_BITS_OF_FLOAT = {2: 11, 4: 24}  # by size in bytes; larger ones are heard as those of four


def bits_of(dtype: np.dtype[Any]) -> int:
    """That a sample of this type carries."""
    return _BITS_OF_FLOAT.get(dtype.itemsize, 24) if dtype.kind == "f" else min(8 * dtype.itemsize, 32)


def files_of(samples: Any) -> list[Path] | None:
    """None for an array."""
    named = list(samples) if isinstance(samples, (list, tuple)) else [samples]
    if not named or not all(is_path(name) for name in named):
        return None
    return [path("samples", name) for name in named]


def array(name: str, samples: Any) -> NDArray[Any]:
    """Numbers of any shape, with nothing masked."""
    if np.ma.is_masked(samples):
        raise BadInput(f"{name}: must not be masked: fill what is masked, or listen to its parts", key=name)
    try:
        given = np.asarray(samples)
    except (TypeError, ValueError) as wrong:
        raise BadType(f"{name}: must be an array, a file or a list of files: {wrong}", key=name) from None
    if given.dtype.kind not in "iuf":
        raise BadType(f"{name}: must be integers or floating point, not {given.dtype}", key=name, value=samples)
    return given


def one_channel(name: str, given: NDArray[Any], channel: Any, is_whole: bool = False) -> NDArray[Any]:
    """[n_sample], a view."""
    if given.ndim not in (1, 2):
        shapes = "[n_sample] or [n_sample x n_channel]"
        raise BadType(f"{name}: must be {shapes}, has the shape {given.shape}", key=name, value=given)
    channels = 1 if given.ndim == 1 else given.shape[1]
    if channels > _MOST_CHANNELS or (is_whole and channels > given.shape[0] > 0):
        raise BadInput(
            f"{name}: must be [n_sample x n_channel], has the shape {given.shape}: transpose it", key=name, value=given
        )
    if not 1 <= whole_number("channel", channel) <= channels:
        raise BadInput(f"channel = {channel}: {name} has {channels}", key="channel", value=channel)
    return given if given.ndim == 1 else given[:, int(channel) - 1]


def blocks_of(sound: NDArray[Any]) -> Iterator[tuple[int, NDArray[Any]]]:
    """Its blocks, each with the number of its first sample: what is made of one takes 64 MB, however long it all is."""
    for begin in range(0, sound.size, _BLOCK):
        yield begin, sound[begin : begin + _BLOCK]


def largest_magnitude(name: str, sound: NDArray[Any]) -> float:
    """Of floating-point samples that exceed 1, else 1. Refuses what is not finite."""
    largest = 1.0
    if sound.dtype.kind == "f":
        for begin, block in blocks_of(sound):
            shares = scaled(name, block, begin)
            largest = max(largest, float(shares.max()), -float(shares.min()))
    return largest


def scaled(name: str, sound: NDArray[Any], begin: int = 0) -> NDArray[np.float32]:
    """Shares of full scale, contiguous, as libsndfile makes them of a file's samples; `begin`: number of the first."""
    if sound.dtype.kind == "f":
        with np.errstate(over="ignore"):
            shares = np.ascontiguousarray(sound, dtype=np.float32)
        if not np.isfinite(shares).all():
            first = int(np.argmin(np.isfinite(shares)))
            raise BadInput(
                f"{name}[{begin + first}] = {sound[first]}: must be finite, as float32", key=name, value=sound
            )
        return shares
    full_scale = 2.0 ** (8 * sound.dtype.itemsize - 1)
    if sound.dtype.kind == "u":
        return ((sound.astype(np.float64) - full_scale) / full_scale).astype(np.float32)
    return sound.astype(np.float32) * np.float32(1.0 / full_scale)
