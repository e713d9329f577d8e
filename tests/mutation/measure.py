"""Plants every fault of some files, runs the tests that come by each, and reports which were noticed."""

from __future__ import annotations

import argparse
import contextlib
import fcntl
import os
import random
import re
import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path
from types import FrameType

from equivalents import Entry, complain_of, faults_meant, read_entries
from project import BadInput, Commands, Project, Test
from sites import Fault, arguments_for_clang, faults_of
from switch import HEADER, switched


@dataclass
class Planted:
    file: str
    fault: Fault
    excuse: Entry | None = None  # the list says that nobody can notice it
    seen_by: str = ""
    reached: bool = False
    left_out: float = 0.0  # seconds of tests for which there was no time


@dataclass
class Baseline:
    """The tests of a program with no fault: how long each takes and which faults it comes by."""

    seconds: dict[Test, float] = field(default_factory=dict)
    reached: dict[Test, set[int]] = field(default_factory=dict)
    failing: list[str] = field(default_factory=list)
    apart: set[str] = field(default_factory=set)  # programs whose tests fail in one process although each succeeds


@dataclass
class Running:
    """The tests that run now, so that none outlives this program when it is told to stop."""

    groups: set[int] = field(default_factory=set)
    lock: threading.Lock = field(default_factory=threading.Lock)

    def stop(self, number: int, _: FrameType | None) -> None:
        for group in list(self.groups):
            with contextlib.suppress(ProcessLookupError):
                os.killpg(group, signal.SIGKILL)
        os._exit(128 + number)


RUNNING = Running()


def show(text: str) -> None:
    if sys.stderr.isatty():
        sys.stderr.write(f"\r\x1b[K{text[:150]}")
        sys.stderr.flush()


def run_command(command: list[str], test: Test, extra: dict[str, str], limit: float) -> str:
    """'' when it succeeds, else how it failed. What it started goes with it."""
    environment = dict(os.environ) | dict(test.environment) | extra
    with RUNNING.lock:
        process = subprocess.Popen(
            command,
            cwd=test.folder,
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            start_new_session=True,
        )
        RUNNING.groups.add(process.pid)
    try:
        status = process.wait(timeout=limit)
    except subprocess.TimeoutExpired:
        return f"not done in {limit:.0f} s"
    finally:
        with contextlib.suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
        process.wait()
        RUNNING.groups.discard(process.pid)
    return "" if status == 0 else f"status {status}"


def build_without_errors(
    project: Project, plans: dict[str, dict[int, Fault]], sources: dict[str, bytes], programs: list[str]
) -> dict[int, str]:
    """Plants everything; faults that do not compile are taken out until the rest does. Returns those with the file."""
    dropped: dict[int, str] = {}
    for _ in range(30):
        texts = {name: switched(sources[name], plan) for name, plan in plans.items()}
        project.copy({name: text.text for name, text in texts.items()})
        result = project.ninja("-k", "0", *programs)
        if result.returncode == 0:
            return dropped
        before = len(dropped)
        for name, text in texts.items():
            for line in re.findall(rf"tree/{re.escape(name)}:(\d+):\d+: (?:error|  )", result.stdout):
                number = text.lines.get(int(line))
                if number in plans[name]:
                    dropped[number] = name
                    del plans[name][number]
        named = re.findall(r"tree/(\S+\.hpp):", result.stdout) + [name for name in plans if name.endswith(".hpp")]
        with_faults = next((name for name in named if plans.get(name)), None)
        if len(dropped) == before and with_faults:  # the compiler may stumble over one where it is used
            dropped |= dict.fromkeys(plans[with_faults], with_faults)
            plans[with_faults].clear()
        elif len(dropped) == before:
            tail = [line for line in result.stdout.split("\n") if re.search("error|Error|FAILED", line)]
            raise SystemExit("does not build, and no planted fault is to blame:\n" + "\n".join(tail[:20]))
    raise SystemExit("does not build after thirty attempts")


