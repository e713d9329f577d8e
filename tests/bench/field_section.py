"""Wall seconds of `earshot field`, from the start of the process to its end.

The paper's ocean to 100 km at 300 depths: 2.4 million values. A section with gaps, or of less, is none (wrong: half as
far). In short once.

usage: field_section.py PROGRAM          the whole command, best of five
       field_section.py PROGRAM peer     netCDF4-python writes loss and SNR of the same section, zlib 1 and shuffle, at
                                         full precision
"""

import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import netCDF4
import numpy as np

OCEAN = Path(__file__).parents[2] / "sim/ocean/environments/munk_flat.toml"
RUNS = 1 if "EARSHOT_BENCH_SHORT" in os.environ else 5
FURTHEST_KM = 50 if "EARSHOT_BENCH_WRONG" in os.environ else 100

LIBRARY = f"""name = "one section"
environment = "{OCEAN}"
source_depth_m = [30.0]
receiver_depth_m = {[10.0 * i for i in range(1, 300)] + [3000.0]}
[positions]
layout = "list"
north_m = [0.0]
east_m = [0.0]
[radials]
count = 1
max_range_km = 100.0
range_step_m = 12.5
"""


def run(*arguments) -> float:
    start = time.monotonic()
    subprocess.run([sys.argv[1], *map(str, arguments)], check=True, stdout=sys.stderr)
    return time.monotonic() - start


def full_precision_loss(folder: Path) -> np.ndarray:
    """[range x depth] as `earshot field --library` keeps it: not rounded."""
    (folder / "library.toml").write_text(LIBRARY)
    run("--library", folder / "library.toml", "-o", folder / "library.nc")
    with netCDF4.Dataset(folder / "library.nc") as data:
        return np.asarray(data["transmission_loss"][0, 0])


def write(path: Path, arrays: dict[str, np.ndarray]) -> float:
    start = time.monotonic()
    with netCDF4.Dataset(path, "w") as data:
        for name, length in zip(("range", "depth"), arrays["transmission_loss"].shape, strict=True):
            data.createDimension(name, length)
        for name, values in arrays.items():
            data.createVariable(name, "f4", ("range", "depth"), zlib=True, complevel=1, shuffle=True)[:] = values
    return time.monotonic() - start


def require_whole(path: Path) -> None:
    """It has a loss at nearly each of its places, at every depth and as far as was asked."""
    with netCDF4.Dataset(path) as data:
        loss_db = np.ma.filled(data["transmission_loss"][:].astype(float), np.nan)
        furthest_km = 1e-3 * float(data["range"][-1])
    values = int(np.count_nonzero(np.isfinite(loss_db)))
    if furthest_km < 99.0 or values < 0.9 * 2_400_000:
        sys.exit(f"the section has {values} values of 2400000, and reaches {furthest_km:g} km of 100")


with tempfile.TemporaryDirectory() as name:
    file = Path(name) / "field.nc"
    if sys.argv[2:] == ["peer"]:
        loss_db = full_precision_loss(Path(name))
        arrays = {"transmission_loss": loss_db, "snr": np.float32(100.0) - loss_db}
        seconds = min(write(file, arrays) for _ in range(RUNS))
    else:
        seconds = min(run(OCEAN, "--max-range-km", FURTHEST_KM, "--depth-spacing", 10, "-o", file) for _ in range(RUNS))
        require_whole(file)
    print(f"{file.stat().st_size / 1e6:.1f} MB", file=sys.stderr)
print(json.dumps({"value": seconds}))
