"""What the paper searches in: Clark et al. 2022."""

from pathlib import Path

__all__ = ["PAPER_ENVIRONMENT"]

PAPER_ENVIRONMENT = Path(__file__).parent / "gym" / "environments" / "munk_flat.toml"