def measure_baseline(project: Project, tests: list[Test], count: int) -> Baseline:
    baseline = Baseline()
    reached = project.build / "reached"
    for index, test in enumerate(tests):
        show(f"without a fault: {index + 1} of {len(tests)} tests")
        reached.write_bytes(bytes(count))
        began = time.monotonic()
        failure = run_command(list(test.command), test, {"EARSHOT_FAULTS_REACHED": str(reached)}, 600.0)
        if failure:
            baseline.failing.append(f"{test.name}: {failure}")
            continue
        baseline.seconds[test] = time.monotonic() - began
        baseline.reached[test] = {n for n, byte in enumerate(reached.read_bytes()) if byte}
    for batch in batches(list(baseline.seconds), set()):
        if run_command(command_of(batch), batch[0], {}, 600.0):
            baseline.apart.add(batch[0].program)
    return baseline


def batches(tests: list[Test], apart: set[str]) -> list[list[Test]]:
    """Tests of one GoogleTest program in one process; any other alone, as those of a program of `apart`."""
    groups: dict[tuple[object, ...], list[Test]] = {}
    for test in tests:
        is_google = len(test.command) > 1 and test.command[1].startswith("--gtest_filter=")
        together = is_google and test.program not in apart
        key = (test.program, test.environment, test.folder) if together else (test.name,)
        groups.setdefault(key, []).append(test)
    return list(groups.values())


def command_of(batch: list[Test]) -> list[str]:
    command = list(batch[0].command)
    if len(batch) == 1:
        return command
    names = ":".join(t.command[1].removeprefix("--gtest_filter=") for t in batch)
    return [command[0], f"--gtest_filter={names}", "--gtest_fail_fast", *command[2:]]


def try_fault(planted: Planted, number: int, baseline: Baseline, seconds: float, near: set[str]) -> None:
    """Runs the tests that come by the fault, the nearest and quickest first, until one fails."""
    coming_by = [t for t, reached in baseline.reached.items() if number in reached]
    planted.reached = bool(coming_by)
    coming_by.sort(key=lambda t: (t.program not in near, baseline.seconds[t], t.name))
    chosen: list[Test] = []
    for test in coming_by:
        if seconds >= baseline.seconds[test]:
            seconds -= baseline.seconds[test]
            chosen.append(test)
        else:
            planted.left_out += baseline.seconds[test]
    for batch in batches(chosen, baseline.apart):
        limit = 5.0 + 10.0 * sum(baseline.seconds[t] for t in batch)
        failure = run_command(command_of(batch), batch[0], {"EARSHOT_FAULT": str(number)}, limit)
        if failure:
            planted.seen_by = f"{batch[0].program} ({failure})"
            return


def time_in_words(seconds: float) -> str:
    return f"{1000.0 * seconds:.0f} ms" if seconds < 1.0 else f"{seconds:.1f} s"


def report(name: str, planted: list[Planted], skipped: str) -> tuple[int, int]:
    counted = [p for p in planted if p.excuse is None]
    noticed = sum(1 for p in counted if p.seen_by)
    if not counted:
        return 0, 0
    rate = f"{100 * noticed / len(counted):.0f} %"
    print(f"{name}: {noticed} of {len(counted)} noticed, {rate} ({skipped}{len(planted) - len(counted)} equivalent)")
    for p in sorted(counted, key=lambda p: p.fault.line):
        if not p.seen_by:
            why = "" if p.reached else " (no test comes by)"
            why += f" (tests of {time_in_words(p.left_out)} were not run)" if p.left_out else ""
            site = f", {p.fault.site}" if p.fault.site else ""
            print(
                f"  {name}:{p.fault.line}: survived: {p.fault.kind}: {p.fault.change} [{p.fault.function}{site}]{why}"
            )
    return noticed, len(counted)


def report_refuted(planted: list[Planted]) -> bool:
    """Names the entries of the list of equivalents whose fault a test notices. @return whether there is one"""
    refuted = [p for p in planted if p.excuse is not None and p.seen_by]
    for p in refuted:
        print(f"no equivalent, a test notices it: {p.file}:{p.fault.line}: {p.fault.change}: {p.seen_by}")
    return bool(refuted)


def run(options: argparse.Namespace, names: list[str], root: Path, listed: Path) -> int:
    place = root / "build" / "mutation"
    with contextlib.ExitStack() as stack:
        try:
            place.mkdir(parents=True, exist_ok=True)
            lock = stack.enter_context((place / "lock").open("w"))
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise BadInput("build/mutation is in use by another run") from None
        except OSError as e:
            raise BadInput(f"{e.filename}: {e.strerror}") from None
        for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
            signal.signal(number, RUNNING.stop)
        return measure(options, names, Project(root, place), listed)


