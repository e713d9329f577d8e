"""gym.*: steps of the search as a Gymnasium environment, and steps of Stable-Baselines3's PPO on it. One thread.

usage: python tests/bench/peers/gym_steps.py env|vector|train earshot|python      prints one JSON line, steps a second

Both our environment and a plain Python one are the changing source with the memory state, m = 2: one environment
stepped alone (env), eight stepped together (vector), 64 trained on together (train). The plain Python environment is
sb3_ppo.py's, written as a person would; several of it stand in Stable-Baselines3's DummyVecEnv, its default.
"""

import json
import sys
import time

import sb3_without_plots  # noqa: F401

import gymnasium
import numpy as np
import torch
from stable_baselines3 import PPO
from stable_baselines3.common.monitor import Monitor
from stable_baselines3.common.vec_env import DummyVecEnv

import earshot_gym.sb3
from earshot_gym.world import WorldOptions
from sb3_ppo import AcousticSearch

OPTIONS: WorldOptions = {"state": "memory", "source": "changing"}
STEPPED_TOGETHER = 8
TRAINED_TOGETHER = 64


def env_steps_per_s(env: gymnasium.Env, steps: int) -> float:
    actions = np.random.default_rng(1).integers(0, 8, steps)
    env.reset(seed=1)
    begin = time.perf_counter()
    for action in actions:
        _, _, terminated, truncated, _ = env.step(action)
        if terminated or truncated:
            env.reset()
    return steps / (time.perf_counter() - begin)


def vector_steps_per_s(env, steps: int) -> float:
    actions = np.random.default_rng(1).integers(0, 8, (steps // STEPPED_TOGETHER, STEPPED_TOGETHER))
    env.seed(1)
    env.reset()
    begin = time.perf_counter()
    for together in actions:
        env.step(together)
    return actions.size / (time.perf_counter() - begin)


def train_steps_per_s(env, steps: int) -> float:
    """Rollouts of 256 steps each and updates with minibatches of 2048.

    With small ones the update, the same for both, is nearly all there is.
    """
    model = PPO("MlpPolicy", env, n_steps=256, batch_size=2048, seed=1, device="cpu")
    begin = time.perf_counter()
    model.learn(steps)
    return model.num_timesteps / (time.perf_counter() - begin)


def together(whose: str, count: int):
    if whose == "earshot":
        return earshot_gym.sb3.SearchVecEnv(count, **OPTIONS)
    return DummyVecEnv([lambda: Monitor(AcousticSearch())] * count)


def main() -> None:
    torch.set_num_threads(1)
    what, whose = sys.argv[1:]
    if what == "env":
        env = earshot_gym.AcousticSearchEnv(**OPTIONS) if whose == "earshot" else AcousticSearch()
        value = env_steps_per_s(env, 100_000)
    elif what == "vector":
        value = vector_steps_per_s(together(whose, STEPPED_TOGETHER), 160_000)
    else:
        value = train_steps_per_s(together(whose, TRAINED_TOGETHER), 65_536)
    print(json.dumps({"name": f"gym.{what}", "value": value, "unit": "steps/s"}))


if __name__ == "__main__":
    main()
