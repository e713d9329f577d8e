"""The search for an underwater source as a Gymnasium environment, on the C++ that flies.

>>> import earshot.gym, gymnasium
>>> env = gymnasium.make("earshot/AcousticSearch-v0", state="memory", source="changing")
"""

import gymnasium as _gymnasium

from earshot.core import BadInput, FrozenPolicy
from earshot.gym.environment import AcousticSearchEnv
from earshot.gym.vector import AcousticSearchVectorEnv
from earshot.gym.world import SearchWorld, make_world

ID = "earshot/AcousticSearch-v0"

if ID not in _gymnasium.registry:
    _gymnasium.register(
        id=ID,
        entry_point="earshot.gym.environment:AcousticSearchEnv",
        vector_entry_point="earshot.gym.vector:AcousticSearchVectorEnv",
    )

__all__ = [
    "ID",
    "AcousticSearchEnv",
    "AcousticSearchVectorEnv",
    "BadInput",
    "FrozenPolicy",
    "SearchWorld",
    "make_world",
]
