"""Lets C++ read beyond an array: where a sanitizer watches memory, this does not end in order.

usage: PYTHON tests/policy/python/random_calls/reads_beyond.py
"""

import numpy as np

from earshot.gym import make_world

lies = np.lib.stride_tricks.as_strided(np.zeros(4), (1_000,), (8,))
make_world().snr_db(lies)
