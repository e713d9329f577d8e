"""Earshot's search for an underwater source as a Gymnasium environment, on the C++ that flies.

>>> import earshot_gym, gymnasium
>>> env = gymnasium.make("earshot/AcousticSearch-v0", state="memory", source="changing")
"""

from pathlib import Path as _Path

import gymnasium as _gymnasium

from earshot_gym import processor as _processor

_processor.require(_Path(__file__).with_name("built_for.txt"))
try:
    from earshot_gym._core import BadInput, FrozenPolicy
except ModuleNotFoundError as missing:
    if missing.name != "earshot_gym._core":
        raise
    raise ImportError(
        f"{__path__[0]} is the package's source, without its compiled part: pip install ./policy/python "
        "from the root of the repository, and start Python in another folder than policy/python"
    ) from None
from earshot_gym.environment import AcousticSearchEnv  # noqa: E402  (once the processor is known to do)
from earshot_gym.vector import AcousticSearchVectorEnv  # noqa: E402
from earshot_gym.world import SearchWorld, make_world  # noqa: E402

ID = "earshot/AcousticSearch-v0"

if ID not in _gymnasium.registry:
    _gymnasium.register(
        id=ID,
        entry_point="earshot_gym.environment:AcousticSearchEnv",
        vector_entry_point="earshot_gym.vector:AcousticSearchVectorEnv",
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
