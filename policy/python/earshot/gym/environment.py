"""The search as a Gymnasium environment."""

from __future__ import annotations

import copy
from typing import Any

import gymnasium
import numpy as np
from numpy.typing import NDArray

from earshot.arguments import place
from earshot.core import Episodes
from earshot.gym import drawing
from earshot.gym.window import Window
from earshot.gym.world import SearchWorld, WorldOptions, make_world

try:
    from typing import Unpack
except ImportError:  # Python before 3.11
    from typing_extensions import Unpack


def spaces_of(world: SearchWorld) -> tuple[gymnasium.spaces.Box, gymnasium.spaces.Discrete]:
    """Observations are scaled but not bounded: the last step of an episode may leave the domain."""
    observation = gymnasium.spaces.Box(-np.inf, np.inf, (world.observation_size,), np.float32)
    return observation, gymnasium.spaces.Discrete(world.action_count)


class AcousticSearchEnv(gymnasium.Env[NDArray[np.float32], np.int64]):
    """One vehicle that takes steps of 1 km in compass directions.

    An episode lasts until it is within 1 km of the source, out of the domain, or out of time.

    Observation  float32 [observation_size], as `state` says (see `make_world`); the same code makes it at sea
    Action       a compass direction, clockwise, 0 is north
    Reward       0 with a detection, -1 without; down to -100 and below towards and beyond the edge of the domain
    Terminated   source found, or domain left;  truncated after `max_steps`
    Info         snr_db (dB), and too_faint where it was not measured but lies somewhere below; position_m and source_m,
                 (north, east) in metres from the south-west corner, the source not for the policy to see; at the end of
                 an episode also found and detections

    reset(options={"position_m": (north, east), "source_m": (north, east)}) starts at a given place.
    render_mode "human" shows each reset and each step in a window of matplotlib's, four a second; `render` need not be
    called. Raises gymnasium.error.DependencyNotInstalled without matplotlib, BadInput where it can open no window.

    Other keyword arguments are those of `make_world`.
    """

    metadata: dict[str, Any] = {"render_modes": ["ansi", "rgb_array", "human"], "render_fps": 4}

    def __init__(self, *, render_mode: str | None = None, **options: Unpack[WorldOptions]) -> None:
        if render_mode is not None and render_mode not in self.metadata["render_modes"]:
            raise ValueError(f"render_mode = {render_mode!r}: must be one of {self.metadata['render_modes']}")
        self.render_mode = render_mode
        self.world = make_world(**options)
        self.observation_space, self.action_space = spaces_of(self.world)
        self._episodes = Episodes(self.world, 1)
        self._seeded = False
        self._path: list[tuple[float, float]] = []
        self._window = self._opened() if render_mode == "human" else None

    def __getstate__(self) -> dict[str, Any]:
        """A copy, or what is unpickled, opens a window of its own."""
        return {**self.__dict__, "_window": None}

    def __copy__(self) -> AcousticSearchEnv:
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
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[NDArray[np.float32], dict[str, Any]]:
        super().reset(seed=seed)
        if seed is None and not self._seeded:
            seed = int(self.np_random.integers(2**63))
        self._seeded = True
        self._episodes.start(0, None if seed is None else seed % 2**64)
        if options:
            self._start_at(options)
        self._path = [self._episodes.position_m(0)]
        if self.render_mode == "human":
            self.render()
        return self._episodes.observations()[0], self._episodes.info(0)

    def step(self, action: int | np.int64) -> tuple[NDArray[np.float32], float, bool, bool, dict[str, Any]]:
        stepped = self._episodes.step_one(action)
        if self.render_mode is not None:
            self._path.append(self._episodes.position_m(0))
            if self.render_mode == "human":
                self.render()
        return stepped

    def render(self) -> Any:
        """ "ansi": one line. "rgb_array": uint8 [height x width x 3], north up. Blue: there the source is
        detected; yellow: path; white: vehicle; red: source.

        "human": None; both in the window.
        """
        if self.render_mode is None:
            return None
        if self.render_mode == "ansi":
            return drawing.line(self.world, self._episodes)
        picture = drawing.picture(self.world, self._path, self._episodes.source_m(0))
        if self.render_mode == "rgb_array":
            return picture
        self._window = self._window or self._opened()
        self._window.draw(picture, drawing.line(self.world, self._episodes).strip())
        return None

    def close(self) -> None:
        if self._window is not None:
            self._window.close()
            self._window = None

    def _opened(self) -> Window:
        return Window("Earshot", self.metadata["render_fps"])

    def _start_at(self, options: dict[str, Any]) -> None:
        unknown = set(options) - {"position_m", "source_m"}
        if unknown:
            raise ValueError(f"options: unknown {sorted(unknown)}; there are position_m and source_m")
        position = place("position_m", options.get("position_m", self._episodes.position_m(0)))
        source = place("source_m", options.get("source_m", self._episodes.source_m(0)))
        self._episodes.start_at(0, position, source)
