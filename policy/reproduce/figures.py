"""The paper's figures, drawn from Earshot's files. Every function takes data and returns a matplotlib figure."""

import io
import tomllib

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import netCDF4
import numpy as np
from matplotlib.colors import BoundaryNorm, LinearSegmentedColormap, ListedColormap, Normalize
from matplotlib.patches import Rectangle
from PIL import Image

SIDE_KM = 25.0
SOURCE_KM = (10.0, 10.0)
VEHICLE_DEPTH_M = 300.0
THRESHOLD_DB = 10.0
RECENT = 50  # episodes: the paper's running median
LABELS = {
    "fixed_simple": "fixed source, simple state",
    "changing_simple": "changing source, simple state",
    "changing_memory": "changing source, memory state",
    "changing_position_memory": "changing source, memory and position",
}
COLOURS = {
    "fixed_simple": "#1b6ca8",
    "changing_simple": "#d1495b",
    "changing_memory": "#2a9d6f",
    "changing_position_memory": "#8a5aa8",
}
# Told apart without colours too: on paper, and by one in twelve men.
DASHES = {
    "fixed_simple": "-",
    "changing_simple": (0, (6, 1.5)),
    "changing_memory": "-",
    "changing_position_memory": (0, (2, 1)),
}
MARKERS = {"fixed_simple": "s", "changing_simple": "o", "changing_memory": "^", "changing_position_memory": "D"}
MARKS = 8  # along a curve
PATH_DASHES = ["-", (0, (5, 1.5)), (0, (2, 1)), (0, (6, 1.5, 1.5, 1.5))]
# The scale of every map and field of Earshot (sim/plot/snr_scale.cpp): dB above 20 below the threshold, and colour.
SNR_COLOURS = [(0, "#081d58"), (20, "#bdd7e7"), (20, "#fff3b0"), (50, "#a63603")]
PATH_COLOURS = ["#1b6ca8", "#e08a1e", "#2a9d6f", "#b03a6f"]

plt.rcParams.update({
    "font.family": "sans-serif", "font.size": 9.5, "axes.titlesize": 10, "axes.titleweight": "bold",
    "axes.titlelocation": "left", "axes.spines.top": False, "axes.spines.right": False, "axes.linewidth": 0.8,
    "legend.frameon": False, "figure.dpi": 130, "savefig.dpi": 130, "figure.constrained_layout.use": True,
})  # fmt: skip


def environment_and_profile(environment_file, section_file):
    """Figure 2."""
    with open(environment_file, "rb") as stream:
        environment = tomllib.load(stream)
    water, sea_floor_m = environment["water"], environment["seabed"]["depth_m"]
    mud_mps = environment["seabed"]["layers"][0]["sound_speed_mps"]
    depth_m = np.linspace(0.0, sea_floor_m, 301)
    eta = 2.0 * (depth_m - water["axis_depth_m"]) / water["scale_m"]
    speed_mps = water["axis_sound_speed_mps"] * (1.0 + water["perturbation"] * (eta + np.exp(-eta) - 1.0))

    figure, (left, right) = plt.subplots(1, 2, figsize=(9.6, 3.7), sharey=True, width_ratios=(1, 3.2))
    left.plot(speed_mps, depth_m / 1e3, color="#1b6ca8", lw=1.8)
    left.plot([mud_mps, mud_mps], [sea_floor_m / 1e3, 3.3], color="#7a5c3e", lw=1.8)
    left.annotate(f"axis: {water['axis_sound_speed_mps']:.0f} m/s\nat {water['axis_depth_m']:.0f} m",
                  (water["axis_sound_speed_mps"], water["axis_depth_m"] / 1e3), (1512, 1.15), fontsize=8.5)  # fmt: skip
    left.annotate(f"mud: {mud_mps:.0f} m/s", (mud_mps + 3, 3.2), fontsize=8.5)
    left.axhspan(sea_floor_m / 1e3, 3.3, color="#c9b18f", lw=0)
    left.set(xlabel="sound speed, m/s", ylabel="depth, km", title="a  Munk profile", ylim=(3.3, 0))

    with netCDF4.Dataset(section_file) as data:
        range_km = np.asarray(data["range"][:]) / 1e3
        receiver_km = np.asarray(data["depth"][:]) / 1e3
        loss_db = np.asarray(data["transmission_loss"][:])
    norm = BoundaryNorm(np.arange(60, 121, 5), 256, extend="both")
    mesh = right.pcolormesh(range_km, receiver_km, loss_db.T, cmap="viridis_r", norm=norm, shading="nearest",
                            rasterized=True)  # fmt: skip
    right.axhspan(sea_floor_m / 1e3, 3.3, color="#c9b18f", lw=0)
    source_km = environment["source"]["depth_m"] / 1e3
    right.plot(0.4, source_km, marker="*", ms=13, color="#ffcf33", mec="k", mew=0.7, clip_on=False)
    right.axhline(VEHICLE_DEPTH_M / 1e3, color="w", lw=1, ls="--")
    right.annotate("vehicle, 300 m", (49, 0.40), color="w", fontsize=8.5, ha="right", va="top")
    right.set(xlabel="range, km", title="b  transmission loss at 20 Hz, source at 30 m", xlim=(0, 50))
    figure.colorbar(mesh, ax=right, label="dB re 1 m", pad=0.015)
    return figure


