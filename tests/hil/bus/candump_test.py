"""earshot candump as a person types it, on files; with --can also beside can-utils on vcan0.

usage: candump_test.py EARSHOT_CANDUMP [--can]
"""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

PROGRAM = ""
ROOT = Path(__file__).resolve().parents[3]
LINES = [
    "(1436509052.249713) can0 09F8017F#50C3B81347D82BC6",
    "(1436509052.349713) can0 09F1127F#FF705AFF7FFF7FFD",
    "(1436509052.449713) can0 09F11280#FF705AFF7FFF7FFD",
]


def candump(*arguments: str, given: str | None = None) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [PROGRAM, *arguments],
        check=False,
        input=given,
        capture_output=True,
        text=True,
        timeout=60,
        env={**os.environ, "TZ": "UTC0"},
    )


def wait_for(what, why: str) -> None:
    """Until what() is true; a minute is long enough for a machine that has other things to do."""
    end = time.monotonic() + 60
    while not what():
        if time.monotonic() > end:
            raise AssertionError(why)
        time.sleep(0.02)


class InAFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def write(self, name: str, text: str) -> str:
        path = self.folder / name
        path.write_text(text)
        return str(path)


class Reads(InAFolder):
    def test_a_log_and_standard_input_alike(self):
        text = "\n".join(LINES) + "\n"
        read = candump(self.write("sea.log", text))
        self.assertEqual(read.returncode, 0)
        self.assertEqual(
            read.stdout.splitlines()[0],
            "1436509052.249713 can0 127: 129025 PositionRapidUpdate: Latitude = 33.0875728 deg, "
            "Longitude = -97.0205113 deg",
        )
        self.assertEqual(candump("-", given=text).stdout, read.stdout)

    def test_only_what_is_asked_for(self):
        log = self.write("sea.log", "\n".join(LINES) + "\n")

        def said(*options: str) -> list[tuple[int, int]]:
            printed = candump(log, "--format", "json", *options).stdout.splitlines()
            return [(line["source"], line["pgn"]) for line in map(json.loads, printed)]

        self.assertEqual(said("--pgn", "127250"), [(127, 127250), (128, 127250)])
        self.assertEqual(said("--source", "128"), [(128, 127250)])
        self.assertEqual(said("--pgn", "127250,129025", "--source", "127"), [(127, 129025), (127, 127250)])
        self.assertEqual(said("--count", "1"), [(127, 129025)])
        self.assertEqual(said("--source", "128", "--count", "1"), [(128, 127250)])

    def test_past_damaged_lines_and_says_where_they_are(self):
        log = self.write("sea.log", f"{LINES[0]}\n\nnonsense\n{LINES[1]}\n{LINES[2][:-1]}")
        read = candump(log)
        self.assertEqual(read.returncode, 1)
        self.assertEqual(len(read.stdout.splitlines()), 2)
        self.assertIn(f"{log}:3: no frame; passed over\n", read.stderr)
        self.assertIn(f"{log}:5: data are up to 8 bytes", read.stderr)
        self.assertIn("2 damaged lines, 2 frames, 2 messages", read.stderr)

    def test_comments_explanations_and_lost_frames_as_no_damage(self):
        error = "  can0  20000004   [8]  00 04 00 00 00 00 00 00   ERRORFRAME\n\tcontroller-problem{rx-overflow}\n"
        lost = "DROPCOUNT: dropped 3 CAN frames on 'can0' socket (total drops 3)\n"
        log = self.write("sea.log", f"# of the trial\n\n{LINES[0]}\n{error}{lost}{LINES[1]}\n")
        read = candump(log)
        self.assertEqual((read.returncode, len(read.stdout.splitlines())), (0, 2), read.stderr)
        self.assertIn(": 3 frames, 2 messages", read.stderr)
        self.assertIn("3 frames lost by who recorded", read.stderr)
        self.assertIn("3 frames lost by who recorded", candump(log, "--quiet").stderr)

    def test_what_a_gateway_of_yacht_devices_writes(self):
        raw = "17:33:21.107 R 09F11223 FF 70 5A FF 7F FF 7F FD\r\n17:33:21.141 R 09F80123 00 E1 F5 05 00 C2 EB 0B\r\n"
        out = self.folder / "out.log"
        read = candump("-", "--record", str(out), given=raw)
        self.assertEqual(read.returncode, 0, read.stderr)
        self.assertIn("Heading = 2.3152 rad", read.stdout)
        # (17 * 60 + 33) * 60 + 21 s after midnight.
        self.assertEqual(out.read_text().splitlines()[0], "(0000063201.107000) can0 09F11223#FF705AFF7FFF7FFD")

    def test_what_canboat_put_together_and_records_the_frames_that_it_came_of(self):
        # A list of groups (126464), 1 + 5 * 3 bytes; a heading; and what is too long for a fast packet.
        list_ = "2020-08-22T13:52:52.882Z,6,126464,35,255,16,00,01,f8,01,02,f8,01,03,f8,01,04,f8,01,05,f8,01"
        heading = "2020-08-22T13:52:52.932Z,2,127250,35,255,8,ff,70,5a,ff,7f,ff,7f,fd"
        long = "2020-08-22T13:52:53.000Z,6,129540,35,255,1785," + ",".join(["00"] * 1785)
        out = self.folder / "out.log"
        read = candump("-", "--record", str(out), given=f"# format=FAST\n{list_}\n{heading}\n{long}\n")
        self.assertEqual(read.returncode, 0, read.stderr)
        self.assertIn("PGN[4] = 129029", read.stdout)
        self.assertIn("Heading = 2.3152 rad", read.stdout)
        self.assertRegex(read.stderr, r"1 message too long.*; 4 frames")
        self.assertEqual(
            [line.split()[2] for line in out.read_text().splitlines()],
            [
                "19EEFF23#00100001F80102F8",
                "19EEFF23#010103F80104F801",
                "19EEFF23#0205F801FFFFFFFF",
                "09F11223#FF705AFF7FFF7FFD",
            ],
        )
        again = candump(str(out)).stdout
        self.assertEqual(again, "".join(read.stdout.splitlines(keepends=True)[:2]))

    def test_traces_of_other_recorders(self):
        for name, text in (
            ("pcan.trc", ";$FILEVERSION=1.1\n     1)  48.6  Rx  09F11223  8  FF 70 5A FF 7F FF 7F FD \n"),
            ("vector.asc", "base hex  timestamps absolute\n 0.0 1 9F11223x  Rx  d 8 FF 70 5A FF 7F FF 7F FD\n"),
            ("savvy.csv", "Time Stamp,ID,Extended,Bus,LEN,D1,D2,D3\n1,09F11223,true,0,3,FF,70,5A,\n"),
            ("old.txt", "<0x09f11223> [8] ff 70 5a ff 7f ff 7f fd \n"),
        ):
            with self.subTest(name=name):
                read = candump(self.write(name, text))
                self.assertEqual(read.returncode, 0, read.stderr)
                self.assertIn("Heading = 2.3152 rad", read.stdout)

    def test_names_a_format_that_it_does_not_read_before_anything_is_replaced(self):
        out = self.write("out.log", LINES[0] + "\n")
        for text, name in (
            ("timestamp,arbitration_id,extended,remote,error,dlc,data\n1.0,0x9f11223,1,0,0,1,/w==\n", "python-can"),
            ("LOGG\x01\x02", "BLF"),
        ):
            with self.subTest(name=name):
                refused = candump(self.write("other", text), "--record", out, "--replace")
                self.assertEqual((refused.returncode, refused.stdout), (2, ""))
                self.assertIn(f"{self.folder}/other: is a", refused.stderr)
                self.assertIn(name, refused.stderr)
                self.assertEqual(Path(out).read_text(), LINES[0] + "\n")

    def test_quietly_and_tells_damage_all_the_same(self):
        self.assertEqual(candump(self.write("a", LINES[0]), "--quiet").stderr, "")
        bad = candump(self.write("b", LINES[0] + "\nx\n"), "--quiet")
        self.assertEqual((bad.returncode, bad.stdout), (1, ""))
        self.assertIn("b:2: ", bad.stderr)

    def test_a_file_of_something_else_without_telling_of_every_line(self):
        read = candump(self.write("noise", "x y z\n" * 5000))
        self.assertEqual((read.returncode, read.stdout), (2, ""))
        self.assertRegex(read.stderr, rf"^{self.folder}/noise: [^\n]* 5000 lines none [^\n]*\n$")

    def test_a_file_of_something_else_before_it_replaces_a_recording(self):
        older = self.write("sea.log", LINES[0] + "\n")
        read = candump(self.write("README.md", "# A page\n\nof words\nand more\n"), "--record", older, "--replace")
        self.assertEqual((read.returncode, read.stdout), (2, ""))
        self.assertRegex(read.stderr, r"README\.md: .* 4 lines none")
        self.assertEqual(Path(older).read_text(), LINES[0] + "\n")

    def test_much_that_is_damaged_behind_a_line_of_a_log_without_telling_of_every_line(self):
        read = candump(self.write("noise", LINES[0] + "\n" + "x y z\n" * 5000))
        self.assertEqual(read.returncode, 1)
        self.assertLess(len(read.stderr.splitlines()), 110)
        self.assertIn("5000 damaged lines", read.stderr)

    def test_refuses_what_it_cannot_do(self):
        log = self.write("sea.log", LINES[0])
        for arguments in (
            [str(self.folder / "none")],
            ["no-such-can"],
            [log, "--pgn", "300000"],
            [log, "--pgn", "x"],
            [log, "--source", "256"],
            [log, "--replace"],
            [log, "--format", "xml"],
        ):
            with self.subTest(arguments=arguments):
                self.assertEqual(candump(*arguments).returncode, 2)

    def test_says_that_nobody_takes_what_it_prints(self):
        with Path("/dev/full").open("w") as full:
            done = subprocess.run(
                [PROGRAM, self.write("log", LINES[0] + "\n")],
                check=False,
                stdout=full,
                stderr=subprocess.PIPE,
                text=True,
            )
        self.assertEqual(done.returncode, 3)
        self.assertEqual(done.stderr, "earshot candump: standard output cannot be written\n")


