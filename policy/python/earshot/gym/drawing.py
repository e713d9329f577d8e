"""What a search looks like, for people."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from earshot.core import Episodes, World

_PIXELS = 256  # of the picture's longer side
_QUIET, _LOUD = np.array([28, 40, 64]), np.array([86, 132, 190])  # not detected, detected
_PATH, _VEHICLE, _SOURCE = (250, 220, 90), (255, 255, 255), (235, 80, 60)

Place = tuple[float, float]


def line(world: World, episodes: Episodes) -> str:
    """One line: where the vehicle is, what it hears, how far the source is."""
    (north, east), source = episodes.position_m(0), episodes.source_m(0)
    record, snr_db = episodes.record(0), episodes.snr_db(0)
    heard = "detected" if snr_db >= world.detection_threshold_db else "not detected"
    range_km = math.dist((north, east), source) / 1_000.0
    return (
        f"step {record['steps']:.0f}: {north / 1_000:.1f} km north, {east / 1_000:.1f} km east; "
        f"SNR {snr_db:.1f} dB, {heard}; source {range_km:.1f} km away; reward {record['reward']:.1f}\n"
    )


def picture(world: World, path: list[Place], source: Place) -> NDArray[np.uint8]:
    """uint8 [height x width x 3], north up: lighter where the source is detected, the path, the vehicle, the source."""
    metres_per_pixel = max(world.area_m) / _PIXELS
    height, width = (max(1, round(side / metres_per_pixel)) for side in world.area_m)
    north = (height - 0.5 - np.arange(height))[:, None] * metres_per_pixel
    east = (np.arange(width) + 0.5)[None, :] * metres_per_pixel
    snr_db = world.snr_db(np.hypot(north - source[0], east - source[1]))
    image = np.where((snr_db >= world.detection_threshold_db)[:, :, None], _LOUD, _QUIET).astype(np.uint8)

    def dot(place: Place, colour: tuple[int, int, int], radius: int) -> None:
        row, column = int(height - place[0] / metres_per_pixel), int(place[1] / metres_per_pixel)
        rows = slice(max(0, row - radius), max(0, row + radius + 1))
        columns = slice(max(0, column - radius), max(0, column + radius + 1))
        image[rows, columns] = colour

    for (north_a, east_a), (north_b, east_b) in zip(path, path[1:]):
        for along in np.linspace(0.0, 1.0, 16):
            dot((north_a + along * (north_b - north_a), east_a + along * (east_b - east_a)), _PATH, 0)
    dot(source, _SOURCE, 3)
    if path:
        dot(path[-1], _VEHICLE, 2)
    return image
