"""Copies of environments, pickled or not, go on as the originals; a search that changed on the disk is no copy.

Run by ctest (run in this folder).
"""

import copy
import os
import pickle
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from typing import Any

import cloudpickle
import gymnasium
import numpy as np

import earshot_gym
from earshot_gym.world import PAPER_ENVIRONMENT

ROOT = Path(__file__).resolve().parents[3]
# What draws random numbers at every step and at every start.
CONDITIONS = """
[conditions]
fluctuation_db = 3.0
navigation_drift_m_per_sqrt_km = 50.0
source_speed_mps = 1.0
sources = 2
"""
WAYS = {
    "pickle": lambda env: pickle.loads(pickle.dumps(env)),
    "cloudpickle": lambda env: cloudpickle.loads(cloudpickle.dumps(env)),
    "deepcopy": copy.deepcopy,
}

# Steps what it finds pickled in a file: rewards and observations of 300 steps.
ELSEWHERE = """
import pickle, sys
import numpy as np
with open(sys.argv[1], "rb") as file:
    env, actions = pickle.load(file)
observations = [env.step(action)[0] for action in actions]
np.save(sys.argv[2], np.array(observations))
"""


def steps(env, actions) -> np.ndarray:
    """What is seen and earned from here on; an episode that ends is followed by the next."""
    seen: list[Any] = []
    for action in actions:
        observation, reward, terminated, truncated, info = env.step(action)
        seen += [observation, [reward, info["snr_db"]]]
        if terminated or truncated:
            seen.append(env.reset()[0])
    return np.concatenate([np.ravel(part) for part in seen])


class Folder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.file = self.folder / "ocean.toml"
        self.file.write_text(PAPER_ENVIRONMENT.read_text() + CONDITIONS)
        self.actions = np.random.default_rng(1).integers(0, 8, 300)