def measure(options: argparse.Namespace, names: list[str], project: Project, listed: Path) -> int:
    entries = read_entries(listed, project.root)
    only_listed = options.only_equivalents
    if only_listed:
        names = [name for name in names if any(entry.file == name for entry in entries)]
        if not names:
            raise BadInput("no fault of these files is listed as an equivalent")
    project.copy({})
    project.configure(HEADER)
    commands = Commands(project.tree, project.build)
    sources = {name: (project.root / name).read_bytes() for name in names}
    plans: dict[str, dict[int, Fault]] = {}
    constant: dict[str, int] = {}
    excuses: dict[int, Entry] = {}
    complaints: list[str] = []
    near: set[str] = set()
    programs: set[str] = set()
    next_number = 1
    for name in names:
        near_here, far_here = project.programs_of(name)
        if not near_here:
            print(f"{name}: not tried, it is part of no test program")
            continue
        found = faults_of(project.tree / name, arguments_for_clang(commands.of(name)))
        meant, wrong = faults_meant(entries, name, found)
        complaints += wrong
        constant[name] = sum(1 for f in found if not f.switchable)
        plans[name] = dict(
            enumerate((f for f in found if f.switchable and (f in meant or not only_listed)), next_number)
        )
        excuses |= {number: meant[fault] for number, fault in plans[name].items() if fault in meant}
        next_number += len(plans[name])
        near |= set(near_here)
        programs |= {*near_here, *(far_here if options.far else [])}
    if not programs:  # ninja would build everything
        raise BadInput("no test program is made of these files")
    complain_of(listed, complaints)
    show(f"building {len(programs)} test programs with {next_number - 1} faults")
    dropped = build_without_errors(project, plans, sources, sorted(programs))
    baseline = measure_baseline(project, project.tests(programs), next_number)
    for failing in baseline.failing:
        print(f"left out, it fails with no fault planted: {failing}")
    return run_all(options, plans, constant, dropped, baseline, near, excuses)


def run_all(
    options: argparse.Namespace,
    plans: dict[str, dict[int, Fault]],
    constant: dict[str, int],
    dropped: dict[int, str],
    baseline: Baseline,
    near: set[str],
    excuses: dict[int, Entry],
) -> int:
    chosen = sorted(n for plan in plans.values() for n in plan)
    if options.count and options.count < len(chosen):
        chosen = sorted(random.Random(options.seed).sample(chosen, options.count))
    of_file = {number: name for name, plan in plans.items() for number in plan}
    planted = {n: Planted(of_file[n], plans[of_file[n]][n], excuses.get(n)) for n in chosen}
    began = time.monotonic()
    with ThreadPoolExecutor(max_workers=os.cpu_count()) as pool:
        running = [
            pool.submit(try_fault, planted[number], number, baseline, options.seconds, near) for number in chosen
        ]
        for done, future in enumerate(running, 1):
            future.result()
            show(f"{done} of {len(running)} faults")
    show("")
    each = time_in_words((time.monotonic() - began) / max(len(chosen), 1))
    return report_all(options.at_least, list(planted.values()), constant, dropped, each)


def report_all(
    at_least: float, planted: list[Planted], constant: dict[str, int], dropped: dict[int, str], each: str
) -> int:
    """@return exit status"""
    counts: dict[str, list[int]] = {}
    for name, untried in constant.items():
        did_not_compile = sum(1 for n in dropped.values() if n == name)
        skipped = f"{untried} in constants not tried, {did_not_compile} did not compile, "
        one, all_of_it = report(name, [p for p in planted if p.file == name], skipped)
        of_folder = counts.setdefault(str(Path(name).parent), [0, 0])
        of_folder[0], of_folder[1] = of_folder[0] + one, of_folder[1] + all_of_it
    for folder, (noticed, counted) in counts.items():
        print(f"{folder}: {noticed} of {counted} noticed")
    noticed = sum(n for n, _ in counts.values())
    counted = sum(c for _, c in counts.values())
    rate = 100.0 * noticed / counted if counted else 100.0
    print(f"{noticed} of {counted} noticed, {rate:.0f} %; {each} each")
    return 1 if report_refuted(planted) or rate < at_least else 0
