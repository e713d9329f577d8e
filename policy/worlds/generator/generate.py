"""Draws worlds of a split, or writes the environments of a bank that covers the oceans evenly, or an ocean's variants.

What is drawn, and from what: policy/worlds/generator/README.md. The same words write the same bytes.
"""

from __future__ import annotations

import argparse
import errno
import sys
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import solver
from draws import Draws
from environment import text_of
from oceans import DEEPEST_M, Ocean, bank_ocean, drawn_ocean, environment_text
from output import BANK_HEADER, BANK_NAME, MADE_BY, OCEANS, remove_what_is_half_made_when_stopped, whole
from refusal import Refusal
from searches import Conditions, drawn_conditions
from variants import variants

# Seeds of a split's worlds begin here; as many as a split may have lie before the next's.
FIRST_SEED = {"train": 1_000_000, "validation": 2_000_000, "test": 3_000_000}
MOST_WORLDS = 1_000_000
MOST_DRAWS = 100
BANK_HZ = 20.0
COUNT, FIRST = 40, 0
# What the disk does to a command, not what a person has asked of it.
FAULTS_OF_THE_DISK = (errno.ENOSPC, errno.EDQUOT, errno.EIO)

PROGRAM = "policy/worlds/generate"
# The texts of one world or environment, by the name of their file in the folder.
Files = dict[str, str]


@dataclass(frozen=True)
class Held:
    """What every world has, instead of what was drawn for it: a vehicle's tables are of one of each."""

    frequency_hz: float | None = None
    vehicle_depth_m: float | None = None

    def words(self) -> str:
        """As on the command line."""
        frequency = "" if self.frequency_hz is None else f" --frequency-hz {self.frequency_hz:g}"
        return frequency + ("" if self.vehicle_depth_m is None else f" --vehicle-depth-m {self.vehicle_depth_m:g}")

    def of(self, ocean: Ocean) -> Ocean:
        return replace(
            ocean,
            frequency_hz=ocean.frequency_hz if self.frequency_hz is None else self.frequency_hz,
            vehicle_depth_m=ocean.vehicle_depth_m if self.vehicle_depth_m is None else self.vehicle_depth_m,
        )


def world_files(split: str, index: int, draw: int, held: Held = Held()) -> Files:
    """World number `index` of a split, drawn for the draw-th time (from 1)."""
    seed = FIRST_SEED[split] + index
    draws = Draws(f"{seed}/{draw}")
    ocean: Ocean = held.of(drawn_ocean(draws))
    conditions: Conditions = drawn_conditions(draws)
    name = f"{split}_{index:03d}"
    made = f"{MADE_BY} --split {split} --first {index} --count 1{held.words()} (draw {draw}). Never edit it.\n"
    world = (
        f'name = "{name}"\nwhat = "{ocean.words()}; {conditions.words()}"\nseed = {seed}\n'
        f'environment = "{OCEANS}/{name}.toml"\n'
        f"vehicle_depth_m = {ocean.vehicle_depth_m:.1f}\n\n"
    )
    return {
        f"{name}.toml": made + world + conditions.text(),
        f"{OCEANS}/{name}.toml": made + environment_text(ocean, name),
    }


def write(folder: Path, files: Files) -> None:
    for name, text in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)


def report(line: str) -> None:
    erase = "\r\033[K" if sys.stderr.isatty() else ""
    print(f"{erase}{line}", file=sys.stderr)


def show_progress(name: str, part: int, whole: int) -> None:
    if sys.stderr.isatty():
        print(f"\r{name} ({part} of {whole})" + ("\n" if part == whole else ""), end="", file=sys.stderr, flush=True)


def write_world(
    split: str, index: int, folder: Path, refuses: Callable[[Path], str | None], held: Held = Held()
) -> None:
    for draw in range(1, MOST_DRAWS + 1):
        files = world_files(split, index, draw, held)
        write(folder, files)
        complaint = refuses(folder / next(iter(files)))
        if complaint is None:
            return
        report(f"{split}_{index:03d}: drawn again: {complaint}")
    raise SystemExit(f"{PROGRAM}: {split}_{index:03d}: {MOST_DRAWS} draws, and none is taken")


def write_bank(count: int, frequency_hz: float, folder: Path, refuses: Callable[[Path, float], str | None]) -> None:
    """Point after point of the design; one that is refused is left out."""
    rows = [BANK_HEADER]
    point = 0
    while len(rows) <= count:
        if point >= count + MOST_DRAWS:
            raise SystemExit(f"{PROGRAM}: {MOST_DRAWS} points of the bank are refused")
        ocean, name = bank_ocean(point, frequency_hz), f"bank_{point:03d}"
        made = f"{MADE_BY} --bank {count} --frequency-hz {frequency_hz:g}. Never edit it.\n"
        write(folder, {f"{name}.toml": made + environment_text(ocean, name)})
        complaint = refuses(folder / f"{name}.toml", ocean.vehicle_depth_m)
        if complaint is None:
            rows.append(f"{name}.toml,{ocean.vehicle_depth_m:g}")
            show_progress(name, len(rows) - 1, count)
        else:
            (folder / f"{name}.toml").unlink()
            report(f"{name}: left out: {complaint}")
        point += 1
    (folder / BANK_NAME).write_text("\n".join(rows) + "\n")


