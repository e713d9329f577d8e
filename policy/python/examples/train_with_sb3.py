"""Trains a policy with Stable-Baselines3's PPO on Earshot's C++ environment, and saves it so that a vehicle can fly it.

usage: python policy/python/examples/train_with_sb3.py [--steps N] [--state simple|memory|position_memory|belief]
                                                       [--source fixed|changing] [-o model.zip]

Then, with the programs built (cmake --preset release && cmake --build --preset release):

    earshot freeze model.zip -o model.policy --draw argmax --key earshot.key --new-key
    earshot evaluate model.policy --environment sim/ocean/environments/munk_flat.toml
"""

import argparse

from stable_baselines3 import PPO

import earshot.gym.sb3


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--steps", type=int, default=200_000)
    parser.add_argument("--state", choices=["simple", "memory", "position_memory", "belief"], default="simple")
    parser.add_argument("--source", choices=["fixed", "changing"], default="fixed")
    parser.add_argument("--environments", type=int, default=8, help="searches stepped together")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("-o", "--output", default="model.zip")
    arguments = parser.parse_args()

    env = earshot.gym.sb3.SearchVecEnv(arguments.environments, state=arguments.state, source=arguments.source)
    model = PPO("MlpPolicy", env, n_steps=2048 // arguments.environments, seed=arguments.seed, device="cpu", verbose=1)
    model.learn(arguments.steps)
    print(earshot.gym.sb3.save(model, arguments.output))


if __name__ == "__main__":
    main()
