#!/usr/bin/env python3
"""Gives Earshot one order over LCM, and prints what came of it. How to run it: ../connect_your_autopilot.md

usage: order_over_lcm.py LCM_URL ORDER [--max-depth M] [--max-speed M_PER_S] [--max-time S]
    [--key-file FILE] [--vehicle-id NAME] [--mission FILE]
ORDER is START, COMPLETE, ABORT, LISTEN, PAUSE, RESUME or TIGHTEN; the limits go with TIGHTEN.
Ends with 0 once the order is obeyed, with 1 when it is not, or when nobody answers within 10 s.
"""

import argparse
import math
import random
import signal
import sys
import time

import lcm

from earshot import command_acknowledgement_t, operator_command_t
from marked_order import Marker, outcome_of

WAIT_S = 10.0
ORDERS = ("START", "COMPLETE", "ABORT", "LISTEN", "PAUSE", "RESUME", "TIGHTEN")

parser = argparse.ArgumentParser(description="Gives Earshot one order over LCM.")
parser.add_argument("url")
parser.add_argument("order", choices=ORDERS)
parser.add_argument("--max-depth", type=float, default=math.nan)
parser.add_argument("--max-speed", type=float, default=math.nan)
parser.add_argument("--max-time", type=float, default=math.nan)
Marker.add_options(parser)
options = parser.parse_args()

order = operator_command_t()
order.issuer, order.number = random.getrandbits(31), 1
order.command = getattr(order, options.order)
order.max_depth_m, order.max_speed_mps, order.max_time_s = options.max_depth, options.max_speed, options.max_time
marker = Marker(options)
answers: list[str] = []
refusals: list[str] = []


def on_acknowledgement(_channel, data):
    acknowledgement = command_acknowledgement_t.decode(data)
    if not answers and (acknowledgement.issuer, acknowledgement.number) == (order.issuer, order.number):
        outcome = outcome_of(acknowledgement.outcome)
        (answers if marker.is_final(outcome) else refusals).append(outcome)


signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C ends it without a traceback
bus = lcm.LCM(options.url)
bus.subscribe("EARSHOT_COMMAND_ACKNOWLEDGEMENT", on_acknowledgement)
marker.subscribe(bus)
deadline = time.monotonic() + WAIT_S
next_order = time.monotonic()
while not answers and time.monotonic() < deadline:
    order.utime = time.time_ns() // 1000
    order.expiry_utime = order.utime + 600_000_000  # a START waits so long for navigation and SNR
    # The same numbers once a second: obeyed once however often it arrives. An ABORT needs no mark.
    if time.monotonic() >= next_order and (marker.mark(order) or options.order == "ABORT"):
        bus.publish("EARSHOT_OPERATOR_COMMAND", order.encode())
        next_order = time.monotonic() + (0.25 if refusals else 1.0)
    bus.handle_timeout(200)
silence = marker.silence(WAIT_S) if marker.key is not None and not marker.starts else "nobody answers"
outcome = (answers + refusals + [silence])[0]
print(f"{options.order}:", outcome)
sys.exit(0 if outcome in ("OBEYED", "OBEYED_NOT_DURABLE", "REPEATED") else 1)
