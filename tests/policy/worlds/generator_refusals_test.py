"""What the generator of worlds refuses, and what it leaves. usage: generator_refusals_test.py FOLDER_OF_PROGRAMS"""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "policy/worlds/generator"))
import output
from refusal import Refusal

ROOT = Path(__file__).resolve().parents[3]
PROGRAMS = Path(sys.argv.pop())
PAPERS = ROOT / "sim/ocean/environments/munk_flat.toml"
GENERATE = str(ROOT / "policy/worlds/generate")
OURS = f"{output.MADE_BY} --variants-of munk_flat.toml. Never edit it.\n"


class InFolder(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory(prefix="earshot-test-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.out = self.folder / "worlds"

    def generate(self, *words: object) -> subprocess.CompletedProcess[str]:
        """Runs in the folder. A pipe that is waited for would last longer than 20 seconds."""
        command = [GENERATE, *(str(word) for word in words)]
        return subprocess.run(
            command, capture_output=True, text=True, check=False, cwd=self.folder, timeout=20, stdin=subprocess.DEVNULL
        )

    def variants(self, output_folder: object, *words: object) -> subprocess.CompletedProcess[str]:
        return self.generate("--variants-of", PAPERS, "-o", output_folder, *words)

    def refused(self, done: subprocess.CompletedProcess[str], *complaints: str) -> None:
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        for complaint in complaints:
            self.assertIn(complaint, done.stderr)

    def left(self) -> list[str]:
        return sorted(str(path.relative_to(self.folder)) for path in self.folder.rglob("*"))


class Environments(InFolder):
    def test_a_number_that_no_ocean_has_is_refused_with_its_key_value_and_range(self) -> None:
        table = PAPERS.read_text().replace('profile = "munk"', 'profile = "table"\nsound_speed_mps = [1500.0, 1520.0]')
        for text, old, new, complaint in [
            (None, "depth_m = 3000.0", "depth_m = nan", "[seabed] depth_m: nan: must be above 0, at most 12000"),
            (None, "depth_m = 3000.0", "depth_m = 20.0", "[source] depth_m: 30.0: must be above the sea floor, 20"),
            (None, "depth_m = 30.0", "depth_m = -5.0", "[source] depth_m: -5.0: must be above 0, at most 12000"),
            (None, "= 20.0", '= "20"', "[source] frequency_hz: '20': must be a number, 1 to 10000"),
            (None, "= 20.0", "= true", "[source] frequency_hz: True: must be a number, 1 to 10000"),
            (None, "1505.0", f"{10**400}", "[seabed.layers] sound_speed_mps: "),
            (None, "= 1.5 ", "= inf ", "[seabed.layers] density_g_per_cm3: inf: must be 0.5 to 20"),
            (None, "perturbation = 0.00737", "perturbation = 0.2", "[water] perturbation: 0.2: must be 0 to 0.1"),
            (None, "scale_m = 1300.0", "scale_m = 1e-9", "sound_speed_mps"),
            (table, "[water]", "[water]\ndepth_m = [0.0, 2000.0]", "[water] depth_m: ends at 2000.0"),
            (table, "[water]", "[water]\ndepth_m = [0.0, -1.0]", "[water] depth_m, value 2: -1.0: must be 0 to 12000"),
            (table, "[water]", "[water]\ndepth_m = [0.0]", "[water] sound_speed_mps: 2 values: must be 1"),
            (table, "[water]", "[water]\ndepth_m = 3", "[water] depth_m: 3: must be a list of numbers"),
        ]:
            file = self.folder / "ocean.toml"
            file.write_text((text or PAPERS.read_text()).replace(old, new, 1))
            self.refused(self.generate("--variants-of", file, "-o", self.out), f"--variants-of {file}: ", complaint)
            self.assertEqual(self.left(), ["ocean.toml"])

    def test_only_a_regular_file_of_a_size_that_environments_have_is_read(self) -> None:
        pipe, large = self.folder / "pipe", self.folder / "large.toml"
        os.mkfifo(pipe)
        large.write_text(PAPERS.read_text() + "#" * 1_000_000)
        for file, complaint in [
            (pipe, "no regular file"),
            (Path("/dev/zero"), "no regular file"),
            (self.folder, "s a directory"),
            (large, "longer than 1000000 bytes"),
        ]:
            self.refused(self.generate("--variants-of", file, "-o", self.out), f"--variants-of {file}: ", complaint)

    def test_a_name_with_quotation_marks_is_text_in_every_variant(self) -> None:
        file = self.folder / "ocean.toml"
        file.write_text(PAPERS.read_text().replace('"Munk profile over a flat floor"', '"a \\"duct\\""'))
        done = self.generate("--variants-of", file, "-o", self.out)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn('name = "a \\"duct\\": over_basalt"\n', (self.out / "over_basalt.toml").read_text())


class Folders(InFolder):
    def test_a_folder_that_cannot_be_made_is_said_in_one_line(self) -> None:
        (self.folder / "file").write_text("mine")
        for name, complaint in [
            ("file", "file: is there and no folder"),
            ("file/x", "file/x: Not a directory"),
            ("/proc/x", "/proc/x: No such file or directory"),
            ("x" * 300, "File name too long"),
        ]:
            self.refused(self.variants(name), complaint)
        for name in ("", ".", "..", "file/..", "/"):
            done = self.variants(name)
            self.assertEqual(done.returncode, 2)
            self.assertIn(f"--output: {name!r}: must name a folder", done.stderr)
        self.assertEqual(self.left(), ["file"])

    def test_a_name_as_long_as_names_can_be_is_written(self) -> None:
        self.assertEqual(self.variants("x" * 255).returncode, 0)
        self.assertEqual([path.name for path in self.folder.iterdir()], ["x" * 255])

    def test_folders_above_one_that_is_refused_are_not_left(self) -> None:
        self.refused(self.generate("--variants-of", "none.toml", "-o", "a/b/c"), "none.toml")
        self.assertEqual(self.left(), [])

    def test_what_others_put_into_a_folder_is_never_replaced(self) -> None:
        self.assertEqual(self.variants(self.out).returncode, 0)
        theirs = self.out / "theirs"
        for put, take in [
            (theirs.mkdir, theirs.rmdir),
            ((self.out / "oceans").mkdir, (self.out / "oceans").rmdir),
            (lambda: os.mkfifo(theirs), theirs.unlink),
            (lambda: theirs.symlink_to("nowhere"), theirs.unlink),
            (lambda: theirs.symlink_to(PAPERS), theirs.unlink),
        ]:
            put()
            before = self.left()
            self.refused(self.variants(self.out, "--force"), f"{self.out}: holds what was not made here")
            self.assertEqual(self.left(), before)
            take()
        self.assertEqual(self.variants(self.out, "--force").returncode, 0)

    def test_what_others_put_there_meanwhile_is_not_replaced_either(self) -> None:
        for force in (False, True):
            with self.assertRaisesRegex(Refusal, "not made here"), output.whole(self.out, force) as made:
                (made / "a.toml").write_text(OURS)
                self.out.mkdir(exist_ok=True)
                (self.out / "letter.txt").write_text("mine")
            self.assertEqual(self.left(), ["worlds", "worlds/letter.txt"])
            (self.out / "letter.txt").unlink()

    def test_what_was_there_comes_back_when_the_new_cannot_be_put_there(self) -> None:
        self.out.mkdir()
        (self.out / "old.toml").write_text(OURS)
        with self.assertRaises(FileNotFoundError), output.whole(self.out, True) as made:
            made.rmdir()
        self.assertEqual(self.left(), ["worlds", "worlds/old.toml"])

    def test_nothing_is_left_beside_when_it_is_asked_to_stop(self) -> None:
        for number in (signal.SIGTERM, signal.SIGINT):
            command = [GENERATE, "--bank", "10000", "-o", str(self.out), "--bin", str(PROGRAMS)]
            running = subprocess.Popen(command, stderr=subprocess.PIPE, text=True, start_new_session=True)
            until = time.monotonic() + 20
            while not list(self.folder.glob(".worlds.*/made/*")) and time.monotonic() < until:
                time.sleep(0.02)
            running.send_signal(number)
            _, said = running.communicate(timeout=20)
            self.assertEqual((running.returncode, said), (128 + number, ""))
            self.assertEqual(self.left(), [])


if __name__ == "__main__":
    unittest.main()