def snr_and_detection(map_file):
    """Figure 3."""
    with netCDF4.Dataset(map_file) as data:
        east_km, north_km = np.asarray(data["east"][:]) / 1e3, np.asarray(data["north"][:]) / 1e3
        snr_db = np.asarray(data["map_snr"][:])
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.6, 4.1), sharey=True)
    widest_db = SNR_COLOURS[-1][0]
    colours = LinearSegmentedColormap.from_list("snr", [(db / widest_db, colour) for db, colour in SNR_COLOURS], N=500)
    norm = Normalize(THRESHOLD_DB - 20, THRESHOLD_DB - 20 + widest_db)  # the colours part at the threshold
    mesh = left.pcolormesh(east_km, north_km, snr_db, cmap=colours, norm=norm, shading="nearest", rasterized=True)
    figure.colorbar(mesh, ax=left, label="SNR, dB", pad=0.015, extend="both")
    left.set(title="a  SNR at 300 m", ylabel="north, km")
    cmap = ListedColormap(["#e9eef2", "#1b6ca8"])
    right.pcolormesh(east_km, north_km, snr_db >= THRESHOLD_DB, cmap=cmap, shading="nearest", rasterized=True)
    right.set(title=f"b  detected: SNR of {THRESHOLD_DB:.0f} dB or more (blue)")
    for axes in (left, right):
        star(axes, SOURCE_KM)
        axes.add_patch(Rectangle((0, 0), SIDE_KM, SIDE_KM, fill=False, ec="k", lw=1.2))
        axes.set(aspect="equal", xlabel="east, km")
    right.annotate("search domain", (SIDE_KM / 2, SIDE_KM + 0.6), ha="center", va="bottom", fontsize=8.5)
    return figure


def detection_rings(snr_of_range):
    """[(inner, outer)] in km where the source is heard. @param snr_of_range  (range in km, SNR in dB)"""
    range_km, snr_db = snr_of_range
    heard = np.concatenate([[False], snr_db >= THRESHOLD_DB, [False]])
    edges = np.flatnonzero(np.diff(heard.astype(int)))
    return [(range_km[a], range_km[b - 1]) for a, b in zip(edges[::2], edges[1::2], strict=True)]


def shade_detections(axes, snr_of_range, centre, extent):
    """Pale blue where the source is heard."""
    east, north = np.meshgrid(np.linspace(*extent[:2], 600), np.linspace(*extent[2:], 600))
    distance = np.hypot(east - centre[0], north - centre[1])
    heard = np.interp(distance, *snr_of_range) >= THRESHOLD_DB
    blue = ListedColormap(["#d6e6f2"])
    axes.imshow(np.where(heard, 1.0, np.nan), extent=extent, origin="lower", cmap=blue, zorder=0, aspect="auto")


def domain(axes, border_km=1.0):
    axes.add_patch(Rectangle((0, 0), SIDE_KM, SIDE_KM, fill=False, ec="k", lw=1))
    inner_km = SIDE_KM - 2 * border_km
    axes.add_patch(Rectangle((border_km, border_km), inner_km, inner_km, fill=False, ec="0.5", lw=0.7, ls=":"))
    seen_km = (-1.5, SIDE_KM + 1.5)
    axes.set(xlim=seen_km, ylim=seen_km, aspect="equal", xlabel="east, km", ylabel="north, km")


