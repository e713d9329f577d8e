"""Runs the benchmarks of benchmarks.toml and prints one row a figure (see README.md of this folder)."""

import argparse
import fnmatch
import json
import math
import os
import platform
import subprocess
import sys
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
ONE_THREAD = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "MKL_NUM_THREADS": "1"}


class Runner:
    """Runs the commands of the rows."""

    def __init__(self, preset: str, form: dict[str, str]) -> None:
        """preset: or the folder of a build; form: what the environment says of it (short_form.hpp)"""
        self.build = ROOT / "build" / preset
        self.environment = os.environ | ONE_THREAD | form

    def measure(self, log_name: str, command: list[str]) -> float:
        """The value that a command prints as its last line, a JSON object with the key "value".

        What else it says stays in a log of its own, and is told when it fails.
        """
        words = [word.format(bin=self.build / "bin", python=sys.executable) for word in command]
        log = self.build / "bench" / f"{log_name}.log"
        log.parent.mkdir(parents=True, exist_ok=True)
        with log.open("w+", encoding="utf-8", errors="replace") as said:
            try:
                done = subprocess.run(
                    words, cwd=ROOT, env=self.environment, stdout=subprocess.PIPE, stderr=said, text=True, check=False
                )
            except OSError as error:
                raise RuntimeError(f"{words[0]}: {error.strerror}") from error
        if done.returncode < 0:
            raise ChildProcessError(f"{' '.join(words)}: ended by signal {-done.returncode}; {tail(log)}")
        if done.returncode != 0:
            raise RuntimeError(f"{' '.join(words)}: exit status {done.returncode}: {tail(log)}")
        try:
            value = float(json.loads(done.stdout.strip().splitlines()[-1])["value"])
        except (ValueError, KeyError, IndexError, TypeError) as error:
            raise RuntimeError(f"{' '.join(words)}: printed no value: {done.stdout[-200:]!r}") from error
        if not math.isfinite(value) or value == 0.0:
            raise RuntimeError(f"{' '.join(words)}: measured {value}")
        return value


def tail(log: Path) -> str:
    """What a command said last of all, for a person to begin with."""
    lines = log.read_text(encoding="utf-8", errors="replace").strip().splitlines()
    return f"{lines[-1]} (all: {log})" if lines else "it said nothing"


def row_of(name: str, entry: dict, runner: Runner, is_short: bool) -> dict:
    value = runner.measure(name, entry["command"])
    if is_short and entry["peer_command"][0] == "{python}":  # their packages are heavy
        return {"name": name, "value": value, "unit": entry["unit"], "peer": entry["peer"]}
    peer_value = runner.measure(f"{name}.peer", entry["peer_command"])
    ratio = value / peer_value if entry["better"] == "higher" else peer_value / value
    return {
        "name": name,
        "value": value,
        "unit": entry["unit"],
        "peer": entry["peer"],
        "peer_value": peer_value,
        "ratio": ratio,
    }


def cpu_model() -> str:
    for line in Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.split(":", 1)[1].strip()
    return platform.machine()


def write_whole(path: Path, text: str) -> None:
    part = path.with_name(path.name + ".part")
    part.write_text(text)
    part.replace(path)


def line_of(row: dict) -> str:
    measured = f"{row['name']:<36} {row['value']:>12.5g} {row['unit']:<12}"
    if "ratio" not in row:
        return f"{measured} {'-':>12} {'-':>9}  {row['peer']}"
    return f"{measured} {row['peer_value']:>12.5g} {row['ratio']:>8.3g}x  {row['peer']}"


def fail_as_they_should(wanted: dict[str, dict], runner: Runner) -> int:
    """Whether every row ends with an error where what it measures is not in the state that the row is about."""
    measured = 0
    for name, entry in wanted.items():
        try:
            value = runner.measure(f"{name}.wrong", entry["command"])
        except RuntimeError as error:
            print(f"{name}: fails, as it should: {error}", flush=True)
        except ChildProcessError as error:
            print(f"{name}: {error}", file=sys.stderr)
            measured += 1
        else:
            print(f"{name}: measured {value} {entry['unit']} in a state that it is not about", file=sys.stderr)
            measured += 1
    return 1 if measured else 0


def main() -> int:
    parser = argparse.ArgumentParser(
        prog="tests/bench/run", description="Benchmarks, each beside its named alternative."
    )
    parser.add_argument("names", nargs="*", metavar="NAME", help='figures to measure; "pe.*" for a family; none: all')
    parser.add_argument("--json", type=Path, metavar="FILE", help="also write the rows there")
    parser.add_argument("--short", action="store_true", help="once and little of each, to see that it can be measured")
    parser.add_argument(
        "--wrong", action="store_true", help="measures what is in a wrong state: every row must end with an error"
    )
    parser.add_argument(
        "--build",
        default="release",
        metavar="PRESET",
        help="whose programs are measured: a preset, or its folder (release)",
    )
    parser.add_argument("--list", action="store_true", help="say what there is and stop")
    arguments = parser.parse_args()

    with (Path(__file__).parent / "benchmarks.toml").open("rb") as stream:
        entries = tomllib.load(stream)
    patterns = arguments.names or ["*"]
    wanted = {name: entry for name, entry in entries.items() if any(fnmatch.fnmatch(name, p) for p in patterns)}
    unknown = [n for n in arguments.names if not fnmatch.filter(entries, n)]
    if unknown:
        print(f"no benchmark {', '.join(unknown)}; there are: {', '.join(entries)}", file=sys.stderr)
        return 2
    if arguments.list:
        for name, entry in wanted.items():
            print(f"{name:<36} {entry['unit']:<12} beside {entry['peer']}")
        return 0

    form = {"EARSHOT_BENCH_SHORT": "1"} if arguments.short or arguments.wrong else {}
    if arguments.wrong:
        return fail_as_they_should(wanted, Runner(arguments.build, form | {"EARSHOT_BENCH_WRONG": "1"}))
    runner = Runner(arguments.build, form)
    print(f"{cpu_model()}, {os.cpu_count()} cores")
    print(f"{'name':<36} {'value':>12} {'unit':<12} {'peer value':>12} {'ratio':>9}  peer")
    rows, failed = [], 0
    for name, entry in wanted.items():
        try:
            row = row_of(name, entry, runner, arguments.short)
        except (RuntimeError, ChildProcessError) as error:
            print(f"{name}: {error}", file=sys.stderr)
            failed += 1
            continue
        rows.append(row)
        print(line_of(row), flush=True)
    if arguments.json:
        content = {"machine": cpu_model(), "cores": os.cpu_count(), "rows": rows}
        write_whole(arguments.json, json.dumps(content, indent=1) + "\n")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
