"""Frames a second that cantools' generated C decodes.

They are the single frames of the bus that tests/bench/can_decode.cpp reads.
Every field of a frame becomes a double, as there. Needs a C compiler, and cantools (tests/hil/bus/requirements.txt).
"""

import json
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
# PGN names of the DBC, with how often a second of the bus holds them.
MIX = {
    "VesselHeading": 10, "RateOfTurn": 10, "Attitude": 10, "Rudder": 10, "PositionRapidUpdate": 10, "WindData": 10,
    "Speed": 1, "ActualPressure": 1, "WaterDepth": 1, "BatteryStatus": 1,
}  # fmt: skip
MAIN = """
#include <stdio.h>
#include <string.h>
#include <time.h>
#include "bus.h"
static const struct {{ int which; uint8_t data[8]; }} frames[] = {{ {frames} }};
static volatile double sink;
static double seconds(void) {{ struct timespec t; clock_gettime(CLOCK_MONOTONIC, &t);
  return t.tv_sec + 1e-9 * t.tv_nsec; }}
int main(void) {{
  const int count = sizeof(frames) / sizeof(frames[0]);
  double best = 1e9;
  for (int round = 0; round < 200; ++round) {{
    const double began = seconds();
    for (int second = 0; second < 1000; ++second)
      for (int i = 0; i < count; ++i)
        switch (frames[i].which) {{ {cases} }}
    const double spent = seconds() - began;
    if (spent < best) best = spent;
  }}
  printf("%.6g\\n", 1000.0 * count / best);
  return 0;
}}
"""


def in_environment() -> None:
    """Runs this again where cantools is."""
    python = subprocess.run(
        [ROOT / "toolchains/python-environment", ROOT / "tests/hil/bus/requirements.txt"],
        capture_output=True, text=True, check=True,
    ).stdout.strip()  # fmt: skip
    sys.exit(subprocess.run([python, __file__, "here"], check=False).returncode)


def main() -> None:
    import cantools  # only in its own environment
    from cantools.database.can.c_source import camel_to_snake_case as snake

    dbc = ROOT / "hil/bus/earshot.dbc"
    kept = [message for message in cantools.database.load_file(dbc).messages if message.name in MIX]
    frames, cases = [], []
    for which, message in enumerate(kept):
        name = f"bus_{snake(message.name)}"
        frames += [f"{{ {which}, {{ 16,16,16,16,16,16,16,16 }} }}"] * MIX[message.name]
        fields = [snake(signal.name) for signal in message.signals]
        total = " + ".join(f"{name}_{field}_decode(m.{field})" for field in fields)
        cases.append(
            f"case {which}: {{ struct {name}_t m; {name}_unpack(&m, frames[i].data, 8); sink = {total}; break; }}"
        )
    with tempfile.TemporaryDirectory() as folder:
        generate = [sys.executable, "-m", "cantools", "generate_c_source", "--database-name", "bus", str(dbc)]
        subprocess.run(generate, cwd=folder, check=True, stdout=subprocess.DEVNULL)
        Path(folder, "main.c").write_text(MAIN.format(frames=",".join(frames), cases=" ".join(cases)))
        subprocess.run(["cc", "-O2", "-o", "peer", "main.c", "bus.c"], cwd=folder, check=True)
        done = subprocess.run([str(Path(folder, "peer"))], capture_output=True, text=True, check=True)
    print(json.dumps({"value": float(done.stdout)}))


if __name__ == "__main__":
    main() if sys.argv[1:] == ["here"] else in_environment()
