"""A first field, drawn: transmission loss at 20 Hz over a flat floor, against range and depth (Munk's profile)."""

import sys

import matplotlib

matplotlib.use("agg")
import matplotlib.pyplot as plot

import earshot

environment = earshot.Environment(sound_speed=earshot.Munk(), bathymetry=3000.0, sediment=earshot.Layer(1505.0))
field = earshot.field(environment, frequency=20.0, source_depth=30.0)
field.transmission_loss.plot(x="range", y="depth", yincrease=False)
plot.savefig(sys.argv[1], bbox_inches="tight")
