"""The trainings and evaluations behind the figures: what is run, and what comes back."""

import csv
import hashlib
import json
import os
import shutil
import subprocess
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
ENVIRONMENT = ROOT / "sim/ocean/environments/munk_flat.toml"
KEY = "reproduce.key"
MARK = ".made-by-reproduce"
EVALUATION_SEED = 1000  # plus the seed of the training: starts that the training did not draw


@dataclass(frozen=True)
class Setting:
    """One task, one state, one budget. The defaults are Earshot's reading of the paper."""

    name: str
    state: str
    source: str = "changing"
    episodes: int = 0
    steps: int = 0
    start: str = "domain"
    margin_m: float = 0.0  # starts at least so far from every edge; above 0 it takes the place of `start`
    border_m: float = 1000.0
    directions: int = 8
    remembered: int = 2
    ppo: str = ""  # lines of the run file's table of that name

    def run_file(self):
        return (
            f'environment = "{ENVIRONMENT}"\nstate = "{self.state}"\nremembered_steps = {self.remembered}\n'
            f"episodes = {self.episodes}\nsteps = {self.steps}\n"
            f'[search]\nsource = "{self.source}"\n'
            + (f"start_margin_m = {self.margin_m:.1f}\n" if self.margin_m else f'start = "{self.start}"\n')
            + f"border_width_m = {self.border_m:.1f}\ndirections = {self.directions}\n[ppo]\n{self.ppo}"
        )


@dataclass
class Seed:
    """The outcome of one training."""

    curve: np.ndarray  # [episode x (reward, found, steps so far)]
    evaluation: dict  # of earshot evaluate --json
    rewards: np.ndarray  # of the evaluation's episodes
    paths: list  # the evaluation's first episodes, each a dict of arrays


def clear(folder):
    """Removes what an earlier run left. Any other folder that holds something is refused."""
    folder = Path(folder)
    if not folder.is_dir() or not any(folder.iterdir()):
        return
    if not (folder / MARK).exists():
        raise SystemExit(f"{folder}: was not made by an earlier run; empty it, or name another folder")
    shutil.rmtree(folder)


