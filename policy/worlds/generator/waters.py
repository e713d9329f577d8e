"""Sound speed against depth in the waters of the seas, cold to warm."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

# Depths at which a profile is written, m; linear between them. Closer where it bends.
NODES_M = [
    0,
    10,
    20,
    30,
    40,
    50,
    60,
    80,
    100,
    125,
    150,
    200,
    250,
    300,
    400,
    500,
    600,
    800,
    1000,
    1250,
    1500,
    *range(2000, 6001, 500),
]

KINDS = ("polar", "winter", "summer", "tropical", "munk")


@dataclass(frozen=True)
class Water:
    """One water of a kind.

    `shape` says where between the least and the greatest of the kind its three numbers lie, each 0 to 1.
    """

    kind: str
    shape: tuple[float, float, float]


@dataclass(frozen=True)
class Munk:
    """The numbers of a Munk profile, as sim/ocean/file takes them; its scale is the depth of its axis."""

    axis_sound_speed_mps: float
    axis_depth_m: float
    perturbation: float

    def sound_speed_mps(self, depth_m: float) -> float:
        eta = 2 * (depth_m - self.axis_depth_m) / self.axis_depth_m
        return self.axis_sound_speed_mps * (1 + self.perturbation * (eta + math.exp(-eta) - 1))


def sound_speed_mps(temperature_c: float, salinity_psu: float, depth_m: float) -> float:
    """Source: Mackenzie, J. Acoust. Soc. Am. 70 (1981) 807, nine terms; -2 to 30 C, 25 to 40 psu, 0 to 8000 m."""
    t, s, d = temperature_c, salinity_psu - 35, depth_m
    of_temperature = 4.591 * t - 5.304e-2 * t * t + 2.374e-4 * t * t * t
    of_depth = 1.630e-2 * d + 1.675e-7 * d * d - 7.139e-13 * t * d * d * d
    return 1448.96 + of_temperature + 1.340 * s + of_depth - 1.025e-2 * t * s


def between(low: float, high: float, fraction: float) -> float:
    return low + (high - low) * fraction


def layer(top: float, bottom: float, mixed_m: float, scale_m: float) -> Callable[[float], float]:
    """`top` down to mixed_m, below it exponentially towards `bottom`."""
    return lambda depth_m: bottom + (top - bottom) * math.exp(-max(0.0, depth_m - mixed_m) / scale_m)


def polar(a: float, b: float, c: float) -> Callable[[float], float]:
    """Cold fresh water at the surface: sound speed grows with depth throughout."""
    mixed_m = between(30, 100, b)
    temperature = layer(between(-1.7, 0, a), between(0.1, 1.5, c), mixed_m, mixed_m)
    salinity = layer(32.5, 34.9, mixed_m, mixed_m)
    return lambda depth_m: sound_speed_mps(temperature(depth_m), salinity(depth_m), depth_m)


def winter(a: float, b: float, c: float) -> Callable[[float], float]:
    """Mixed from the surface down: a duct there, below it the thermocline that lasts all year."""
    temperature = layer(between(5, 12, a), 2.5, between(80, 400, b), between(300, 800, c))
    return lambda depth_m: sound_speed_mps(temperature(depth_m), 35, depth_m)


def summer(a: float, b: float, c: float) -> Callable[[float], float]:
    """Water of winter under a warm layer of 20 m."""
    lasting = layer(between(6, 12, a), 2.5, 100, 500)
    seasonal = layer(between(5, 12, b), 0, 20, between(10, 40, c))
    return lambda depth_m: sound_speed_mps(lasting(depth_m) + seasonal(depth_m), 35, depth_m)


def tropical(a: float, b: float, c: float) -> Callable[[float], float]:
    """Warm all year over a steep thermocline."""
    mixed_m = between(30, 100, b)
    deep = layer(8, 2, mixed_m, 1000)
    warm = layer(between(25, 29, a) - 8, 0, mixed_m, between(120, 300, c))
    return lambda depth_m: sound_speed_mps(deep(depth_m) + warm(depth_m), 35, depth_m)


def munk(water: Water) -> Munk:
    a, b, c = water.shape
    return Munk(
        axis_sound_speed_mps=round(between(1480, 1505, a), 1),
        axis_depth_m=round(between(700, 1500, b)),
        perturbation=round(between(0.005, 0.009, c), 5),
    )


OF_TEMPERATURE = {"polar": polar, "winter": winter, "summer": summer, "tropical": tropical}


def profile(water: Water) -> Callable[[float], float]:
    """Sound speed in m/s at a depth in m."""
    if water.kind == "munk":
        return munk(water).sound_speed_mps
    return OF_TEMPERATURE[water.kind](*water.shape)


def table(water: Water, floor_m: float) -> list[tuple[float, float]]:
    """(depth in m, sound speed in m/s) from the surface to the sea floor."""
    speed = profile(water)
    depths_m: list[float] = [*(node for node in NODES_M if node < floor_m), floor_m]
    return [(depth_m, round(speed(depth_m), 1)) for depth_m in depths_m]