class Records(InAFolder):
    def test_what_the_screen_showed_as_a_log(self):
        shown = " (1436509052.249713)  can0  09F8017F   [8]  50 C3 B8 13 47 D8 2B C6\n  can0       123   [2]  01 02\n"
        out = self.folder / "out.log"
        self.assertEqual(candump("-", "--record", str(out), "--quiet", given=shown).returncode, 0)
        self.assertEqual(out.read_text(), LINES[0] + "\n")

    def test_nothing_over_another_file_unless_told_to(self):
        log = self.write("sea.log", LINES[0] + "\n")
        thesis = self.write("thesis", "all my work")
        refused = candump(log, "--record", thesis)
        self.assertEqual((refused.returncode, refused.stdout), (2, ""))
        self.assertIn("--replace", refused.stderr)
        self.assertEqual(Path(thesis).read_text(), "all my work")
        self.assertEqual(candump(log, "--record", log).returncode, 2)
        self.assertEqual(candump(log, "--record", thesis, "--replace").returncode, 0)
        self.assertEqual(Path(thesis).read_text(), LINES[0] + "\n")

    def test_never_the_file_that_is_being_read(self):
        log = self.write("sea.log", LINES[0] + "\n")
        hard = self.folder / "hard.log"
        hard.hardlink_to(log)
        for record in (log, str(hard)):
            refused = candump(log, "--record", record, "--replace")
            self.assertEqual(refused.returncode, 2)
            self.assertIn(f"INPUT {log}, --record {record}: the same file", refused.stderr)
            with Path(log).open() as given:
                from_shell = subprocess.run(
                    [PROGRAM, "-", "--record", record, "--replace"],
                    check=False,
                    stdin=given,
                    capture_output=True,
                    text=True,
                    timeout=60,
                )
            self.assertEqual(from_shell.returncode, 2, from_shell)
            self.assertIn(f"--record {record}: the same file", from_shell.stderr)
        self.assertEqual(Path(log).read_text(), LINES[0] + "\n")

    def test_whole_lines_on_a_full_disk_and_says_so(self):
        log = self.write("sea.log", (LINES[0] + "\n") * 1000)
        out = self.folder / "out.log"
        script = f'ulimit -f 4; exec "{PROGRAM}" "{log}" --record "{out}" --quiet'
        done = subprocess.run(["bash", "-c", script], check=False, capture_output=True, text=True)
        self.assertEqual(done.returncode, 3)
        self.assertIn("cannot be written", done.stderr)
        # 4096 bytes hold 80 lines of 51.
        self.assertEqual(out.read_text(), (LINES[0] + "\n") * 80)

    def test_whole_lines_but_perhaps_the_last_however_often_it_is_killed(self):
        for attempt in range(20):
            out = self.folder / f"{attempt}.log"
            with subprocess.Popen([PROGRAM, "-", "--record", str(out), "--quiet"], stdin=subprocess.PIPE) as program:
                assert program.stdin is not None
                for _ in range(attempt + 1):
                    program.stdin.write(((LINES[0] + "\n") * 50).encode())
                    program.stdin.flush()
                wait_for(lambda path=out: path.exists() and path.stat().st_size > 0, "nothing was recorded")
                program.kill()
            # The kernel may end a write between two pages.
            *whole, last = out.read_text().split("\n")
            self.assertEqual(set(whole), {LINES[0]})
            self.assertTrue(LINES[0].startswith(last), last)