def draw_path(axes, path, colour, origin=(0.0, 0.0), label=None, dashes="-"):
    east, north = path["east"] - origin[0], path["north"] - origin[1]
    axes.plot(east, north, color=colour, lw=1.3, ls=dashes, label=label, zorder=3)
    axes.plot(east[0], north[0], "o", color=colour, ms=5.5, mec="w", mew=0.7, zorder=4)
    end = "s" if path["end"] == "found" else "X"
    axes.plot(east[-1], north[-1], end, color=colour, ms=6, mec="w", mew=0.7, zorder=4)


def star(axes, place, colour="#ffcf33"):
    axes.plot(*place, marker="*", ms=13, color=colour, mec="k", mew=0.7, zorder=5, ls="none")


def high_and_low_reward(paths, snr_of_range):
    """Figure 4: of the evaluation's searches, the one at the 95th and the one at the 5th percentile of reward."""
    ordered = sorted(paths, key=lambda path: path["reward"][-1])
    chosen = [ordered[int(0.95 * (len(ordered) - 1))], ordered[int(0.05 * (len(ordered) - 1))]]
    figure, panels = plt.subplots(1, 2, figsize=(9.0, 4.5))
    for axes, path, letter, name in zip(panels, chosen, "ab", ("high", "low"), strict=True):
        domain(axes)
        shade_detections(axes, snr_of_range, path["source"], (0, SIDE_KM, 0, SIDE_KM))
        draw_path(axes, path, "#1b6ca8" if name == "high" else "#d1495b")
        star(axes, path["source"])
        axes.set_title(f"{letter}  {name} reward: {path['reward'][-1]:.0f} in {len(path['east']) - 1} steps")
    return figure


