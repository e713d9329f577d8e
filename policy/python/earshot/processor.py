"""Whether this computer has the processor that the compiled part was built for: elsewhere it would die silently."""

from __future__ import annotations

from pathlib import Path

__all__ = ["require"]


def require(built_for: Path, processor: Path = Path("/proc/cpuinfo")) -> None:
    """ImportError where `processor` lacks a feature that `built_for` names; if a file is missing it says nothing."""
    if not built_for.is_file() or not processor.is_file():
        return
    needed = built_for.read_text(encoding="ascii").split()
    line = next((line for line in processor.read_text(encoding="utf-8").splitlines() if line.startswith("flags")), "")
    missing = [feature for feature in needed if feature not in line.split()]
    if missing:
        raise ImportError(
            f"this earshot was built for a processor with {', '.join(missing)}, which this one lacks: "
            "build it on this computer (pip install ./policy/python)"
        )
