"""Import before stable_baselines3.

Its logger and monitor import matplotlib and pandas (150 MB) for plots nobody draws here.
"""

import sys
import types

for _name in ("matplotlib", "matplotlib.figure", "pandas"):
    sys.modules.setdefault(_name, types.ModuleType(_name))
vars(sys.modules["matplotlib"])["figure"] = sys.modules["matplotlib.figure"]
vars(sys.modules["matplotlib.figure"])["Figure"] = object
vars(sys.modules["pandas"])["DataFrame"] = object
