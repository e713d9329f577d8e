"""Stable-Baselines3 trains on the environment, and what it trained decides the same when frozen.

Run by ctest where PyTorch is there.
"""

import copy
import inspect
import json
import os
import pickle
import subprocess
import sys
import tempfile
import unittest
import zipfile
from pathlib import Path
from unittest import mock

import cloudpickle
import gymnasium
import numpy as np
import torch

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "bench" / "peers"))
import sb3_without_plots  # noqa: F401

from stable_baselines3 import PPO
from stable_baselines3.common.evaluation import evaluate_policy
from stable_baselines3.common.torch_layers import FlattenExtractor
from stable_baselines3.common.vec_env import DummyVecEnv, SubprocVecEnv, VecFrameStack, VecNormalize

import earshot_gym.sb3
from earshot_gym.world import WorldOptions

OPTIONS: WorldOptions = {"state": "memory", "source": "changing"}


def trained(env, steps=4_096):
    model = PPO("MlpPolicy", env, n_steps=256, seed=1, device="cpu")
    model.learn(steps)
    return model


class Documented(torch.nn.Module):
    """As in Stable-Baselines3's guide, "Exporting models"."""

    def __init__(self, policy):
        super().__init__()
        self.policy = policy

    def forward(self, observation):
        return self.policy(observation, deterministic=True)


class Normalised(torch.nn.Module):
    """The logits of a policy that sees observations less their mean, in units of their deviation."""

    def __init__(self, policy, mean, deviation):
        super().__init__()
        self.layers = torch.nn.Sequential(*policy.mlp_extractor.policy_net, policy.action_net)
        self.register_buffer("mean", mean)
        self.register_buffer("deviation", deviation)

    def forward(self, observation):
        return self.layers((observation - self.mean) / self.deviation)


