"""Stable-Baselines3: the fast vector environment, and models saved so that `earshot freeze` can be sure of them."""

from __future__ import annotations

import copy
import inspect
import io
import json
import os
import time
import zipfile
from pathlib import Path
from typing import Any, Union

import gymnasium
import numpy as np
import stable_baselines3
from gymnasium.wrappers import OrderEnforcing, PassiveEnvChecker, RecordEpisodeStatistics, TimeLimit
from numpy.typing import NDArray
from stable_baselines3.common.base_class import BaseAlgorithm
from stable_baselines3.common.monitor import Monitor
from stable_baselines3.common.torch_layers import FlattenExtractor
from stable_baselines3.common.vec_env import DummyVecEnv, VecCheckNan, VecEnv, VecEnvWrapper, VecMonitor, VecNormalize

from earshot import arguments
from earshot.core import Episodes
from earshot.gym.environment import AcousticSearchEnv, spaces_of
from earshot.gym.world import WorldOptions, make_world

try:
    from typing import Unpack
except ImportError:  # Python before 3.11
    from typing_extensions import Unpack

__all__ = ["SearchVecEnv", "describe", "export_onnx", "save"]

Path_ = Union[str, os.PathLike[str]]

# Wrappers that leave observations and actions as they are; a class derived from one may not, nor one that only has
# its name.
_PLAIN_VECTOR_WRAPPERS = (VecMonitor, VecCheckNan)
_PLAIN_WRAPPERS = (Monitor, TimeLimit, OrderEnforcing, PassiveEnvChecker, RecordEpisodeStatistics)


class SearchVecEnv(VecEnv):
    """`num_envs` searches stepped together in C++.

    Monitored: info["episode"] holds reward and length of an episode that ended.
    Keyword arguments are those of `make_world`.
    """

    def __init__(self, num_envs: int = 1, **options: Unpack[WorldOptions]) -> None:
        num_envs = arguments.count("num_envs", num_envs)
        self.world = make_world(**options)
        self.render_mode = None
        self._episodes = Episodes(self.world, num_envs)
        self._begin = time.time()
        self._seeded = False
        self._actions: NDArray[np.int64] = np.zeros(num_envs, dtype=np.int64)
        super().__init__(num_envs, *spaces_of(self.world))

    def __copy__(self) -> SearchVecEnv:
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

    def reset(self) -> NDArray[np.float32]:
        if not self._seeded and all(seed is None for seed in self._seeds):
            self.seed(int(np.random.default_rng().integers(2**31)))
        for index, seed in enumerate(self._seeds):
            self._episodes.start(index, None if seed is None else int(seed) % 2**64)
        self._seeded = True
        self._reset_seeds()
        return self._episodes.observations()

    def step_async(self, actions: NDArray[np.int64]) -> None:
        self._actions = np.asarray(actions)

    def step_wait(self) -> tuple[NDArray[np.float32], NDArray[np.float32], NDArray[np.bool_], list[dict[str, Any]]]:
        observations, rewards, terminated, truncated, ended = self._episodes.step(self._actions)
        infos: list[dict[str, Any]] = [{} for _ in range(self.num_envs)]
        for index, last, record in ended:
            infos[index] = {
                "terminal_observation": last,
                "TimeLimit.truncated": bool(truncated[index]),
                "is_success": record["found"],
                "episode": {"r": record["reward"], "l": record["steps"], "t": round(time.time() - self._begin, 6)},
            }
        return observations, rewards.astype(np.float32), terminated | truncated, infos

    def close(self) -> None:
        """Nothing is open."""

    def get_attr(self, attr_name: str, indices: Any = None) -> list[Any]:
        return [getattr(self, attr_name)] * len(list(self._get_indices(indices)))

    def set_attr(self, attr_name: str, value: Any, indices: Any = None) -> None:
        raise AttributeError(f"{attr_name}: the searches of a SearchVecEnv share what they are; make another one")

    def env_method(self, method_name: str, *method_args: Any, indices: Any = None, **method_kwargs: Any) -> list[Any]:
        raise AttributeError(f"{method_name}: the searches of a SearchVecEnv have no methods of their own")

    def env_is_wrapped(self, wrapper_class: type[gymnasium.Wrapper], indices: Any = None) -> list[bool]:
        """Monitored without a Monitor."""
        return [wrapper_class is Monitor] * len(list(self._get_indices(indices)))


def _inner(env: gymnasium.Env) -> gymnasium.Env:
    while isinstance(env, gymnasium.Wrapper):
        if type(env) not in _PLAIN_WRAPPERS:
            raise ValueError(
                f"{type(env).__name__}: not known to leave observations and actions as they are; "
                "this policy cannot be frozen"
            )
        env = env.env
    return env


