"""Wall seconds of `earshot field --library`, to a file on the disk.

64 sources x 72 radials x 25 km at 20 Hz over charted hills, at 0.1 dB; in short one source and 8 radials.
A library without loss in it is none (wrong: its vehicle is below the sea floor).

usage: field_library.py PROGRAM
"""

import json
import os
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "policy/worlds/oceans"))
import netCDF4  # noqa: E402
import numpy as np  # noqa: E402

from hills import depth_m  # noqa: E402

OCEAN = ROOT / "tests/sim/sonar/hilly.toml"

IS_SHORT = "EARSHOT_BENCH_SHORT" in os.environ
PLACES = [3000] if IS_SHORT else [-21000, -15000, -9000, -3000, 3000, 9000, 15000, 21000]
RADIALS = 8 if IS_SHORT else 72
RECEIVER_DEPTH_M = 9000.0 if "EARSHOT_BENCH_WRONG" in os.environ else 300.0

LIBRARY = f"""name = "64 sources"
environment = "ocean.toml"
source_depth_m = [30.0]
receiver_depth_m = [{RECEIVER_DEPTH_M}]
[positions]
layout = "grid"
north_m = {PLACES}
east_m = {PLACES}
[radials]
count = {RADIALS}
max_range_km = 25.0
range_step_m = 50.0
accuracy_db = 0.1
"""


def chart() -> str:
    """The hills of the world hilly, a node every 1.1 km."""
    lines = ["latitude_deg,longitude_deg,elevation_m"]
    for i in range(-50, 51):
        for j in range(-50, 51):
            lines.append(f"{0.01 * i:.4f},{0.0106 * j:.4f},{-depth_m(i * 1.112, j * 1.179):.1f}")
    return "\n".join(lines) + "\n"


def require_filled(path: Path) -> None:
    """Every source has its radials, and nearly every place of them a loss: some hills come near the vehicle's depth."""
    with netCDF4.Dataset(path) as data:
        loss_db = np.ma.filled(data["transmission_loss"][:].astype(float), np.nan)
    # 500 places of 50 m in 25 km
    wanted = len(PLACES) ** 2 * RADIALS * 500
    plausible = int(np.count_nonzero((loss_db > 30.0) & (loss_db < 200.0)))
    if plausible < 0.9 * wanted:
        sys.exit(f"the library has a loss at {plausible} places of {wanted}")


with tempfile.TemporaryDirectory() as folder:
    for name, text in {"chart.csv": chart(), "ocean.toml": OCEAN.read_text(), "library.toml": LIBRARY}.items():
        (Path(folder) / name).write_text(text)
    start = time.monotonic()
    command = [sys.argv[1], "--library", f"{folder}/library.toml", "-o", f"{folder}/library.nc"]
    status = subprocess.run(command, check=False, stdout=sys.stderr).returncode
    wall_s = time.monotonic() - start
    if status != 0:
        sys.exit(f"earshot field: status {status}")
    require_filled(Path(folder) / "library.nc")
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
peak_mib = usage.ru_maxrss / 1024
print(f"library: {usage.ru_utime:.1f} s of processor time, peak memory {peak_mib:.0f} MiB", file=sys.stderr)
print(json.dumps({"value": wall_s}))
