"""Flies missions with faults with the real earshotd on a CAN bus or over LCM, and reports which cases passed.

Without --interface it does so on a virtual bus, in user-mode Linux where this kernel has no SocketCAN. Cases over LCM
need no CAN bus, and are flown within this machine, alone where no bus can be made. It builds what it needs, which takes
minutes the first time; --earshotd PATH, or EARSHOT_PROGRAMS=FOLDER, takes programs that are there. Ctrl-C ends
the flight.
Exit status: 0 every case passed; 1 one did not; 2 bad input; 3 the bench was lost; 130 Ctrl-C, or another signal.
"""

from __future__ import annotations

import argparse
import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

sys.path.insert(1, str(Path(__file__).resolve().parents[1] / "page"))
from bad_input import BadInput
from bench_results import BadResults, CaseResult, read_results
from bus import VIRTUAL, command_on_bus, require_bus, why_no_virtual_bus
from case_files import USUAL_MISSION, chosen_names, list_cases, names_over_can, require_cases
from group_names import read_group_names
from junit_report import junit_report
from markup import printable, printable_values
from outputs import is_junit_report, is_page, is_results, make_folder, require_writable, take_folder, write_whole
from programs import BuildFailed, NoPage, Programs, programs_for

ROOT = Path(__file__).resolve().parents[2]
COMMAND = os.environ.pop("EARSHOT_COMMAND", "hil/run")  # how it was called; not for what it starts
DONE, FAILED, BAD_INPUT, LOST, STOPPED = 0, 1, 2, 3, 130
RESULTS = "results.json"
# As the mission: programs that somebody copied have no tree of their own.
OCEAN = ROOT / "sim/ocean/environments/munk_flat.toml"


def whole_number(lowest: int, highest: int) -> Callable[[str], int]:
    """A reader of numbers of a command line."""

    def read(text: str) -> int:
        if not (text.isascii() and text.isdecimal() and lowest <= int(text) <= highest):
            raise argparse.ArgumentTypeError(f"{text} is no whole number from {lowest} to {highest}")
        return int(text)

    return read


