"""Writes the page of what the shipped policy finds, from the tables that policy/frozen/measure has written.

usage: policy/frozen/results_page.py FOLDER    writes FOLDER/README.md
"""

from __future__ import annotations

import csv
import sys
from pathlib import Path

Row = dict[str, str]

INTRODUCTION = """# results: what the shipped policy finds
`policy/frozen/measure` made this page (by `policy/frozen/results_page.py`) at commit {commit}. Edit those instead.

| column | meaning |
| --- | --- |
| found | share of the searches, with its exact binomial 95 % interval |
| hours | time to find, in the mean over all searches; one that did not find counts as its limit |
| mismatch | share of the searches whose measurements fitted nothing that was believed possible |
| declared falsely | share in which the vehicle's rule declared the source found further than a step length from it |
| far off | the same, further than one and a half step lengths |
| missed | of those that ended a step within a step length of the source, the share without a declaration there |
"""

WORLDS = """
## The worlds of `policy/worlds`
These are validation worlds: they were used while the policy was made. `sweep` is the blind pattern to which the
vehicle falls back, and `oracle` knows where the source is. `infotaxis` flies {infotaxis} searches in each
world, with the same tables, and the others fly {shipped}.

![found, mean hours to find](worlds.png)
"""

NOTICED = """
## With the paper's table only
This shows how a vehicle notices an ocean that it does not know: its tables hold the paper's ocean alone. It flies
{episodes} searches of 15 steps in each world.
"""

TEST = """
## The test split
These worlds were drawn by `policy/worlds/generate` from seeds of their own, and flown once, after everything was
chosen. `policy/tables/make_for` made tables for each world's frequency and depth; only by chance do they hold the
world's ocean.

All worlds together: {found} of {episodes} searches found, {share:.1f} %, from {low:.1f} in one world to {high:.1f}
in another; `oracle` {oracle:.1f} %. Mismatch: {mismatched:.1f} % of the searches, in the mean over the worlds.

*Own ocean* is the same policy with a table of the world's own ocean alone, at its own level of noise. The ocean is then
known, and all else is not. So it finds {known:.1f} %, and 95 % or more in {known_worlds} of {worlds} worlds
instead of {shipped_worlds}.
"""

BEARING = """
## With a bearing of 10 degrees
The same worlds, with {episodes} searches in each.
"""


def read(path: Path) -> dict[str, dict[str, Row]]:
    """The rows of a table of `earshot evaluate --csv`: by world, by policy."""
    worlds: dict[str, dict[str, Row]] = {}
    with path.open(newline="") as file:
        for row in csv.DictReader(file):
            worlds.setdefault(row["world"], {})[row["policy"]] = row
    return worlds


def percent(share: str) -> str:
    return "-" if share in ("", "nan") else f"{100.0 * float(share):.1f}".removesuffix(".0")


def found(row: Row) -> str:
    share, low, high = (percent(row[f"found_fraction{end}"]) for end in ("", "_low", "_high"))
    return f"{share} % ({low} to {high})"


def hours(row: Row) -> str:
    mean = row["restricted_mean_hours_to_find"]
    low, high = row["restricted_mean_hours_to_find_low"], row["restricted_mean_hours_to_find_high"]
    return f"{float(mean):.2f} ({float(low):.2f} to {float(high):.2f})"


def mismatched(row: Row) -> str:
    return f"{percent(row['surprised_fraction'])} %"


ENOUGH = 95.0  # percent found

DECLARED = ["declared falsely, far off", "missed"]


def declared(row: Row) -> list[str]:
    """Under DECLARED."""
    missed = percent(row["missed_fraction"])
    return [
        f"{percent(row['declared_falsely_fraction'])}, {percent(row['declared_far_off_fraction'])} %",
        missed if missed == "-" else f"{missed} %",
    ]


def table(header: list[str], rows: list[list[str]]) -> str:
    lines = [header, ["---"] * len(header), *rows]
    return "".join("| " + " | ".join(cells) + " |\n" for cells in lines)


