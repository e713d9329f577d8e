"""gym.*: steps of the search as a Gymnasium environment, and steps of Stable-Baselines3's PPO on it. One thread.

usage: python tests/bench/peers/gym_steps.py env|vector|train earshot|python      prints one JSON line

The figure is steps a second of the processor, for a machine has other work. Both our environment and a plain Python one
are the changing source with the memory state, m = 2: one environment stepped alone (env), eight stepped together
(vector), 64 trained on together (train). Steps in which no search ends, and a training that changes nothing, are none
(wrong: hardly a step, and a learning rate of zero). The plain Python environment is sb3_ppo.py's, written as a person
would; several of it stand in Stable-Baselines3's DummyVecEnv, its default.
"""

import json
import os
import sys
import time

import sb3_without_plots  # noqa: F401

import gymnasium
import numpy as np
import torch
from stable_baselines3 import PPO
from stable_baselines3.common.monitor import Monitor
from stable_baselines3.common.vec_env import DummyVecEnv

import earshot.gym.sb3
from earshot.gym.world import WorldOptions
from sb3_ppo import AcousticSearch

OPTIONS: WorldOptions = {"state": "memory", "source": "changing"}
STEPPED_TOGETHER = 8
TRAINED_TOGETHER = 64
IS_SHORT = "EARSHOT_BENCH_SHORT" in os.environ
IS_WRONG = "EARSHOT_BENCH_WRONG" in os.environ


def require(holds: bool, fault: str) -> None:
    if not holds:
        sys.exit(fault)


def env_steps_per_s(env: gymnasium.Env, steps: int) -> float:
    actions = np.random.default_rng(1).integers(0, 8, steps)
    env.reset(seed=1)
    searches = 0
    begin = time.process_time()
    for action in actions:
        _, _, terminated, truncated, _ = env.step(action)
        if terminated or truncated:
            searches += 1
            env.reset()
    spent_s = time.process_time() - begin
    require(searches > 0, f"no search ended in {steps} steps")
    return steps / spent_s


def vector_steps_per_s(env, steps: int) -> float:
    actions = np.random.default_rng(1).integers(0, 8, (steps // STEPPED_TOGETHER, STEPPED_TOGETHER))
    env.seed(1)
    env.reset()
    searches = 0
    begin = time.process_time()
    for together in actions:
        searches += np.count_nonzero(env.step(together)[2])
    spent_s = time.process_time() - begin
    require(searches > 0, f"no search ended in {steps} steps")
    return actions.size / spent_s


def train_steps_per_s(env, steps: int) -> float:
    """Rollouts of 256 steps each and updates with minibatches of 2048.

    With small ones the update, the same for both, is nearly all there is.
    """
    learning_rate = 0.0 if IS_WRONG else 3e-4
    model = PPO("MlpPolicy", env, learning_rate, n_steps=256, batch_size=2048, seed=1, device="cpu")
    untrained = torch.nn.utils.parameters_to_vector(model.policy.parameters()).detach().clone()
    begin = time.process_time()
    model.learn(steps)
    spent_s = time.process_time() - begin
    trained = torch.nn.utils.parameters_to_vector(model.policy.parameters()).detach()
    require(not torch.equal(trained, untrained) and bool(torch.isfinite(trained).all()), "nothing was learnt")
    return model.num_timesteps / spent_s


def steps_of(full: int) -> int:
    if IS_WRONG:
        return STEPPED_TOGETHER
    return full // 20 if IS_SHORT else full


def together(whose: str, count: int):
    if whose == "earshot":
        return earshot.gym.sb3.SearchVecEnv(count, **OPTIONS)
    return DummyVecEnv([lambda: Monitor(AcousticSearch())] * count)


def main() -> None:
    torch.set_num_threads(1)
    what, whose = sys.argv[1:]
    if what == "env":
        env = earshot.gym.AcousticSearchEnv(**OPTIONS) if whose == "earshot" else AcousticSearch()
        value = env_steps_per_s(env, steps_of(100_000))
    elif what == "vector":
        value = vector_steps_per_s(together(whose, STEPPED_TOGETHER), steps_of(160_000))
    else:
        value = train_steps_per_s(together(whose, TRAINED_TOGETHER), 16_384 if IS_SHORT else 65_536)
    print(json.dumps({"name": f"gym.{what}", "value": value, "unit": "steps/s"}))


if __name__ == "__main__":
    main()