class OnABus(InAFolder):
    """Beside can-utils."""

    def record(self, *options: str) -> subprocess.Popen[str]:
        out = self.folder / "out.log"
        program = subprocess.Popen(
            [PROGRAM, "vcan0", "--record", str(out), *options],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        self.addCleanup(program.wait)
        self.addCleanup(program.kill)
        # Made once the program listens.
        wait_for(out.exists, "no recording was begun")
        return program

    def test_decodes_and_records_what_candump_logs(self):
        theirs = self.folder / "theirs.log"
        with theirs.open("w") as file, subprocess.Popen(["candump", "-L", "vcan0"], stdout=file) as peer:
            program = self.record()
            sent = [line.split()[2] for line in LINES]
            for frame in sent:
                subprocess.run(["cansend", "vcan0", frame], check=True)
            out = self.folder / "out.log"
            wait_for(lambda: len(out.read_text().splitlines()) == 3, "not all was recorded")
            wait_for(lambda: len(theirs.read_text().splitlines()) == 3, "candump has not heard all")
            program.send_signal(signal.SIGINT)
            printed, complaints = program.communicate()
            peer.terminate()
        self.assertEqual(program.returncode, 0, complaints)
        self.assertEqual(out.read_text(), theirs.read_text())
        self.assertEqual(len(printed.splitlines()), 3)
        self.assertIn("3 frames recorded", complaints)

    def test_records_what_canplayer_plays_and_log2asc_reads(self):
        log = self.write("sea.log", "\n".join(LINES) + "\n")
        program = self.record("--quiet", "--count", "3")
        subprocess.run(["canplayer", "-I", log, "vcan0=can0"], check=True)
        program.communicate()
        self.assertEqual(program.returncode, 0)
        recorded = (self.folder / "out.log").read_text().splitlines()
        self.assertEqual([line.split()[2] for line in recorded], [line.split()[2] for line in LINES])
        text = subprocess.run(
            ["log2asc", "-I", str(self.folder / "out.log"), "vcan0"], capture_output=True, text=True, check=True
        ).stdout
        self.assertIn("9F8017Fx", text)

    def test_leaves_whole_lines_and_at_most_the_beginning_of_one_when_it_is_killed(self):
        program = self.record("--quiet")
        with subprocess.Popen(["cangen", "vcan0", "-e", "-g", "0", "-n", "3000"]) as sender:
            out = self.folder / "out.log"
            wait_for(lambda: out.stat().st_size > 5000, "nothing was recorded")
            program.kill()
            sender.wait()
        *whole, rest = out.read_text().split("\n")
        for line in whole:
            self.assertRegex(line, r"^\(\d+\.\d+\) vcan0 [0-9A-F]{8}#[0-9A-F]*$")
        # The kernel may end a write between two pages: then one more line has begun.
        self.assertEqual(candump(str(out), "--quiet").returncode, 1 if rest else 0)

    def test_goes_on_after_the_interface_was_down(self):
        program = self.record("--quiet")
        out = self.folder / "out.log"
        subprocess.run(["cansend", "vcan0", "09F8017F#01"], check=True)
        wait_for(lambda: out.stat().st_size > 0, "nothing was recorded")
        subprocess.run(["ip", "link", "set", "vcan0", "down"], check=True)
        time.sleep(0.5)
        subprocess.run(["ip", "link", "set", "vcan0", "up"], check=True)

        def is_heard() -> bool:
            subprocess.run(["cansend", "vcan0", "09F8017F#02"], check=False)
            return "09F8017F#02" in out.read_text()

        wait_for(is_heard, "not a frame was recorded after the interface had come up again")
        program.terminate()
        program.communicate()
        self.assertEqual(program.returncode, 0)


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    cases = [OnABus] if "--can" in sys.argv else [Reads, Records]
    suite = unittest.TestSuite(unittest.defaultTestLoader.loadTestsFromTestCase(case) for case in cases)
    sys.exit(not unittest.TextTestRunner(verbosity=2).run(suite).wasSuccessful())
