"""hil/run as a person types it, with a stand-in for earshot-bench; with EARSHOTD also the real one on a virtual bus.

usage: bench_command_test.py [EARSHOTD]
"""

from __future__ import annotations

import base64
import contextlib
import gzip
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
import xml.etree.ElementTree as ET
from datetime import UTC, datetime
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "page"))
from bench_example import ROOT, calm, deaf

STUB = Path(__file__).with_name("stub_bench")
EARSHOTD = ""


class InAFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.cases = self.folder / "cases"
        self.cases.mkdir()
        for case in (calm(), deaf()):
            (self.cases / f"{case['name']}.toml").write_text(f'when = "{case["when"]}"\n')
        self.earshotd = self.folder / "programs/earshotd"
        self.earshotd.parent.mkdir()
        for name in ("earshotd", "earshot-bench"):
            shutil.copy(STUB, self.earshotd.with_name(name))

    def environment(self, **more: str) -> dict[str, str]:
        # As on a machine that has a vcan0: the command runs as it is.
        kept = {key: value for key, value in os.environ.items() if not key.startswith(("EARSHOT_", "BENCH_"))}
        return kept | {"EARSHOT_CAN": "here", **more}

    def bench(self, *words: object, **environment: str) -> subprocess.CompletedProcess[str]:
        command = [ROOT / "hil/run", "--cases", self.cases, "--earshotd", self.earshotd, *words]
        return subprocess.run(
            list(map(str, command)),
            cwd=self.folder,
            env=self.environment(**environment),
            capture_output=True,
            text=True,
            check=False,
            timeout=120,
        )

    def results(self, *entries: dict) -> str:
        file = self.folder / "given.json"
        file.write_text(json.dumps({"cases": entries}))
        return str(file)

    def shown(self, page: str = "page.html") -> dict:
        """What a page holds, as JSON or compressed."""
        found = re.search(
            r'<script id="bench" type="application/(json|gzip)">(.*?)</script>', (self.folder / page).read_text()
        )
        assert found is not None
        return json.loads(found[2] if found[1] == "json" else gzip.decompress(base64.b64decode(found[2])))

    def told(self) -> list[str]:
        return json.loads((self.folder / "out/bench/told.json").read_text())


class Lists(InAFolder):
    def test_every_case_and_what_it_does(self):
        said = self.bench("--list")
        self.assertEqual(said.returncode, 0)
        self.assertEqual(said.stdout, "calm  nothing is wrong\ndeaf  the hydrophone is open for a while\n")
        self.assertEqual(self.bench("--list", "--case", "calm").stdout, "calm  nothing is wrong\n")
        self.assertFalse((self.folder / "out").exists())

    def test_the_cases_that_ship(self):
        said = subprocess.run([ROOT / "hil/run", "--list"], capture_output=True, text=True, check=True)
        there = sorted(file.stem for file in (ROOT / "hil/cases").glob("*.toml"))
        self.assertEqual([line.split()[0] for line in said.stdout.splitlines()], there)

    def test_no_case_that_is_no_toml_or_does_not_say_what_it_does(self):
        for text, words in {"when = ": "a.toml: Invalid value", "when = 7": "a.toml: when: must be a text"}.items():
            (self.cases / "a.toml").write_text(text)
            said = self.bench("--list")
            self.assertEqual((said.returncode, said.stdout), (2, ""))
            self.assertIn(words, said.stderr)

    def test_nothing_that_could_steer_a_terminal(self):
        (self.cases / "a\nb.toml").write_text('when = "one\\u001b[31m\\ntwo"\n')
        said = self.bench("--list", "--case", "a\nb")
        self.assertEqual((said.returncode, said.stdout), (0, "a b  one\\u001b[31m two\n"))

    def test_no_case_that_could_never_be_read(self):
        os.mkfifo(self.cases / "a.toml")
        self.assertIn("a.toml: is no regular file", self.bench("--list").stderr)
        (self.cases / "a.toml").unlink()
        (self.cases / "a.toml").symlink_to("/dev/zero")
        self.assertIn("a.toml: is no regular file", self.bench("--list").stderr)
        (self.cases / "a.toml").unlink()
        (self.cases / "a.toml").write_text("# " + "x" * (4 << 20))
        self.assertIn("a.toml: has more than 4194304 bytes", self.bench("--list").stderr)
        (self.cases / "a.toml").write_text("when = " + "[" * 100_000)
        said = self.bench("--list")
        self.assertIn("a.toml: is nested too deeply", said.stderr)
        self.assertEqual(said.returncode, 2)


