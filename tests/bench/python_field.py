"""Processor seconds of `earshot.field` for the paper's ocean to 25 km at 300 depths, the xarray Dataset included.

A field that is not within 0.05 dB of the reference (median) is none (wrong: of another frequency). Best of a
hundred, in short once.

usage: python_field.py
"""

import json
import os
import sys
import time
from pathlib import Path

import numpy as np

import earshot

REFERENCE = Path(__file__).parents[1] / "reference/pe/munk_20hz/tl.csv"
RUNS = 1 if "EARSHOT_BENCH_SHORT" in os.environ else 100
FREQUENCY_HZ = 22.0 if "EARSHOT_BENCH_WRONG" in os.environ else 20.0
MUD = earshot.Layer(sound_speed=1505.0, density=1.5, attenuation=0.5)


def field():
    ocean = earshot.Environment(sound_speed=earshot.Munk(), bathymetry=3000.0, sediment=MUD)
    return earshot.field(
        ocean, frequency=FREQUENCY_HZ, source_depth=30.0, depth_spacing=10.0, max_range=25e3, output_step=50.0
    )


def seconds() -> float:
    start = time.process_time()
    field()
    return time.process_time() - start


def require_accurate() -> None:
    range_m, loss_db = np.loadtxt(REFERENCE, delimiter=",", skiprows=1, usecols=(0, 1), unpack=True)
    computed = field().transmission_loss.sel(depth=300.0)
    far = computed.range.values >= 1e3
    truth = np.interp(computed.range.values[far], range_m, loss_db)
    error_db = float(np.median(np.abs(computed.values[far] - truth)))
    print(f"median error {error_db:.3f} dB", file=sys.stderr)
    if not error_db <= 0.05:
        sys.exit(f"the field is {error_db:.3f} dB off the reference: less accurate than the peer")


require_accurate()
print(json.dumps({"value": min(seconds() for _ in range(RUNS))}))
