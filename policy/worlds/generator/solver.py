"""Asks Earshot's programs whether they take what was drawn."""

from __future__ import annotations

import json
import subprocess
import tempfile
from pathlib import Path

from refusal import Refusal

SEARCHES = 20  # of the oracle, straight to the source
LEAST_HEARD = 0.02  # share of its steps


def complaint_of(command: list[str]) -> str | None:
    """What a program says when it refuses; None when it does not."""
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=False)
    except FileNotFoundError:
        raise Refusal(
            f"{command[0]}: no such program; build it as the README of the tree shows, or name its folder with --bin"
        ) from None
    except OSError as error:
        raise Refusal(f"{command[0]}: {error.strerror}") from None
    if done.returncode == 0:
        return None
    if done.returncode < 0:
        raise SystemExit(f"policy/worlds/generate: {command[0]} was ended by signal {-done.returncode}")
    return (done.stderr.strip().splitlines() or [f"ended with {done.returncode} and no word"])[-1]


def refuses_world(programs: str, world: Path) -> str | None:
    """Why nobody could search in a world file; None when one could.

    A program refuses it, or the source is not heard on the way to it.
    """
    with tempfile.TemporaryDirectory() as folder:
        figures = Path(folder) / "oracle.json"
        command = [f"{programs}earshot-evaluate", "--policies", "oracle", "--episodes", str(SEARCHES), "--quiet"]
        complaint = complaint_of([*command, "--world", str(world), "--json", str(figures)])
        if complaint:
            return complaint
        row = json.loads(figures.read_text())["results"][0]
    heard = row["mean_detections"] / row["mean_steps"]
    return (
        None
        if heard >= LEAST_HEARD
        else f"the source is heard at {100 * heard:.1f} % of an oracle's steps, at least {100 * LEAST_HEARD:.0f} %"
    )


def refuses_environment(programs: str, environment: Path, vehicle_depth_m: float) -> str | None:
    """Why no table can be made of an environment file; None when one can."""
    with tempfile.TemporaryDirectory() as folder:
        command = [
            f"{programs}earshot-field",
            str(environment),
            "-o",
            f"{folder}/field.nc",
            "--quiet",
            "--max-range-km",
            "36.5",
        ]
        return complaint_of([*command, "--receiver-depth-m", str(vehicle_depth_m)])
