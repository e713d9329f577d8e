"""Where the source may be, by all that was heard."""

from __future__ import annotations

import copy
import os
from typing import TYPE_CHECKING, Any

import numpy as np

from earshot.arguments import Place, is_path, number, one_or_more, path, place, truth_value, whole_number
from earshot.core import BeliefState
from earshot.errors import BadInput, BadType
from earshot.ocean_tables import Tables

if TYPE_CHECKING:
    import pandas
    import xarray

__all__ = ["Belief"]


class Belief:
    """The belief that flies: probability of the source's place, together with that of ocean, level, pauses and motion.

    tables               `Tables`, or the path of a `.tables` file: the oceans that are thought possible
    area                 (north, east), m: the source lies in it
    step_length          m, of the vehicle's steps; within it of the source the search ends
    directions           1 to 32: actions, compass directions clockwise, 0 is north
    border_width         m, of the edge that the vehicle had better not enter
    detection_threshold  dB

    Places are (north, east) in m from the area's south-west corner. Before the first measurement every place is as
    likely as another. Copies and pickles go on as the original would.

    Raises BadInput with the argument as `key`, BadType for what is of another kind.

    >>> belief = Belief("20hz_300m.tables")
    >>> belief.update((12_000.0, 8_000.0), snr=14.2)
    >>> belief.probabilities.plot()
    """

    def __init__(
        self,
        tables: Tables | str | os.PathLike[str],
        *,
        area: Place = (25_000.0, 25_000.0),
        step_length: float = 1_000.0,
        directions: int = 8,
        border_width: float = 1_000.0,
        detection_threshold: float = 10.0,
    ) -> None:
        if not isinstance(tables, Tables):
            if not is_path(tables):
                raise BadType("tables: must be earshot.Tables, or a path", key="tables", value=tables)
            tables = Tables.from_file(path("tables", tables))
        self._state = BeliefState(
            tables=tables._tables,
            area=place("area", area),
            step_length=number("step_length", step_length),
            directions=whole_number("directions", directions),
            border_width=number("border_width", border_width),
            detection_threshold=number("detection_threshold", detection_threshold),
        )

    def update(
        self,
        position: Place,
        *,
        snr: float,
        too_faint: bool = False,
        bearing: tuple[float, float] | tuple[float, float, float] | None = None,
    ) -> None:
        """Takes in one measurement: what was heard at a place, once the vehicle has made a step.

        position   (north, east), m, where navigation believes the vehicle
        snr        dB, -600 to 600; where it was too faint to measure, the least that could have been measured
        too_faint  whether the signal lies somewhere below `snr`
        bearing    (direction, standard deviation), degrees, true, clockwise from north; of a line of hydrophones, which
                   hears the same from either side of its axis, (direction, standard deviation, axis)
        """
        heard: tuple[float, float, float | None] | None = None
        if bearing is not None:
            angles = np.atleast_1d(one_or_more("bearing", bearing))
            if angles.size not in (2, 3):
                raise BadInput(
                    "bearing: must be (direction, standard deviation) or (direction, standard deviation, axis)",
                    key="bearing",
                    value=bearing,
                )
            heard = (float(angles[0]), float(angles[1]), float(angles[2]) if angles.size == 3 else None)
        is_faint = truth_value("too_faint", too_faint)
        self._state.update(place("position", position), snr=number("snr", snr), too_faint=is_faint, bearing=heard)

    @property
    def measurements(self) -> int:
        """How many were taken in."""
        return int(self._state.measurements)

    @property
    def probabilities(self) -> xarray.DataArray:
        """Probability that the source lies in each cell, float32 [north x east], over the cells' centres in m."""
        import xarray

        cells = self._state.probabilities()
        centres = [side * (np.arange(count) + 0.5) / count for side, count in zip(self._state.area, cells.shape)]
        array = xarray.DataArray(
            cells,
            {"north": ("north", centres[0], {"units": "m"}), "east": ("east", centres[1], {"units": "m"})},
            ("north", "east"),
            "probability",
        )
        array.attrs["long_name"] = "probability that the source lies in the cell"
        return array

    @property
    def summary(self) -> dict[str, Any]:
        """The belief in a few numbers.

        likeliest, mean     (north, east), m: centre of the likeliest cell, mean place
        spread              m, root mean square distance from the mean
        likeliest_share     probability of the likeliest cell
        effective_cells     over how many cells the belief is spread: one over the sum of squared probabilities
        mismatch_bits       how much better the sound is explained without any ocean; below 0 the oceans explain more
        is_mismatched       whether that ever came to 6.75 bits
        calls_for_sweep     whether the vehicle had better sweep the area
        """
        return dict(self._state.summary())

    @property
    def mismatch(self) -> float:
        """bits, of `summary`; below 0 the oceans explain what was heard, from 6.75 on they do not."""
        return float(self._state.summary()["mismatch_bits"])

    @property
    def declaration(self) -> dict[str, Any] | None:
        """Where the source is declared found at the last measurement: probability, likeliest place, closest_approach
        (m), least_snr (dB) that is expected so near. Else None."""
        return self._state.declaration()

    @property
    def hypotheses(self) -> pandas.DataFrame:
        """The explanations that are retained, the likeliest first.

        probability; ocean, its name, and table, its number; level_offset_db, by which the source is louder than the
        table; spread_db, of the measured SNR; silence_share, of measurements that meet a pause; moves_cells, how far
        the source may move between two measurements, and its drift in step lengths; is_current, whether a current that
        navigation does not see carries the vehicle.
        """
        import pandas

        frame = pandas.DataFrame(self._state.hypotheses())
        return frame.sort_values("probability", ascending=False, kind="stable", ignore_index=True)

    @property
    def actions(self) -> pandas.DataFrame:
        """What a step in each direction promises, by action.

        direction_deg; found, probability that its end lies within a step of the source; find_probability, the same
        within three steps, discounted; detected, probability of a detection at its end; border, how deep that lies in
        the border; regret, expected cost of the search after it, less that after the best action.
        """
        import pandas

        frame = pandas.DataFrame(self._state.actions())
        frame.index.name = "action"
        return frame

    @property
    def fingerprint(self) -> int:
        """CRC-32 of all that is believed of places, bit for bit."""
        return int(self._state.fingerprint)

    def __copy__(self) -> Belief:
        return copy.deepcopy(self)

    def __deepcopy__(self, memo: dict[int, Any]) -> Belief:
        twin = Belief.__new__(Belief)
        twin._state = copy.copy(self._state)
        return twin

    def __repr__(self) -> str:
        return f"<earshot.Belief after {self.measurements} measurements, mismatch {self.mismatch:.1f} bits>"
