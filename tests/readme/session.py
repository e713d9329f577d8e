"""Runs the commands of one Markdown file as a reader would.

One after the other, in one shell, from the root of a copy of the tree. What they started in its session has ended then.
"""

from __future__ import annotations

import os
import shlex
import signal
import subprocess
from pathlib import Path

from markdown import Command

# A command that does not end by itself: must still run after three seconds, and end on Ctrl-C with all that it started,
# as a shell's foreground job would. Who sees something run on presses again: a process that a script starts with &
# takes no notice of Ctrl-C until it has asked for it.
_FUNCTIONS = r"""
runs_in_group() {
  local stat line words
  for stat in /proc/[0-9]*/stat; do
    { read -r line <"$stat"; } 2>/dev/null || continue
    words=(${line##*) })
    [[ ${words[2]} == "$1" && ${words[0]} != Z ]] && return
  done
  return 1
}
start_and_stop() {
  local job tenths
  set -m
  (eval "$1") &
  job=$!
  set +m
  for _ in $(seq 30); do
    sleep 0.1
    kill -0 "$job" 2>/dev/null && continue
    wait "$job"
    echo "ended by itself with status $?, though it is marked as one that does not" >&2
    kill -KILL -- "-$job" 2>/dev/null # what it left
    return 1
  done
  for ((tenths = 0; tenths < 600; ++tenths)); do
    ((tenths % 100)) || kill -INT -- "-$job"
    sleep 0.1
    runs_in_group "$job" || { wait "$job"; case $? in 0 | 130) return 0 ;; *) return 1 ;; esac; }
  done
  kill -KILL -- "-$job"
  echo "did not end within 60 s of Ctrl-C" >&2
  return 1
}
ended() { printf '%s\n' "$1" >&3; [ "$1" -eq 0 ] || exit "$1"; }
"""


def _script(commands: list[Command]) -> str:
    lines = [_FUNCTIONS]
    for command in commands:
        if "start" in command.marks:
            lines.append(f"start_and_stop {shlex.quote(command.text)}")
        elif command.language == "python":
            lines.append(f"python3 -c {shlex.quote(command.text)}")
        else:
            lines.append(command.text)
        lines.append("ended $?")
    return "\n".join(lines) + "\n"


def _kill_session(leader: int) -> None:
    """All that it started, in whichever process group: each of them may hold the pipe that is read to its end."""
    for name in os.listdir("/proc"):
        try:
            if name.isdigit() and os.getsid(int(name)) == leader:
                os.kill(int(name), signal.SIGKILL)
        except ProcessLookupError:  # it ended meanwhile
            pass


def _available(read_end: int) -> str:
    """What the shell wrote, which has ended; not until all have who hold the pipe."""
    os.set_blocking(read_end, False)
    written = b""
    try:
        while some := os.read(read_end, 65536):
            written += some
    except BlockingIOError:
        pass
    os.close(read_end)
    return written.decode()


def failure_of(commands: list[Command], folder: Path, environment: dict[str, str], limit_s: float) -> str | None:
    """Runs them until one fails. Returns FILE:LINE: the command and the end of what it printed, or None if none did."""
    read_end, write_end = os.pipe()
    shell = subprocess.Popen(
        # Who runs this with & in a script has Ctrl-C ignored, which a shell would hand on and could not trap.
        ["env", "--default-signal=INT", "bash", "-c", f"exec 3>&{write_end} {write_end}>&-\n" + _script(commands)],
        cwd=folder,
        env=environment,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        pass_fds=[write_end],
        start_new_session=True,
        text=True,
        errors="replace",
    )
    os.close(write_end)
    try:
        printed, _ = shell.communicate(timeout=limit_s)
        _kill_session(shell.pid)  # what runs on behind them
        why = f"status {shell.returncode}"
    except subprocess.TimeoutExpired:
        _kill_session(shell.pid)
        try:
            printed, _ = shell.communicate(timeout=10.0)
        except subprocess.TimeoutExpired:
            printed = "(a session of its own that was started holds the output)"
        why = f"not done within {limit_s:.0f} s"
    done = _available(read_end).split()
    if shell.returncode == 0 and len(done) == len(commands):
        return None
    failed = commands[min(len(commands) - 1, sum(status == "0" for status in done))]
    last = "\n".join("    " + line for line in printed.splitlines()[-15:])
    return f"{failed.file}:{failed.line}: {failed.text}\n  {why}; it printed last:\n{last}"