class Copies(Folder):
    def make(self, **options):
        return gymnasium.make(earshot_gym.ID, environment=self.file, source="changing", **options)

    def test_step_as_the_original_and_draw_the_same_searches_after(self):
        for state in ("simple", "memory", "position_memory", "belief"):
            env = self.make(state=state)
            env.reset(seed=5)
            steps(env, self.actions[:3])
            copies = {name: way(env) for name, way in WAYS.items()} | {"copy": copy.copy(env.unwrapped)}
            expected = steps(env, self.actions[3:])
            for name, other in copies.items():
                with self.subTest(state=state, way=name):
                    np.testing.assert_array_equal(steps(other, self.actions[3:]), expected)

    def test_leave_the_original_where_it_is(self):
        for name, way in (WAYS | {"copy": lambda env: copy.copy(env.unwrapped)}).items():
            with self.subTest(way=name):
                env, same = self.make(state="memory"), self.make(state="memory")
                for each in (env, same):
                    each.reset(seed=5)
                steps(way(env), self.actions)
                np.testing.assert_array_equal(steps(env, self.actions), steps(same, self.actions))

    def test_begin_where_the_original_was_told_to(self):
        env = self.make(state="memory")
        places = {"position_m": (3_000.0, 4_000.0), "source_m": (12_000.0, 20_000.0)}
        env.reset(seed=5, options=places)
        other = pickle.loads(pickle.dumps(env))
        self.assertEqual(other.unwrapped._episodes.position_m(0), places["position_m"])
        np.testing.assert_array_equal(steps(other, self.actions), steps(env, self.actions))

    def test_are_over_where_the_original_is_and_not_begun_where_it_is_not(self):
        env = self.make(max_steps=2)
        self.assertRaisesRegex(Exception, "reset", pickle.loads(pickle.dumps(env)).step, 0)
        env.unwrapped.reset(seed=1, options={"position_m": (20_000.0, 20_000.0)})
        for _ in range(2):
            env.unwrapped.step(0)
        other = pickle.loads(pickle.dumps(env.unwrapped))
        self.assertRaisesRegex(RuntimeError, "the episode is over", other.step, 0)
        np.testing.assert_array_equal(other.reset()[0], env.unwrapped.reset()[0])

    def test_of_one_without_a_seed_draw_the_same(self):
        env = self.make()
        env.unwrapped.np_random  # noqa: B018  drawn once, and copied from then on
        other = pickle.loads(pickle.dumps(env))
        np.testing.assert_array_equal(env.reset()[0], other.reset()[0])

    def test_draw_the_path_that_the_original_went(self):
        env = self.make(render_mode="rgb_array")
        env.reset(seed=5)
        env.step(2)
        np.testing.assert_array_equal(pickle.loads(pickle.dumps(env)).render(), env.render())

    def test_of_a_vector_step_as_the_original(self):
        env = earshot_gym.AcousticSearchVectorEnv(4, environment=self.file, state="memory", source="changing")
        env.reset(seed=5)
        rng = np.random.default_rng(2)
        actions = rng.integers(0, 8, (400, 4))
        for row in actions[:200]:
            env.step(row)
        copies = [way(env) for way in WAYS.values()] + [copy.copy(env)]
        for row in actions[200:]:
            expected = env.step(row)
            for other in copies:
                for part, same in zip(other.step(row)[:4], expected[:4], strict=True):
                    np.testing.assert_array_equal(part, same)

    def test_share_the_ocean_of_the_original(self):
        env = self.make()
        for name, way in WAYS.items():
            with self.subTest(way=name):
                self.assertIs(way(env).unwrapped.world, env.unwrapped.world)
        self.assertIs(copy.copy(env.unwrapped.world), env.unwrapped.world)

    def test_step_as_the_original_in_another_process(self):
        env = self.make(state="belief")
        env.reset(seed=7, options={"position_m": (20_000.0, 20_000.0), "source_m": (3_000.0, 3_000.0)})
        env.step(4)
        actions = [6, 4, 6, 4]
        with (self.folder / "env.pickle").open("wb") as file:
            pickle.dump((env, actions), file)
        expected = [env.step(action)[0] for action in actions]
        command = [sys.executable, "-c", ELSEWHERE, self.folder / "env.pickle", self.folder / "seen.npy"]
        subprocess.run([str(word) for word in command], check=True, cwd=self.folder)
        np.testing.assert_array_equal(np.load(self.folder / "seen.npy"), expected)

    def test_that_somebody_mangled_are_refused(self):
        episodes = earshot_gym.AcousticSearchEnv(max_steps=2).unwrapped._episodes
        episodes.start(0, 1)
        world, [whole] = episodes.__getstate__()
        state, increment, started, places, actions = whole
        for broken in (
            whole[:4],
            (state, increment + 1, started, places, actions),
            (state, increment, started, places, b"\x08"),  # of 8 actions the last is 7
            (state, increment, started, places, b"\x00" * 3),
            (state, increment, started, ((float("nan"), 0.0), (0.0, 0.0)), actions),
            (state, increment, started, ((0.0, 0.0), (1e9, 0.0)), actions),
        ):
            with self.subTest(broken=broken), self.assertRaises(ValueError):
                kind: Any = type(episodes)
                kind.__new__(kind).__setstate__((world, [broken]))

    def test_of_a_frozen_policy_decide_the_same(self):
        policy = earshot_gym.FrozenPolicy(ROOT / "policy/frozen/fixed_source.policy")
        observations = np.random.default_rng(3).normal(size=(20, 2)).astype(np.float32)
        for name, way in (WAYS | {"copy": copy.copy}).items():
            with self.subTest(way=name):
                np.testing.assert_array_equal(way(policy).logits(observations), policy.logits(observations))
                self.assertEqual(way(policy).provenance, policy.provenance)


