#!/usr/bin/env python3
"""Gives Earshot one order over LCM, and says what came of it. How to run it: ../connect_your_autopilot.md

usage: order_over_lcm.py LCM_URL START|COMPLETE|ABORT
Ends with 0 once the order is obeyed, with 1 when it is not, or when nobody answers within 10 s.
"""

import random
import signal
import sys
import time

import lcm
from earshot import command_acknowledgement_t, operator_command_t

OUTCOMES = (
    "OBEYED",
    "REPEATED",
    "TOO_OLD",
    "EXPIRED",
    "NOT_IN_THIS_STATE",
    "UNKNOWN_ORDER",
    "NOT_CONFIGURED",
    "OUT_OF_ORDER",
)
order = operator_command_t()
order.issuer, order.number = random.getrandbits(31), 1
order.command = {"START": order.START, "COMPLETE": order.COMPLETE, "ABORT": order.ABORT}[sys.argv[2]]
answers: list[str] = []


def on_acknowledgement(_channel, data):
    acknowledgement = command_acknowledgement_t.decode(data)
    if not answers and (acknowledgement.issuer, acknowledgement.number) == (order.issuer, order.number):
        answers.append(OUTCOMES[acknowledgement.outcome])


signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C ends it without a traceback
bus = lcm.LCM(sys.argv[1])
bus.subscribe("EARSHOT_COMMAND_ACKNOWLEDGEMENT", on_acknowledgement)
deadline = time.monotonic() + 10.0
while not answers and time.monotonic() < deadline:
    order.utime = time.time_ns() // 1000
    order.expiry_utime = order.utime + 600_000_000  # a START waits so long for navigation and SNR
    # The same numbers again: obeyed once however often it arrives.
    bus.publish("EARSHOT_OPERATOR_COMMAND", order.encode())
    bus.handle_timeout(200)
outcome = answers[0] if answers else "nobody answers"
print(f"{sys.argv[2]}:", outcome)
sys.exit(0 if outcome in ("OBEYED", "REPEATED") else 1)
