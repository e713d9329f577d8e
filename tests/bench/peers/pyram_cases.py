"""Processor seconds of pyRAM (the solver of Clark et al. 2022), after numba has compiled.

On the figures of tests/bench/pe_solver.cpp.

usage: pyram_cases.py FIGURE
"""

import json
import sys
import time

import numpy as np
from pyram.PyRAM import PyRAM

FLAT = [[0.0, 3000.0]]
UPSLOPE = [[0.0, 3000.0], [5e3, 3000.0], [25e3, 1000.0], [35e3, 1000.0]]


def munk(depth: np.ndarray) -> np.ndarray:
    eta = 2.0 * (depth - 1300.0) / 1300.0
    return 1500.0 * (1.0 + 0.00737 * (eta + np.exp(-eta) - 1.0))


def run(floor, sediment, dr, dz, range_m, source_depth=30.0) -> float:
    """Everything but the compilation: construction too. pyRAM changes its arguments, so they are made anew."""
    depth = np.arange(0.0, max(d for _, d in floor) + 501.0, 10.0) if len(floor) > 1 else np.arange(0.0, 3001.0, 10.0)
    speed, density, attenuation = (np.array([[value]]) for value in sediment)
    start = time.process_time()
    water, everywhere = munk(depth).reshape(-1, 1), np.array([0.0])
    sea_floor = speed, density, attenuation, np.array(floor)
    PyRAM(20.0, source_depth, 300.0, depth, everywhere, water, everywhere.copy(), everywhere.copy(), *sea_floor,
          dr=dr, dz=dz, np=8, rmax=range_m, c0=1500.0).run()  # fmt: skip
    return time.process_time() - start


MUD, SAND = (1505.0, 1.5, 0.5), (1600.0, 1.8, 0.5)
FIGURES = {
    "same_grid.single": lambda: run(FLAT, MUD, 50.0, 1.0, 25e3),
    "same_grid.batch": lambda: sum(run(FLAT, MUD, 50.0, 1.0, 25e3, 30.0 + 10.0 * i) for i in range(8)) / 8,
    "equal_accuracy.munk_20hz": lambda: run(FLAT, MUD, 50.0, 0.5, 25e3),  # 0.045 dB; 0.052 dB at dz 1 m
    "equal_accuracy.range_dependent": lambda: run(UPSLOPE, SAND, 50.0, 1.0, 35e3),  # 0.78 dB; no lower than 0.65 dB
    "library": lambda: 64 * 72 / 2 * run(UPSLOPE, SAND, 50.0, 1.0, 25e3),  # one radial, times what two cores share
}

figure = sys.argv[1]
run(FLAT, MUD, 50.0, 5.0, 1e3)
run(UPSLOPE, SAND, 50.0, 5.0, 6e3)
repeats = 1 if figure == "library" else 3
print(json.dumps({"value": min(FIGURES[figure]() for _ in range(repeats))}))
