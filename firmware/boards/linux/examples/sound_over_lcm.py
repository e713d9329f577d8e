#!/usr/bin/env python3
"""A hydrophone's driver: sends samples as they are taken, block after block, over LCM.

How to run it: ../connect_your_autopilot.md
usage: sound_over_lcm.py LCM_URL SAMPLE_RATE_HZ CHANNELS
"""

import math
import signal
import sys
import time

import lcm

from earshot import hydrophone_block_t

SAMPLES = 1024  # of each channel in a block

signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C ends it without a traceback
bus = lcm.LCM(sys.argv[1])
block = hydrophone_block_t()
block.sample_rate_hz, block.channels = float(sys.argv[2]), int(sys.argv[3])
block.sample_count = block.channels * SAMPLES
block.gain_db = 20.0
began = time.time()
while True:
    taken_at = began + block.first_sample / block.sample_rate_hz
    time.sleep(max(0.0, taken_at + SAMPLES / block.sample_rate_hz - time.time()))  # here an ADC would fill the block
    radians = 2.0 * math.pi * 20.0 / block.sample_rate_hz  # a tone of 20 Hz at a tenth of full scale
    sound = [0.1 * math.sin(radians * (block.first_sample + n)) for n in range(SAMPLES)]
    block.samples = [pressure for pressure in sound for _ in range(block.channels)]
    block.utime = int(taken_at * 1e6)
    bus.publish("EARSHOT_HYDROPHONE_BLOCK", block.encode())
    block.sequence += 1
    block.first_sample += SAMPLES
