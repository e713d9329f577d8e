"""`earshot.gym.vector` under its name of before, by which also pickles know it."""

from earshot.gym.vector import *  # noqa: F403
