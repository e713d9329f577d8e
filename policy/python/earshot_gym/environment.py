"""`earshot.gym.environment` under its name of before, by which also pickles know it."""

from earshot.gym.environment import *  # noqa: F403
