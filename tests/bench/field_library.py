"""Wall seconds of `earshot field --library`, to a file on the disk.

64 sources x 72 radials x 25 km at 20 Hz over charted hills, at 0.1 dB.

usage: field_library.py PROGRAM
"""

import json
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "policy/worlds/oceans"))
from hills import depth_m  # noqa: E402

OCEAN = ROOT / "tests/sim/sonar/hilly.toml"

LIBRARY = """name = "64 sources"
environment = "ocean.toml"
source_depth_m = [30.0]
receiver_depth_m = [300.0]
[positions]
layout = "grid"
north_m = [-21000, -15000, -9000, -3000, 3000, 9000, 15000, 21000]
east_m = [-21000, -15000, -9000, -3000, 3000, 9000, 15000, 21000]
[radials]
count = 72
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


with tempfile.TemporaryDirectory() as folder:
    for name, text in {"chart.csv": chart(), "ocean.toml": OCEAN.read_text(), "library.toml": LIBRARY}.items():
        (Path(folder) / name).write_text(text)
    start = time.monotonic()
    command = [sys.argv[1], "--library", f"{folder}/library.toml", "-o", f"{folder}/library.nc"]
    subprocess.run(command, check=True, stdout=sys.stderr)
    wall_s = time.monotonic() - start
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
peak_mib = usage.ru_maxrss / 1024
print(f"library: {usage.ru_utime:.1f} s of processor time, peak memory {peak_mib:.0f} MiB", file=sys.stderr)
print(json.dumps({"value": wall_s}))