def example_paths(paths, snr_of_range, title):
    """Figures 6 to 8: the evaluation's first four searches, as they are and with the source at the origin."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.0, 4.2))
    domain(left)
    left.set_title(f"a  {title}")
    extent = (-SIDE_KM, SIDE_KM, -SIDE_KM, SIDE_KM)
    shade_detections(right, snr_of_range, (0, 0), extent)
    fixed = len({path["source"] for path in paths[:4]}) == 1
    for path, colour, dashes in zip(paths[:4], PATH_COLOURS, PATH_DASHES, strict=False):
        draw_path(left, path, colour, dashes=dashes)
        star(left, path["source"], "#ffcf33" if fixed else colour)
        draw_path(right, path, colour, path["source"], f"{path['reward'][-1]:.0f}", dashes)
    star(right, (0, 0))
    right.legend(title="reward", loc="upper left", bbox_to_anchor=(1.0, 1.0), handlelength=2.4)
    right.set(xlim=extent[:2], ylim=extent[2:], aspect="equal", title="b  relative to the source",
              xlabel="east of the source, km", ylabel="north of the source, km")  # fmt: skip
    return figure


def running_median(rewards, window=RECENT):
    """Of each episode and those before it, at most `window`."""
    whole = np.lib.stride_tricks.sliding_window_view(rewards, min(window, rewards.size))
    start = [np.median(rewards[: i + 1]) for i in range(min(window, rewards.size) - 1)]
    return np.concatenate([start, np.median(whole, axis=1)])


def curve_over_seeds(seeds, episodes=None):
    """(episode, median over the seeds, lower and upper quartile) of the running medians, as far as all seeds reach."""
    length = min([len(s.curve) for s in seeds] + ([episodes] if episodes else []))
    curves = np.array([running_median(s.curve[:length, 0]) for s in seeds])
    return np.arange(1, length + 1), *np.quantile(curves, (0.5, 0.25, 0.75), axis=0)


def training_reward(panels, episodes):
    """Figure 5. @param panels  [(title, {name: seeds})], the first drawn as far as `episodes`"""
    figure, row = plt.subplots(1, len(panels), figsize=(9.6, 3.9), sharey=True)
    for axes, letter, (title, runs) in zip(row, "abc", panels, strict=False):
        for name, seeds in runs.items():
            kind = name.removesuffix("_long").replace("central", "changing")
            x, middle, low, high = curve_over_seeds(seeds, episodes if letter == "a" else None)
            thin = slice(None, None, max(1, x.size // 300))
            axes.fill_between(x[thin], low[thin], high[thin], color=COLOURS[kind], alpha=0.2, lw=0)
            axes.plot(x[thin], middle[thin], color=COLOURS[kind], lw=1.3, ls=DASHES[kind], marker=MARKERS[kind], ms=5,
                      mec="w", mew=0.6, markevery=max(1, x[thin].size // MARKS), label=LABELS[kind])  # fmt: skip
        axes.set(xlabel="episode", xlim=(0, None), ylim=(-200, 3), title=f"{letter}  {title}")
        axes.grid(axis="y", color="0.9", lw=0.7)
    row[0].set_ylabel(f"reward, median of the last {RECENT} episodes")
    figure.legend(*row[0].get_legend_handles_labels(), fontsize=8.5, loc="lower center", ncols=4)
    figure.get_layout_engine().set(rect=(0, 0.07, 1, 0.93))
    return figure


def reward_histograms(columns):
    """Figure 9. @param columns  [(heading, {name: seeds})]"""
    kinds = list(LABELS)
    shape = len(kinds), len(columns)
    figure, panels = plt.subplots(*shape, figsize=(9.6, 7.2), sharex=True, sharey="row", squeeze=False)
    bins = np.arange(-200, 5, 5)
    for column, (heading, named) in enumerate(columns):
        # Starts in the central part are another task: their names are in no row.
        runs = {name.removesuffix("_long"): seeds for name, seeds in named.items()}
        for axes, kind in zip(panels[:, column], kinds, strict=True):
            if kind not in runs:
                axes.set_axis_off()
                continue
            rewards = np.concatenate([s.rewards for s in runs[kind]])
            median = np.median(rewards)
            percent = np.full(rewards.size, 100.0 / rewards.size)
            axes.hist(np.clip(rewards, -197, None), bins, weights=percent, color=COLOURS[kind])
            axes.axvline(median, color="k", lw=1, ls="--")
            # Where the bars leave room.
            beside, side = (4, "left") if median < -120 else (-4 if median < -20 else -14, "right")
            axes.annotate(f"median {median:.0f}", (median, 0.93), xycoords=("data", "axes fraction"),
                          xytext=(beside, 0), textcoords="offset points", ha=side, va="top", fontsize=8.5)  # fmt: skip
            axes.set_title(f"{LABELS[kind]}, {heading}", fontsize=8.5)
        panels[-1, column].set_xlabel("reward of a search (all below -195 in the first bar)")
    for axes in panels[:, 0]:
        axes.set_ylabel("searches, %")
    return figure


def sweep(rows):
    """What the paper leaves open.

    @param rows  [(label, {state: [median reward of each seed]})], the first the reference
    """
    figure, axes = plt.subplots(figsize=(9.0, 0.42 * len(rows) + 1.2))
    shifts = {"simple": -0.2, "memory": 0.0, "position_memory": 0.2}
    for y, (_, states) in enumerate(rows):
        for state, medians in states.items():
            kind, place = "changing_" + state, y + shifts[state]
            colour, label = COLOURS[kind], LABELS[kind] if y == 0 else None
            axes.plot([min(medians), max(medians)], [place] * 2, color=colour, lw=1, alpha=0.5)
            axes.plot(medians, [place] * len(medians), "|", color=colour, ms=5, alpha=0.7)
            axes.plot(np.median(medians), place, MARKERS[kind], color=colour, ms=6, label=label)
    axes.set(yticks=range(len(rows)), yticklabels=[label for label, _ in rows])
    axes.set_xlabel("median reward of a training's evaluation; stroke: one seed; symbol: their median")
    axes.invert_yaxis()
    axes.grid(axis="both", color="0.92", lw=0.7)
    axes.legend(fontsize=8.5, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=3)
    return figure


def save(figure, folder, name):
    """Writes NAME.png: a third of the bytes of the same figure as SVG, and the same letters in every viewer."""
    picture = io.BytesIO()
    figure.savefig(picture, format="png")
    Image.open(picture).convert("RGB").quantize(256).save(folder / f"{name}.png", optimize=True)
    plt.close(figure)