class Flies(InAFolder):
    def test_what_it_was_told_to(self):
        said = self.bench("--case", "deaf", "calm", "--seed", "7", BENCH_RESULTS=self.results(calm()))
        self.assertEqual((said.returncode, said.stderr), (0, ""))
        told = self.told()
        options = dict(zip(told[::2], told[1::2], strict=True))
        self.assertEqual(
            options,
            {
                "--earshotd": str(self.earshotd),
                "--cases": str(self.cases),
                "--mission": str(ROOT / "hil/missions/search_over_can.toml"),
                "--environment": str(ROOT / "sim/ocean/environments/munk_flat.toml"),
                "--interface": "vcan0",
                "--seed": "7",
                "--out": str(self.folder / "out/bench"),
                "--case": "deaf,calm",
            },
        )

    def test_all_cases_without_a_name(self):
        self.bench(BENCH_RESULTS=self.results(calm()))
        self.assertNotIn("--case", self.told())

    def test_the_programs_of_a_folder_that_a_variable_names(self):
        said = subprocess.run(
            [ROOT / "hil/run", "--cases", self.cases],
            cwd=self.folder,
            env=self.environment(EARSHOT_PROGRAMS=str(self.earshotd.parent), BENCH_RESULTS=self.results(calm())),
            capture_output=True,
            text=True,
            check=False,
        )
        self.assertEqual((said.returncode, said.stderr), (0, ""))
        self.assertIn(str(self.earshotd), self.told())

    def test_what_is_over_lcm_where_no_can_bus_can_be_made_and_names_the_rest(self):
        (self.cases / "lost.toml").write_text(
            f'when = "nothing comes"\nmission = "{ROOT}/hil/missions/search_over_lcm.toml"\n'
        )
        without = {"EARSHOT_CAN": "nowhere", "BENCH_RESULTS": self.results(calm() | {"name": "lost"})}
        said = self.bench("--report", "page.html", **without)
        self.assertEqual(said.returncode, 1, "not every case passed")
        can, flown = said.stderr.splitlines()
        self.assertRegex(can, "with-can: EARSHOT_CAN = nowhere: .*here, namespace or uml")
        self.assertRegex(flown, "LCM.* not flown: calm deaf$")
        told = self.told()
        self.assertEqual(told[told.index("--case") + 1], "lost")
        self.assertEqual(self.shown()["not_flown"], ["calm", "deaf"])
        said = self.bench("--case", "calm", **without)
        self.assertEqual(said.returncode, 2)
        self.assertIn("no case is flown; not flown: calm\n", said.stderr)
        self.assertEqual(self.bench("--random", "3", **without).returncode, 2, "these are drawn from all")

    def test_nothing_where_a_case_is_wrong_though_no_can_bus_can_be_made(self):
        said = self.bench(EARSHOT_CAN="nowhere", BENCH_JUDGES="2")
        self.assertEqual((said.returncode, said.stderr), (2, ""))

    def test_random_cases_which_leave_no_results(self):
        said = self.bench("--random", "1000", "--seed", "3")
        self.assertEqual((said.returncode, said.stderr), (0, ""))
        told = self.told()
        self.assertEqual(told[told.index("--random") + 1], "1000")

    def test_and_writes_a_page_and_a_report_of_what_came_of_it(self):
        outputs = ("--report", "out/page.html", "--junit", "out/bench/junit.xml")
        for _ in range(2):  # the second replaces the first's
            said = self.bench(*outputs, BENCH_RESULTS=self.results(calm(), deaf()), BENCH_ENDS="1")
            self.assertEqual((said.returncode, said.stderr), (1, ""))
        page = self.shown("out/page.html")
        self.assertEqual((page["format"], page["cases"], page["not_flown"]), (1, [calm(), deaf()], []))
        self.assertEqual(page["group_names"]["127250"], "VesselHeading")
        flown = r"earshotd 9\.8\.7 \(a stub\), flown by hil/run with seed 1 on a virtual bus \(vcan0\), (.{16}) UTC\."
        found = re.fullmatch(flown, page["made"])
        assert found is not None, page["made"]
        day = datetime.strptime(found[1] + " +0000", "%Y-%m-%d %H:%M %z")
        self.assertLess(abs((datetime.now(UTC) - day).total_seconds()), 300)
        suite = ET.parse(self.folder / "out/bench/junit.xml").getroot()
        self.assertEqual((suite.get("tests"), suite.get("failures")), ("2", "1"))

    @staticmethod
    def end(flying: subprocess.Popen[bytes]) -> None:
        with contextlib.suppress(ProcessLookupError):
            os.killpg(flying.pid, signal.SIGKILL)
        flying.wait()

    def start(self, **environment: str) -> subprocess.Popen[bytes]:
        """A flight that waits for its end; it has begun when this returns."""
        command = [ROOT / "hil/run", "--cases", self.cases, "--earshotd", self.earshotd, "--report", "page.html"]
        flying = subprocess.Popen(
            list(map(str, command)),
            cwd=self.folder,
            env=self.environment(BENCH_ENDS="stop", **environment),
            start_new_session=True,
        )
        self.addCleanup(self.end, flying)
        end = time.monotonic() + 60
        while not (self.folder / "out/bench/waits").exists() and time.monotonic() < end:
            time.sleep(0.02)
        return flying

    def test_until_ctrl_c_and_still_tells_of_what_was_flown(self):
        flying = self.start(BENCH_RESULTS=self.results(calm()))
        os.killpg(flying.pid, signal.SIGINT)
        self.assertEqual(flying.wait(60), 130)
        self.assertEqual(self.shown()["not_flown"], ["deaf"])

    def test_until_its_terminal_is_gone(self):
        flying = self.start(BENCH_RESULTS=self.results(calm()))
        flying.send_signal(signal.SIGHUP)
        self.assertEqual(flying.wait(60), 130)

    def test_and_leaves_no_bench_behind_when_it_is_killed(self):
        flying = self.start()
        bench = int((self.folder / "out/bench/waits").read_text())
        flying.kill()
        flying.wait(60)
        end = time.monotonic() + 60
        while Path(f"/proc/{bench}").exists() and time.monotonic() < end:
            time.sleep(0.02)
        self.assertFalse(Path(f"/proc/{bench}").exists())

    def test_alone_in_its_folder(self):
        flying = self.start()
        said = self.bench("--report", "other.html", BENCH_RESULTS=self.results(calm()))
        os.killpg(flying.pid, signal.SIGINT)
        flying.wait(60)
        self.assertEqual(said.returncode, 2)
        self.assertRegex(said.stderr, "out/bench: another hil/run")
        self.assertFalse((self.folder / "other.html").exists())
        self.assertEqual(self.bench(BENCH_RESULTS=self.results(calm())).returncode, 0, "it is free again")


