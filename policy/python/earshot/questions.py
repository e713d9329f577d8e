"""What is asked of the sound in an ocean, as people give it, made into what the C++ module takes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from earshot.arguments import axis, number, one_or_more, text, whole_number
from earshot.core import SoundRequest
from earshot.errors import BadInput, BadType
from earshot.oceans import Environment

__all__ = ["Question", "question_of"]

_ANY_HZ = 100.0  # stands where a band is asked for, which states its frequencies
_DEFAULT_MAX_RANGE_M = 25_000.0


def _known(name: str, value: Any, known: Any) -> Any:
    """[n], or [] of one number; what the environment knows where nothing is asked."""
    if value is None and known is None:
        raise BadInput(f"{name}: must be given, for the environment does not state it", key=name)
    return one_or_more(name, known if value is None else value)


def _optional(name: str, value: float | None) -> float | None:
    return None if value is None else number(name, value)


def _edges(band: Any, frequency: Any) -> tuple[float, float] | None:
    if band is None:
        return None
    if frequency is not None and np.ndim(frequency) > 0:
        raise BadInput("band: not with several frequencies", key="band", value=band)
    low_high = axis("band", band)
    if low_high.size != 2:
        raise BadInput("band: must be the low and the high frequency", key="band", value=band)
    return float(low_high[0]), float(low_high[1])


@dataclass(frozen=True)
class Question:
    """frequencies, source_depths  [n], or [] of one number;   band  Hz, or None;   settings  of a SoundRequest"""

    frequencies: Any
    source_depths: Any
    band: tuple[float, float] | None
    settings: dict[str, Any]

    def sources(self) -> list[tuple[float, float]]:
        """Each frequency with each depth."""
        depths = np.atleast_1d(self.source_depths).tolist()
        return [(f, d) for f in np.atleast_1d(self.frequencies).tolist() for d in depths]

    def of(self, frequency: float, source_depth: float) -> SoundRequest:
        return SoundRequest(frequency=frequency, source_depth=source_depth, **self.settings)


def question_of(
    environment: Environment,
    *,
    frequency: Any,
    source_depth: Any,
    receiver_depth: Any,
    max_range: Any,
    depth_spacing: Any,
    output_step: Any,
    accuracy_db: Any,
    band: Any,
    band_parts: Any,
    starter: Any,
    range_step: Any,
    depth_step: Any,
    terms: Any,
    absorber_wavelengths: Any,
) -> Question:
    """Raises BadInput, BadType. What is None is the environment's, or is chosen after the ocean."""
    if not isinstance(environment, Environment):
        raise BadType("environment: must be an earshot.Environment", key="environment", value=environment)
    of_ocean = environment.frequency if band is None or environment.frequency is not None else _ANY_HZ
    frequencies = _known("frequency", frequency, of_ocean)
    if band is None:
        environment._require_frequencies(frequencies)
    depths_of_file = environment.source_depths
    one_known = environment.source_depth
    source_depths = _known("source_depth", source_depth, depths_of_file if one_known is None else one_known)
    settings = {
        "max_range": number("max_range", max_range)
        if max_range is not None
        else environment.max_range or _DEFAULT_MAX_RANGE_M,
        "receiver_depth": []
        if receiver_depth is None
        else np.atleast_1d(_known("receiver_depth", receiver_depth, None)).tolist(),
        "depth_spacing": _optional("depth_spacing", depth_spacing),
        "output_step": _optional("output_step", output_step),
        "accuracy_db": number("accuracy_db", accuracy_db),
        "band": _edges(band, frequency),
        "band_parts": whole_number("band_parts", band_parts),
        "starter": text("starter", starter),
        "range_step": _optional("range_step", range_step),
        "depth_step": _optional("depth_step", depth_step),
        "terms": whole_number("terms", terms),
        "absorber_wavelengths": _optional("absorber_wavelengths", absorber_wavelengths),
        "file_depth": [],
        "file_range": [],
    }
    return Question(frequencies, source_depths, settings["band"], settings)
