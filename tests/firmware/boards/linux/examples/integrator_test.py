"""The integrator's example, outside the tree: built against what the package earshot-dev holds.

Flown on a pseudo-terminal with an own sensor, and by a policy that came from Python.

usage: integrator_test.py BUILD [PYTHON]
       integrator_test.py --installed
BUILD: folder of a whole build, whose component dev is installed for it; --installed: the packages are, in /usr
PYTHON: one with earshot_gym and Stable-Baselines3; then my_policy.py trains with it, and its policy alone flies
"""

import math
import os
import pty
import re
import select
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import tty
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[5]
EXAMPLE = ROOT / "firmware/boards/linux/examples/integrator"
TRAINING = ROOT / "policy/python/examples/my_policy.py"
BUILD = None if sys.argv[1] == "--installed" else Path(sys.argv[1]).resolve()
PROGRAMS = Path("/usr/bin") if BUILD is None else BUILD / "bin"
PYTHON = sys.argv[2] if len(sys.argv) > 2 else None
URL = f"udpm://239.255.76.67:{20000 + os.getpid() % 10000}?ttl=0"  # of this test alone
PATIENCE_S = 60.0


def run(*command, **options):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False, **options)
    if done.returncode != 0:
        raise AssertionError(f"{' '.join(map(str, command))}: {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


class SerialVehicle:
    """A vehicle at the other end of a serial line, twenty times as fast as at sea: it goes where it is told."""

    def __init__(self):
        self.master, self.slave = pty.openpty()
        tty.setraw(self.slave)
        self.line = os.ttyname(self.slave)
        self.north_m, self.east_m, self.heading_deg = 12000.0, 8000.0, 90.0
        self.told: list[tuple] = []
        self._rest = b""

    def close(self):
        os.close(self.master)
        os.close(self.slave)

    def send(self, line):
        os.write(self.master, line.encode("ascii") + b"\n")

    def publish_place(self):
        self.send(f"NAV {self.north_m:.1f} {self.east_m:.1f} 300.0 {self.heading_deg:.1f} 2.0")

    def live(self, seconds):
        """Says where it is, four times a second, and sails as it was told last."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            self.publish_place()
            step_end = time.monotonic() + 0.25
            while (left := step_end - time.monotonic()) > 0:
                if select.select([self.master], [], [], left)[0]:
                    self._rest += os.read(self.master, 4096)
            *lines, self._rest = self._rest.split(b"\n")
            for line in lines:
                words = line.decode("ascii").split()
                self.told.append((words[0], *map(float, words[1:])))
            if self.told and self.told[-1][2] > 0:
                self.heading_deg = self.told[-1][1]
                self.north_m += 10.0 * math.cos(math.radians(self.heading_deg))
                self.east_m += 10.0 * math.sin(math.radians(self.heading_deg))

    def live_until(self, condition):
        end = time.monotonic() + PATIENCE_S
        while not condition() and time.monotonic() < end:
            self.live(0.25)
        return condition()


class Integrator(unittest.TestCase):
    folder: Path
    mine: Path  # a copy of the example, built

    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix="integrator-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.mine = cls.folder / "mine"
        shutil.copytree(EXAMPLE, cls.mine)
        configure = ["cmake", "-G", "Ninja", "-S", cls.mine, "-B", cls.mine / "build"]
        if BUILD is not None:
            installed = cls.folder / "installed"
            run("cmake", "--install", BUILD, "--component", "dev", "--prefix", installed)
            configure += [f"-DCMAKE_PREFIX_PATH={installed}", "-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"]
        run(*configure)
        run("cmake", "--build", cls.mine / "build")
        run(PROGRAMS / "earshot", "init", cls.mine / "own", "--lcm-url", URL)

    def fly(self, mission, legs):
        """Flies until so many headings were given, and an end by Ctrl-C. @return what the vehicle was told"""
        vehicle = SerialVehicle()
        self.addCleanup(vehicle.close)
        journal = self.folder / f"journal-{mission.stem}"
        with open(self.folder / "said", "w+") as said:
            flown = subprocess.Popen(
                [self.mine / "build/my_vehicle", mission, vehicle.line, journal], stdout=said, stderr=said, text=True
            )
            sensor = subprocess.Popen([self.mine / "build/my_sensor", URL, "3"])
            try:
                vehicle.live(2.0)
                self.assertEqual(vehicle.told, [], "commanded before START")
                vehicle.send("START")
                searching = vehicle.live_until(lambda: len(vehicle.told) > 3)
                self.assertTrue(searching, (self.folder / "said").read_text())
                self.assertTrue(
                    vehicle.live_until(lambda: len({told[1] for told in vehicle.told}) >= legs), vehicle.told[-5:]
                )
                during = list(vehicle.told)
                flown.send_signal(signal.SIGINT)
                vehicle.live(1.5)
                self.assertEqual(flown.wait(PATIENCE_S), 0, (self.folder / "said").read_text())
            finally:
                for process in (flown, sensor):
                    process.kill()
                    process.wait()
        self.assertEqual(vehicle.told[-1][3], 0.0, "not told to come up at the end")
        run(PROGRAMS / "earshot", "replay", journal / "journal.lcmlog")
        return during

    def test_own_port_and_own_sensor_fly_a_search_that_replays_byte_for_byte(self):
        for word, heading_deg, speed_mps, depth_m in self.fly(self.mine / "own/mission.toml", legs=1):
            self.assertEqual((word, speed_mps, depth_m), ("SET", 2.0, 300.0))
            self.assertTrue(0.0 <= heading_deg < 360.0)

    def test_own_policy_from_python_flies_the_vehicle(self):
        model = ROOT / "tests/policy/freeze/models/memory.zip"  # as my_policy.py saves one
        if PYTHON is not None:
            train = f"import runpy, sb3_without_plots; runpy.run_path({str(TRAINING)!r})"
            peers = {**os.environ, "PYTHONPATH": str(ROOT / "tests/bench/peers")}
            run(PYTHON, "-c", train, "2048", cwd=self.folder, env=peers)
            model = self.folder / "my_policy.zip"
        own = self.mine / "own"
        run(
            PROGRAMS / "earshot",
            "freeze",
            model,
            "-o",
            own / "my.policy",
            "--draw",
            "argmax",
            "--listening",
            "mean",
            "--listening-window-s",
            "30",
            "--key",
            own / "my.key",
            "--new-key",
        )
        text = (own / "mission.toml").read_text()
        text = re.sub(r'^file = ".*?"', 'file = "my.policy"', text, flags=re.MULTILINE)
        text = re.sub(r'^public_key_file = ".*?"', 'public_key_file = "my.pub"', text, flags=re.MULTILINE)
        (own / "by_my_policy.toml").write_text(text)
        self.assertIn("my.policy", run(PROGRAMS / "earshotd", "--check", own / "by_my_policy.toml"))
        self.fly(own / "by_my_policy.toml", legs=1)


if __name__ == "__main__":
    tests = ["Integrator.test_own_policy_from_python_flies_the_vehicle"] if PYTHON else []
    unittest.main(argv=[sys.argv[0], *tests], verbosity=2)
