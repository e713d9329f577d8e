"""What the paper says, what Earshot measures, and why they differ: rows of text with the numbers of this run."""

import tomllib

import netCDF4
import numpy as np

from figures import RECENT, THRESHOLD_DB, detection_rings, running_median

CONVERGED_REWARD = -3.0


def over_seeds(values, scale=1.0, digits=1, unit=""):
    """'median (lower quartile to upper quartile)' of one value a seed."""
    low, middle, high = scale * np.quantile(values, (0.25, 0.5, 0.75))
    return f"{middle:.{digits}f}{unit} ({low:.{digits}f} to {high:.{digits}f})"


def of_evaluations(seeds, key):
    return [seed.evaluation[key] for seed in seeds]


def gain(more, less, key="median_reward"):
    """Of each seed, how much better the one state did than the other."""
    return np.array(of_evaluations(more, key)) - np.array(of_evaluations(less, key))


def first_episode_at(seed, reward):
    """Where the running median first reaches `reward` and stays there to the end; NaN when it does not."""
    below = np.flatnonzero(running_median(seed.curve[:, 0]) < reward)
    last = below[-1] + 2 if below.size else 1
    return last if last <= len(seed.curve) else np.nan


def found(seeds):
    return over_seeds(of_evaluations(seeds, "found_fraction"), 100.0, 1, " %")


def reward(seeds):
    median, mean = (over_seeds(of_evaluations(seeds, f"{kind}_reward")) for kind in ("median", "mean"))
    return f"{median}, mean {mean}"


def heard(seeds):
    return over_seeds(of_evaluations(seeds, "mean_detections"))


def lengths(trainings):
    """Episodes of each training, median of its seeds."""
    return ", ".join(f"{np.median([len(seed.curve) for seed in seeds]):.0f}" for seeds in trainings)


def millions_of_steps(seeds):
    return f"{seeds[0].curve[-1, 2] / 1e6:.1f} million steps"


def ocean_claims(environment_file, snr_of_range, map_file):
    with open(environment_file, "rb") as stream:
        environment = tomllib.load(stream)
    water = environment["water"]
    eta = 2.0 * (environment["seabed"]["depth_m"] - water["axis_depth_m"]) / water["scale_m"]
    floor_mps = water["axis_sound_speed_mps"] * (1.0 + water["perturbation"] * (eta + np.exp(-eta) - 1.0))
    mud_mps = environment["seabed"]["layers"][0]["sound_speed_mps"]
    with netCDF4.Dataset(map_file) as data:
        share = float(np.mean(np.asarray(data["map_snr"][:]) >= THRESHOLD_DB))
    rings = [f"{a:.1f} to {b:.1f} km" for a, b in detection_rings(snr_of_range) if b - a > 0.3]
    where = ", ".join(rings[:4]) + (" and further out" if len(rings) > 4 else "")
    return [
        ("2", "Munk profile over a flat floor at 3000 m of deep-sea mud, 1505 m/s, which it calls 0.98 of the speed in "
         "the water.",
         f"{floor_mps:.1f} m/s in the water at the floor; the mud's 1505 m/s is {mud_mps / floor_mps:.3f} of it.",
         "The paper's two numbers for the mud contradict each other; the speed is used. It gives neither density nor "
         "attenuation: 1.5 g/cm³ and 0.5 dB a wavelength."),
        ("3", "SNR = SL - TL - N with SL 190 dB, N 90 dB; detection from 10 dB on; a map of 100 km × 100 km.",
         f"Detected in {100 * share:.0f} % of the map: at ranges {where}.",
         "Pictures, not compared number by number. The transmission loss is our own parabolic equation's; where the "
         "SNR grazes 10 dB, rings come and go with the floor's attenuation."),
    ]  # fmt: skip


def learning_claims(paper, longer, paths_of):
    fixed, simple = paper["fixed_simple"], paper["changing_simple"]
    memory, both = paper["changing_memory"], paper["changing_position_memory"]
    simple_long, memory_long, both_long = (
        longer[f"changing_{s}_long"] for s in ("simple", "memory", "position_memory")
    )
    million, late_gain = millions_of_steps(simple_long), gain(both_long, simple_long)
    return [
        high_and_low_claim(paths_of),
        convergence_claim(fixed),
        ("5, 7", "Changing source, simple state: converges within 1500 episodes.",
         f"1500 episodes: median reward {reward(simple)}; found {found(simple)}; detections a search {heard(simple)}. "
         f"{million}: {reward(simple_long)}; found {found(simple_long)}.",
         settled(simple, simple_long) + " A policy that knows only its own position cannot react to a source that it "
         "cannot foresee: it learns to keep away from the edge and to stay where most sources are heard."),
        ("5, 8, 9", "Changing source: the memory state (displacement and SNR of the last m = 2 steps) gains about 20 "
         "points of median reward over the simple state, after 1500 episodes.",
         f"Memory state alone. 1500 episodes: median reward {reward(memory)}, a gain of "
         f"{over_seeds(gain(memory, simple))}; {million}: {reward(memory_long)}, a gain of "
         f"{over_seeds(gain(memory_long, simple_long))}; of that mean, the border's penalty is "
         f"{over_seeds(border_penalties(memory_long))}.",
         "Differs. The memory state as it is written down does not tell the vehicle where the edge is, and an edge "
         "costs 100 a step: most of what is lost is lost there. The next rows choose the start region, and give the "
         "vehicle its position back."),
        central_claim(longer["central_simple_long"], longer["central_memory_long"]),
        ("5, 9", "The same claim, read as memory in addition to the position of the simple state.",
         f"Memory and position. 1500 episodes: median reward {reward(both)}, a gain of "
         f"{over_seeds(gain(both, simple))}; {million}: {reward(both_long)}, a gain of {over_seeds(late_gain)}, "
         f"{int(np.sum(late_gain >= 20))} of {len(both_long)} seeds by 20 or more; found {found(both_long)}.",
         f"{agreement(gain(both, simple), late_gain)} {time_to_gain(both_long, simple_long, 20.0)} "
         f"{million} are {lengths((simple_long, memory_long, both_long))} episodes (simple, memory, memory and "
         "position)."),
        ("9", "Histograms of the reward of 300 evaluation episodes: the memory state earns about 20 points more than "
         "the simple state.",
         "Quartiles of a training's evaluation, longer trainings, median of the seeds: "
         f"simple {quartiles(simple_long)}, memory {quartiles(memory_long)}, memory and position "
         f"{quartiles(both_long)}. Ended beyond the edge: simple {left(simple_long)}, memory {left(memory_long)}, "
         f"memory and position {left(both_long)}.",
         "Hovering within earshot costs nothing under this reward, so a policy that hears the source has no reason to "
         "reach it: high rewards and few sources found go together."),
    ]  # fmt: skip


