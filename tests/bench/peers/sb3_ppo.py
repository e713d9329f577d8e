"""Peer of ppo.steps_per_s: Stable-Baselines3's PPO at its defaults on the same task, one thread.

The task is written as a plain Python Gymnasium environment.

With large_batch, the peer of ppo.large_batch.steps_per_s: minibatches of 2048, the whole rollout. With
many_environments, that of ppo.many_environments.steps_per_s: 64 environments, 256 steps of each in a rollout,
minibatches of 2048.

usage: python tests/bench/peers/sb3_ppo.py [large_batch|many_environments] [STEPS]
       prints one JSON line, training steps a second
"""

import json
import math
import sys
import time

import sb3_without_plots  # noqa: F401

import gymnasium
import numpy as np
import torch
from stable_baselines3 import PPO
from stable_baselines3.common.vec_env import DummyVecEnv

DOMAIN_M, STEP_M, BORDER_M, MAX_STEPS, THRESHOLD_DB, REMEMBERED = 25_000.0, 1_000.0, 1_000.0, 100, 10.0, 2
# Spherical spreading every 10 m, as tests/bench/ppo_steps.cpp.
SNR_DB = [85.0 - 20.0 * math.log10(max(1.0, 10.0 * i)) for i in range(4001)]
DIRECTIONS = [(math.cos(2 * math.pi * i / 8), math.sin(2 * math.pi * i / 8)) for i in range(8)]


class AcousticSearch(gymnasium.Env):
    """Changing source, memory state."""

    observation_space = gymnasium.spaces.Box(-np.inf, np.inf, (3 * REMEMBERED,), np.float32)
    action_space = gymnasium.spaces.Discrete(8)

    def snr(self) -> float:
        position = math.hypot(self.north - self.source_north, self.east - self.source_east) / 10.0
        if position >= len(SNR_DB) - 1:
            return SNR_DB[-1]
        i = int(position)
        return SNR_DB[i] + (position - i) * (SNR_DB[i + 1] - SNR_DB[i])

    def observation(self) -> np.ndarray:
        return np.array(self.memory, dtype=np.float32)

    def reset(self, *, seed=None, options=None):
        super().reset(seed=seed)
        while True:
            self.source_north, self.source_east, self.north, self.east = self.np_random.uniform(0.0, DOMAIN_M, 4)
            if math.hypot(self.north - self.source_north, self.east - self.source_east) > STEP_M:
                break
        self.steps = 0
        unheard = [0.0, 0.0, -THRESHOLD_DB / 30.0]
        self.memory = [0.0, 0.0, (self.snr() - THRESHOLD_DB) / 30.0] + unheard * (REMEMBERED - 1)
        return self.observation(), {}

    def step(self, action):
        north, east = DIRECTIONS[action]
        self.north += STEP_M * north
        self.east += STEP_M * east
        self.steps += 1
        snr = self.snr()
        self.memory = [east, north, (snr - THRESHOLD_DB) / 30.0] + self.memory[:-3]
        to_edge = min(self.north, DOMAIN_M - self.north, self.east, DOMAIN_M - self.east)
        reward = 0.0 if snr >= THRESHOLD_DB else -1.0
        if to_edge < BORDER_M:
            reward -= 100.0 * (BORDER_M - to_edge) / BORDER_M
        found = math.hypot(self.north - self.source_north, self.east - self.source_east) <= STEP_M
        terminated = found or to_edge < 0.0
        return self.observation(), reward, terminated, self.steps >= MAX_STEPS and not terminated, {}


def main() -> None:
    kind = sys.argv[1] if sys.argv[1:2] in (["large_batch"], ["many_environments"]) else ""
    arguments = sys.argv[2:] if kind else sys.argv[1:]
    steps = int(arguments[0]) if arguments else (32_768 if kind == "many_environments" else 20_480)
    torch.set_num_threads(1)
    if kind == "many_environments":
        model = PPO("MlpPolicy", DummyVecEnv([AcousticSearch] * 64), n_steps=256, batch_size=2048, seed=1, device="cpu")
    elif kind == "large_batch":
        model = PPO("MlpPolicy", AcousticSearch(), batch_size=2048, seed=1, device="cpu")
    else:
        model = PPO("MlpPolicy", AcousticSearch(), seed=1, device="cpu")
    begin = time.perf_counter()
    model.learn(steps)
    elapsed = time.perf_counter() - begin
    name = f"ppo.{kind}.steps_per_s" if kind else "ppo.steps_per_s"
    print(json.dumps({"name": name, "value": model.num_timesteps / elapsed, "unit": "steps/s"}))


if __name__ == "__main__":
    main()
