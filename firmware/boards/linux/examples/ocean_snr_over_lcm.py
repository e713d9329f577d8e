#!/usr/bin/env python3
"""Gives a vehicle of your own the SNR that an ocean has where it is: answers every fix on the bus.

How to run it: ../connect_your_autopilot.md
usage: ocean_snr_over_lcm.py LCM_URL SNR_CSV NORTH_M EAST_M
"""

import argparse
import bisect
import csv
import math
import pathlib
import signal

import lcm

from earshot import nav_state_t, snr_estimate_t

parser = argparse.ArgumentParser(description="Gives a vehicle of your own the SNR that an ocean has where it is.")
parser.add_argument("url")
parser.add_argument("snr", type=pathlib.Path, help="snr.csv of a flight: SNR against range at the mission's depth")
parser.add_argument("north_m", type=float, help="of the source")
parser.add_argument("east_m", type=float)
parser.add_argument("--floor-db", type=float, default=-math.inf, help="what is fainter is reported as too faint")
options = parser.parse_args()

with options.snr.open(newline="", encoding="utf-8") as table:
    rows = [(float(row["range_m"]), float(row["snr_db"])) for row in csv.DictReader(table)]


def snr_at(range_m):
    """Linear between two rows; beyond the last one that row's."""
    i = bisect.bisect_right(rows, (range_m, math.inf))
    if i == 0 or i == len(rows):
        return rows[max(i - 1, 0)][1]
    (near_m, near_db), (far_m, far_db) = rows[i - 1], rows[i]
    return near_db + (far_db - near_db) * (range_m - near_m) / (far_m - near_m)


def on_fix(_channel, data):
    fix = nav_state_t.decode(data)
    estimate = snr_estimate_t()
    estimate.utime = fix.utime  # what is heard where the vehicle was at that time
    snr_db = snr_at(math.hypot(options.north_m - fix.north_m, options.east_m - fix.east_m))
    estimate.too_faint = snr_db < options.floor_db
    estimate.snr_db = max(snr_db, options.floor_db)
    bus.publish("EARSHOT_SNR_ESTIMATE", estimate.encode())


signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C ends it without a traceback
bus = lcm.LCM(options.url)
bus.subscribe("EARSHOT_NAV_STATE", on_fix)
while True:
    bus.handle()
