"""Trains and evaluates everything for Figures 2 to 9 of Clark et al. 2022.

Draws the figures, and writes them beside the paper's claims.
"""

import argparse
import json
import subprocess
import sys
import time
from pathlib import Path

import netCDF4
import numpy as np

import claims
import experiments
import figures
import page
from experiments import ENVIRONMENT, ROOT

INTRO = [
    "Clark, Hunter, Isupova and Donnelly, Exploring the use of AI in marine acoustic sensor management, "
    "Proc. Mtgs. Acoust. 47, 070008 (2022): a vehicle searches a 25 km × 25 km domain for a source of 20 Hz "
    "in steps of 1 km, by policies learned with PPO.",
    "Earshot's reading unless a row says otherwise: border b = 1 km, n = 8 directions, start anywhere in the domain, "
    "m = 2 remembered steps, Stable-Baselines3's default settings, sampled actions. {seeds} trainings each; every "
    "number is the median of the {seeds} and, in brackets, their interquartile range; {episodes} evaluation searches "
    "each, from starts that the training did not draw.",
]
SWEEP_NOTE = (
    "One thing changed at a time; source changing, trainings as long as in the paper, seeds 1 to {seeds}: median and "
    "interquartile range of their evaluations' median rewards. A wider or narrower border also changes what a given "
    "path earns, so rows are to be read from left to right: what matters is what memory gains over the simple state "
    "under the same choice."
)


def options():
    parser = argparse.ArgumentParser(prog="policy/reproduce/run", description=__doc__)
    parser.add_argument(
        "--quick", action="store_true", help="tiny trainings, in seconds: shows that everything works, measures nothing"
    )
    parser.add_argument(
        "--keep",
        action="store_true",
        help="go on with what an interrupted run left in --work instead of beginning anew",
    )
    for name, folder, what in [
        ("--out", "policy/reproduce/results", "the pages and figures"),
        ("--work", "build/reproduce", "checkpoints and tables"),
        ("--bin", "build/release/bin", "Earshot's programs"),
    ]:
        parser.add_argument(name, type=Path, default=ROOT / folder, help=f"folder of {what} (%(default)s)")
    parser.add_argument("--jobs", type=int, default=experiments.processors(), help="processors to use (%(default)s)")
    return parser.parse_args()


def snr_at_vehicle(section_file):
    """(range in km, SNR in dB) at the vehicle's depth."""
    with netCDF4.Dataset(section_file) as data:
        row = int(np.argmin(np.abs(np.asarray(data["depth"][:]) - figures.VEHICLE_DEPTH_M)))
        loss_db = np.asarray(data["transmission_loss"][:, row])
        snr_db = float(data["source_level"][...]) - loss_db - float(data["noise_level"][...])
        return np.asarray(data["range"][:]) / 1e3, snr_db


def measure(workshop, settings, seeds, episodes):
    results = {}
    for setting in settings:
        began = time.monotonic()
        results[setting.name] = workshop.results(setting, seeds, episodes)
        reward, seconds = claims.reward(results[setting.name]), time.monotonic() - began
        print(f"{setting.name}: median reward {reward}  [{seconds:.0f} s]", flush=True)
    return results


def measure_sweep(workshop, settings, seeds, episodes, paper):
    """[((what, value), {state: median rewards})], Earshot's reading first."""

    def medians(of_seeds):
        return claims.of_evaluations(of_seeds, "median_reward")

    results = measure(workshop, [setting for _, _, setting in settings], seeds, episodes)
    states = ("simple", "memory", "position_memory")
    rows = {("as above", ""): {state: medians(paper[f"changing_{state}"][:seeds]) for state in states}}
    for what, value, setting in settings:
        rows.setdefault((what, value), {})[setting.state] = medians(results[setting.name])
    return list(rows.items())


def training_panels(paper, longer):
    whole = {name: seeds for name, seeds in longer.items() if not name.startswith("central")}
    central = {name: seeds for name, seeds in longer.items() if name.startswith("central")}
    return [("as long as in the paper", paper), ("longer", whole), ("longer, central starts", central)]


