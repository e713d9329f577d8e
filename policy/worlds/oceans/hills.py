"""The sea floor of the world hilly.

Hills of 300 m, 19 km from crest to crest, on hills of 150 m, over a floor of 2500 m; slopes up to 14 percent.

usage: hills.py > CHART.csv    the chart that make_library takes, nodes 1.5 km apart, 42 km around the domain
"""

import math
from collections.abc import Callable


def depth_m(north_km: float, east_km: float) -> float:
    return 2500 + 300 * math.sin(east_km / 3 + 0.5 * math.sin(north_km / 7)) + 150 * math.sin(north_km / 1.8)


def print_chart(depth_m: Callable[[float, float], float], spacing_km: float) -> None:
    """A node every so often, from 42 km south and west of the domain to 42 km north and east of it."""
    print("latitude_deg,longitude_deg,elevation_m")
    nodes_km = [spacing_km * i for i in range(round(-42 / spacing_km), round(69 / spacing_km) + 1)]
    for north in nodes_km:
        for east in nodes_km:
            print(f"{north / 110.574:.5f},{east / 111.320:.5f},{-depth_m(north, east):.1f}")


if __name__ == "__main__":
    print_chart(depth_m, spacing_km=1.5)
