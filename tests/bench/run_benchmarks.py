"""Runs the benchmarks of benchmarks.toml and prints one row a figure (see README.md of this folder)."""

import argparse
import fnmatch
import json
import os
import platform
import subprocess
import sys
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BIN = ROOT / "build" / "release" / "bin"
ONE_THREAD = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "MKL_NUM_THREADS": "1"}


def measure(command: list[str]) -> float:
    """The value that a command prints as its last line, a JSON object with the key "value"."""
    words = [word.format(bin=BIN, python=sys.executable) for word in command]
    done = subprocess.run(words, cwd=ROOT, env=os.environ | ONE_THREAD, stdout=subprocess.PIPE, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(words)}: exit status {done.returncode}")
    return float(json.loads(done.stdout.strip().splitlines()[-1])["value"])


def row_of(name: str, entry: dict) -> dict:
    value = measure(entry["command"])
    peer_value = measure(entry["peer_command"])
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


def main() -> int:
    parser = argparse.ArgumentParser(
        prog="tests/bench/run", description="Benchmarks, each beside its named alternative."
    )
    parser.add_argument("names", nargs="*", metavar="NAME", help='figures to measure; "pe.*" for a family; none: all')
    parser.add_argument("--json", type=Path, metavar="FILE", help="also write the rows there")
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

    print(f"{cpu_model()}, {os.cpu_count()} cores")
    print(f"{'name':<36} {'value':>12} {'unit':<12} {'peer value':>12} {'ratio':>9}  peer")
    rows, failed = [], 0
    for name, entry in wanted.items():
        try:
            row = row_of(name, entry)
        except (RuntimeError, ValueError, KeyError, IndexError) as error:
            print(f"{name}: {error}", file=sys.stderr)
            failed += 1
            continue
        rows.append(row)
        measured = f"{name:<36} {row['value']:>12.5g} {row['unit']:<12}"
        print(f"{measured} {row['peer_value']:>12.5g} {row['ratio']:>8.3g}x  {row['peer']}", flush=True)
    if arguments.json:
        content = {"machine": cpu_model(), "cores": os.cpu_count(), "rows": rows}
        write_whole(arguments.json, json.dumps(content, indent=1) + "\n")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