def _searches(env: VecEnv) -> list[Any]:
    while isinstance(env, VecEnvWrapper):
        plain = type(env) in _PLAIN_VECTOR_WRAPPERS or (type(env) is VecNormalize and not env.norm_obs)
        if not plain:
            raise ValueError(f"{type(env).__name__}: changes what the policy sees; this policy cannot be frozen")
        env = env.venv
    searches = [_inner(each) for each in env.envs] if isinstance(env, DummyVecEnv) else [env]
    for search in searches:
        if not isinstance(search, (SearchVecEnv, AcousticSearchEnv)):
            raise ValueError(
                f"{type(search).__name__}: not a search of Earshot, or not to be looked into; "
                "train in earshot.gym.sb3.SearchVecEnv"
            )
    return searches


def describe(model: BaseAlgorithm, env: VecEnv | None = None) -> str:
    """What `earshot freeze` must know of the policy besides its weights, one line of JSON.

    Raises ValueError when something between environment and policy changes what it sees (VecNormalize, frame stacks,
    unknown wrappers, a features extractor), and when its environments are searches that differ.
    """
    current = env if env is not None else model.get_env()
    if current is None:
        raise ValueError("the model has no environment: give the one it was trained in (env=...)")
    extractor = type(getattr(model.policy, "features_extractor", None))
    if extractor is not FlattenExtractor:
        raise ValueError(
            f"features_extractor: {extractor.__name__} changes what the policy sees; this policy cannot be frozen"
        )
    inner, *others = _searches(current)
    if any(other.search_description != inner.search_description for other in others):
        raise ValueError("the model's environments are searches that differ; this policy cannot be frozen")
    description = json.loads(inner.search_description)
    description["provenance"] = {
        "trained_by": f"stable-baselines3 {stable_baselines3.__version__} {type(model).__name__}",
        "steps": str(model.num_timesteps),
        **description["provenance"],
    }
    return json.dumps(description)


def save(model: BaseAlgorithm, path: Path_, env: VecEnv | None = None) -> Path:
    """model.save(path), and in the zip what the policy was trained to search: `earshot freeze` reads it.

    Stable-Baselines3 loads the file as any other of its own. Returns the file. Raises ValueError as `describe` does,
    BadInput or BadType for what is no path; then nothing is written.
    """
    given = arguments.path("path", path)
    file = given if given.suffix == ".zip" else Path(f"{given}.zip")
    description = describe(model, env)
    part = file.with_name(file.name + ".part.zip")
    try:
        model.save(part)
        with zipfile.ZipFile(part, "a") as archive:
            archive.writestr("earshot.json", description)
        os.replace(part, file)
    finally:
        part.unlink(missing_ok=True)
    return file


def export_onnx(model: BaseAlgorithm, path: Path_, env: VecEnv | None = None) -> Path:
    """Writes the actor as ONNX that `earshot freeze` reads.

    Shapes  observation [batch x observation_size] -> logits [batch x action_count]
    Raises ValueError as `describe` does, BadInput or BadType for what is no path; then nothing is written.
    """
    import torch

    file = arguments.path("path", path)
    description = describe(model, env)
    policy = model.policy
    actor = torch.nn.Sequential(*policy.mlp_extractor.policy_net, policy.action_net).to("cpu").eval()
    stream = io.BytesIO()
    # PyTorch's newer exporter, its default since 2.9, writes no streams and puts the weights into a file of their own.
    older = {"dynamo": False} if "dynamo" in inspect.signature(torch.onnx.export).parameters else {}
    torch.onnx.export(
        actor,
        torch.zeros(1, model.observation_space.shape[0]),
        stream,
        input_names=["observation"],
        output_names=["logits"],
        dynamic_axes={"observation": {0: "batch"}, "logits": {0: "batch"}},
        opset_version=13,
        **older,
    )
    # Fields of a protobuf message may stand in any order: an entry of metadata_props (field 14) is appended.
    entry = _text_field(1, "earshot") + _text_field(2, description)
    part = file.with_name(file.name + ".part")
    try:
        part.write_bytes(stream.getvalue() + _bytes_field(14, entry))
        os.replace(part, file)
    finally:
        part.unlink(missing_ok=True)
    return file


def _varint(value: int) -> bytes:
    out = bytearray()
    while value > 0x7F:
        out.append(value & 0x7F | 0x80)
        value >>= 7
    out.append(value)
    return bytes(out)


def _bytes_field(number: int, content: bytes) -> bytes:
    return _varint(number << 3 | 2) + _varint(len(content)) + content


def _text_field(number: int, text: str) -> bytes:
    return _bytes_field(number, text.encode())
