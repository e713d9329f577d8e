"""`earshot.gym.world` under its name of before, by which also pickles know it."""

from earshot.gym.world import PAPER_ENVIRONMENT, SearchWorld, WorldOptions, _unpickled, make_world

__all__ = ["PAPER_ENVIRONMENT", "SearchWorld", "WorldOptions", "_unpickled", "make_world"]
