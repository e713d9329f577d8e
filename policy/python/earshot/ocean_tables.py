"""What a belief thinks possible of the ocean."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Union

import numpy as np

from earshot import arguments, core
from earshot.arguments import number, require_callable, whole_number
from earshot.errors import BadInput, BadType
from earshot.oceans import Environment

if TYPE_CHECKING:
    import xarray

__all__ = ["Tables", "tables"]

Oceans = Union[Environment, str, "os.PathLike[str]", Sequence[Union[Environment, str, "os.PathLike[str]"]]]


_BEGIN = b"EARSHOTT"  # of a file of tables


class Tables:
    """SNR against range in each of some oceans, at one depth of the vehicle and one frequency. Nothing of it changes.

    `Tables.from_file(path)` reads a `.tables` file; `earshot.tables` makes them of environments.
    """

    def __init__(self, made: core.Tables) -> None:
        if not isinstance(made, core.Tables):
            raise BadType("Tables: come from Tables.from_file or earshot.tables", key="Tables", value=made)
        self._tables = made
        self._described = made.described

    @classmethod
    def from_file(cls, path: str | os.PathLike[str]) -> Tables:
        """The tables of a file, whoever signed it. Raises BadInput for what is none, BadType for no path."""
        file = arguments.path("path", path)
        try:
            return cls(core.Tables.from_file(file))
        except BadInput as bad:
            raise bad.about(str(file), core.printable(file), key="path", value=path) from None

    def save(self, path: str | os.PathLike[str], *, force: bool = False) -> None:
        """Writes a `.tables` file, whole or not at all.

        force  replace a file that is there already, of whatever kind; otherwise only tables are replaced

        Every tool on a desk reads it. A vehicle refuses tables that `earshot.tables` made, for they are not signed:
        `earshot tables ... --key` makes signed ones. Raises BadInput where it cannot be written.
        """
        target = arguments.path("path", path)
        arguments.truth_value("force", force)
        if target.is_symlink() or (target.exists() and not target.is_file()):
            raise BadInput(f"path = {target}: must be a file, or not be there yet", key="path", value=path)
        try:
            if target.exists() and not force and target.read_bytes()[: len(_BEGIN)] != _BEGIN:
                raise BadInput(
                    f"path = {target}: is there and holds no tables; force=True replaces it", key="path", value=path
                )
            with tempfile.NamedTemporaryFile(dir=target.parent, prefix=target.name + ".", delete=False) as file:
                written = Path(file.name)
                try:
                    file.write(self._tables.bytes)
                    file.flush()
                    written.chmod(0o644)
                    written.replace(target)
                except BaseException:
                    written.unlink(missing_ok=True)
                    raise
        except OSError as wrong:
            raise BadInput(f"path = {target}: cannot be written: {wrong.strerror}", key="path", value=path) from None

    @property
    def frequency(self) -> float:
        """Of the source, Hz."""
        return float(self._described["frequency"])

    @property
    def vehicle_depth(self) -> float:
        """m, positive down."""
        return float(self._described["vehicle_depth"])

    @property
    def provenance(self) -> str:
        """How they were made, lines of `name = value`."""
        return str(self._described["provenance"])

    def __len__(self) -> int:
        return len(self._described["name"])

    def to_xarray(self) -> xarray.Dataset:
        """snr [table x range] in dB, in half decibels as they fly; prior and sea_floor_depth [table]; names as `table`.

        Range in m; priors add up to one in tables that Earshot made.
        """
        import xarray

        described = self._described
        snr = self._tables.snr_db
        dataset = xarray.Dataset(
            {
                "snr": (
                    ("table", "range"),
                    snr,
                    {"units": "dB", "long_name": "signal-to-noise ratio at the hydrophone"},
                ),
                "prior": (("table",), np.array(described["prior"]), {"long_name": "prior probability"}),
                "sea_floor_depth": (("table",), np.array(described["sea_floor_depth"]), {"units": "m"}),
            },
            {
                "table": (("table",), described["name"]),
                "range": (("range",), described["range_step"] * np.arange(snr.shape[1]), {"units": "m"}),
            },
        )
        dataset.attrs.update(
            frequency_hz=self.frequency,
            vehicle_depth_m=self.vehicle_depth,
            source_depth_m=list(described["source_depth"]),
            sea_depth_m=list(described["sea_depth"]),
        )
        return dataset

    def __repr__(self) -> str:
        oceans = "1 ocean" if len(self) == 1 else f"{len(self)} oceans"
        return f"<earshot.Tables: {oceans}, {self.frequency:g} Hz, vehicle at {self.vehicle_depth:g} m>"

    def __copy__(self) -> Tables:
        return self

    def __deepcopy__(self, memo: dict[int, Any]) -> Tables:
        return self


def _oceans(given: Any) -> list[Any]:
    try:
        each = [given] if isinstance(given, (Environment, str, os.PathLike)) else list(given)
    except TypeError:
        each = [given]
    if not each:
        raise BadInput("environments: must be one or more", key="environments", value=given)
    oceans: list[Any] = []
    for one in each:
        if isinstance(one, Environment):
            oceans.append(one._scenario())
        elif arguments.is_path(one):
            oceans.append(arguments.path("environments", one))
        else:
            raise BadType("environments: must be of earshot.Environment, or paths", key="environments", value=one)
    return oceans


def tables(
    environments: Oceans,
    *,
    vehicle_depth: float = 300.0,
    max_range: float = 35_356.0,
    range_step: float = 100.0,
    bearings: int = 8,
    at_most: int = 96,
    progress: Callable[[float], object] | None = None,
) -> Tables:
    """SNR against range in each of some oceans, solved with the parabolic equation: as `earshot tables` makes them.

    environments   one, or several: each an `Environment` that knows its source and noise, or the path of a file, which
                   gives its own ocean and those of its [[oceans]], [family] or field library
    vehicle_depth  m, 0.1 to 12 000
    max_range      m; a source may be so far from the vehicle. The default is the diagonal of the paper's area
    range_step     m between ranges, of which a vehicle holds 512
    bearings       1 to 360: how many directions of an ocean that differs with them are tables of their own
    at_most        1 to 96; of more oceans those that are most alike become one
    progress       called with the share of the work that is done, 0 to 1

    Returns `Tables`, for `earshot.Belief` and `earshot.evaluate`. They are not signed: a vehicle refuses them.

    Raises BadInput with the argument as `key`, BadType for what is of another kind.
    """
    require_callable(progress)
    asked: dict[str, Any] = {
        "oceans": _oceans(environments),
        "vehicle_depth": number("vehicle_depth", vehicle_depth),
        "max_range": number("max_range", max_range),
        "range_step": number("range_step", range_step),
        "bearings": whole_number("bearings", bearings),
        "at_most": whole_number("at_most", at_most),
        "progress": progress,
    }
    try:
        return Tables(core.Tables.make(**asked))
    except BadInput as bad:
        if bad.file is not None or bad.key in asked:
            raise
        raise BadInput(f"environments: {bad}", key="environments", value=environments) from None
