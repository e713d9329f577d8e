"""What the sea floor is made of, soft mud to rock."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Bed:
    """A fluid half-space or layer.

    It has no shear, for the solver has none: real rock takes more out of sound at small angles.
    """

    name: str
    speed_ratio: float  # sound speed over that of the water above it
    density_g_per_cm3: float
    attenuation_db_per_wavelength: float


# Source: Jensen, Kuperman, Porter and Schmidt, Computational Ocean Acoustics (2nd ed. 2011), table 1.3, compressional
# waves over water of 1500 m/s; the first, mud of the deep sea, slower than the water above it: Hamilton, J. Acoust.
# Soc. Am. 68 (1980) 1313.
SCALE = (
    Bed("soft mud", 0.98, 1.4, 0.1),
    Bed("clay", 1.00, 1.5, 0.2),
    Bed("silt", 1.05, 1.7, 1.0),
    Bed("sand", 1.10, 1.9, 0.8),
    Bed("gravel", 1.20, 2.0, 0.6),
    Bed("moraine", 1.30, 2.1, 0.4),
    Bed("chalk", 1.60, 2.2, 0.2),
    Bed("limestone", 2.00, 2.4, 0.1),
    Bed("basalt", 3.50, 2.7, 0.1),
)


def bed_at(hardness: float) -> Bed:
    """Hardness 0 is the first of the scale, 1 the last.

    Between two neighbours every number lies between theirs; the name is the nearer's.
    """
    place = hardness * (len(SCALE) - 1)
    lower = min(int(place), len(SCALE) - 2)
    part = place - lower
    soft, hard = SCALE[lower], SCALE[lower + 1]

    def number(low: float, high: float) -> float:
        return round(low + (high - low) * part, 3)

    return Bed(
        hard.name if part >= 0.5 else soft.name,
        number(soft.speed_ratio, hard.speed_ratio),
        number(soft.density_g_per_cm3, hard.density_g_per_cm3),
        number(soft.attenuation_db_per_wavelength, hard.attenuation_db_per_wavelength),
    )