def read_command_line(words: list[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog=COMMAND, description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--list", action="store_true", help="print every case, and what it does, and fly none")
    parser.add_argument(
        "--case", nargs="+", action="extend", default=[], metavar="NAME", help="which to fly (default: all)"
    )
    parser.add_argument(
        "--cases", type=Path, default=ROOT / "hil/cases", metavar="DIR", help="where the cases are (default: hil/cases)"
    )
    parser.add_argument("--interface", metavar="NAME", help="a CAN interface of this machine, such as can0")
    parser.add_argument(
        "--seed",
        type=whole_number(0, (1 << 63) - 1),
        default=1,
        metavar="N",
        help="draws which frames a fault is injected into (default: 1)",
    )
    parser.add_argument(
        "--random",
        type=whole_number(1, 1_000_000),
        metavar="N",
        help="fly N random combinations of the cases' faults instead; a case that shows what broke is left in DIR",
    )
    parser.add_argument(
        "--out",
        type=Path,
        default=Path("out/bench"),
        metavar="DIR",
        help="for results.json and each case's journal (default: out/bench)",
    )
    parser.add_argument("--report", type=Path, metavar="FILE", help="a page of all cases (HTML)")
    parser.add_argument("--junit", type=Path, metavar="FILE", help="the same for CI servers (JUnit's XML)")
    parser.add_argument(
        "--earshotd",
        type=Path,
        metavar="PATH",
        help="fly this earshotd, with the earshot-bench and its libraries beside it, and build nothing",
    )
    return parser.parse_args(words)


def judge(options: argparse.Namespace) -> None:
    """All that can be wrong with them, before anything is built or written."""
    require_cases(options.cases, options.case)
    if options.interface is not None:
        require_bus(options.interface)
    if options.random is not None and (options.report or options.junit):
        raise BadInput("--random: of random cases there is no page and no JUnit report")
    if os.path.exists(options.out) and not options.out.is_dir():
        raise BadInput(f"--out {options.out}: is no folder")
    wanted: list[tuple[Path, str, Callable[[Path], bool]]] = [
        (options.out / RESULTS, "what earshot-bench writes", is_results)
    ]
    if options.report is not None:
        wanted.append((options.report, "an HTML page", is_page))
    if options.junit is not None:
        wanted.append((options.junit, "a JUnit report", is_junit_report))
    for path, kind, is_of_kind in wanted:
        require_writable(path, kind, is_of_kind, to_be_made=options.out)
    if len({path.resolve() for path, *_ in wanted}) < len(wanted):
        raise BadInput("the page, the JUnit report and results.json must be three files")


def bench_command(options: argparse.Namespace, programs: Programs, names: list[str]) -> list[str]:
    """@param names  of the cases; none: all"""
    command = [programs.bench, "--earshotd", programs.earshotd, "--cases", options.cases.absolute()]
    command += ["--mission", USUAL_MISSION, "--environment", OCEAN]
    command += ["--interface", options.interface or VIRTUAL, "--seed", options.seed, "--out", options.out.absolute()]
    if names:
        command += ["--case", ",".join(dict.fromkeys(names))]
    if options.random is not None:
        command += ["--random", options.random]
    return [str(word) for word in command]


def run_to_its_end(command: list[str]) -> int:
    """Ctrl-C reaches it, too: it ends in its own way, and is waited for. Returns its status, as a shell counts."""
    # It ends with this process, however that ends.
    child = subprocess.Popen(["setpriv", "--pdeathsig", "TERM", *command], stdin=subprocess.DEVNULL)
    signal.signal(signal.SIGINT, lambda *_: None)
    for number in (signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, lambda *_: child.terminate())
    status = child.wait()
    return status if status >= 0 else 128 - status


def identity(file: Path) -> tuple[int, int] | None:
    """Unlike that of any file that was, or will be, in its place."""
    if not file.exists():
        return None
    found = file.stat()
    return found.st_ino, found.st_mtime_ns


def write_reports(options: argparse.Namespace, results: list[CaseResult], programs: Programs) -> None:
    can = options.interface or f"a virtual bus ({VIRTUAL})"
    buses = " and ".join(can if bus == "CAN" else bus for bus in sorted({result.bus for result in results}))
    day = time.strftime("%Y-%m-%d %H:%M UTC", time.gmtime())
    made = f"{programs.version()}, flown by {COMMAND} with seed {options.seed} on {buses or can}, {day}."
    flown = {result.name for result in results}
    not_flown = [name for name in chosen_names(options.cases, options.case) if name not in flown]
    if options.junit is not None:
        write_whole(options.junit, junit_report(results, not_flown))
    if options.report is not None:
        content = {
            "format": 1,
            "made": made,
            "not_flown": not_flown,
            "group_names": read_group_names(ROOT / "hil/bus/earshot.dbc"),
            "cases": [result.written for result in results],
        }
        write_whole(options.report, programs.page_of(json.dumps(printable_values(content))))


def fly(options: argparse.Namespace, programs: Programs) -> int:
    over_can = names_over_can(options.cases, options.case)
    missing = why_no_virtual_bus(ROOT) if over_can and options.interface is None else ""
    if missing:
        return fly_over_lcm(options, programs, over_can, missing)
    command = bench_command(options, programs, options.case)
    return fly_by(command_on_bus(ROOT, options.interface, command, needs_can=bool(over_can)), options, programs)


def fly_over_lcm(options: argparse.Namespace, programs: Programs, over_can: list[str], missing: str) -> int:
    """What there is no CAN bus for is judged, and named as not flown."""
    judged = run_to_its_end([*bench_command(options, programs, options.case), "--judge"])
    if judged != DONE:
        return judged if judged in (BAD_INPUT, STOPPED) else LOST
    over_lcm = [name for name in chosen_names(options.cases, options.case) if name not in over_can]
    fly_some = bool(over_lcm) and options.random is None  # random cases are drawn from all
    print(f"{COMMAND}: {missing}", file=sys.stderr)
    left = "no case" if not fly_some else "only what is over LCM"
    print(f"{COMMAND}: {left} is flown; not flown: {' '.join(_line(name) for name in over_can)}", file=sys.stderr)
    if not fly_some:
        return BAD_INPUT
    status = fly_by(bench_command(options, programs, over_lcm), options, programs)
    return FAILED if status == DONE else status


def fly_by(command: list[str], options: argparse.Namespace, programs: Programs) -> int:
    file = options.out / RESULTS
    older = identity(file)
    status = run_to_its_end(command)
    if identity(file) != older:
        write_reports(options, read_results(file), programs)
    elif status in (DONE, FAILED) and options.random is None:
        print(f"{COMMAND}: {programs.bench} left no {file}", file=sys.stderr)
        return LOST
    if status not in (DONE, FAILED, BAD_INPUT, LOST, STOPPED):
        print(f"{COMMAND}: {programs.bench} ended with status {status}", file=sys.stderr)
        return LOST
    return status


def _line(text: str) -> str:
    """As a terminal may show it."""
    return " ".join(printable(text).split())


def run(options: argparse.Namespace) -> int:
    if options.list:
        cases = list_cases(options.cases, options.case)
        width = max(len(_line(case.name)) for case in cases)
        print("".join(f"{_line(case.name):{width}}  {_line(case.when)}\n" for case in cases), end="")
        return DONE
    judge(options)
    programs = programs_for(ROOT, options.earshotd)
    make_folder(options.out)
    with take_folder(options.out):
        return fly(options, programs)


def main(words: list[str]) -> int:
    try:
        return run(read_command_line(words))
    except BadInput as e:
        print(f"{COMMAND}: {e}", file=sys.stderr)
        return BAD_INPUT
    except (BadResults, BuildFailed, NoPage, OSError) as e:
        print(f"{COMMAND}: {e}", file=sys.stderr)
        return LOST
    except KeyboardInterrupt:
        return STOPPED


if __name__ == "__main__":
    # What is listed may be read by one who has read enough.
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)
    sys.exit(main(sys.argv[1:]))
