"""What a search meets besides its ocean: drawn, and as the text of a world file's [conditions]."""

from __future__ import annotations

from dataclasses import dataclass

from draws import Draws


@dataclass(frozen=True)
class Pauses:
    interval_s: float
    song_min: float
    pause_min: float


@dataclass(frozen=True)
class Current:
    speed_mps: float
    seen: bool  # by navigation


@dataclass(frozen=True)
class Conditions:
    fluctuation_db: float
    level_spread_db: float  # 0: as told
    drift_m_per_sqrt_km: float
    source_speed_mps: float
    sources: int
    current: Current | None
    pauses: Pauses | None

    @property
    def floor_db(self) -> float:
        """The least SNR that is measured: higher where it fluctuates more, as in noisy_4db and noisy_8db."""
        return round(max(3.0, 1.25 * self.fluctuation_db), 1)

    def words(self) -> str:
        parts = [f"SNR fluctuates by {self.fluctuation_db:g} dB"]
        if self.level_spread_db:
            parts.append(f"level within {self.level_spread_db:g} dB")
        if self.drift_m_per_sqrt_km:
            parts.append(f"navigation drifts by {self.drift_m_per_sqrt_km:g} m after 1 km")
        if self.source_speed_mps:
            parts.append(f"the source swims at {self.source_speed_mps:g} m/s")
        if self.sources > 1:
            parts.append(f"{self.sources} sources")
        if self.current:
            parts.append(f"a current of {self.current.speed_mps:g} m/s, {'seen' if self.current.seen else 'unseen'}")
        if self.pauses:
            parts.append(f"songs of {self.pauses.song_min:g} min, pauses of {self.pauses.pause_min:g}")
        return "; ".join(parts)

    def text(self) -> str:
        lines = ["[conditions]", f"fluctuation_db = {self.fluctuation_db:.1f}", f"floor_db = {self.floor_db:.1f}"]
        if self.level_spread_db:
            lines.append(f"source_level_spread_db = {self.level_spread_db:.1f}")
        if self.drift_m_per_sqrt_km:
            lines.append(f"navigation_drift_m_per_sqrt_km = {self.drift_m_per_sqrt_km:.1f}")
        if self.source_speed_mps:
            lines.append(f"source_speed_mps = {self.source_speed_mps:.2f}")
        if self.sources > 1:
            lines.append(f"sources = {self.sources}")
        if self.current:
            seen = "true" if self.current.seen else "false"
            lines += [
                "[conditions.current]",
                f"speed_mps = {self.current.speed_mps:.2f}",
                f"seen_by_navigation = {seen}",
            ]
        if self.pauses:
            lines += ["[conditions.calls]", f"interval_s = {self.pauses.interval_s:.1f}"]
            lines += [
                f"song_s = {60 * self.pauses.song_min:.1f}",
                f"pause_s = {60 * self.pauses.pause_min:.1f}",
                "listening_s = 120.0",
            ]
        return "\n".join(lines) + "\n"


def drawn_conditions(draws: Draws) -> Conditions:
    return Conditions(
        fluctuation_db=round(draws.uniform(0, 8), 1),
        level_spread_db=round(draws.uniform(1, 6), 1) if draws.happens(0.3) else 0.0,
        drift_m_per_sqrt_km=round(draws.uniform(10, 100), 1) if draws.happens(0.2) else 0.0,
        source_speed_mps=round(draws.uniform(0.2, 1.5), 2) if draws.happens(0.3) else 0.0,
        sources=2 if draws.happens(0.1) else 1,
        current=Current(round(draws.uniform(0.1, 0.5), 2), draws.happens(0.5)) if draws.happens(0.3) else None,
        pauses=_drawn_pauses(draws) if draws.happens(0.3) else None,
    )


def _drawn_pauses(draws: Draws) -> Pauses:
    return Pauses(
        interval_s=round(draws.uniform(10, 25), 1),
        song_min=round(draws.uniform(5, 30), 1),
        pause_min=round(draws.log_uniform(2, 20), 1),
    )
