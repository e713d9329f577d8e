"""The name that `earshot.gym` had before; all of it stands there now, and this name goes with the next version but one.

>>> import earshot_gym, gymnasium
>>> env = gymnasium.make("earshot/AcousticSearch-v0", state="memory", source="changing")
"""

from earshot.gym import (
    ID,
    AcousticSearchEnv,
    AcousticSearchVectorEnv,
    BadInput,
    FrozenPolicy,
    SearchWorld,
    environment,
    make_world,
    vector,
    world,
)

__all__ = [
    "ID",
    "AcousticSearchEnv",
    "AcousticSearchVectorEnv",
    "BadInput",
    "FrozenPolicy",
    "SearchWorld",
    "environment",
    "make_world",
    "vector",
    "world",
]
