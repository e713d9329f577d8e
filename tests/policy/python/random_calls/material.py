"""The files and objects that random calls are given.

Used as a module beside it.
"""

import os
import subprocess
import wave
from pathlib import Path
from typing import Any

import numpy as np

import earshot

ROOT = Path(__file__).resolve().parents[4]
TABLES = ROOT / "policy/tables/shipped/20hz_300m.tables"
POLICY = ROOT / "policy/frozen/shipped.policy"


class Material:
    """Good ones, made in a folder."""

    def __init__(self, programs: Path, folder: Path) -> None:
        self.folder = folder
        self.shallow = earshot.Environment(**self.ocean())
        self.toml = folder / "shallow.toml"
        self.toml.write_text(self.shallow.to_toml())
        self.sound = earshot.field(
            self.shallow, frequency=[40.0, 60.0], max_range=600.0, receiver_depth=[20.0, 50.0, 80.0]
        )
        self.one = self.sound.isel(frequency=0)
        self.library = ROOT / "policy/worlds/oceans/hilly.nc"
        self.journal = self._flown(programs)
        self.selections = folder / "marks.txt"
        self.selections.write_text("Begin Time (s)\tEnd Time (s)\tLow Freq (Hz)\n12.0\t13.0\t15\n20.5\t21\t16\n")
        rng = np.random.default_rng(1)
        self.noise = 0.02 * rng.standard_normal(130 * 200)
        self.heard = earshot.listen(self.noise, 200.0, threshold_db=0.0)
        self.wav = folder / "noise.wav"
        self._write_wav()

    def ocean(self) -> dict[str, Any]:
        """Arguments of an Environment."""
        return {
            "sound_speed": 1_500.0,
            "bathymetry": 100.0,
            "sediment": earshot.Layer(1_700.0),
            "frequency": 40.0,
            "source_depth": 30.0,
            "source_level": 180.0,
            "noise_level": 90.0,
        }

    def _flown(self, programs: Path) -> Path:
        """The journal of a flight; the program is none of Python's, and is not watched as Python is."""
        without = {name: value for name, value in os.environ.items() if name != "LD_PRELOAD"}
        command = [str(programs / "earshot-fly"), "--quiet", "--no-report", "--out", str(self.folder / "flight")]
        subprocess.run(command, check=True, cwd=ROOT, env=without, capture_output=True)
        file = self.folder / "flight/journal.lcmlog"
        file.write_bytes(file.read_bytes()[:400_000])  # all of it takes pandas half a minute where memory is watched
        return file

    def _write_wav(self) -> None:
        with wave.open(str(self.wav), "wb") as file:
            file.setparams((1, 2, 200, 0, "NONE", ""))
            file.writeframes((self.noise * 32_767.0).astype("<i2").tobytes())
