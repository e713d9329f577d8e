"""Earshot's search for an underwater source as a Gymnasium environment, on the C++ that flies.

>>> import earshot, gymnasium
>>> env = gymnasium.make("earshot/AcousticSearch-v0", state="memory", source="changing")
"""

import gymnasium as _gymnasium

from earshot._core import BadInput, FrozenPolicy
from earshot.environment import AcousticSearchEnv
from earshot.vector import AcousticSearchVectorEnv
from earshot.world import SearchWorld, make_world

ID = "earshot/AcousticSearch-v0"

if ID not in _gymnasium.registry:
    _gymnasium.register(
        id=ID,
        entry_point="earshot.environment:AcousticSearchEnv",
        vector_entry_point="earshot.vector:AcousticSearchVectorEnv",
    )

__all__ = ["ID", "AcousticSearchEnv", "AcousticSearchVectorEnv", "BadInput", "FrozenPolicy", "SearchWorld", "make_world"]
