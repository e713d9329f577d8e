"""Many searches stepped together in C++, as a Gymnasium vector environment."""

from __future__ import annotations

import copy
from collections.abc import Sequence
from typing import Any

import gymnasium
import numpy as np
from gymnasium.vector import VectorEnv
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray

from earshot.arguments import count
from earshot.core import Episodes
from earshot.gym.environment import spaces_of
from earshot.gym.world import WorldOptions, make_world

try:
    from typing import Unpack
except ImportError:  # Python before 3.11
    from typing_extensions import Unpack

# Gymnasium names autoreset modes since 1.1; before, the mode here was the only one there was.
_AUTORESET_MODE = getattr(gymnasium.vector, "AutoresetMode", None)
_IS_GYMNASIUM_1 = int(gymnasium.__version__.split(".")[0]) >= 1


class AcousticSearchVectorEnv(VectorEnv):
    """`num_envs` searches stepped together; observation, action and reward are those of AcousticSearchEnv.

    Autoreset mode: same step. An episode that ends starts anew within the step: the observation is the new episode's
    first; the old one's last is in info as `final_obs` (Gymnasium before 1.0: `final_observation`), its reward, steps,
    detections and found as `final_info`.

    Environment i after reset(seed=s) runs as AcousticSearchEnv after reset(seed=s + i).

    Shapes  observations float32 [num_envs x observation_size]; actions [num_envs];
            rewards float64, terminated, truncated [num_envs]
    Keyword arguments are those of `make_world`; max_episode_steps is another name of max_steps.
    """

    metadata: dict[str, Any] = {
        "render_modes": [],
        "autoreset_mode": _AUTORESET_MODE.SAME_STEP if _AUTORESET_MODE else "SameStep",
    }

    def __init__(
        self,
        num_envs: int = 1,
        *,
        max_episode_steps: int | None = None,
        render_mode: None = None,
        **options: Unpack[WorldOptions],
    ) -> None:
        if render_mode is not None:
            raise ValueError("render_mode: only the single environment draws")
        if max_episode_steps is not None:
            options["max_steps"] = max_episode_steps
        num_envs = count("num_envs", num_envs)
        self.render_mode = None
        self.world = make_world(**options)
        self.num_envs = num_envs
        self._episodes = Episodes(self.world, num_envs)
        self._seeded = False
        self.closed, self.viewer, self.is_vector_env = False, None, True  # what Gymnasium before 1.0 looks for
        self.single_observation_space, self.single_action_space = spaces_of(self.world)
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.action_space = batch_space(self.single_action_space, num_envs)

    def __copy__(self) -> AcousticSearchVectorEnv:
        """Has searches of its own: they go on as these would, and move none of these."""
        return copy.deepcopy(self)

    @property
    def observation_names(self) -> list[str]:
        """Of each number of an observation: "east", "step_snr_0" (the latest step's), "preference_7" (action 7's)."""
        return self.world.observation_names

    @property
    def search_description(self) -> str:
        """What `earshot freeze` must know of a policy trained here."""
        return self.world.description

    def reset(
        self, *, seed: int | Sequence[int | None] | None = None, options: dict[str, Any] | None = None
    ) -> tuple[NDArray[np.float32], dict[str, Any]]:
        if options:
            raise ValueError(f"options: unknown {sorted(options)}")
        for index, own in enumerate(self._seeds(seed)):
            self._episodes.start(index, own)
        self._seeded = True
        return self._episodes.observations(), {}

    def step(
        self, actions: NDArray[np.int64]
    ) -> tuple[NDArray[np.float32], NDArray[np.float64], NDArray[np.bool_], NDArray[np.bool_], dict[str, Any]]:
        observations, rewards, terminated, truncated, ended = self._episodes.step(np.asarray(actions))
        return observations, rewards, terminated, truncated, self._info(ended) if ended else {}

    def _seeds(self, seed: int | Sequence[int | None] | None) -> list[int | None]:
        if seed is None and not self._seeded:
            seed = int(np.random.default_rng().integers(2**63))
        if seed is None:
            return [None] * self.num_envs
        if isinstance(seed, (int, np.integer)):
            seed = [int(seed) + index for index in range(self.num_envs)]
        if len(seed) != self.num_envs or any(own is not None and own < 0 for own in seed):
            raise ValueError(
                f"seed: must be one number, 0 or more, or one for each of the {self.num_envs} environments"
            )
        return [None if own is None else own % 2**64 for own in seed]

    def _info(self, ended: list[tuple[int, NDArray[np.float32], dict[str, float]]]) -> dict[str, Any]:
        mask = np.zeros(self.num_envs, dtype=bool)
        last = np.full(self.num_envs, None, dtype=object)
        records = np.full(self.num_envs, None, dtype=object)
        for index, observation, record in ended:
            mask[index], last[index], records[index] = True, observation, record
        if not _IS_GYMNASIUM_1:
            return {
                "final_observation": last,
                "_final_observation": mask,
                "final_info": records,
                "_final_info": mask.copy(),
            }
        final_info: dict[str, Any] = {}
        for key, like in ended[0][2].items():
            final_info[key] = np.zeros(self.num_envs, dtype=type(like))
            for index, _, record in ended:
                final_info[key][index] = record[key]
            final_info["_" + key] = mask.copy()
        return {"final_obs": last, "_final_obs": mask, "final_info": final_info, "_final_info": mask.copy()}
