"""Writes the page of what the shipped policy finds, from the tables that policy/frozen/measure has written.

usage: policy/frozen/results_page.py FOLDER    writes FOLDER/README.md
"""

from __future__ import annotations

import csv
import sys
from pathlib import Path

Row = dict[str, str]

INTRODUCTION = """# results: what the shipped policy finds
Written by `policy/frozen/measure` (`policy/frozen/results_page.py`), at commit {commit}; edit those. Found: share of
the searches, with its exact binomial 95 % interval. Hours: to find, in
the mean over all searches, one that did not find counts as its limit. Surprised: share of the searches in which what
was heard fitted nothing that was believed possible. Declared falsely: share of the searches in which
the rule on board said "found" further than a step length from the source; far off: further than one and a half.
"""

WORLDS = """
## The worlds of `policy/worlds`
Validation: they were looked at while the policy was made. `sweep` is the blind pattern that the vehicle falls back
to, `oracle` is told where the source is, `infotaxis` flies {infotaxis} searches in each
world, with the same tables, the others {shipped}.

![found, mean hours to find](worlds.png)
"""

TEST = """
## The test split
Drawn by `policy/worlds/generate` from seeds of its own, flown once, after everything was chosen. Tables were made
for each world's frequency and depth by `policy/tables/make_for`; none has the world's ocean in it but by chance.
All worlds together: {found} of {episodes} searches found, {share:.1f} %, from {low:.1f} in one world to {high:.1f}
in another; `oracle` {oracle:.1f} %.
"""

BEARING = """
## With a bearing of 10 degrees
The same worlds, {episodes} searches in each.
"""


def read(path: Path) -> dict[str, dict[str, Row]]:
    """The rows of a table of `earshot evaluate --csv`: by world, by policy."""
    worlds: dict[str, dict[str, Row]] = {}
    with path.open(newline="") as file:
        for row in csv.DictReader(file):
            worlds.setdefault(row["world"], {})[row["policy"]] = row
    return worlds


def percent(share: str) -> str:
    return "-" if share == "" else f"{100.0 * float(share):.1f}".removesuffix(".0")


def found(row: Row) -> str:
    share, low, high = (percent(row[f"found_fraction{end}"]) for end in ("", "_low", "_high"))
    return f"{share} % ({low} to {high})"


def hours(row: Row) -> str:
    mean = row["restricted_mean_hours_to_find"]
    low, high = row["restricted_mean_hours_to_find_low"], row["restricted_mean_hours_to_find_high"]
    return f"{float(mean):.2f} ({float(low):.2f} to {float(high):.2f})"


def table(header: list[str], rows: list[list[str]]) -> str:
    lines = [header, ["---"] * len(header), *rows]
    return "".join("| " + " | ".join(cells) + " |\n" for cells in lines)


def worlds_table(worlds: dict[str, dict[str, Row]], infotaxis: dict[str, dict[str, Row]]) -> str:
    header = ["world", "`shipped`: found", "hours", "reward", "surprised", "declared falsely, far off"]
    header += ["`infotaxis`: found", "hours", "`sweep`: found", "`oracle`: found"]
    rows = []
    for world, of in worlds.items():
        shipped = of["shipped"]
        other = infotaxis[world]["infotaxis"]
        rows.append(
            [f"`{world}`", found(shipped), hours(shipped), f"{float(shipped['mean_reward']):.1f}"]
            + [f"{percent(shipped['surprised_fraction'])} %"]
            + [f"{percent(shipped['declared_falsely_fraction'])}, {percent(shipped['declared_far_off_fraction'])} %"]
            + [found(other), hours(other), f"{percent(of['sweep']['found_fraction'])} %"]
            + [f"{percent(of['oracle']['found_fraction'])} %"]
        )
    return table(header, rows)


def test_table(worlds: dict[str, dict[str, Row]]) -> str:
    header = ["world", "`shipped`: found", "hours", "reward", "surprised", "`sweep`: found", "`oracle`: found"]
    return table(
        header,
        [
            [f"`{world}`", found(of["shipped"]), hours(of["shipped"]), f"{float(of['shipped']['mean_reward']):.1f}"]
            + [f"{percent(of['shipped']['surprised_fraction'])} %"]
            + [f"{percent(of[name]['found_fraction'])} %" for name in ("sweep", "oracle")]
            for world, of in worlds.items()
        ],
    )


def bearing_table(worlds: dict[str, dict[str, Row]]) -> str:
    rows = [
        [f"`{world}`", found(of["shipped"]), hours(of["shipped"]), f"{float(of['shipped']['path_over_straight']):.2f}"]
        for world, of in worlds.items()
    ]
    return table(["world", "found", "hours", "path over straight line"], rows)


def episodes(worlds: dict[str, dict[str, Row]], policy: str) -> str:
    return next(iter(worlds.values()))[policy]["episodes"]


def test_words(worlds: dict[str, dict[str, Row]]) -> str:
    flown = {name: [of[name] for of in worlds.values()] for name in ("shipped", "oracle")}
    total = sum(int(row["episodes"]) for row in flown["shipped"])
    hits = {n: sum(round(float(r["found_fraction"]) * int(r["episodes"])) for r in rows) for n, rows in flown.items()}
    shares = [100.0 * float(row["found_fraction"]) for row in flown["shipped"]]
    return TEST.format(
        found=hits["shipped"],
        episodes=total,
        share=100.0 * hits["shipped"] / total,
        low=min(shares),
        high=max(shares),
        oracle=100.0 * hits["oracle"] / total,
    )


def page(folder: Path) -> str:
    worlds, infotaxis = read(folder / "worlds.csv"), read(folder / "infotaxis.csv")
    bearing, test = read(folder / "bearing.csv"), read(folder / "test.csv")
    numbers = {"infotaxis": episodes(infotaxis, "infotaxis"), "shipped": episodes(worlds, "shipped")}
    return "".join(
        [
            INTRODUCTION.format(commit=(folder / "commit").read_text().strip()),
            WORLDS.format(**numbers) + "\n" + worlds_table(worlds, infotaxis),
            test_words(test) + "\n" + test_table(test),
            BEARING.format(episodes=episodes(bearing, "shipped")) + "\n" + bearing_table(bearing),
        ]
    )


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    results = Path(sys.argv[1])
    (results / "README.md").write_text(page(results))
