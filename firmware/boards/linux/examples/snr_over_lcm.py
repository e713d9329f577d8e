#!/usr/bin/env python3
"""Stands in for the hydrophone over LCM: the same SNR every half second. How to run it: ../connect_your_autopilot.md

usage: snr_over_lcm.py LCM_URL SNR_DB
"""

import signal
import sys
import time

import lcm

from earshot import snr_estimate_t

signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C ends it without a traceback
bus = lcm.LCM(sys.argv[1])
estimate = snr_estimate_t()
estimate.snr_db = float(sys.argv[2])
while True:
    estimate.utime = time.time_ns() // 1000  # the end of the interval that it was measured over
    bus.publish("EARSHOT_SNR_ESTIMATE", estimate.encode())
    time.sleep(0.5)