class Loses(InAFolder):
    def test_a_bench_that_leaves_no_results_and_takes_none_of_an_earlier_run(self):
        self.bench(BENCH_RESULTS=self.results(calm()))
        said = self.bench("--report", "page.html")
        self.assertEqual(said.returncode, 3)
        self.assertIn("earshot-bench left no out/bench/results.json", said.stderr)
        self.assertFalse((self.folder / "page.html").exists())

    def test_the_page_alone_where_the_bench_does_not_make_it(self):
        outputs = ("--report", "page.html", "--junit", "junit.xml")
        said = self.bench(*outputs, BENCH_RESULTS=self.results(calm()), BENCH_MAKES_PAGE="2")
        self.assertEqual(said.returncode, 3)
        self.assertIn("earshot-bench --page ended with status 2", said.stderr)
        self.assertFalse((self.folder / "page.html").exists())
        self.assertTrue((self.folder / "junit.xml").exists())

    def test_a_bench_that_is_killed(self):
        said = self.bench(BENCH_ENDS="killed")
        self.assertEqual(said.returncode, 3)
        self.assertIn("ended with status 137", said.stderr)

    def test_results_that_are_none(self):
        bad = self.folder / "bad.json"
        bad.write_text('{"cases": [{}]}')
        said = self.bench(BENCH_RESULTS=str(bad))
        self.assertEqual(said.returncode, 3)
        self.assertRegex(said.stderr, r"out/bench/results\.json: .*passed is missing")

    def test_the_bus_when_the_bench_does(self):
        self.assertEqual(self.bench(BENCH_ENDS="3").returncode, 3)
        self.assertEqual(self.bench(BENCH_ENDS="2").returncode, 2)


