"""A window of the mission's plane on paper: kilometres to points of the picture, with axes and a scale of its own."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

from bench_results import Place
from markup import number

_MOST_TICKS = 6


@dataclass(frozen=True)
class Window:
    """What of the plane is seen; square, so that a kilometre is as long one way as the other."""

    south_m: float
    west_m: float
    side_m: float

    def holds(self, place: Place) -> bool:
        inside_north = self.south_m <= place.north_m <= self.south_m + self.side_m
        return inside_north and self.west_m <= place.east_m <= self.west_m + self.side_m


def extent_of(places: Iterable[Place]) -> float:
    """The longer side of the rectangle around them, in metres."""
    norths, easts = zip(*((place.north_m, place.east_m) for place in places), strict=True)
    return max(max(norths) - min(norths), max(easts) - min(easts))


def window_around(places: Iterable[Place], margin: float = 0.08, smallest_m: float = 200.0) -> Window:
    """The smallest that holds all, with a margin on every side that is this share of it."""
    norths, easts = zip(*((place.north_m, place.east_m) for place in places), strict=True)
    extent = max(max(norths) - min(norths), max(easts) - min(easts), smallest_m)
    side = extent * (1.0 + 2.0 * margin)
    return Window(
        south_m=(max(norths) + min(norths) - side) / 2.0, west_m=(max(easts) + min(easts) - side) / 2.0, side_m=side
    )


def tick_step_km(side_km: float) -> float:
    """1, 2 or 5 times a power of ten, so that there are at most _MOST_TICKS of them."""
    least = side_km / _MOST_TICKS
    power = 10.0 ** math.floor(math.log10(least))
    return next(factor * power for factor in (1.0, 2.0, 5.0, 10.0) if factor * power >= least * (1.0 - 1e-9))


@dataclass(frozen=True)
class Panel:
    """A window drawn as a square; x grows to the right, y downwards."""

    window: Window
    left: float
    top: float
    side: float
    name: str  # of its clip path, unlike any other of the page

    def x(self, place: Place) -> float:
        return self.left + (place.east_m - self.window.west_m) / self.window.side_m * self.side

    def y(self, place: Place) -> float:
        return self.top + self.side - (place.north_m - self.window.south_m) / self.window.side_m * self.side

    def points(self, places: Iterable[Place]) -> str:
        return " ".join(f"{self.x(place):.1f},{self.y(place):.1f}" for place in places)

    def frame(self, title: str) -> str:
        """Axes in kilometres, their names, and the clip path for what is drawn in it."""
        side_km = self.window.side_m / 1e3
        step = tick_step_km(side_km)
        decimals = max(0, -math.floor(math.log10(step)))
        bottom, right = self.top + self.side, self.left + self.side
        parts = [
            f'<clipPath id="{self.name}"><rect x="{self.left}" y="{self.top}" width="{self.side}" '
            f'height="{self.side}"/></clipPath>',
            f'<text class="title" x="{self.left}" y="{self.top - 8}">{title}</text>',
        ]
        for km in _ticks(self.window.west_m / 1e3, side_km, step):
            x = self.x(Place(self.window.south_m, km * 1e3))
            parts.append(f'<path class="grid" d="M{x:.1f} {self.top}V{bottom}"/>')
            parts.append(f'<text class="tick" x="{x:.1f}" y="{bottom + 14}">{number(km, decimals)}</text>')
        for km in _ticks(self.window.south_m / 1e3, side_km, step):
            y = self.y(Place(km * 1e3, self.window.west_m))
            parts.append(f'<path class="grid" d="M{self.left} {y:.1f}H{right}"/>')
            parts.append(f'<text class="tick north" x="{self.left - 5}" y="{y + 4:.1f}">{number(km, decimals)}</text>')
        middle = self.left + self.side / 2.0
        parts.append(f'<text class="tick" x="{middle}" y="{bottom + 29}">east (km)</text>')
        x, y = self.left - 38, self.top + self.side / 2.0
        parts.append(f'<text class="tick" x="{x}" y="{y}" transform="rotate(-90 {x} {y})">north (km)</text>')
        parts.append(f'<rect class="frame" x="{self.left}" y="{self.top}" width="{self.side}" height="{self.side}"/>')
        return "\n".join(parts)


def _ticks(first_km: float, side_km: float, step: float) -> list[float]:
    begin, end = math.ceil(first_km / step - 1e-9), math.floor((first_km + side_km) / step + 1e-9)
    return [index * step for index in range(begin, end + 1)]
