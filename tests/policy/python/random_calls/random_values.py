"""Arguments as nobody should give them: arrays and numbers of every kind, texts, objects, and files that were damaged.

Used as a module by random_calls.
"""

import datetime
import decimal
import fractions
from pathlib import Path
from typing import Any

import numpy as np
import pandas
import xarray

_DTYPES = ("f8", "f4", "f2", "g", ">f8", "i8", "i2", "u1", "u8", "?", "c16", "O", "U8", "S4", "M8[s]", "m8[s]", "V8")
_NUMBERS: tuple[Any, ...] = (
    *(0.0, -0.0, 1.0, -1.0, 0.5, 3, 7, 1e-300, 1e300, -1e300, 1e38, 1e-9, 2**31, 2**53, 2**63, 2**64, 10**400),
    *(np.nan, np.inf, -np.inf, np.float32(30.0), np.float16(2.0), np.int8(5), np.uint64(2**64 - 1), np.bool_(True)),
    *(True, False, 1j, decimal.Decimal("1.5"), fractions.Fraction(1, 3), np.longdouble("1e4000"), np.datetime64("NaT")),
)


class Awkward:
    """Fails in whatever way it is looked at."""

    def __array__(self, *_: Any, **__: Any) -> Any:
        raise ValueError("no array")

    def __float__(self) -> float:
        raise ValueError("no number")

    def __len__(self) -> int:
        raise ValueError("no length")

    def __fspath__(self) -> Any:
        return 5


class Values:
    """Draws them."""

    def __init__(self, rng: np.random.Generator, folder: Path) -> None:
        self.rng = rng
        self.folder = folder

    def one_of(self, choices: Any) -> Any:
        return choices[int(self.rng.integers(len(choices)))]

    def chance(self, share: float) -> bool:
        return bool(self.rng.random() < share)

    def number(self, low: float, high: float) -> Any:
        """Between the two, as a number of Python or NumPy."""
        value = float(self.rng.uniform(low, high))
        return self.one_of((float, np.float32, np.float64, int, np.asarray))(value)

    def ascending(self, low: float, high: float, most: int = 6) -> Any:
        """[n] between the two."""
        return np.sort(self.rng.uniform(low, high, int(self.rng.integers(1, most))))

    def odd_array(self, good: Any = None) -> Any:
        """Of the good one, or of noise: other types, layouts, shapes, and numbers that are none."""
        array = np.array(self.rng.normal(100.0, 300.0, int(self.rng.integers(0, 9))) if good is None else good)
        for _ in range(int(self.rng.integers(1, 4))):
            array = self._odd(array)
        if self.chance(0.2):
            array.flags.writeable = False
        return array.tolist() if self.chance(0.15) else array

    def _odd(self, array: Any) -> Any:
        if array.dtype.kind == "f" and array.size > 0 and self.chance(0.4):
            array = np.array(array)
            array.flat[int(self.rng.integers(array.size))] = self.one_of((np.nan, np.inf, -np.inf, -5.0, 1e300, 0.0))
            return array
        rank = array.ndim
        changes = (
            lambda: array.astype(self.one_of(_DTYPES)),
            lambda: array[:0],
            lambda: array[..., ::-1],
            lambda: np.repeat(array, 2, axis=-1)[..., ::2],
            lambda: array.T,
            lambda: np.asfortranarray(array),
            lambda: array[None],
            lambda: array[..., None],
            lambda: np.broadcast_to(array, (3, *array.shape)),
            lambda: np.broadcast_to(array.flat[0], (4,)),
            lambda: array.reshape(-1),
            lambda: np.concatenate([array] * 40),
            lambda: np.lib.stride_tricks.as_strided(array, (5,) * max(rank, 1), (0,) * max(rank, 1)),
            lambda: np.frombuffer(b"\0" + array.astype("f8").tobytes(), "f8", offset=1) if array.size else array,
            lambda: np.empty((2, 0, 3)),
            lambda: np.ones((1,) * 33) if rank < 2 else array,  # more axes than NumPy has
        )
        try:
            with np.errstate(all="ignore"):
                return np.asarray(self.one_of(changes)())
        except (TypeError, ValueError, IndexError, OverflowError):
            return array  # this array cannot be changed so

    def anything(self) -> Any:
        """Of whatever type."""
        kinds: tuple[Any, ...] = (
            lambda: self.one_of(_NUMBERS),
            lambda: self.one_of(_NUMBERS),
            self.odd_array,
            self.odd_array,
            lambda: self.one_of(("", "fin", "a\0b", "\ud800", "\udc80", "nowhere/x.nc", "%", "{", "\n", "x" * 5_000)),
            lambda: self.one_of((b"bytes", bytearray(8), memoryview(b"12345678"), None, Ellipsis, NotImplemented)),
            lambda: self.one_of(([], (), {}, set(), [[]], [[1.0, 2.0], [3.0]], [None], (1.0, "a"), {1: 2}, range(3))),
            lambda: self.one_of((object(), Awkward(), len, iter([1.0]), int, (x for x in (1.0, 2.0)))),
            lambda: np.ma.masked_array([1.0, 2.0, 3.0], [False, True, False]),
            lambda: np.zeros(3, [("a", "f8"), ("b", "i4")]),
            lambda: np.rec.array([(1.0, 2)], dtype=[("a", "f8"), ("b", "i4")]),
            lambda: self.labelled(self.one_of(("range", "depth", "layer", "x"))),
            lambda: pandas.Series([1.0, np.nan, 3.0]),
            lambda: pandas.DataFrame({"begin_s": [1.0, np.nan], "end_s": [2.0, 3.0]}),
            lambda: datetime.datetime(1, 1, 1, tzinfo=datetime.timezone(datetime.timedelta(hours=14))),
            lambda: self.folder,
            lambda: self.folder / "nowhere",
        )
        return self.one_of(kinds)()

    def labelled(self, *dims: str) -> Any:
        """A DataArray or a Dataset with these dimensions, coordinates or none."""
        sizes = self.rng.integers(0, 5, len(dims))
        values = self.odd_array(self.rng.uniform(0.0, 2_000.0, sizes)) if self.chance(0.2) else np.full(sizes, 1_500.0)
        coords = {dims[i]: np.arange(sizes[i]) * 100.0 for i in range(len(dims)) if self.chance(0.8)}
        try:
            array = xarray.DataArray(values, coords, dims, "sound_speed")
        except (ValueError, TypeError):
            return xarray.DataArray(5.0)
        return array.to_dataset() if self.chance(0.3) else array

    def damaged(self, file: Path) -> Path:
        """A copy of a file with some bytes changed, cut or doubled."""
        data = bytearray(file.read_bytes())
        for _ in range(int(self.rng.integers(1, 5))):
            at = int(self.rng.integers(max(len(data), 1)))
            size = int(self.rng.integers(1, 16))
            change = int(self.rng.integers(5))
            if change == 0 and data:
                data[at] ^= 1 << int(self.rng.integers(8))
            elif change == 1:
                data[at : at + size] = self.rng.bytes(size)
            elif change == 2:
                del data[at : at + size]
            elif change == 3:
                data[at:at] = data[at : at + size] * int(self.rng.integers(1, 9))
            elif self.chance(0.3):
                del data[at:]
        copy = self.folder / f"damaged{file.suffix}"
        copy.write_bytes(data)
        return copy