class Refuses(InAFolder):
    def refused(self, *words: object) -> str:
        said = self.bench(*words)
        self.assertEqual((said.returncode, said.stdout), (2, ""), said.stderr)
        self.assertFalse((self.folder / "out/bench/told.json").exists(), "it flew")
        return said.stderr

    def test_a_case_that_is_not_there_and_names_what_is_alike(self):
        self.assertIn("clam.toml; did you mean calm?", self.refused("--case", "deaf", "clam"))
        self.assertIn("none.toml; --list prints all", self.refused("--case", "none"))

    def test_a_folder_without_cases(self):
        self.assertIn("no such folder of cases", self.refused("--cases", self.folder / "none"))
        self.assertIn("holds no case", self.refused("--cases", self.folder))

    def test_a_bus_that_is_not_there_or_is_none(self):
        self.assertIn("there is no such interface", self.refused("--interface", "can77"))
        self.assertIn("there is no such interface", self.refused("--interface", "../../etc"))
        self.assertIn("is no CAN interface", self.refused("--interface", "lo"))

    def test_a_seed_that_is_no_whole_number(self):
        for seed in ("-1", "x", "1.5", str(1 << 63)):
            self.assertRegex(self.refused("--seed", seed), f"{seed} .*0 to 9223372036854775807")

    def test_an_earshotd_that_is_not_there_or_has_no_bench_beside_it(self):
        self.assertIn("none: no such program", self.refused("--earshotd", "none"))
        self.earshotd.with_name("earshot-bench").unlink()
        self.assertIn("it must stand beside the earshotd", self.refused())

    def test_to_replace_what_is_not_its_own(self):
        letter = self.folder / "letter"
        for option, kind in {"--report": "an HTML page", "--junit": "a JUnit report"}.items():
            letter.write_text("mine")
            self.assertIn(f"letter: is not {kind}", self.refused(option, "letter"))
            self.assertEqual(letter.read_text(), "mine")
            self.assertIn("is no regular file", self.refused(option, "cases"))
            self.assertIn("there is no folder", self.refused(option, "no/such/folder"))
        self.assertIn("letter: is no folder", self.refused("--out", "letter"))
        (self.folder / "circle").symlink_to("circle")
        self.assertIn("circle", self.refused("--report", "circle"))
        self.assertIn("circle", self.refused("--out", "circle"))
        self.assertIn("File name too long", self.refused("--out", "x" * 300))
        (self.folder / "results.json").write_text("[" * 100_000)
        self.assertIn("is not what earshot-bench writes", self.refused("--out", "."))
        (self.folder / "results.json").write_text('{"mine": 1}')
        self.assertIn("is not what earshot-bench writes", self.refused("--out", "."))

    def test_a_page_of_random_cases(self):
        self.assertIn("there is no page", self.refused("--random", "5", "--report", "page.html"))
        self.assertIn("is no whole number from 1 to 1000000", self.refused("--random", "0"))

    def test_one_file_for_two(self):
        self.assertIn("must be three files", self.refused("--report", "a", "--junit", "a"))
        self.assertIn("must be three files", self.refused("--report", "out/bench/results.json"))