def write_variants(environment: Path, folder: Path) -> None:
    try:
        texts = variants(text_of(environment))
    except OSError as error:
        raise Refusal(f"--variants-of {environment}: {error.strerror}") from error
    except KeyError as error:
        raise Refusal(f"--variants-of {environment}: lacks {error}, which every environment has") from error
    except (ValueError, TypeError, RecursionError) as error:  # a file that is no TOML is a ValueError, too
        raise Refusal(f"--variants-of {environment}: {error}") from error
    name_in_comment = environment.name.encode("unicode_escape").decode()  # which may hold the end of a line
    made = f"{MADE_BY} --variants-of {name_in_comment}. Never edit it.\n"
    write(folder, {f"{name}.toml": made + text for name, text in texts.items()})


def options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog=PROGRAM, description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    what = parser.add_mutually_exclusive_group(required=True)
    what.add_argument("--split", choices=FIRST_SEED, help="draw worlds of this split; no two splits share a seed")
    what.add_argument(
        "--bank", type=int, metavar="N", help="write N environments that cover the oceans evenly, and bank.csv"
    )
    what.add_argument(
        "--variants-of",
        type=Path,
        metavar="ENVIRONMENT",
        help="write this environment over every kind of sea floor, and with its source at other depths",
    )
    parser.add_argument("--count", type=int, help=f"worlds of --split to draw ({COUNT})")
    parser.add_argument("--first", type=int, help=f"number of the first of them in its split ({FIRST})")
    parser.add_argument(
        "--frequency-hz", type=float, help="of the bank's sources (20); of every source of --split train (drawn)"
    )
    parser.add_argument(
        "--vehicle-depth-m",
        type=float,
        help="of every vehicle of --split train (drawn); shallower water is drawn again",
    )
    parser.add_argument("-o", "--output", required=True, help="folder to write; it is there whole or not at all")
    parser.add_argument("--force", action="store_true", help="replace a folder that was made by this program")
    parser.add_argument("--bin", type=Path, help="folder of Earshot's programs, instead of those on the PATH")
    o = parser.parse_args()
    if o.split is None and (o.count is not None or o.first is not None):
        parser.error("--count, --first: of --split")
    o.count, o.first = (COUNT if o.count is None else o.count), (FIRST if o.first is None else o.first)
    if Path(o.output).name in ("", ".."):
        parser.error(f"--output: {o.output!r}: must name a folder that can be made or replaced")
    o.output = Path(o.output)
    if o.split and not (o.count >= 1 and o.first >= 0 and o.first + o.count <= MOST_WORLDS):
        parser.error(
            f"--first {o.first} --count {o.count}: worlds 0 to {MOST_WORLDS - 1} of a split can be drawn, at least one"
        )
    if o.bank is not None and not 1 <= o.bank <= 10_000:
        parser.error(f"--bank: {o.bank}: must be 1 to 10000")
    if o.split in ("validation", "test") and (o.frequency_hz is not None or o.vehicle_depth_m is not None):
        parser.error(f"--frequency-hz, --vehicle-depth-m: not of --split {o.split}, which is the same for everyone")
    if o.variants_of is not None and (o.frequency_hz is not None or o.vehicle_depth_m is not None):
        parser.error("--frequency-hz, --vehicle-depth-m: not of --variants-of, whose frequency is the environment's")
    if o.bank is not None and o.vehicle_depth_m is not None:
        parser.error("--vehicle-depth-m: of --split train; a bank's are as deep as bank.csv states")
    if o.frequency_hz is not None and not 1 <= o.frequency_hz <= 100:
        parser.error(f"--frequency-hz: {o.frequency_hz:g}: must be 1 to 100")
    if o.vehicle_depth_m is not None and not 1 <= o.vehicle_depth_m < DEEPEST_M:
        parser.error(f"--vehicle-depth-m: {o.vehicle_depth_m:g}: must be 1 to less than {DEEPEST_M:g}")
    return o


def make(o: argparse.Namespace) -> None:
    programs = f"{o.bin}/" if o.bin else ""
    with whole(o.output, o.force) as made:
        if o.split:
            held = Held(o.frequency_hz, o.vehicle_depth_m)
            for index in range(o.first, o.first + o.count):
                write_world(o.split, index, made, lambda world: solver.refuses_world(programs, world), held)
                show_progress(f"{o.split}_{index:03d}", index - o.first + 1, o.count)
        elif o.variants_of is not None:
            write_variants(o.variants_of, made)
        else:
            write_bank(
                o.bank,
                BANK_HZ if o.frequency_hz is None else o.frequency_hz,
                made,
                lambda file, depth: solver.refuses_environment(programs, file, depth),
            )


def main() -> None:
    remove_what_is_half_made_when_stopped()
    o = options()
    try:
        make(o)
    except Refusal as refusal:
        report(f"{PROGRAM}: {refusal}")
        raise SystemExit(2) from None
    except OSError as error:
        report(f"{PROGRAM}: {o.output}: {error.strerror}")
        raise SystemExit(1 if error.errno in FAULTS_OF_THE_DISK else 2) from None


if __name__ == "__main__":
    main()