def worlds_table(worlds: dict[str, dict[str, Row]], infotaxis: dict[str, dict[str, Row]]) -> str:
    header = ["world", "`shipped`: found", "hours", "reward", "mismatch", *DECLARED]
    header += ["`infotaxis`: found", "hours", "`sweep`: found", "`oracle`: found"]
    rows = []
    for world, of in worlds.items():
        shipped = of["shipped"]
        other = infotaxis[world]["infotaxis"]
        rows.append(
            [f"`{world}`", found(shipped), hours(shipped), f"{float(shipped['mean_reward']):.1f}"]
            + [mismatched(shipped), *declared(shipped)]
            + [found(other), hours(other), f"{percent(of['sweep']['found_fraction'])} %"]
            + [f"{percent(of['oracle']['found_fraction'])} %"]
        )
    return table(header, rows)


def test_table(worlds: dict[str, dict[str, Row]], known: dict[str, dict[str, Row]]) -> str:
    header = ["world", "`shipped`: found", "hours", "reward", "mismatch", *DECLARED]
    header += ["own ocean: found", "`sweep`: found", "`oracle`: found"]
    return table(
        header,
        [
            [f"`{world}`", found(of["shipped"]), hours(of["shipped"]), f"{float(of['shipped']['mean_reward']):.1f}"]
            + [mismatched(of["shipped"]), *declared(of["shipped"])]
            + [f"{percent(row['found_fraction'])} %" for row in (known[world]["shipped"], of["sweep"], of["oracle"])]
            for world, of in worlds.items()
        ],
    )


def bearing_table(worlds: dict[str, dict[str, Row]]) -> str:
    rows = [
        [f"`{world}`", found(of["shipped"]), hours(of["shipped"]), f"{float(of['shipped']['path_over_straight']):.2f}"]
        + declared(of["shipped"])
        for world, of in worlds.items()
    ]
    return table(["world", "found", "hours", "path over straight line", *DECLARED], rows)


def noticed_table(worlds: dict[str, dict[str, Row]]) -> str:
    rows = [[f"`{world}`", mismatched(of["shipped"])] for world, of in worlds.items()]
    return table(["world", "mismatch within 15 steps"], rows)


def episodes(worlds: dict[str, dict[str, Row]], policy: str) -> str:
    return next(iter(worlds.values()))[policy]["episodes"]


def test_words(worlds: dict[str, dict[str, Row]], known: dict[str, dict[str, Row]]) -> str:
    flown = {name: [of[name] for of in worlds.values()] for name in ("shipped", "oracle")}
    shares_known = [100.0 * float(of["shipped"]["found_fraction"]) for of in known.values()]
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
        mismatched=100.0 * sum(float(row["surprised_fraction"]) for row in flown["shipped"]) / len(flown["shipped"]),
        known=sum(shares_known) / len(shares_known),
        known_worlds=sum(share >= ENOUGH for share in shares_known),
        worlds=len(shares),
        shipped_worlds=sum(share >= ENOUGH for share in shares),
    )


def page(folder: Path) -> str:
    worlds, infotaxis = read(folder / "worlds.csv"), read(folder / "infotaxis.csv")
    bearing, test = read(folder / "bearing.csv"), read(folder / "test.csv")
    noticed, known = read(folder / "noticed.csv"), read(folder / "told.csv")
    numbers = {"infotaxis": episodes(infotaxis, "infotaxis"), "shipped": episodes(worlds, "shipped")}
    return "".join(
        [
            INTRODUCTION.format(commit=(folder / "commit").read_text().strip()),
            WORLDS.format(**numbers) + "\n" + worlds_table(worlds, infotaxis),
            NOTICED.format(episodes=episodes(noticed, "shipped")) + "\n" + noticed_table(noticed),
            test_words(test, known) + "\n" + test_table(test, known),
            BEARING.format(episodes=episodes(bearing, "shipped")) + "\n" + bearing_table(bearing),
        ]
    )


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    results = Path(sys.argv[1])
    (results / "README.md").write_text(page(results))
