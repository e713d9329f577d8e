#!/usr/bin/env python3
"""A vehicle that follows Earshot's set-points over LCM, and starts the search.

How to run it: ../connect_your_autopilot.md
usage: autopilot_over_lcm.py LCM_URL [--key-file FILE] [--vehicle-id NAME] [--mission FILE] [--speed N]
"""

import argparse
import math
import random
import signal
import time

import lcm

from earshot import command_acknowledgement_t, nav_state_t, operator_command_t, setpoint_t
from marked_order import Marker, outcome_of

parser = argparse.ArgumentParser(description="A vehicle that follows Earshot's set-points over LCM.")
parser.add_argument("url")
Marker.add_options(parser)
parser.add_argument("--speed", type=float, default=1.0, help="of a rehearsal, as earshotd's: it sails so much faster")
options = parser.parse_args()

vehicle = nav_state_t()
vehicle.utime = time.time_ns() // 1000
vehicle.north_m = vehicle.east_m = 12_500.0  # the middle of the mission's area
start = operator_command_t()
start.issuer, start.number, start.command = random.getrandbits(31), 1, operator_command_t.START
start.max_depth_m = start.max_speed_mps = start.max_time_s = math.nan  # a START tightens nothing
marker = Marker(options)
answers: list[str] = []
released: list[bool] = []


def on_setpoint(_channel, data):
    setpoint = setpoint_t.decode(data)  # this vehicle obeys at once; here an autopilot would steer
    vehicle.heading_rad, vehicle.speed_mps, vehicle.depth_m = setpoint.heading_rad, setpoint.speed_mps, setpoint.depth_m
    if setpoint.release_weight and not released:
        released.append(True)  # here yours lets its drop weight go
        print("releases its drop weight", flush=True)


def on_acknowledgement(_channel, data):
    acknowledgement = command_acknowledgement_t.decode(data)
    outcome = outcome_of(acknowledgement.outcome)
    is_of_start = (acknowledgement.issuer, acknowledgement.number) == (start.issuer, start.number)
    if not answers and is_of_start and marker.is_final(outcome):
        answers.append(outcome)
        print("START:", outcome, flush=True)


signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C ends it without a traceback
bus = lcm.LCM(options.url)
bus.subscribe("EARSHOT_SETPOINT", on_setpoint)
bus.subscribe("EARSHOT_COMMAND_ACKNOWLEDGEMENT", on_acknowledgement)
marker.subscribe(bus)
next_start = time.monotonic()
while True:
    bus.handle_timeout(100)
    now = time.time_ns() // 1000
    travelled_m = options.speed * vehicle.speed_mps * (now - vehicle.utime) * 1e-6
    vehicle.north_m += travelled_m * math.cos(vehicle.heading_rad)
    vehicle.east_m += travelled_m * math.sin(vehicle.heading_rad)
    vehicle.utime = now
    bus.publish("EARSHOT_NAV_STATE", vehicle.encode())
    if not answers and time.monotonic() >= next_start:  # the same numbers again: obeyed once however often it arrives
        start.utime, start.expiry_utime = now, now + 10_000_000
        if marker.mark(start):
            bus.publish("EARSHOT_OPERATOR_COMMAND", start.encode())
            next_start = time.monotonic() + 1.0