class StableBaselines3(unittest.TestCase):
    def setUp(self):
        torch.set_num_threads(1)
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def freeze(self, model: Path, *options) -> subprocess.CompletedProcess:
        self.policy = self.folder / "model.policy"
        key = ["--key", self.folder / "a.key"] + ([] if (self.folder / "a.key").exists() else ["--new-key"])
        command = [f"{os.environ['EARSHOT_PROGRAMS']}/earshot-freeze", model, "-o", self.policy, *key, *options]
        return subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)

    def test_frozen_makes_the_ten_thousand_decisions_of_predict(self):
        """On the observations of the searches it flies, zip and ONNX alike.

        Sums in another order may turn a tie within a float's rounding: such a decision counts as the same only if its
        two best logits are that near.
        """
        env = earshot_gym.sb3.SearchVecEnv(50, **OPTIONS)
        model = trained(env, 25_600)
        env.seed(3)
        observation, seen = env.reset(), []
        for _ in range(200):
            seen.append(observation)
            observation, *_ = env.step(model.predict(observation, deterministic=True)[0])
        seen = np.concatenate(seen)
        self.assertEqual(len(seen), 10_000)
        decided, _ = model.predict(seen, deterministic=True)
        zipped = earshot_gym.sb3.save(model, self.folder / "model")
        for file in (zipped, earshot_gym.sb3.export_onnx(model, self.folder / "model.onnx")):
            done = self.freeze(file)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            logits = earshot_gym.FrozenPolicy(self.policy).logits(seen)
            differ = logits.argmax(axis=1) != decided
            best = np.sort(logits, axis=1)
            print(f"{file.name}: {differ.sum()} of {len(seen)} decisions differ", file=sys.stderr)
            self.assertTrue(np.all(best[differ, -1] - best[differ, -2] < 1e-5))
            self.assertLessEqual(differ.sum(), 1)

    def export(self, module, name: str) -> Path:
        file = self.folder / name
        older = {"dynamo": False} if "dynamo" in inspect.signature(torch.onnx.export).parameters else {}
        torch.onnx.export(module, torch.zeros(1, 6), file, opset_version=17, input_names=["input"], **older)
        return file

    def test_frozen_gives_the_logits_of_layers_of_256_units_with_relu_whatever_file_they_come_in(self):
        """Logits are below one, of sums that PyTorch adds in another order."""
        env = earshot_gym.sb3.SearchVecEnv(2, **OPTIONS)
        layers = {"net_arch": {"pi": [256, 256, 256], "vf": [4]}, "activation_fn": torch.nn.ReLU}
        model = PPO("MlpPolicy", env, n_steps=16, seed=1, device="cpu", policy_kwargs=layers)
        description = self.folder / "search.json"
        description.write_text(earshot_gym.sb3.describe(model))
        seen = np.random.default_rng(2).uniform(-1.5, 1.5, (1_000, 6)).astype(np.float32)
        mean, deviation = torch.linspace(-0.4, 0.6, 6), torch.linspace(0.5, 2.0, 6)
        normalised = Normalised(model.policy, mean, deviation)
        with torch.no_grad():
            plain = normalised.layers(torch.tensor(seen)).numpy()
            other = normalised(torch.tensor(seen)).numpy()
        search = ("--search", description)
        for file, options, expected in (
            (earshot_gym.sb3.save(model, self.folder / "model"), (), plain),
            (earshot_gym.sb3.export_onnx(model, self.folder / "model.onnx"), (), plain),
            (self.export(Documented(model.policy), "documented.onnx"), search, plain),
            (self.export(normalised, "normalised.onnx"), search, other),
        ):
            with self.subTest(file=file.name):
                done = self.freeze(file, *options, "--force")
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                self.assertIn("network 256-256-256 ReLU of 541728 bytes", done.stdout)
                logits = earshot_gym.FrozenPolicy(self.policy).logits(seen)
                np.testing.assert_allclose(logits, expected, atol=1e-6)

    def test_trains_on_the_registered_environment_too(self):
        model = trained(gymnasium.make(earshot_gym.ID, **OPTIONS), 512)
        done = self.freeze(earshot_gym.sb3.save(model, self.folder / "model.zip"))
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_learns_to_find_a_fixed_source(self):
        env = earshot_gym.sb3.SearchVecEnv(8, state="simple", source="fixed", start="inside_border")
        env.seed(1)
        model = PPO("MlpPolicy", env, n_steps=256, seed=1, device="cpu")
        before, _ = evaluate_policy(model, env, 40)
        model.learn(30_000)
        after, _ = evaluate_policy(model, env, 40)
        self.assertGreater(after, before / 3)  # rewards are negative: three times better at the least

    def test_a_saved_model_is_loaded_by_stable_baselines3(self):
        env = earshot_gym.sb3.SearchVecEnv(2, **OPTIONS)
        model = trained(env, 512)
        file = earshot_gym.sb3.save(model, self.folder / "model")
        self.assertEqual(json.loads(zipfile.ZipFile(file).read("earshot.json"))["normalisation"], "none")
        observation = np.zeros((1, 6), np.float32)
        decided, _ = model.predict(observation, deterministic=True)
        self.assertEqual(PPO.load(file).predict(observation, deterministic=True)[0], decided)
        self.assertEqual([path.name for path in self.folder.iterdir()], ["model.zip"])

    def test_searches_are_counted(self):
        for number in (0, 1.5):
            self.assertRaisesRegex(ValueError, f"^num_envs = {number}: must be", earshot_gym.sb3.SearchVecEnv, number)

    def test_searches_are_sent_to_other_processes_as_they_are(self):
        env = gymnasium.make(earshot_gym.ID, **OPTIONS)
        env.reset(seed=4)
        actions = np.random.default_rng(4).integers(0, 8, 20)
        begun = [env.step(action)[0] for action in actions[:2]]
        self.assertEqual(len(begun), 2)
        # Made here and carried there; Stable-Baselines3 resets what it gets, whose random numbers go on.
        envs = SubprocVecEnv([lambda: env, lambda: env], start_method="spawn")
        self.addCleanup(envs.close)
        first = envs.reset()
        np.testing.assert_array_equal(first, [env.reset()[0]] * 2)
        action = int(actions[2])
        np.testing.assert_array_equal(envs.step(np.array([action, action]))[0], [env.step(action)[0]] * 2)
        self.assertEqual(envs.get_attr("search_description"), [env.unwrapped.search_description] * 2)
        self.assertEqual(envs.get_attr("world")[0].arguments, env.unwrapped.world.arguments)

    def test_copies_of_the_vector_environment_step_as_it_does(self):
        env = earshot_gym.sb3.SearchVecEnv(3, **OPTIONS)
        env.seed(1)
        env.reset()
        actions = np.random.default_rng(5).integers(0, 8, (150, 3))
        for row in actions[:50]:
            env.step(row)
        ways = [lambda one: pickle.loads(pickle.dumps(one)), lambda one: cloudpickle.loads(cloudpickle.dumps(one))]
        copies = [way(env) for way in [*ways, copy.deepcopy, copy.copy]]
        for row in actions[50:]:
            expected = env.step(row)
            for other in copies:
                for part, same in zip(other.step(row)[:3], expected[:3], strict=True):
                    np.testing.assert_array_equal(part, same)

    def test_exports_by_the_exporter_that_writes_one_file_whatever_pytorch_prefers(self):
        model = trained(earshot_gym.sb3.SearchVecEnv(2, **OPTIONS), 512)
        older, asked = torch.onnx.export, []

        def export(*arguments, dynamo=True, **options):  # as of PyTorch 2.9
            asked.append(dynamo)
            older(*arguments, **options)

        with mock.patch.object(torch.onnx, "export", export):
            file = earshot_gym.sb3.export_onnx(model, self.folder / "model.onnx")
        self.assertEqual(asked, [False])
        self.assertEqual(self.freeze(file).returncode, 0)
        earshot_gym.sb3.export_onnx(model, file)  # with the exporter that is here, which may not know the word

    def test_exports_what_was_never_trained(self):
        """Its biases are all zero: PyTorch writes them once, for every layer."""
        model = PPO("MlpPolicy", earshot_gym.sb3.SearchVecEnv(2, **OPTIONS), n_steps=16, device="cpu")
        done = self.freeze(earshot_gym.sb3.export_onnx(model, self.folder / "model.onnx"))
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_refuses_to_save_what_saw_changed_observations(self):
        for env in (
            VecNormalize(earshot_gym.sb3.SearchVecEnv(2, **OPTIONS)),
            VecFrameStack(earshot_gym.sb3.SearchVecEnv(2, **OPTIONS), 2),
            DummyVecEnv([lambda: gymnasium.wrappers.NormalizeObservation(gymnasium.make(earshot_gym.ID, **OPTIONS))]),
        ):
            model = PPO("MlpPolicy", env, n_steps=16, device="cpu")
            self.assertRaisesRegex(ValueError, "frozen", earshot_gym.sb3.save, model, self.folder / "model.zip")
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_refuses_a_features_extractor_that_would_be_dropped(self):
        class Doubled(FlattenExtractor):
            def forward(self, observations):
                return 2.0 * super().forward(observations)

        kwargs = {"features_extractor_class": Doubled}
        env = earshot_gym.sb3.SearchVecEnv(2, **OPTIONS)
        model = PPO("MlpPolicy", env, n_steps=16, device="cpu", policy_kwargs=kwargs)
        for write in (earshot_gym.sb3.save, earshot_gym.sb3.export_onnx):
            self.assertRaisesRegex(ValueError, "features_extractor: Doubled", write, model, self.folder / "model")
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_looks_at_the_wrappers_of_every_environment_and_at_more_than_their_names(self):
        class TimeLimit(gymnasium.ObservationWrapper):
            def observation(self, observation):
                return 2.0 * observation

        def make(**options):
            return gymnasium.make(earshot_gym.ID, **{**OPTIONS, **options})

        for last, message in [
            (lambda: TimeLimit(make()), "TimeLimit: not known"),
            (lambda: gymnasium.wrappers.NormalizeObservation(make()), "NormalizeObservation: not known"),
            (lambda: make(source="fixed"), "searches that differ"),
        ]:
            with self.subTest(message):
                model = PPO("MlpPolicy", DummyVecEnv([make, last]), n_steps=16, device="cpu")
                self.assertRaisesRegex(ValueError, message, earshot_gym.sb3.describe, model)
        earshot_gym.sb3.describe(PPO("MlpPolicy", DummyVecEnv([make, make]), n_steps=16, device="cpu"))

    def test_normalised_rewards_change_nothing(self):
        env = VecNormalize(earshot_gym.sb3.SearchVecEnv(2, **OPTIONS), norm_obs=False)
        self.assertEqual(self.freeze(earshot_gym.sb3.save(trained(env, 512), self.folder / "model.zip")).returncode, 0)

    def test_refuses_to_save_where_no_file_can_be(self):
        model = PPO("MlpPolicy", earshot_gym.sb3.SearchVecEnv(2, **OPTIONS), n_steps=64, seed=1, device="cpu")
        for write in (earshot_gym.sb3.save, earshot_gym.sb3.export_onnx):
            for wrong, error in ((3, TypeError), ("", ValueError), ("a\0b", ValueError)):
                with self.subTest(function=write.__name__, path=wrong):
                    self.assertRaisesRegex(error, "^path", write, model, wrong)

    def test_a_model_without_description_needs_one(self):
        env = earshot_gym.sb3.SearchVecEnv(2, **OPTIONS)
        model = trained(env, 512)
        model.save(self.folder / "plain.zip")
        refused = self.freeze(self.folder / "plain.zip")
        self.assertEqual(refused.returncode, 2)
        self.assertIn("--search", refused.stderr)
        (self.folder / "search.json").write_text(earshot_gym.sb3.describe(model))
        self.assertEqual(self.freeze(self.folder / "plain.zip", "--search", self.folder / "search.json").returncode, 0)

    def test_the_vector_environment_tells_of_episodes_as_a_monitor_does(self):
        options: WorldOptions = {**OPTIONS, "max_steps": 3}
        env = earshot_gym.sb3.SearchVecEnv(4, **options)
        env.seed(1)
        env.reset()
        for _ in range(3):
            _, _, done, infos = env.step(np.zeros(4, dtype=np.int64))
        for info in (info for info, over in zip(infos, done, strict=True) if over):
            self.assertEqual(info["episode"]["l"], 3)
            self.assertEqual(info["terminal_observation"].shape, (6,))
        self.assertTrue(done.any())


if __name__ == "__main__":
    unittest.main()
