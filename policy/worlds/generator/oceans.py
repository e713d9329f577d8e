"""One ocean: drawn, of the bank, and as the text of an environment file."""

from __future__ import annotations

from dataclasses import dataclass

import waters
from draws import Draws, van_der_corput
from sea_beds import Bed, bed_at
from waters import Water

SHALLOWEST_M, DEEPEST_M = 60.0, 6000.0
SHALLOWEST_SOURCE_M, DEEPEST_SOURCE_M = 10.0, 200.0
VEHICLE_M = 300.0  # of a mission; less where the water is


@dataclass(frozen=True)
class Layer:
    thickness_m: float
    bed: Bed


@dataclass(frozen=True)
class Ocean:
    floor_m: float
    water: Water
    bed: Bed
    cover: Layer | None  # softer, above it
    frequency_hz: float
    source_depth_m: float
    level_db: float
    noise_db: float
    vehicle_depth_m: float

    def words(self) -> str:
        """In half a line, for people."""
        cover = f"{self.cover.thickness_m:g} m of {self.cover.bed.name} on " if self.cover else ""
        water = {"munk": "water with a Munk profile"}.get(self.water.kind, f"{self.water.kind} water")
        return (
            f"{self.floor_m:g} m of {water} over {cover}{self.bed.name}; "
            f"{self.frequency_hz:g} Hz, {self.level_db:g} dB, {self.source_depth_m:g} m deep; "
            f"noise of {self.noise_db:g} dB; the vehicle {self.vehicle_depth_m:g} m deep"
        )


def drawn_ocean(draws: Draws) -> Ocean:
    floor_m = round(draws.log_uniform(SHALLOWEST_M, DEEPEST_M))
    water = Water(draws.one_of(waters.KINDS), (draws.fraction(), draws.fraction(), draws.fraction()))
    hardness = draws.fraction()
    cover = (
        Layer(round(draws.log_uniform(5, 200), 1), bed_at(hardness * draws.fraction())) if draws.happens(0.3) else None
    )
    return Ocean(
        floor_m=floor_m,
        water=water,
        bed=bed_at(hardness),
        cover=cover,
        frequency_hz=20.0 if draws.happens(0.5) else round(draws.log_uniform(15, 50), 1),
        source_depth_m=round(draws.log_uniform(SHALLOWEST_SOURCE_M, min(DEEPEST_SOURCE_M, 0.8 * floor_m)), 1),
        level_db=round(draws.uniform(184, 196), 1),
        noise_db=round(draws.uniform(84, 100), 1),
        vehicle_depth_m=round(min(VEHICLE_M, draws.uniform(0.3, 0.8) * floor_m)),
    )


def bank_ocean(number: int, frequency_hz: float) -> Ocean:
    """Number 0, 1, 2, ... of a design of which every beginning covers the whole.

    Depth, hardness, water and depth of the source have a base each. The rest is as in the paper, or in the middle of
    what is drawn.
    """
    index = number + 1  # index 0 is a corner in every base
    floor_m = round(SHALLOWEST_M * (DEEPEST_M / SHALLOWEST_M) ** van_der_corput(index, 2))
    deepest_source_m = min(DEEPEST_SOURCE_M, 0.8 * floor_m)
    source_m = SHALLOWEST_SOURCE_M * (deepest_source_m / SHALLOWEST_SOURCE_M) ** van_der_corput(index, 7)
    return Ocean(
        floor_m=floor_m,
        water=Water(waters.KINDS[index % len(waters.KINDS)], (0.5, 0.5, 0.5)),
        bed=bed_at(van_der_corput(index, 3)),
        cover=None,
        frequency_hz=frequency_hz,
        source_depth_m=round(source_m, 1),
        level_db=190.0,
        noise_db=90.0,
        vehicle_depth_m=round(min(VEHICLE_M, 0.5 * floor_m)),
    )


def environment_text(ocean: Ocean, name: str) -> str:
    at_floor_mps = waters.profile(ocean.water)(ocean.floor_m)
    covers = (
        [_bed_text(ocean.cover.bed, at_floor_mps, f"thickness_m = {ocean.cover.thickness_m:.1f}\n")]
        if ocean.cover
        else []
    )
    return "".join(
        [
            f'name = "{name}: {ocean.words()}"\n',
            f"[source]\nfrequency_hz = {ocean.frequency_hz:.1f}\nlevel_db_re_1upa_at_1m = {ocean.level_db:.1f}\n",
            f"depth_m = {ocean.source_depth_m:.1f}\nnorth_m = 10_000.0\neast_m = 10_000.0\n",
            f"[noise]\nlevel_db_re_1upa = {ocean.noise_db:.1f}\n",
            water_text(ocean.water, ocean.floor_m),
            f"[seabed]\ndepth_m = {ocean.floor_m:.1f}\n",
            *covers,
            _bed_text(ocean.bed, at_floor_mps),
        ]
    )


def water_text(water: Water, floor_m: float) -> str:
    if water.kind == "munk":
        munk = waters.munk(water)
        return (
            f'[water]\nprofile = "munk"\naxis_sound_speed_mps = {munk.axis_sound_speed_mps:.1f}\n'
            f"axis_depth_m = {munk.axis_depth_m:.1f}\nscale_m = {munk.axis_depth_m:.1f}\n"
            f"perturbation = {munk.perturbation:.5f}\n"
        )
    rows = waters.table(water, floor_m)
    depths = ", ".join(f"{depth:6.1f}" for depth, _ in rows)
    speeds = ", ".join(f"{speed:6.1f}" for _, speed in rows)
    return f'[water]\nprofile = "table"\ndepth_m         = [{depths}]\nsound_speed_mps = [{speeds}]\n'


def _bed_text(bed: Bed, water_mps: float, thickness: str = "") -> str:
    return (
        f"[[seabed.layers]]\n{thickness}sound_speed_mps = {bed.speed_ratio * water_mps:.1f}\n"
        f"density_g_per_cm3 = {bed.density_g_per_cm3:.3f}\n"
        f"attenuation_db_per_wavelength = {bed.attenuation_db_per_wavelength:.3f}\n"
    )