def high_and_low_claim(paths):
    low, high = np.quantile([path["reward"][-1] for path in paths], (0.05, 0.95))
    return (
        "4", "A path with a high and a path with a low reward.",
        f"Of one evaluation's {len(paths)} searches, the 95th percentile of reward is {high:.0f}, the 5th {low:.0f}.",
        "The paper shows one of each and does not say how they were chosen; here they are chosen by percentile.",
    )  # fmt: skip


def convergence_claim(fixed):
    converged = np.array([first_episode_at(seed, CONVERGED_REWARD) for seed in fixed])
    reached = converged[np.isfinite(converged)]
    episodes = min(len(seed.curve) for seed in fixed)
    return (
        "5, 6", "Fixed source, simple state: converges within 1500 episodes.",
        f"After {over_seeds(reached, digits=0) if reached.size else '-'} episodes the running median stays at "
        f"{CONVERGED_REWARD:.0f} or better, {reached.size} of {len(fixed)} trainings within {episodes}. "
        f"Evaluation: median reward {reward(fixed)}; found {found(fixed)}.",
        "Agrees." if reached.size == len(fixed) else "Differs: not every training converges.",
    )  # fmt: skip


def central_claim(simple, memory):
    """Of trainings that start in the central part."""
    gained = gain(memory, simple)
    return (
        "5", "The same claim, the memory state as written, with what the paper leaves open chosen for it: starts at "
        "least 7.5 km from every edge, b = 0.5 km; for both states 8 environments, rollouts of 1024 steps, batches of "
        "512, a learning rate of 0.001 that falls to zero.",
        f"{millions_of_steps(memory)}: simple state {reward(simple)}; memory state {reward(memory)}, a gain of "
        f"{over_seeds(gained)}, {int(np.sum(gained >= 20))} of {len(gained)} seeds by 20 or more.",
        ("Agrees in size" if np.median(gained) >= 20.0 else "Differs: less is gained") + "; nothing is said of speed, "
        "for it was not trained as briefly as in the paper. The settings were searched for. A memory state hovers "
        "where it hears the source; from there most sources are heard at once, and the edge is far.",
    )  # fmt: skip


def agreement(early, late):
    """Of the gains after as many episodes as in the paper, and after more."""
    if np.median(early) >= 20.0:
        return "Agrees."
    if np.median(late) >= 20.0:
        when = "the gain grows with training, and passes 20 points later than in the paper"
        return f"Agrees in size, not in speed: {when}."
    return "Differs: less is gained."


def settled(brief, longer):
    """Whether training on improved the evaluation by more than the seeds differ."""
    low, middle, high = np.quantile(of_evaluations(brief, "median_reward"), (0.25, 0.5, 0.75))
    later = np.median(of_evaluations(longer, "median_reward"))
    if later <= high + (high - low):
        return "Agrees."
    return f"Differs: longer training still gains {later - middle:.0f} points."


def time_to_gain(more, less, points):
    """When the one state's running median first lies `points` above the median reward of the other's evaluation."""
    targets = np.array(of_evaluations(less, "median_reward")) + points
    medians = [running_median(seed.curve[:, 0])[RECENT:] for seed in more]
    ahead = [np.flatnonzero(median >= target) for median, target in zip(medians, targets, strict=True)]
    firsts = [RECENT + 1 + episodes[0] for episodes in ahead if episodes.size]
    if not firsts:
        return f"It never gains {points:.0f} points in training."
    when = f"after {over_seeds(firsts, digits=0)} episodes, {len(firsts)} of {len(more)} times"
    return f"In training it first gains {points:.0f} points {when}."


def border_penalties(seeds):
    """Mean of a search: its reward without the -1 of every step that heard nothing."""
    return [e["mean_reward"] + e["mean_steps"] - e["mean_detections"] for e in (seed.evaluation for seed in seeds)]


def quartiles(seeds):
    low, high = (np.median(of_evaluations(seeds, f"{side}_quartile_reward")) for side in ("lower", "upper"))
    return f"{low:.0f} to {high:.0f}"


def left(seeds):
    return f"{100 * np.median(of_evaluations(seeds, 'left_domain_fraction')):.0f} %"


def sweep_table(rows):
    """[[what, value, simple, memory, position_memory]] with median and quartiles of the seeds' median rewards."""
    table = []
    for (what, value), states in rows:
        of_states = (states.get(name) for name in ("simple", "memory", "position_memory"))
        cells = [over_seeds(medians, digits=0) if medians is not None else "" for medians in of_states]
        table.append([what, value, *cells])
    return table
