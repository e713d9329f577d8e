"""Wall seconds of `earshot field --library`: 64 sources x 72 radials x 25 km at 20 Hz over charted hills at 0.1 dB, to a file on the disk.

usage: field_library.py PROGRAM
"""

import json
import math
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

OCEAN = """name = "hills"
[origin]
latitude_deg = 45.0
longitude_deg = -20.0
[source]
frequency_hz = 20.0
level_db_re_1upa_at_1m = 190.0
depth_m = 30.0
north_m = 0.0
east_m = 0.0
[noise]
level_db_re_1upa = 90.0
[water]
profile = "munk"
axis_sound_speed_mps = 1500.0
axis_depth_m = 1300.0
scale_m = 1300.0
perturbation = 0.00737
[bathymetry]
layout = "grid_csv"
file = "chart.csv"
[seabed]
[[seabed.layers]]
sound_speed_mps = 1600.0
density_g_per_cm3 = 1.8
attenuation_db_per_wavelength = 0.5
"""

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
    """Hills of 300 m, 19 km from crest to crest, on hills of 150 m: slopes up to 14 percent; a node every 1.1 km."""
    lines = ["latitude_deg,longitude_deg,elevation_m"]
    for i in range(-50, 51):
        for j in range(-50, 51):
            north, east = i * 1.112, j * 0.015 * 111.2 * math.cos(math.radians(45))
            depth = 2500 + 300 * math.sin(east / 3 + 0.5 * math.sin(north / 7)) + 150 * math.sin(north / 1.8)
            lines.append(f"{45 + 0.01 * i:.3f},{-20 + 0.015 * j:.3f},{-depth:.1f}")
    return "\n".join(lines) + "\n"


with tempfile.TemporaryDirectory() as folder:
    for name, text in {"chart.csv": chart(), "ocean.toml": OCEAN, "library.toml": LIBRARY}.items():
        (Path(folder) / name).write_text(text)
    start = time.monotonic()
    subprocess.run([sys.argv[1], "--library", f"{folder}/library.toml", "-o", f"{folder}/library.nc"], check=True, stdout=sys.stderr)
    wall_s = time.monotonic() - start
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
print(f"library: {usage.ru_utime:.1f} s of processor time, peak memory {usage.ru_maxrss / 1024:.0f} MiB", file=sys.stderr)
print(json.dumps({"value": wall_s}))
