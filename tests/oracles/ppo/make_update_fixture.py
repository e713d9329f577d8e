"""Writes tests/policy/ppo/update.json: what Stable-Baselines3 2.3.2 makes of one rollout.

usage: python tests/oracles/ppo/make_update_fixture.py > tests/policy/ppo/update.json
needs: stable-baselines3==2.3.2 gymnasium==0.29.1 torch (toolchains/python-environment tests/bench/requirements.txt)

Inputs come from `uniform` below, an integer hash that learner_test.cpp repeats, so the file holds outputs only:
advantages and returns [environment][step], and every parameter after the epochs, named and row-major as in PyTorch.
"""

import functools
import json
import sys
from pathlib import Path

import gymnasium
import numpy as np
import torch

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "bench" / "peers"))
import sb3_without_plots  # noqa: F401

from stable_baselines3 import PPO
from stable_baselines3.common.logger import Logger
from stable_baselines3.common.vec_env import DummyVecEnv

OBSERVATION_SIZE, ACTIONS, ENVIRONMENTS, STEPS, BATCH = 6, 8, 2, 40, 32
SAMPLES = ENVIRONMENTS * STEPS
# One epoch each: sample i of epoch e is (i * stride + e) mod SAMPLES; 80 samples give batches of 32, 32, 16.
STRIDES = [3, 7, 9]


def uniform(stream: int, i: int) -> float:
    """In [0, 1), 16 bits: exact in a float."""
    x = (i * 2654435761 + stream * 40503 + 12345) % 2**32
    x ^= x >> 15
    x = x * 2246822519 % 2**32
    x ^= x >> 13
    return (x >> 16) / 65536.0


def array(stream: int, shape: tuple[int, ...], scale: float, offset: float) -> np.ndarray:
    n = int(np.prod(shape))
    return np.array([scale * uniform(stream, i) + offset for i in range(n)], dtype=np.float32).reshape(shape)


class Nowhere(gymnasium.Env):
    """Gives PPO the shapes; never stepped."""

    observation_space = gymnasium.spaces.Box(-1.0, 1.0, (OBSERVATION_SIZE,))
    action_space = gymnasium.spaces.Discrete(ACTIONS)

    def reset(self, *, seed=None, options=None):
        return np.zeros(OBSERVATION_SIZE, np.float32), {}


def strided(stride: int, epoch: int, n: int) -> np.ndarray:
    """In place of a random order of n samples."""
    return np.array([(i * stride + epoch) % n for i in range(n)])


def main() -> None:
    torch.set_num_threads(1)
    vector = DummyVecEnv([Nowhere] * ENVIRONMENTS)
    model = PPO("MlpPolicy", vector, n_steps=STEPS, batch_size=BATCH, n_epochs=1, ent_coef=0.01, device="cpu")
    model._logger = Logger(None, [])

    names = dict(model.policy.named_parameters())
    with torch.no_grad():
        for stream, (_, tensor) in enumerate(sorted(names.items())):
            tensor.copy_(torch.from_numpy(array(100 + stream, tuple(tensor.shape), 0.5, -0.25)))

    # Buffers are [step, environment]; streams count environment * STEPS + step, the order of the flattened buffer.
    def by_step(stream: int, scale: float, offset: float) -> np.ndarray:
        return array(stream, (ENVIRONMENTS, STEPS), scale, offset).T.copy()

    buffer = model.rollout_buffer
    buffer.reset()
    buffer.observations = array(1, (ENVIRONMENTS, STEPS, OBSERVATION_SIZE), 2.0, -1.0).transpose(1, 0, 2).copy()
    buffer.actions = np.floor(by_step(2, ACTIONS, 0.0))[:, :, None]
    buffer.log_probs = by_step(3, 1.0, -2.5)
    buffer.values = by_step(4, 4.0, -2.0)
    buffer.rewards = by_step(5, 2.0, -1.5)
    buffer.episode_starts = (by_step(6, 1.0, 0.0) < 0.1).astype(np.float32)
    buffer.pos, buffer.full = STEPS, True
    buffer.compute_returns_and_advantage(last_values=torch.tensor([0.5, -1.25]), dones=np.array([False, True]))

    out = {
        "advantages": buffer.advantages.T.flatten().tolist(),
        "returns": buffer.returns.T.flatten().tolist(),
    }
    for epoch, stride in enumerate(STRIDES):
        np.random.permutation = functools.partial(strided, stride, epoch)
        model.train()
    out["parameters"] = {name: tensor.detach().numpy().flatten().tolist() for name, tensor in sorted(names.items())}
    rounded = json.loads(json.dumps(out), parse_float=lambda s: float(f"{float(s):.9g}"))
    json.dump(rounded, sys.stdout, separators=(",", ":"))
    sys.stdout.write("\n")


if __name__ == "__main__":
    main()
