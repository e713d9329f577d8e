"""Writes tests/policy/freeze/models: policies that Stable-Baselines3 2.3.2 trained, and what it decides with them.

usage: python tests/oracles/freeze/make_models.py tests/policy/freeze/models
needs: stable-baselines3==2.3.2 gymnasium==0.29.1 torch (toolchains/python-environment tests/bench/requirements.txt),
       and policy/python, whose environment they were trained on

memory.zip        PPO at its defaults, memory state, saved by earshot_gym.sb3.save
memory.onnx       the same policy, exported by earshot_gym.sb3.export_onnx
memory.json       its decisions (predict, deterministic) for 10 000 observations that uniform.py gives and
                  sb3_model_test.cpp repeats, one digit each; CRC-32 of every weight's bytes as NumPy has them
named_tanh.zip    activation and layers named in policy_kwargs, hidden layers 32 and 16
plain_save.zip    saved by Stable-Baselines3 itself: says nothing of the search
documented.onnx   the same policy as Stable-Baselines3's documentation exports it: actions, values, log-probabilities
with_cast.onnx    its features extractor, layers and action_net: logits, of observations cast to float32
external.onnx     not made here: memory.onnx with its weights in external.onnx.data, as onnx.save_model writes it with
                  save_as_external_data=True, location="external.onnx.data", size_threshold=0
relu.zip, three_layers.zip   untrained, of layers of four units
named_extractor.zip, own_policy.zip, continuous.zip   what cannot be frozen

Left out of every zip: the optimiser, and what names the machine it was made on (system_info.txt; functions, whose
pickles hold file paths).
"""

import json
import sys
import zipfile
import zlib
from pathlib import Path

import gymnasium
import numpy as np
import torch

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "bench" / "peers"))
import sb3_without_plots  # noqa: F401

from stable_baselines3 import PPO
from stable_baselines3.common.policies import ActorCriticPolicy
from stable_baselines3.common.torch_layers import FlattenExtractor
from uniform import uniform

import earshot_gym.sb3

DECISIONS, OBSERVATION_SIZE = 10_000, 6
FUNCTION = "<class 'function'>"  # as Stable-Baselines3 names the type of what it pickled


class Continuous(gymnasium.Env):
    """Gives PPO continuous actions; never stepped."""

    observation_space = gymnasium.spaces.Box(-1.0, 1.0, (6,))
    action_space = gymnasium.spaces.Box(-1.0, 1.0, (8,))


class OwnPolicy(ActorCriticPolicy):
    pass


class DocumentedExport(torch.nn.Module):
    """As in Stable-Baselines3's guide, "Exporting models"."""

    def __init__(self, policy: ActorCriticPolicy) -> None:
        super().__init__()
        self.policy = policy

    def forward(self, observation: torch.Tensor) -> tuple[torch.Tensor, torch.Tensor, torch.Tensor]:
        return self.policy(observation, deterministic=True)


class Logits(DocumentedExport):
    def forward(self, observation: torch.Tensor) -> torch.Tensor:
        features = self.policy.extract_features(observation)
        return self.policy.action_net(self.policy.mlp_extractor.policy_net(features))


def export(module: torch.nn.Module, file: Path) -> None:
    torch.onnx.export(module, torch.zeros(1, OBSERVATION_SIZE), file, opset_version=17, input_names=["input"])


def decisions_of(model: PPO) -> dict:
    observations = np.array(
        [[3.0 * uniform(element, i) - 1.5 for element in range(OBSERVATION_SIZE)] for i in range(DECISIONS)],
        dtype=np.float32,
    )
    actions, _ = model.predict(observations, deterministic=True)
    weights = {name: tensor.numpy() for name, tensor in model.policy.state_dict().items()}
    return {
        "actions": "".join(str(action) for action in actions),
        "weights_crc32": {name: f"{zlib.crc32(array.tobytes()):08x}" for name, array in weights.items()},
    }


def slim(file: Path) -> None:
    with zipfile.ZipFile(file) as archive:
        entries = {name: archive.read(name) for name in archive.namelist()}
    data = json.loads(entries["data"])
    functions = [key for key, value in data.items() if isinstance(value, dict) and value.get(":type:") == FUNCTION]
    for key in functions:
        del data[key]
    entries["data"] = json.dumps(data, indent=4).encode()
    with zipfile.ZipFile(file, "w") as archive:
        for name, content in entries.items():
            if name not in ("policy.optimizer.pth", "system_info.txt"):
                archive.writestr(zipfile.ZipInfo(name), content)


def main() -> None:
    torch.set_num_threads(1)
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    env = earshot_gym.sb3.SearchVecEnv(8, state="memory", source="changing")

    model = PPO("MlpPolicy", env, n_steps=256, seed=1, device="cpu")
    model.learn(30_000)
    earshot_gym.sb3.save(model, folder / "memory.zip")
    earshot_gym.sb3.export_onnx(model, folder / "memory.onnx")
    (folder / "memory.json").write_text(json.dumps(decisions_of(model), indent=1) + "\n")

    def untrained(policy="MlpPolicy", **kwargs) -> PPO:
        return PPO(policy, env, n_steps=16, seed=2, device="cpu", policy_kwargs=kwargs)

    small, tanh = {"pi": [32, 16], "vf": [4, 4]}, torch.nn.Tanh
    earshot_gym.sb3.save(untrained(net_arch=small, activation_fn=tanh, ortho_init=False), folder / "named_tanh.zip")
    plain = untrained(net_arch=[4, 4])
    plain.save(folder / "plain_save.zip")
    export(DocumentedExport(plain.policy), folder / "documented.onnx")
    export(Logits(plain.policy), folder / "with_cast.onnx")
    earshot_gym.sb3.save(untrained(net_arch=[4, 4], activation_fn=torch.nn.ReLU), folder / "relu.zip")
    earshot_gym.sb3.save(untrained(net_arch=[4, 4, 4]), folder / "three_layers.zip")
    named = untrained(net_arch=[4, 4], features_extractor_class=FlattenExtractor)
    earshot_gym.sb3.save(named, folder / "named_extractor.zip")
    earshot_gym.sb3.save(untrained(OwnPolicy, net_arch=[4, 4]), folder / "own_policy.zip")
    PPO("MlpPolicy", Continuous(), device="cpu", policy_kwargs={"net_arch": [4, 4]}).save(folder / "continuous.zip")
    for file in folder.glob("*.zip"):
        slim(file)


if __name__ == "__main__":
    main()
