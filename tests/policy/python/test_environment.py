"""policy/python as a person meets it: Gymnasium's own checks, seeds, vector against single, bad input.

Run by ctest (run in this folder).
"""

import importlib.util
import os
import subprocess
import sys
import tempfile
import unittest
import warnings
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
from gymnasium.utils.env_checker import check_env

import earshot_gym
import earshot_gym._core

HAS_MATPLOTLIB = importlib.util.find_spec("matplotlib") is not None
os.environ["MPLBACKEND"] = "module://counted_window"
STATES = ("simple", "memory", "position_memory", "belief")
EAST = 2
ROOT = Path(__file__).resolve().parents[3]


def flown(env, seed, actions):
    """Observations and rewards of one episode."""
    observation, _ = env.reset(seed=seed)
    out = [observation]
    for action in actions:
        observation, reward, terminated, truncated, _ = env.step(action)
        out += [observation, reward]
        if terminated or truncated:
            break
    return np.concatenate([np.ravel(x) for x in out])


class Environment(unittest.TestCase):
    def test_passes_the_checks_of_gymnasium(self):
        for state in STATES:
            for source in ("fixed", "changing"):
                with self.subTest(state=state, source=source), warnings.catch_warnings():
                    warnings.simplefilter("error")
                    warnings.filterwarnings("ignore", message=".*Box observation space m..imum value is -?infinity")
                    env = gymnasium.make(earshot_gym.ID, state=state, source=source, render_mode="rgb_array")
                    check_env(env.unwrapped, skip_render_check=not HAS_MATPLOTLIB)  # it opens a window, too

    def test_names_each_number_of_an_observation(self):
        for state in STATES:
            with self.subTest(state=state):
                env = earshot_gym.AcousticSearchEnv(state=state)
                self.assertEqual((len(env.observation_names),), env.observation_space.shape)
                self.assertEqual(len(set(env.observation_names)), len(env.observation_names))
                envs = earshot_gym.AcousticSearchVectorEnv(2, state=state)
                self.assertEqual(envs.observation_names, env.observation_names)
        names = earshot_gym.AcousticSearchEnv(state="position_memory", remembered_steps=1).observation_names
        self.assertEqual(sorted(names), ["east", "north", "step_east_0", "step_north_0", "step_snr_0"])

    def test_the_numbers_that_its_names_tell_of_are_there(self):
        env = earshot_gym.AcousticSearchEnv(state="position_memory", remembered_steps=1, source="changing")
        env.reset(seed=3)
        observation, _, _, _, info = env.step(EAST)
        seen = dict(zip(env.observation_names, observation, strict=True))
        north_m, east_m = info["position_m"]
        half_m = 12_500.0
        self.assertAlmostEqual(seen["east"], (east_m - half_m) / half_m, places=5)
        self.assertAlmostEqual(seen["north"], (north_m - half_m) / half_m, places=5)
        self.assertAlmostEqual(seen["step_east_0"], 1.0, places=5)
        self.assertAlmostEqual(seen["step_north_0"], 0.0, places=5)

    def test_repeats_an_episode_from_its_seed(self):
        rng = np.random.default_rng(1)
        actions = rng.integers(0, 8, 100)
        env = earshot_gym.AcousticSearchEnv(state="memory", source="changing")
        first = flown(env, 5, actions)
        flown(env, 6, actions)
        np.testing.assert_array_equal(flown(env, 5, actions), first)
        self.assertFalse(np.array_equal(flown(env, 6, actions), first))

    def test_without_a_seed_no_two_are_alike(self):
        one, other = earshot_gym.AcousticSearchEnv(), earshot_gym.AcousticSearchEnv()
        self.assertFalse(np.array_equal(one.reset()[0], other.reset()[0]))
        self.assertFalse(np.array_equal(one.reset()[0], one.reset()[0]))

    def test_finds_a_source_straight_east(self):
        env = earshot_gym.AcousticSearchEnv(state="simple", source="changing")
        places = {"position_m": (12_500.0, 5_000.0), "source_m": (12_500.0, 8_500.0)}
        observation, info = env.reset(seed=1, options=places)
        # (x, y) over half the area's 25 km, from its centre; a float's rounding.
        np.testing.assert_allclose(observation, [-0.6, 0.0], atol=1e-6)
        self.assertEqual(info["source_m"], (12_500.0, 8_500.0))
        for step in range(3):  # 3.5 km away, found within 1 km: 3 steps of 1 km
            _, reward, terminated, truncated, info = env.step(EAST)
            self.assertEqual(reward, 0.0)  # 190 dB a few km away is heard
            self.assertEqual(terminated, step == 2)
            self.assertFalse(truncated)
        self.assertTrue(info["found"])
        self.assertEqual(info["position_m"], (12_500.0, 8_000.0))
        self.assertRaisesRegex(RuntimeError, "the episode is over", env.step, EAST)

    def test_believes_in_the_ocean_that_it_is_told_of(self):
        env = earshot_gym.AcousticSearchEnv(state="belief", source="changing")
        start = (3_000.0, 3_000.0)
        observation, info = env.reset(seed=1, options={"position_m": start, "source_m": (3_000.0, 9_000.0)})
        # The likeliest place, metres east and north of the vehicle: elements 4 and 6, in half the area's 25 km.
        likeliest_m = float(np.hypot(observation[4], observation[6])) * 12_500.0
        expected = env.world.snr_db(np.linspace(likeliest_m - 400.0, likeliest_m + 400.0, 81))  # a cell's half diagonal
        self.assertLess(np.min(np.abs(expected - info["snr_db"])), 3.0)
        self.assertGreater(likeliest_m, 1_000.0)
        louder = env.reset(seed=1, options={"position_m": start, "source_m": (3_000.0, 4_500.0)})[0]
        self.assertLess(float(np.hypot(louder[5], louder[7])), float(np.hypot(observation[5], observation[7])), "mean")

    def test_is_cut_after_max_steps(self):
        env = earshot_gym.AcousticSearchEnv(max_steps=2)
        env.reset(seed=1, options={"position_m": (20_000.0, 20_000.0)})
        self.assertEqual(env.step(0)[2:4], (False, False))
        self.assertEqual(env.step(4)[2:4], (False, True))

    def test_draws_itself(self):
        env = earshot_gym.AcousticSearchEnv(render_mode="ansi")
        env.reset(seed=1, options={"position_m": (20_000.0, 10_000.0)})
        self.assertIn("20.0 km north, 10.0 km east", env.render())
        self.assertIn("source 10.0 km away", env.render())
        env = earshot_gym.AcousticSearchEnv(render_mode="rgb_array")
        env.reset(seed=1)
        picture = env.render()
        self.assertEqual((picture.shape, picture.dtype), ((256, 256, 3), np.uint8))
        self.assertEqual(tuple(picture[256 - 103, 102]), (235, 80, 60))  # the source, 10 of 25 km north and east

    def test_draws_nothing_of_the_search_before(self):
        env = earshot_gym.AcousticSearchEnv(render_mode="rgb_array")
        env.reset(seed=1)
        first = env.render()
        for _ in range(3):
            env.step(0)
        self.assertFalse(np.array_equal(env.render(), first))
        env.reset(seed=1)
        np.testing.assert_array_equal(env.render(), first)

    def test_refuses_bad_input_by_name(self):
        cases: list[tuple[dict[str, Any], type[Exception], str]] = [
            ({"state": "both"}, ValueError, "state.*simple.*memory.*belief"),
            ({"source": "moving"}, ValueError, "source.*fixed.*changing"),
            ({"start": "anywhere"}, ValueError, "start.*domain.*inside_border"),
            ({"environment": "none.toml"}, FileNotFoundError, "none.toml"),
            ({"environment": 3}, TypeError, "environment: must be a text or a path"),
            ({"environment": ""}, ValueError, "environment = '': must be the name of a file"),
            ({"environment": "a\0b"}, ValueError, "environment = .*: must be the name of a file"),
            ({"directions": 33}, ValueError, "directions = 33.*1 to 32"),
            ({"directions": -1}, ValueError, "directions = -1"),
            ({"state": "memory", "remembered_steps": 22}, ValueError, "remembered_steps = 22.*1 to 21"),
            ({"state": "position_memory", "remembered_steps": 21}, ValueError, "remembered_steps = 21.*1 to 20"),
            ({"max_steps": 0}, ValueError, "max_steps = 0"),
            ({"listening": "all"}, ValueError, "listening.*newest.*loudest.*mean"),
            (
                {"listening": "newest", "listening_window_s": 30},
                ValueError,
                "listening_window_s.*newest.*without a window",
            ),
            ({"listening": "loudest"}, ValueError, "listening_window_s.*1 to 120"),
            ({"listening": "mean", "listening_window_s": 121}, ValueError, "listening_window_s.*1 to 120 s, not 121"),
            ({"border_width_m": float("nan")}, ValueError, "border_width_m"),
            ({"border_width_m": 12_500.0, "start": "inside_border"}, ValueError, "nothing of the domain is left"),
            ({"vehicle_depth_m": 3_000.0}, ValueError, "vehicle_depth_m"),
            ({"render_mode": "hologram"}, ValueError, "render_mode"),
            ({"frobnicate": 1}, TypeError, "frobnicate"),
        ]
        for arguments, error, message in cases:
            with self.subTest(**arguments):
                self.assertRaisesRegex(error, message, earshot_gym.AcousticSearchEnv, **arguments)

    def test_names_what_is_wrong_with_an_environment_file(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "ocean.toml"
            file.write_text(earshot_gym.world.PAPER_ENVIRONMENT.read_text() + "\n[sky]\n")
            with self.assertRaisesRegex(earshot_gym.BadInput, "ocean.toml.*sky.*unknown key"):
                earshot_gym.AcousticSearchEnv(environment=file)

    def test_refuses_steps_that_cannot_be_taken(self):
        env = earshot_gym.AcousticSearchEnv()
        self.assertRaisesRegex(RuntimeError, "before reset", env.step, 0)
        env.reset(seed=1)
        self.assertRaisesRegex(ValueError, "action 8: must be 0 to 7", env.step, 8)
        self.assertRaisesRegex(ValueError, "action -1", env.step, -1)
        self.assertRaises(TypeError, env.step, 1.9)
        self.assertRaisesRegex(ValueError, "position_m", env.reset, options={"position_m": (float("nan"), 0.0)})
        self.assertRaisesRegex(ValueError, "within a step", env.reset, options={"position_m": (9_500.0, 10_000.0)})
        self.assertRaisesRegex(ValueError, "unknown.*place", env.reset, options={"place": 1})


class Episodes(unittest.TestCase):
    def make(self, count):
        return earshot_gym._core.Episodes(earshot_gym.AcousticSearchEnv(state="memory").world, count)

    def test_refuses_to_observe_before_every_episode_began(self):
        episodes = self.make(2)
        self.assertRaisesRegex(RuntimeError, "observations.. before reset", episodes.observations)
        episodes.start(0, 1)
        self.assertRaisesRegex(RuntimeError, "observations.. before reset", episodes.observations)
        episodes.start(1, 2)
        self.assertEqual(episodes.observations().shape, (2, 6))

    def test_takes_actions_of_integers_only(self):
        for dtype in (np.int8, np.uint8, np.int32, np.int64, np.uint64):
            episodes = self.make(2)
            for index in range(2):
                episodes.start_at(index, (20_000.0, 20_000.0), (10_000.0, 10_000.0))
            episodes.step(np.array([2, 0], dtype=dtype))  # east, north
            self.assertEqual(episodes.position_m(0), (20_000.0, 21_000.0), dtype)
            self.assertEqual(episodes.position_m(1), (21_000.0, 20_000.0), dtype)
        for actions in ([1.9, 0.0], np.array([True, False]), np.array([1.0, 0.0], np.float32), np.array(["1", "0"])):
            self.assertRaisesRegex(TypeError, "actions: must be whole numbers", episodes.step, np.asarray(actions))
        self.assertRaisesRegex(ValueError, "action -1", episodes.step, np.array([2**64 - 1, 0], np.uint64))


class VectorEnvironment(unittest.TestCase):
    COUNT = 5

    def make(self, **options):
        if gymnasium.__version__.startswith("0."):
            options = {"vectorization_mode": "custom", "vector_kwargs": options}
        env = gymnasium.make_vec(earshot_gym.ID, num_envs=self.COUNT, **options)
        self.addCleanup(env.close)
        return env

    def test_runs_as_so_many_single_ones(self):
        options: earshot_gym.world.WorldOptions = {"state": "memory", "source": "changing"}
        rng = np.random.default_rng(2)
        vector, singles = self.make(**options), [earshot_gym.AcousticSearchEnv(**options) for _ in range(self.COUNT)]
        observations, _ = vector.reset(seed=9)
        np.testing.assert_array_equal(observations, [env.reset(seed=9 + i)[0] for i, env in enumerate(singles)])
        last_key = "final_observation" if gymnasium.__version__.startswith("0.") else "final_obs"
        ended = 0
        for _ in range(400):
            actions = rng.integers(0, 8, self.COUNT)
            observations, rewards, terminated, truncated, info = vector.step(actions)
            for i, env in enumerate(singles):
                observation, reward, over, cut, _ = env.step(actions[i])
                self.assertEqual((rewards[i], terminated[i], truncated[i]), (reward, over, cut))
                if over or cut:
                    ended += 1
                    self.assertTrue(info["_" + last_key][i])
                    np.testing.assert_array_equal(info[last_key][i], observation)
                    observation, _ = env.reset()
                np.testing.assert_array_equal(observations[i], observation)
        self.assertGreater(ended, 20)

    def test_states_its_autoreset_mode(self):
        self.assertIn("same", str(self.make().metadata["autoreset_mode"]).lower())

    def test_has_the_shapes_it_says(self):
        env = self.make(state="memory", remembered_steps=3)
        self.assertEqual(env.observation_space.shape, (self.COUNT, 9))
        observations, _ = env.reset(seed=1)
        self.assertTrue(env.observation_space.contains(observations))
        self.assertTrue(env.action_space.contains(env.action_space.sample()))

    def test_keeps_what_it_gave(self):
        env = self.make(state="simple")
        before, _ = env.reset(seed=1)
        copy = before.copy()
        env.step(np.zeros(self.COUNT, dtype=np.int64))
        np.testing.assert_array_equal(before, copy)

    def test_refuses_bad_input_by_name(self):
        env = self.make()
        self.assertRaisesRegex(RuntimeError, "before reset", env.step, np.zeros(self.COUNT, dtype=np.int64))
        self.assertRaisesRegex(ValueError, "seed", env.reset, seed=[1, 2])
        self.assertRaisesRegex(ValueError, "seed", env.reset, seed=-1)
        env.reset(seed=1)
        self.assertRaisesRegex(ValueError, "one for each", env.step, np.zeros(2, dtype=np.int64))
        self.assertRaisesRegex(ValueError, "action 8", env.step, np.full(self.COUNT, 8))
        self.assertRaisesRegex(ValueError, "^num_envs = 0: must be 1 or more", earshot_gym.AcousticSearchVectorEnv, 0)

    def test_a_refused_action_moves_nobody(self):
        env = self.make()
        env.reset(seed=1)
        self.assertRaises(ValueError, env.step, np.array([0, 0, 0, 0, 99]))
        moved, *_ = env.step(np.zeros(self.COUNT, dtype=np.int64))
        env.reset(seed=1)
        np.testing.assert_array_equal(env.step(np.zeros(self.COUNT, dtype=np.int64))[0], moved)


class Package(unittest.TestCase):
    def test_imports_neither_torch_nor_stable_baselines3(self):
        found = "import earshot_gym, sys; sys.exit('torch' in sys.modules or 'stable_baselines3' in sys.modules)"
        self.assertEqual(subprocess.run([sys.executable, "-c", found], check=False).returncode, 0)

    def test_says_how_to_install_it_where_only_its_source_is(self):
        command, source = [sys.executable, "-S", "-c", "import earshot.core"], ROOT / "policy/python"
        done = subprocess.run(command, cwd=source, capture_output=True, text=True, check=False)
        self.assertIn("pip install ./policy/python", done.stderr)

    def test_runs_the_blocks_of_its_readme_pasted_whole(self):
        blocks = (ROOT / "policy/python/README.md").read_text().split("```python\n")[1:]
        self.assertEqual(len(blocks), 9)
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        (Path(folder.name) / "out").mkdir()
        for name in ("sim", "policy"):
            (Path(folder.name) / name).symlink_to(ROOT / name)
        for command in (
            "fin_song out/song.wav out/song.txt",
            "earshot-field --library sim/field_library/example_library.toml -o out/library.nc",
        ):
            program, *arguments = command.split()
            path = f"{os.environ['EARSHOT_PROGRAMS']}/{program}"
            subprocess.run([path, *arguments], cwd=folder.name, check=True, capture_output=True)
        for block in (text.split("```")[0] for text in blocks if "read_journal" not in text):  # tests/readme has flown
            said = subprocess.run(
                [sys.executable, "-qi"],
                input=block,
                cwd=folder.name,
                env=os.environ | {"MPLBACKEND": "agg"},
                capture_output=True,
                text=True,
                check=True,
            ).stderr
            self.assertEqual(said.replace(">>> ", "").replace("... ", "").strip(), "")

    def test_says_that_it_is_typed(self):
        self.assertTrue((Path(earshot_gym.__file__).parent / "py.typed").exists())


if __name__ == "__main__":
    unittest.main()