def draw(folder, ocean, paper, longer, sweep):
    def first(runs, name):
        return runs[name][0].paths

    section, map_file, snr = ocean
    best = first(longer, "changing_position_memory_long")
    shortest = min(len(seed.curve) for seed in paper["fixed_simple"])
    drawn = {
        "figure2": figures.environment_and_profile(ENVIRONMENT, section),
        "figure3": figures.snr_and_detection(map_file),
        "figure4": figures.high_and_low_reward(best, snr),
        "figure5": figures.training_reward(training_panels(paper, longer), shortest),
        "figure6": figures.example_paths(first(paper, "fixed_simple"), snr, "fixed source, simple state"),
        "figure7": figures.example_paths(first(longer, "changing_simple_long"), snr, "changing source, simple state"),
        "figure8": figures.example_paths(first(longer, "changing_memory_long"), snr, "changing source, memory state"),
        "figure8b": figures.example_paths(best, snr, "memory and position"),
        "figure9": figures.reward_histograms([("as in the paper", paper), ("longer", longer)]),
        "sweep": figures.sweep([(f"{what} {value}".strip(), states) for (what, value), states in sweep]),
    }
    for name, figure in drawn.items():
        figures.save(figure, folder, name)


def provenance(seconds, steps):
    def output_of(*words):
        done = subprocess.run(words, cwd=ROOT, capture_output=True, text=True, check=False)
        return done.stdout.strip() if done.returncode == 0 else ""

    words = [word for word in sys.argv[1:] if word != "--keep"]
    changed = output_of("git", "status", "--porcelain", "--untracked-files=no", "--", ":!policy/reproduce/results")
    return {
        "command": " ".join(["policy/reproduce/run", *words]),
        "commit": (output_of("git", "rev-parse", "--short=12", "HEAD") or "unknown") + ("-dirty" if changed else ""),
        "rest": f"{steps / 1e6:.1f} million steps of training for Figures 4 to 9; {seconds / 60:.0f} minutes of "
        "commands, as many at a time as there are processors, for these, the sweep and all evaluations, "
        f"on {experiments.processors()} processors",
    }


def write_measurements(folder, made, paper, longer, sweep):
    """Every evaluation of every seed, for whoever wants other statistics."""
    content = {
        "made": made,
        "evaluations": {name: [seed.evaluation for seed in seeds] for name, seeds in {**paper, **longer}.items()},
        "sweep_median_rewards": [{"what": what, "value": value, **states} for (what, value), states in sweep],
    }
    (folder / "measurements.json").write_text(json.dumps(content, indent=1) + "\n")


def main():
    o = options()
    if not o.keep:
        experiments.clear(o.work)
    workshop = experiments.Workshop(o.work.resolve(), o.bin.resolve(), o.jobs)
    seeds, sweep_seeds, episodes = (2, 1, 10) if o.quick else (5, 3, 300)
    settings, longer_settings = experiments.main_settings(o.quick)
    section, map_file = workshop.field()
    paper = measure(workshop, settings, seeds, episodes)
    longer = measure(workshop, longer_settings, seeds, episodes)
    sweep = measure_sweep(workshop, experiments.sweep_settings(o.quick), sweep_seeds, episodes, paper)

    o.out.mkdir(parents=True, exist_ok=True)
    snr = snr_at_vehicle(section)
    draw(o.out, (section, map_file, snr), paper, longer, sweep)
    steps = sum(seed.curve[-1, 2] for seeds in [*paper.values(), *longer.values()] for seed in seeds)
    made = provenance(sum(workshop.seconds), steps)
    rows = claims.ocean_claims(ENVIRONMENT, snr, map_file)
    rows += claims.learning_claims(paper, longer, longer["changing_position_memory_long"][0].paths)
    intro = [paragraph.format(seeds=seeds, episodes=episodes) for paragraph in INTRO]
    note = SWEEP_NOTE.format(seeds=sweep_seeds)
    page.write(o.out, intro, made, [list(row) for row in rows], claims.sweep_table(sweep), note)
    write_measurements(o.out, made, paper, longer, sweep)
    print(f"{o.out}/reproduction.html")


if __name__ == "__main__":
    main()
