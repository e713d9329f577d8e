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
    """A process, the bus or a file was lost in mid-flight; what there is of the flight stays in the folder named."""


class Flight:
    """A flight's folder, read when it is asked for.

    folder  pathlib.Path of journal.lcmlog, track.csv, summary.json and the others

    Where `earshot.fly` was given no folder, this one goes with the object, in the process that flew. Such a flight
    cannot be pickled.
    """

    _is_temporary = False

    def __init__(self, folder: Path_) -> None:
        self.folder = path("folder", folder)
        if not (self.folder / "summary.json").is_file():
            raise BadInput(
                f"folder = {self.folder}: holds no flight, for it has no summary.json", key="folder", value=folder
            )

    @functools.cached_property
    def summary(self) -> dict[str, Any]:
        """found, reward, steps, end_reason, source, start and the rest of summary.json, in SI units."""
        file = self.folder / "summary.json"
        try:
            found = json.loads(file.read_text(encoding="utf-8"))
        except (OSError, ValueError) as wrong:
            raise BadInput(f"folder = {self.folder}: {file} cannot be read: {wrong}", key="folder") from None
        if not isinstance(found, dict) or not {"found", "steps"} <= found.keys():
            raise BadInput(f"folder = {self.folder}: {file} is no summary of a flight", key="folder")
        return found

    @functools.cached_property
    def track(self) -> pandas.DataFrame:
        """A row each second: time, place, depth, heading, speed, SNR, range to the source, state. Names have units."""
        import pandas

        file = self.folder / "track.csv"
        if not file.is_file():
            raise BadInput(f"folder = {self.folder}: has no track.csv", key="folder")
        return pandas.read_csv(file)

    @functools.cached_property
    def journal(self) -> dict[str, pandas.DataFrame]:
        """What the vehicle wrote down, as `earshot.read_journal` gives it."""
        return read_journal(self.folder)

    @property
    def decisions(self) -> pandas.DataFrame:
        """A row for each decision: where, what was heard, what was chosen, what was believed."""
        return self.journal["decision"]

    def __repr__(self) -> str:
        return f"<earshot.Flight {self.folder}>"

    def __reduce__(self) -> tuple[Any, ...]:
        if self._is_temporary:
            raise BadInput(
                "out: must be given to a flight that is to be pickled, for its folder goes with it", key="out"
            )
        return Flight, (self.folder,)


def _remove(folder: Path, process: int) -> None:
    """A child process has the object, too, and must leave the folder to its parent."""
    if os.getpid() == process:
        shutil.rmtree(folder, ignore_errors=True)


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
        (folder / "given.toml").write_text(value._text_of_file(name), encoding="utf-8")
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
        if ": no such option" in words:  # all options are this module's
            raise BadInput(
                f"programs: {command[0]} is of another version than this package ({words}): install both of one",
                key="programs",
                value=command[0],
            )
        for file, argument in argument_of.items():
            if words.startswith(file):
                raise BadInput(words, key=argument, value=file)
        raise BadInput(words)
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
    lcm_url          the bus; the default is the mission's
    out              folder of the flight's files, in place of those of an earlier flight; None: one that goes with the
                     returned object
    programs         folder of Earshot's programs; None: EARSHOT_PROGRAMS, or the PATH. The wheel holds none. They must
                     be of this package's version

    Returns a `Flight`: its `summary`, `track`, `decisions` and `journal`, and the `folder` of its files.

    Raises BadInput, BadType, and FlightLost where a process or the bus was lost. Ctrl-C ends the flight in order, and
    its journal stays; so does the end of Python, also where it is killed.
    """
    if text("source", source) not in ("changing", "fixed"):
        raise BadInput(f'source = {source!r}: must be "changing" or "fixed"', key="source", value=source)
    if isinstance(tables, Tables):
        raise BadType(
            "tables: must be a path of signed tables, for a vehicle refuses others", key="tables", value=tables
        )
    options = ["--seed", str(whole_number("seed", seed)), "--source", source]
    argument_of: dict[str, str] = {}

    def add(name: str, value: str) -> None:
        argument_of[value] = name
        options.extend(["--" + name.replace("_", "-"), value])

    for name, named in (("mission", mission), ("policy", policy), ("public_key", public_key), ("tables", tables)):
        if named is not None:
            add(name, _path(name, named))
    if hear is not None:
        add("hear", "synthetic" if isinstance(hear, str) and hear == "synthetic" else _path("hear", hear))
    if battery_percent is not None:
        charge = number("battery_percent", battery_percent)
        if not 0.0 <= charge <= 100.0:
            raise BadInput(f"battery_percent = {charge:g}: must be 0 to 100", key="battery_percent", value=charge)
        add("battery_percent", repr(charge))
    if lcm_url is not None:
        add("lcm_url", text("lcm_url", lcm_url))
    if truth_value("ignore_source", ignore_source):
        options.append("--ignore-source")
    kept = None if out is None else _path("out", out)
    program = _program(programs)
    given = Path(tempfile.mkdtemp(prefix="earshot-flight-"))
    is_kept = False
    try:
        if environment is not None:
            add("environment", _in_file("environment", environment, given))
        folder = Path(kept) if kept is not None else given / "flight"
        add("out", str(folder))
        _run([program, "--quiet", "--no-report", "--end-with", str(os.getpid()), *options], argument_of)
        flight = Flight(folder)
        is_kept = kept is None
    except (FlightLost, KeyboardInterrupt):
        is_kept = kept is None  # what there is of the flight lies there
        raise
    finally:
        if not is_kept:
            shutil.rmtree(given, ignore_errors=True)
    if kept is None:
        flight._is_temporary = True
        weakref.finalize(flight, _remove, given, os.getpid())
    return flight