class EditedEnvironment(Folder):
    """`louder` has as many bytes as the file had, and the time of its last change: only what stands in it differs."""

    def edit(self, file: Path, old: str, new: str) -> None:
        text, when = file.read_text(), file.stat()
        self.assertIn(old, text)
        self.assertEqual(len(old), len(new))
        file.write_text(text.replace(old, new))
        os.utime(file, ns=(when.st_atime_ns, when.st_mtime_ns))

    def heard(self, **options) -> float:
        world = earshot_gym.make_world(environment=self.file, **options)
        return float(world.snr_db(np.array([5_000.0]))[0])

    def test_is_solved_anew(self):
        before, snr_db = earshot_gym.make_world(environment=self.file), self.heard()
        self.edit(self.file, "level_db_re_1upa_at_1m = 190.0", "level_db_re_1upa_at_1m = 197.0")
        self.assertAlmostEqual(self.heard() - snr_db, 7.0, places=3)  # the source level is a term of the sonar equation
        self.assertIsNot(earshot_gym.make_world(environment=self.file), before)
        self.edit(self.file, "level_db_re_1upa_at_1m = 197.0", "level_db_re_1upa_at_1m = 190.0")
        self.assertAlmostEqual(self.heard(), snr_db, places=6)

    def test_is_solved_anew_where_a_file_that_it_names_was_edited(self):
        other = self.folder / "other.toml"
        other.write_text(PAPER_ENVIRONMENT.read_text())
        self.file.write_text(PAPER_ENVIRONMENT.read_text() + '\n[[oceans]]\nenvironment = "other.toml"\n')
        before = earshot_gym.make_world(environment=self.file)
        self.assertIs(earshot_gym.make_world(environment=self.file), before)
        self.edit(other, "axis_depth_m = 1300.0", "axis_depth_m = 1000.0")
        self.assertIsNot(earshot_gym.make_world(environment=self.file), before)

    def test_is_another_search_with_every_other_choice(self):
        """As `make_world` gives one object for the same choices, each of them must tell two searches apart."""
        first = earshot_gym.make_world(environment=self.file)
        other = self.folder / "the_same.toml"
        other.write_bytes(self.file.read_bytes())
        choices: list[dict[str, Any]] = [
            {"environment": other},
            {"state": "memory"},
            {"state": "memory", "remembered_steps": 3},
            {"source": "changing"},
            {"start": "inside_border"},
            {"directions": 4},
            {"vehicle_depth_m": 200.0},
            {"border_width_m": 2_000.0},
            {"max_steps": 7},
            {"listening": "loudest", "listening_window_s": 30},
            {"listening": "loudest", "listening_window_s": 31},
        ]
        worlds = [first] + [earshot_gym.make_world(**{"environment": self.file, **each}) for each in choices]
        self.assertEqual(len({id(world) for world in worlds}), len(worlds))
        for world, choice in zip(worlds[1:], choices, strict=True):
            for name, value in choice.items():
                self.assertEqual(world.arguments[name], value)
                self.assertEqual(pickle.loads(pickle.dumps(world)).arguments[name], value)

    def test_refuses_a_search_that_was_pickled_before(self):
        env = earshot_gym.AcousticSearchEnv(environment=self.file)
        pickled = pickle.dumps(env)
        self.edit(self.file, "level_db_re_1upa_at_1m = 190.0", "level_db_re_1upa_at_1m = 191.0")
        self.assertRaisesRegex(ValueError, "ocean.toml.*not what it was when", pickle.loads, pickled)
        copy.deepcopy(env).reset(seed=1)  # its ocean is the one that was solved
        self.file.unlink()
        self.assertRaisesRegex(FileNotFoundError, "ocean.toml", pickle.loads, pickled)

    def test_comes_with_the_package_wherever_that_is_installed(self):
        self.assertNotIn(bytes(PAPER_ENVIRONMENT.parent), pickle.dumps(earshot_gym.AcousticSearchEnv()))


if __name__ == "__main__":
    unittest.main()
