"""Flights of the real runtime, by the programs that fly them."""

from __future__ import annotations

import functools
import json
import os
import shutil
import signal
import subprocess
import tempfile
import weakref
from pathlib import Path
from typing import TYPE_CHECKING, Any, Union

from earshot.arguments import number, path, text, truth_value, whole_number
from earshot.errors import BadInput, BadType
from earshot.journals import read_journal
from earshot.ocean_tables import Tables
from earshot.oceans import Environment

if TYPE_CHECKING:
    import pandas

__all__ = ["Flight", "FlightLost", "fly"]

Path_ = Union[str, "os.PathLike[str]"]

_BAD_INPUT = 2  # of `earshot fly`: exit status
_PROGRAM = "earshot-fly"


class FlightLost(RuntimeError):
    """A process, the bus or a file was lost in mid-flight; what there is of the flight stays in its folder."""


class Flight:
    """A flight's folder, read when it is asked for.

    folder  pathlib.Path of journal.lcmlog, track.csv, summary.json and the others
    """

    def __init__(self, folder: Path_) -> None:
        self.folder = path("folder", folder)
        if not (self.folder / "summary.json").is_file():
            raise BadInput(
                f"folder = {self.folder}: holds no flight, for it has no summary.json", key="folder", value=folder
            )

    @functools.cached_property
    def summary(self) -> dict[str, Any]:
        """found, reward, steps, end_reason, source, start and the rest of summary.json, in SI units."""
        found = json.loads((self.folder / "summary.json").read_text())
        return dict(found)

    @functools.cached_property
    def track(self) -> pandas.DataFrame:
        """A row each second: time, place, depth, heading, speed, SNR, range to the source, state; names have units."""
        import pandas

        return pandas.read_csv(self.folder / "track.csv")

    @functools.cached_property
    def journal(self) -> dict[str, pandas.DataFrame]:
        """What the vehicle wrote down, as `earshot.read_journal` gives it."""
        return read_journal(self.folder)

    @property
    def decisions(self) -> pandas.DataFrame:
        """A row for each decision: where, what was heard, what was chosen, what was believed."""
        return self.journal["decision"]

    def __repr__(self) -> str:
        found = "found" if self.summary["found"] else "not found"
        return f"<earshot.Flight: {found} after {self.summary['steps']} steps, {self.folder}>"


def _program(programs: Path_ | None) -> str:
    folder = programs if programs is not None else os.environ.get("EARSHOT_PROGRAMS")
    if folder is not None:
        program = path("programs", folder) / _PROGRAM
        if not os.access(program, os.X_OK):
            raise BadInput(f"programs = {folder}: holds no program {_PROGRAM}", key="programs", value=folder)
        return str(program)
    found = shutil.which(_PROGRAM)
    if found is None:
        raise BadInput(
            f"programs: {_PROGRAM} is not on the PATH: install Earshot's packages, or name the folder of its programs"
            " here or in EARSHOT_PROGRAMS",
            key="programs",
        )
    return found


def _path(name: str, value: Any) -> str:
    return os.path.abspath(path(name, value))


def _in_file(name: str, value: Any, folder: Path) -> str:
    """The path of what is given as a path or as an object, which is then written to a file in a folder."""
    if isinstance(value, Environment):
        if isinstance(value._scenario(), Path):
            return str(value._scenario())
        (folder / "given.toml").write_text(value.to_toml(), encoding="utf-8")
        return str(folder / "given.toml")
    return _path(name, value)


def _run(command: list[str], argument_of: dict[str, str]) -> None:
    """Runs the program; `argument_of` has the name of the argument that gave a path."""
    process = subprocess.Popen(
        command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True
    )
    try:
        _, errors = process.communicate()
    except BaseException:  # Ctrl-C: the flight ends in order and keeps its journal
        process.send_signal(signal.SIGINT)
        process.wait()
        raise
    if process.returncode == 0:
        return
    words = "\n".join(line.removeprefix("earshot fly: ") for line in errors.strip().splitlines())
    if process.returncode == _BAD_INPUT:
        path = next((path for path in argument_of if words.startswith(path)), None)
        raise BadInput(words, key=argument_of[path], value=path) if path is not None else BadInput(words)
    raise FlightLost(words or f"{_PROGRAM} ended with status {process.returncode}")


def fly(
    mission: Path_ | None = None,
    *,
    environment: Environment | Path_ | None = None,
    policy: Path_ | None = None,
    public_key: Path_ | None = None,
    tables: Path_ | None = None,
    seed: int = 1,
    source: str = "changing",
    hear: str | None = None,
    battery_percent: float | None = None,
    ignore_source: bool = False,
    lcm_url: str | None = None,
    out: Path_ | None = None,
    programs: Path_ | None = None,
) -> Flight:
    """Flies one search with the real runtime and a simulated ocean, in lock-step: what `earshot fly` does.

    mission          mission file; None: the one that ships
    environment      the ocean, source and noise: an `Environment` or a path; None: the one that ships
    policy           instead of the mission's (.policy); public_key: of whoever signed it
    tables           oceans that the vehicle thinks possible (.tables, signed), instead of the mission's
    seed             another source, another start
    source           "changing": drawn with the seed; "fixed": where the environment has it
    hear             "synthetic", or a file of recorded calls: the vehicle hears sound and measures the SNR itself
    battery_percent  a battery is simulated, which holds so much at first
    ignore_source    fly on to the last step even when the source is found
    lcm_url          the bus; two flights at once need one each
    out              folder of the flight's files; None: one that goes with the returned object
    programs         folder of Earshot's programs; None: EARSHOT_PROGRAMS, or the PATH. The wheel holds none

    Raises BadInput, BadType, and FlightLost where a process or the bus was lost. Ctrl-C ends the flight in order.
    """
    if source not in ("changing", "fixed"):
        raise BadInput(f'source = {source!r}: must be "changing" or "fixed"', key="source", value=source)
    program = _program(programs)
    given = Path(tempfile.mkdtemp(prefix="earshot-flight-"))
    try:
        folder = given / "flight" if out is None else Path(_path("out", out))
        command = [program, "--quiet", "--no-report", "--out", str(folder), "--source", source]
        argument_of = {str(folder): "out"}
        command += ["--seed", str(whole_number("seed", seed))]
        for name, value in (
            ("environment", environment),
            ("mission", mission),
            ("policy", policy),
            ("public_key", public_key),
        ):
            if value is not None:
                path = _in_file(name, value, given)
                argument_of[path] = name
                command += ["--" + name.replace("_", "-"), path]
        if isinstance(tables, Tables):
            raise BadType(
                "tables: must be a path of signed tables, for a vehicle refuses others", key="tables", value=tables
            )
        if tables is not None:
            argument_of[_path("tables", tables)] = "tables"
            command += ["--tables", _path("tables", tables)]
        if hear is not None:
            command += ["--hear", hear if hear == "synthetic" else _path("hear", hear)]
        if battery_percent is not None:
            command += ["--battery-percent", repr(number("battery_percent", battery_percent))]
        if lcm_url is not None:
            command += ["--lcm-url", text("lcm_url", lcm_url)]
        if truth_value("ignore_source", ignore_source):
            command.append("--ignore-source")
        _run(command, argument_of)
        flight = Flight(folder)
    except BaseException:
        shutil.rmtree(given, ignore_errors=True)
        raise
    if out is None:
        weakref.finalize(flight, shutil.rmtree, given, ignore_errors=True)
    else:
        shutil.rmtree(given, ignore_errors=True)
    return flight
