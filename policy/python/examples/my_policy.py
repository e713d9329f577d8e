"""A policy of one's own, trained in Python for the mission that earshot init writes.   usage: my_policy.py [STEPS]

Needs the wheel of policy/python and Stable-Baselines3. Leaves my_policy.zip, which `earshot freeze` signs for the
vehicle.
"""

import sys

from stable_baselines3 import PPO

import earshot.gym.sb3

# A source anywhere; what is heard is the mean of half a minute, as the mission has it.
searches = earshot.gym.sb3.SearchVecEnv(8, state="memory", source="changing", listening="mean", listening_window_s=30)
model = PPO("MlpPolicy", searches, n_steps=256, seed=1, device="cpu", verbose=1)
model.learn(int(sys.argv[1]) if len(sys.argv) > 1 else 200_000)
print(earshot.gym.sb3.save(model, "my_policy.zip"))
