"""Commands that run on when they should have ended: none hangs the test, and none is left."""

import os
import signal
import sys
import tempfile
import time
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import session
from markdown import Command

# Started with &, it takes no notice of Ctrl-C until it has asked for it, which is after the first.
LATE = """
import pathlib, signal, sys, time

def stop(*_):
    pathlib.Path("stopped").touch()
    sys.exit()

time.sleep(6)
signal.signal(signal.SIGINT, stop)
time.sleep(1000)
"""


def command(text: str, *marks: str) -> Command:
    return Command(file=Path("README.md"), line=1, text=text, language="sh", marks=frozenset(marks))


def runs(process: int) -> bool:
    try:
        return Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except FileNotFoundError:
        return False


class Session(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def failure_of(self, *commands, limit_s=120.0):
        return session.failure_of(list(commands), self.folder, dict(os.environ), limit_s)

    def test_stops_what_a_command_started_that_took_no_notice_of_the_first_ctrl_c(self):
        (self.folder / "late.py").write_text(LATE)
        ran = command("sh -c 'python3 late.py & exec sleep 1000'", "start")
        self.assertIsNone(self.failure_of(ran))
        self.assertTrue((self.folder / "stopped").exists())

    def test_presses_ctrl_c_though_it_was_started_where_ctrl_c_is_ignored(self):
        self.addCleanup(signal.signal, signal.SIGINT, signal.signal(signal.SIGINT, signal.SIG_IGN))
        self.assertIsNone(self.failure_of(command("bash -c 'trap \"exit 130\" INT; sleep 1000'", "start")))

    def test_tells_of_a_command_that_ends_by_itself_and_ends_what_it_left(self):
        begin = time.monotonic()
        left_behind = command("sh -c 'sleep 1000 & exit 3'", "start")
        self.assertIn("ended by itself with status 3", self.failure_of(left_behind))
        self.assertLess(time.monotonic() - begin, 60.0)

    def test_ends_at_the_limit_though_a_job_of_another_group_holds_the_output(self):
        begin = time.monotonic()
        failure = self.failure_of(command("set -m; sleep 1000 & sleep 1000"), limit_s=1.0)
        self.assertIn("not done within 1 s", failure)
        self.assertLess(time.monotonic() - begin, 60.0)

    def test_ends_what_runs_on_behind_commands_that_succeeded(self):
        begin = time.monotonic()
        self.assertIsNone(self.failure_of(command("sleep 1000 >/dev/null 2>&1 & echo $! >number")))
        self.assertLess(time.monotonic() - begin, 60.0)
        number = int((self.folder / "number").read_text())
        while runs(number) and time.monotonic() - begin < 60.0:
            time.sleep(0.01)
        self.assertFalse(runs(number))

    def test_ends_at_the_limit_though_a_session_of_its_own_holds_the_output(self):
        begin = time.monotonic()
        failure = self.failure_of(command("setsid sleep 70 & sleep 100"), limit_s=1.0)
        self.assertIn("not done within 1 s", failure)
        self.assertLess(time.monotonic() - begin, 60.0)


if __name__ == "__main__":
    unittest.main()
