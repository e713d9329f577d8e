#!/usr/bin/env python3
"""Reports once a second over LCM how a vehicle, its autopilot and its hydrophone are, to try a mission's rules.

How to run it: ../connect_your_autopilot.md
usage: status_over_lcm.py LCM_URL [--altitude M] [--battery PERCENT] [--leak] [--ground-fault] [--disengaged] [--deaf]
What is not given is well: the bottom is not heard, the battery is full.
"""

import argparse
import math
import signal
import time

import lcm

from earshot import autopilot_status_t, hydrophone_status_t, vehicle_status_t

parser = argparse.ArgumentParser(description="Reports over LCM how a vehicle, its autopilot and its hydrophone are.")
parser.add_argument("url")
parser.add_argument("--altitude", type=float, default=math.nan, help="above the sea floor, in metres")
parser.add_argument("--battery", type=float, default=100.0, help="charge that is left, in per cent")
parser.add_argument("--leak", action="store_true", help="there is water in the hull")
parser.add_argument("--ground-fault", action="store_true", help="current flows between battery and hull")
parser.add_argument("--disengaged", action="store_true", help="the autopilot follows no set-points")
parser.add_argument("--deaf", action="store_true", help="the hydrophone hears nothing")
options = parser.parse_args()

vehicle, autopilot, hydrophone = vehicle_status_t(), autopilot_status_t(), hydrophone_status_t()
vehicle.altitude_m, vehicle.battery_percent = options.altitude, options.battery
vehicle.leak, vehicle.ground_fault = options.leak, options.ground_fault
autopilot.follows_setpoints = not options.disengaged
hydrophone.deaf = options.deaf

signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C ends it without a traceback
bus = lcm.LCM(options.url)
while True:
    vehicle.utime = autopilot.utime = hydrophone.utime = time.time_ns() // 1000
    bus.publish("EARSHOT_VEHICLE_STATUS", vehicle.encode())
    bus.publish("EARSHOT_AUTOPILOT_STATUS", autopilot.encode())
    bus.publish("EARSHOT_HYDROPHONE_STATUS", hydrophone.encode())
    time.sleep(1.0)
