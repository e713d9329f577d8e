"""The sea floor of the world seamount.

A mountain of 2400 m, of the shape of a bell, over a floor of 3000 m, its top 600 m deep in the middle of the domain;
slopes up to 34 percent, 19 degrees, as steep as seamounts are.

usage: seamount.py > CHART.csv    the chart that make_library takes, nodes 1 km apart, 42 km around the domain
"""

import math

from hills import print_chart


def depth_m(north_km: float, east_km: float) -> float:
    from_top_km = math.hypot(north_km - 12.5, east_km - 12.5)
    return 3000 - 2400 * math.exp(-((from_top_km / 6) ** 2))


if __name__ == "__main__":
    print_chart(depth_m, spacing_km=1.0)
