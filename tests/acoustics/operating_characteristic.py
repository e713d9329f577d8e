"""The detector's operating characteristic beside theory: says how far apart they are in dB, and draws both.

usage: operating_characteristic.py CURVES.csv [FIGURE.png]

Theory, with n = 2 B T = 30 degrees of freedom (band 15 Hz, 1 s):
  noise alone    P / N = chi2_n / n
  with a tone    P / N = chi2_n(n SNR) / n, non-central
                 Source: Urkowitz 1967, Energy detection of unknown deterministic signals, Proc. IEEE 55, eqs. 20-28
  estimated N    the 60th of 120 powers of noise alone, over its own mean: its density is that of an order statistic,
                 and P_fa = integral of P(chi2_n > n threshold x) over it.
                 Source: Rohling 1983, IEEE Trans. AES 19, eq. 10, with chi-square in place of exponential variables.

How far apart: at the threshold where the detector's own P_fa is 1e-4, the SNR that theory needs at P_fa 1e-4 for the
P_d that the detector has, less the SNR that was there. Exit status 1 where that is more than 0.15 dB (noise known) or
0.3 dB (estimated) at any SNR with a P_d from 0.05 to 0.95.
"""

import csv
import sys
from collections.abc import Callable

import numpy as np
from scipy import optimize, stats

DEGREES = 30
MEMORY, RANK = 120, 60
FALSE_ALARMS = 1e-4
MOST_DB = {"known": 0.15, "estimated": 0.30}

# Powers of noise over their mean, and the weights that the order statistic gives them.
POWERS = np.linspace(0.5, 1.8, 4001)
WEIGHTS = stats.beta.pdf(stats.chi2.cdf(DEGREES * POWERS, DEGREES), RANK, MEMORY - RANK + 1) * stats.chi2.pdf(
    DEGREES * POWERS, DEGREES
)
WEIGHTS /= WEIGHTS.sum()
MEDIAN = stats.chi2.ppf(RANK / (MEMORY + 1), DEGREES) / DEGREES  # what the floor is divided by


def probability(kind: str, threshold: float, snr: float) -> float:
    """That P / N reaches a threshold."""

    def reach(x: np.ndarray) -> np.ndarray:
        if snr == 0.0:
            return stats.chi2.sf(DEGREES * x, DEGREES)
        return stats.ncx2.sf(DEGREES * x, DEGREES, DEGREES * snr)

    if kind == "known":
        return float(reach(np.array([threshold]))[0])
    return float(np.sum(WEIGHTS * reach(threshold * POWERS / MEDIAN)))


def root(function: Callable[[float], float], low: float, high: float) -> float:
    return float(optimize.brentq(function, low, high, xtol=1e-6))


def threshold_of_theory(kind: str) -> float:
    return root(lambda t: np.log(probability(kind, t, 0.0) / FALSE_ALARMS), 1.2, 6.0)


def snr_of_theory_db(kind: str, detections: float) -> float:
    threshold = threshold_of_theory(kind)
    return root(lambda s: probability(kind, threshold, 10.0 ** (s / 10.0)) - detections, -8.0, 15.0)


def read(path: str) -> dict[str, dict[str, np.ndarray]]:
    curves: dict[str, dict[str, list[float]]] = {}
    with open(path, newline="", encoding="utf-8") as stream:
        for row in csv.DictReader(stream):
            curve = curves.setdefault(
                row["snr_db"], {"threshold_db": [], "known": [], "estimated": [], "decisions": []}
            )
            for name, values in curve.items():
                values.append(float(row[name]))
    return {snr: {name: np.array(values) for name, values in curve.items()} for snr, curve in curves.items()}


def measured_threshold(noise: dict[str, np.ndarray], kind: str) -> int:
    """The index of the lowest threshold with no more false alarms than are wanted."""
    return int(np.argmax(noise[kind] <= FALSE_ALARMS))


def compare(curves: dict[str, dict[str, np.ndarray]]) -> bool:
    noise = curves["none"]
    print(f"{noise['decisions'][0]:.0f} decisions on noise alone, {curves['3']['decisions'][0]:.0f} at each SNR")
    holds = True
    for kind, most_db in MOST_DB.items():
        at = measured_threshold(noise, kind)
        theory_db = 10.0 * np.log10(threshold_of_theory(kind))
        print(f"noise {kind}: P_fa 1e-4 at P/N {noise['threshold_db'][at]:.2f} dB, in theory {theory_db:.2f} dB")
        for snr, curve in curves.items():
            detections = curve[kind][at]
            if snr == "none" or not 0.05 <= detections <= 0.95:
                continue
            apart_db = snr_of_theory_db(kind, detections) - float(snr)
            holds = holds and abs(apart_db) <= most_db
            print(f"  SNR {snr} dB: P_d {detections:.4f}, theory {apart_db:+.3f} dB from there (bar {most_db} dB)")
    return holds


def draw(curves: dict[str, dict[str, np.ndarray]], path: str) -> None:
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(figsize=(6.0, 4.0), dpi=100)
    grid = np.linspace(-2.0, 8.0, 101)
    for kind, colour in (("known", "tab:blue"), ("estimated", "tab:orange")):
        threshold = threshold_of_theory(kind)
        theory = [probability(kind, threshold, 10.0 ** (s / 10.0)) for s in grid]
        axes.plot(grid, theory, color=colour, label=f"theory, noise {kind}")
        at = measured_threshold(curves["none"], kind)
        snrs = [snr for snr in curves if snr != "none"]
        measured = [curves[snr][kind][at] for snr in snrs]
        axes.plot([float(s) for s in snrs], measured, "o", color=colour, label=f"detector, noise {kind}")
    axes.set(xlabel="SNR in the band / dB", ylabel="probability of detection", title="P_fa = 1e-4, band 15 Hz, 1 s")
    axes.grid(alpha=0.3)
    axes.legend()
    figure.tight_layout()
    figure.savefig(path, metadata={"Software": ""})


def main() -> int:
    if len(sys.argv) not in (2, 3):
        print(__doc__, file=sys.stderr)
        return 2
    curves = read(sys.argv[1])
    holds = compare(curves)
    if len(sys.argv) == 3:
        draw(curves, sys.argv[2])
    return 0 if holds else 1


if __name__ == "__main__":
    sys.exit(main())
