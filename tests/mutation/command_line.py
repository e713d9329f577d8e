"""Plants small faults one at a time in C++ files and says which of them the tests notice."""

from __future__ import annotations

import argparse
import contextlib
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

from equivalents import read_entries, show
from project import BadInput

ROOT = Path(__file__).resolve().parents[2]
LISTED = Path(__file__).with_name("equivalents.toml")
USUAL = [
    f"firmware/{part}"
    for part in ["core", "config", "messages", "policy", "guidance", "safety", "authority", "detector", "runtime"]
]
USUAL += ["firmware/wire", "firmware/host", "firmware/boards"]
USUAL += ["sim/pe", "sim/sonar", "sim/search", "policy/ppo", "policy/freeze"]


def number_from(lowest: float, highest: float, kind: type[int] | type[float]) -> Callable[[str], float]:
    """A reader of numbers of a command line."""

    def read(text: str) -> float:
        with contextlib.suppress(ValueError):
            value = kind(text)
            if lowest <= value <= highest:
                return value
        raise argparse.ArgumentTypeError(f"{text} is no {'whole ' * (kind is int)}number from {lowest} to {highest}")

    return read


def read_command_line() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="tests/mutation/run", description=__doc__)
    parser.add_argument(
        "files", nargs="*", metavar="FILE", help="a C++ source or header, or a folder of them (default: all that fly)"
    )
    parser.add_argument(
        "--seed", type=number_from(0, 2**63, int), default=1, metavar="N", help="which faults are chosen (default 1)"
    )
    parser.add_argument(
        "--count",
        type=number_from(0, 10**6, int),
        default=60,
        metavar="N",
        help="faults chosen of all in the files; 0 for all (default 60)",
    )
    parser.add_argument(
        "--far", action="store_true", help="also tests outside the mirrored folder that do not include the file"
    )
    seconds = number_from(0.001, 86_400, float)
    parser.add_argument(
        "--seconds",
        type=seconds,
        default=60.0,
        metavar="S",
        help="for one fault no more tests are run, the nearest and quickest first, than take S seconds together "
        "with no fault planted (default 60)",
    )
    parser.add_argument(
        "--at-least",
        type=number_from(0, 100, float),
        default=0.0,
        metavar="PERCENT",
        help="exit status 1 when fewer are noticed",
    )
    parser.add_argument(
        "--only-equivalents",
        action="store_true",
        help="plant just all faults that are listed as changing nothing: does a test notice one after all?",
    )
    parser.add_argument(
        "--show-equivalents",
        action="store_true",
        help="plant nothing; print the faults of FILE (default: of all files) that are listed as changing nothing, "
        "with the reasons",
    )
    options = parser.parse_args()
    if options.only_equivalents:
        options.count = 0
    return options


def files_named(named: list[str]) -> list[str]:
    """The C++ files of the tree that are named, or lie in a folder that is, each once, from the root on."""
    command = ["git", "ls-files", "-z", "-co", "--exclude-standard", "*.cpp", "*.hpp"]
    listed = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout.split("\0")
    found: dict[str, None] = {}
    for name in named:
        path = Path(name).resolve() if Path(name).exists() else ROOT / name
        inside = [f for f in listed if f and (ROOT / f == path or path in (ROOT / f).parents)]
        if not inside or not name:
            raise BadInput(f'"{name}": no C++ file or folder with one in this tree')
        found |= dict.fromkeys(inside)
    return list(found)


def main() -> int:
    options = read_command_line()
    try:
        if options.show_equivalents:
            show(read_entries(LISTED, ROOT), files_named(options.files) if options.files else None)
            return 0
        names = files_named(options.files or USUAL)
        set_up = subprocess.run([ROOT / "toolchains" / "setup", "build", "mutation"], check=False)
        if set_up.returncode != 0:
            return set_up.returncode
        from measure import run  # needs what was just set up

        return run(options, names, ROOT, LISTED)
    except BadInput as e:
        print(f"tests/mutation/run: {e}", file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main())