class Workshop:
    """Runs Earshot's programs in one folder.

    A command whose files are there already, made by the same words, is not run again.
    """

    def __init__(self, folder, programs, jobs):
        self.folder, self.programs, self.jobs = Path(folder), Path(programs), jobs
        self.seconds = []  # of each command, those of an earlier run that was kept too
        self.folder.mkdir(parents=True, exist_ok=True)
        (self.folder / MARK).touch()

    def run(self, program, *arguments, makes):
        words = [str(argument) for argument in arguments]
        outputs = [self.folder / name for name in makes]
        stamp = outputs[0].with_name(outputs[0].name + ".command")
        read = [self.folder / word for word in words if word.endswith((".toml", ".checkpoint", ".policy"))]
        inputs = b"".join(file.read_bytes() for file in read if file.is_file())
        text = program + " " + " ".join(words) + " # " + hashlib.sha256(inputs).hexdigest()
        if stamp.exists() and all(o.exists() for o in outputs):
            made_by, _, seconds = stamp.read_text().rpartition("\n")
            if made_by == text:
                self.seconds.append(float(seconds))
                return
        began = time.monotonic()
        command = [str(self.programs / f"earshot-{program}"), *words]
        done = subprocess.run(command, cwd=self.folder, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise SystemExit(f"earshot {program} {' '.join(words)}\n{done.stderr.strip()}")
        seconds = time.monotonic() - began
        stamp.write_text(f"{text}\n{seconds:.1f}")
        self.seconds.append(seconds)

    def field(self):
        """A section out to 50 km, and a map of 100 km x 100 km at the vehicle's depth: two NetCDF files."""
        self.run("field", ENVIRONMENT, "-o", "section.nc", "--max-range-km", 50, "--depth-spacing", 10,
                 "--output-step-m", 50, makes=["section.nc"])  # fmt: skip
        self.run("field", ENVIRONMENT, "-o", "map.nc", "--max-range-km", 71, "--radials", 8, "--receiver-depth-m", 300,
                 "--map", "--map-side-km", 100, "--map-intervals", 400, makes=["map.nc"])  # fmt: skip
        return self.folder / "section.nc", self.folder / "map.nc"

    def results(self, setting, seeds, episodes):
        """One Seed for each of 1..seeds."""
        name = setting.name
        (self.folder / f"{name}.toml").write_text(setting.run_file())
        self.run("train", f"{name}.toml", "--seeds", f"1-{seeds}", "--threads", self.jobs, "-o", f"{name}.checkpoint",
                 makes=[f"{name}.seed{k}.checkpoint" for k in range(1, seeds + 1)])  # fmt: skip
        if not (self.folder / KEY).exists():
            self.run("freeze", "--new-key", "--key", KEY, makes=[KEY])
        with ThreadPoolExecutor(self.jobs) as pool:
            return list(pool.map(lambda k: self.one_seed(setting, k, episodes), range(1, seeds + 1)))

    def one_seed(self, setting, k, episodes):
        stem = f"{setting.name}.seed{k}"
        self.run("freeze", f"{stem}.checkpoint", "-o", f"{stem}.policy", "--draw", "sampled", "--key", KEY,
                 makes=[f"{stem}.policy"])  # fmt: skip
        start = ["--start-margin-m", setting.margin_m] if setting.margin_m else ["--start", setting.start]
        self.run("evaluate", f"{stem}.policy", "--environment", ENVIRONMENT, "--source", setting.source, *start,
                 "--border-width-m", setting.border_m, "--episodes", episodes, "--seed", EVALUATION_SEED + k,
                 "--json", f"{stem}.json", "--paths", f"{stem}.paths.csv",
                 makes=[f"{stem}.json", f"{stem}.paths.csv"])  # fmt: skip
        curve = np.loadtxt(self.folder / f"{stem}.csv", delimiter=",", skiprows=1, ndmin=2)
        evaluation = json.loads((self.folder / f"{stem}.json").read_text())["results"][0]
        paths = read_paths(self.folder / f"{stem}.paths.csv")
        return Seed(curve[:, [2, 3, 1]], evaluation, np.array([p["reward"][-1] for p in paths]), paths)


def read_paths(file):
    """[{east, north, snr, reward, source, state}] of every episode, positions in km."""

    def column(rows, name, unit=1.0):
        return np.array([float(row[name]) for row in rows]) / unit

    episodes: dict[int, list[dict[str, str]]] = {}
    with open(file, newline="") as stream:
        for row in csv.DictReader(stream):
            episodes.setdefault(int(row["episode"]), []).append(row)
    return [
        {
            "east": column(rows, "east_m", 1e3),
            "north": column(rows, "north_m", 1e3),
            "snr": column(rows, "snr_db"),
            "reward": column(rows, "reward_so_far"),
            "source": (float(rows[0]["source_east_m"]) / 1e3, float(rows[0]["source_north_m"]) / 1e3),
            "end": rows[-1]["state"],
        }
        for _, rows in sorted(episodes.items())
    ]


def main_settings(quick):
    """Figures 4 to 9: the three trainings of the paper, the third also in its other reading.

    Returns those that are as long as in the paper, and longer ones.
    """
    episodes = 20 if quick else 1500
    steps = 4096 if quick else 1_000_000
    paper = [
        Setting("fixed_simple", "simple", "fixed", episodes=episodes),
        Setting("changing_simple", "simple", episodes=episodes),
        Setting("changing_memory", "memory", episodes=episodes),
        Setting("changing_position_memory", "position_memory", episodes=episodes),
    ]
    longer = [replace(s, name=s.name + "_long", episodes=0, steps=steps) for s in paper[1:]]
    # The start region, border and batches with which the memory state of the paper gains what the paper says:
    # policy/ppo/runs/changing_*.toml.
    batches = (
        "environments = 8\nsteps_per_rollout = 1024\nbatch_size = 512\n"
        'learning_rate = 1e-3\nlearning_rate_schedule = "linear"\n'
    )
    central: dict[str, Any] = {"margin_m": 7500.0, "border_m": 500.0, "ppo": batches}
    longer += [Setting(f"central_{state}_long", state, steps=2 * steps, **central) for state in ("simple", "memory")]
    return paper, longer


def sweep_settings(quick):
    """What the paper leaves open, one thing changed at a time: [(what, value, Setting)].

    The source changes, and trainings are as long as in the paper.
    """
    varied: list[tuple[str, str, dict[str, Any]]]
    varied = [("border width b", f"{b:g} km", {"border_m": 1000.0 * b}) for b in (0.5, 2.0)]
    varied += [("directions n", str(n), {"directions": n}) for n in (4, 16)]
    varied += [("start", "inside the border", {"start": "inside_border"})]
    varied += [("remembered steps m", str(m), {"remembered": m}) for m in (1, 4)]
    episodes = 20 if quick else 1500
    if quick:
        varied = varied[1:2] + varied[-1:]
    return [
        (what, value, Setting(f"sweep_{what}_{value}_{state}".replace(" ", "_"), state, episodes=episodes, **change))
        for what, value, change in varied
        for state in ("simple", "memory", "position_memory")
        if not (state == "simple" and "remembered" in change)
    ]


def processors():
    return len(os.sched_getaffinity(0))
