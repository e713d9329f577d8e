"""What the package offers of beliefs, policies and flights, with arguments that are good, to be made worse.

Used as a module by random_calls.
"""

import functools
from typing import Any

import numpy as np
from material import POLICY, TABLES, Material
from random_values import Values
from thing import Thing

import earshot
import earshot.gym
from earshot import core
from earshot.gym.vector import AcousticSearchVectorEnv
from earshot.gym.world import make_world


class OfSearch:
    """Its calls."""

    def __init__(self, given: Material) -> None:
        self.given = given

    def things(self) -> list[Thing]:
        with_progress = functools.partial(Thing, has_progress=True)
        of_gym = functools.partial(Thing, is_gym=True)
        return [
            with_progress("tables", self._tables, earshot.tables, 1.0),
            Thing("Tables.from_file", lambda v: {"path": TABLES}, earshot.Tables.from_file, 0.5),
            Thing("Belief", self._belief, self._believe, 2.0),
            with_progress("evaluate", self._evaluated, earshot.evaluate, 0.5),
            Thing("read_journal", lambda v: {"path": self.given.journal}, earshot.read_journal, 0.5),
            Thing("fly", self._flight, earshot.fly, 0.5, always_given=("programs",)),
            Thing("Flight", lambda v: {"folder": self.given.folder / "flight"}, earshot.Flight, 0.3),
            of_gym("make_world", self._world, make_world, 0.3),
            of_gym("AcousticSearchEnv", self._search, self._play, 2.0),
            of_gym("AcousticSearchVectorEnv", self._searches, self._play_many, 2.0),
            of_gym("FrozenPolicy", self._observations, self._logits, 1.0),
        ]

    def _tables(self, v: Values) -> dict[str, Any]:
        return {
            "environments": v.one_of((self.given.shallow, [self.given.shallow, self.given.toml], self.given.toml)),
            "vehicle_depth": v.number(10.0, 90.0),
            "max_range": v.number(500.0, 2_000.0),
            "range_step": v.number(50.0, 200.0),
            "bearings": int(v.rng.integers(1, 9)),
            "at_most": int(v.rng.integers(1, 9)),
        }

    def _belief(self, v: Values) -> dict[str, Any]:
        heard = {
            "position": (v.number(-9e3, 3e4), v.number(-9e3, 3e4)),
            "snr": v.number(-50.0, 50.0),
            "too_faint": v.chance(0.3),
            "bearing": v.one_of((None, (80.0, 10.0), (80.0, 10.0, 30.0))),
        }
        if v.chance(0.2):
            heard[v.one_of(list(heard))] = v.anything()
        return {
            "tables": TABLES,
            "area": (v.number(5e3, 3e4), v.number(5e3, 3e4)),
            "step_length": v.number(200.0, 2_000.0),
            "directions": int(v.rng.integers(1, 33)),
            "border_width": v.number(0.0, 2_000.0),
            "detection_threshold": v.number(-10.0, 20.0),
            "measurements": (heard, heard),
        }

    def _believe(self, tables: Any = TABLES, measurements: Any = (), **given: Any) -> Any:
        belief = earshot.Belief(tables, **given)
        for heard in measurements if isinstance(measurements, tuple) else ():
            if isinstance(heard, dict):
                belief.update(**heard)
        return belief

    def _evaluated(self, v: Values) -> dict[str, Any]:
        def wild(position: Any, snr: Any, too_faint: Any, step: Any) -> Any:
            return v.anything() if v.chance(0.05) else int(v.rng.integers(8))

        return {
            "policies": v.one_of((wild, "sweep", "oracle", ["sweep", wild], {"mine": wild}, POLICY)),
            "environment": self.given.shallow,
            "n": 1,
            "seed": int(v.rng.integers(99)),
            "source": v.one_of(("changing", "fixed")),
            "start": v.one_of(("domain", "inside_border")),
            "vehicle_depth": 50.0,
            "border_width": v.number(0.0, 2_000.0),
            "max_steps": int(v.rng.integers(1, 20)),
            "declared": v.chance(0.3),
        }

    def _flight(self, v: Values) -> dict[str, Any]:
        """Arguments alone: the folder holds no program."""
        empty = self.given.folder / "empty"
        empty.mkdir(exist_ok=True)
        names = ("mission", "environment", "policy", "public_key", "tables", "hear", "out")
        asked = dict.fromkeys(names, self.given.toml)
        more = {"seed": 1, "source": "fixed", "battery_percent": v.number(0.0, 100.0), "ignore_source": True}
        return asked | more | {"lcm_url": "udpm://", "programs": empty}

    def _world(self, v: Values) -> dict[str, Any]:
        return {
            "environment": self.given.toml,
            "state": v.one_of(("simple", "memory", "position_memory", "belief")),
            "remembered_steps": int(v.rng.integers(1, 5)),
            "source": v.one_of(("fixed", "changing")),
            "start": v.one_of(("domain", "inside_border")),
            "directions": int(v.one_of((4, 8))),
            "vehicle_depth_m": 50.0,
            "border_width_m": 1_000.0,
            "max_steps": 20,
            "listening": "newest",
            "listening_window_s": 0,
        }

    def _search(self, v: Values) -> dict[str, Any]:
        places = {"position_m": (v.number(0.0, 25e3), v.number(0.0, 25e3)), "source_m": (5e3, 5e3)}
        if v.chance(0.3):
            places[v.one_of(list(places))] = v.anything()
        actions = tuple(v.anything() if v.chance(0.03) else int(v.rng.integers(8)) for _ in range(6))
        mode = v.one_of((None, "ansi", "rgb_array"))
        options = v.one_of((None, places))
        return {"render_mode": mode, "seed": int(v.rng.integers(99)), "options": options, "actions": actions}

    def _play(self, render_mode: Any = None, seed: Any = None, options: Any = None, actions: Any = ()) -> Any:
        env = earshot.gym.AcousticSearchEnv(render_mode=render_mode, environment=self.given.toml, vehicle_depth_m=50.0)
        seen: list[Any] = [env.reset(seed=seed, options=options)]
        for action in actions:
            seen.append(env.step(action))
        return seen, env.render()

    def _searches(self, v: Values) -> dict[str, Any]:
        count = int(v.rng.integers(1, 5))
        actions = tuple(v.rng.integers(0, 8, count) for _ in range(4))
        seeds = v.one_of((None, 5, [1] * count))
        return {"num_envs": count, "seed": seeds, "options": v.one_of((None, {})), "actions": actions}

    def _play_many(self, num_envs: Any = 1, seed: Any = None, options: Any = None, actions: Any = ()) -> Any:
        env = AcousticSearchVectorEnv(num_envs, environment=self.given.toml, state="memory", vehicle_depth_m=50.0)
        seen: list[Any] = [env.reset(seed=seed, options=options)]
        for each in actions:
            seen.append(env.step(each))
        return seen, env.world.snr_db(np.abs(seen[0][0]))

    def _observations(self, v: Values) -> dict[str, Any]:
        return {"file": POLICY, "observations": v.rng.normal(0.0, 1.0, (3, 58)), "ranges": v.rng.uniform(0.0, 1e5, 4)}

    def _logits(self, file: Any = POLICY, observations: Any = None, ranges: Any = None) -> Any:
        policy = core.FrozenPolicy(file)
        world = make_world(environment=self.given.toml, vehicle_depth_m=50.0)
        return policy.logits(observations), policy.provenance, world.snr_db(ranges)