class Really(InAFolder):
    def install(self, programs: Path) -> Path:
        """As one who copies them, far from the tree that they were built in. Returns its earshotd."""
        installed = self.folder / "copied"
        installed.mkdir()
        for name in ("earshotd", "earshot-bench", "libearshot-simulation.so"):
            shutil.copy(programs / name, installed)
        return installed / "earshotd"

    def test_tells_of_the_case_that_was_flown_before_ctrl_c_even_if_that_kills_user_mode_linux(self):
        if not EARSHOTD:
            self.skipTest("no EARSHOTD was named")
        command = [ROOT / "hil/run", "--earshotd", EARSHOTD, "--case", "compass_lost", "hydrophone_quiet"]
        command += ["--report", "page.html", "--junit", "junit.xml"]
        environment = {key: value for key, value in os.environ.items() if not key.startswith("EARSHOT_PROGRAMS")}
        with subprocess.Popen(
            list(map(str, command)),
            cwd=self.folder,
            env=environment,
            stdout=subprocess.PIPE,
            text=True,
            start_new_session=True,
        ) as flying:
            assert flying.stdout is not None
            self.assertIn("passed compass_lost", flying.stdout.readline())
            time.sleep(1.0)  # of the other's twenty or so
            os.killpg(flying.pid, signal.SIGINT)
            self.assertEqual(flying.wait(60), 130)
        self.assertEqual(self.shown()["not_flown"], ["hydrophone_quiet"])
        suite = ET.parse(self.folder / "junit.xml").getroot()
        self.assertEqual((suite.get("tests"), suite.get("failures"), suite.get("skipped")), ("2", "0", "1"))

    def test_flies_a_case_that_ships_and_that_of_the_readme_on_a_virtual_bus(self):
        if not EARSHOTD:
            self.skipTest("no EARSHOTD was named")
        cases = self.folder / "flown"
        cases.mkdir()
        written = {
            "compass_lost": (ROOT / "hil/cases/compass_lost.toml").read_text(),
            "of_the_readme": (ROOT / "hil/README.md").read_text().split("```toml\n")[1].split("```")[0],
        }
        for name, text in written.items():
            (cases / f"{name}.toml").write_text(text)
        earshotd = self.install(Path(EARSHOTD).parent)
        command = [ROOT / "hil/run", "--earshotd", earshotd, "--cases", cases, "--report", "page.html"]
        command += ["--junit", "junit.xml"]
        environment = {key: value for key, value in os.environ.items() if not key.startswith("EARSHOT_PROGRAMS")}
        flown = subprocess.run(
            list(map(str, command)), cwd=self.folder, env=environment, capture_output=True, text=True, check=False
        )
        self.assertEqual(flown.returncode, 0, flown.stdout + flown.stderr)
        self.assertEqual([case["name"] for case in self.shown()["cases"]], list(written))
        reported = ET.parse(self.folder / "junit.xml").getroot().iter("testcase")
        self.assertEqual([(case.get("name"), case.find("failure")) for case in reported], [(n, None) for n in written])


if __name__ == "__main__":
    EARSHOTD = sys.argv.pop(1) if len(sys.argv) > 1 else ""
    unittest.main()
