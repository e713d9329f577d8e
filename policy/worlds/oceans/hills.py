"""The sea floor of the world hilly.

Hills of 300 m, 19 km from crest to crest, on hills of 150 m, over a floor of 2500 m; slopes up to 14 percent.

usage: hills.py > CHART.csv    the chart that make_hilly takes, nodes 1.5 km apart, 42 km around the domain on all sides
"""

import math


def depth_m(north_km: float, east_km: float) -> float:
    return 2500 + 300 * math.sin(east_km / 3 + 0.5 * math.sin(north_km / 7)) + 150 * math.sin(north_km / 1.8)


def main() -> None:
    print("latitude_deg,longitude_deg,elevation_m")
    for north in (1.5 * i for i in range(-28, 47)):
        for east in (1.5 * j for j in range(-28, 47)):
            print(f"{north / 110.574:.5f},{east / 111.320:.5f},{-depth_m(north, east):.1f}")


if __name__ == "__main__":
    main()
