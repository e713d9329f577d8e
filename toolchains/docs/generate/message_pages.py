"""Pages of what goes over the buses.

LCM types come from their definitions, CAN messages from the DBC file that `earshot dbc` prints.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import Path

from command_pages import plain

WITHOUT_VALUE = ("not available", "out of range", "reserved")  # every signal has them: its highest values

_FIELD = re.compile(r"^\s+(\w+)\s+(\w+)((?:\[\w+\])*);\s*(?://\s*(.*))?$")
_CONSTANT = re.compile(r"^\s+const\s+\w+\s+(.*?);\s*(?://\s*(.*))?$")


LCM_ABOUT = """# LCM messages
Types of the LCM package `earshot`, as `firmware/wire/lcm/*.lcm` defines them. Lengths are metres, depth is positive
down, angles are radians clockwise from true north, times (`utime`) are microseconds of UTC.
[Connect your autopilot](../../../../firmware/boards/linux/connect_your_autopilot.md#the-messages) states which of them
goes where, and how often. `lcm-gen` makes code of these files for C, C++, Java, Lua and Python.
"""
CAN_ABOUT = """# CAN messages (NMEA 2000)
What Earshot reads and writes on a CAN bus, as `earshot dbc` prints it: 29-bit identifiers, 250 kbit/s. Bits count from
0, in the order of the bytes on the bus.
[Connect your autopilot](../../../../firmware/boards/linux/connect_your_autopilot.md#the-messages) states which device
sends what, and how often. [hil/bus](../../../../hil/bus/README.md) has the DBC file and what reads it.
"""


def lcm_page(folder: Path) -> str:
    pieces = [LCM_ABOUT]
    for file in sorted(folder.glob("*.lcm")):
        pieces.append(_lcm_type(file.read_text()))
    return "\n".join(pieces)


def _lcm_type(text: str) -> str:
    """Comments between package and struct describe the message; a field's stands behind it, or on the lines before."""
    before, _, body = text.partition("package ")[2].partition("struct ")
    name = body.split("{")[0].strip()
    about = " ".join(line.removeprefix("//").strip() for line in before.splitlines() if line.startswith("//"))
    rows: list[str] = []
    comment: list[str] = []
    for line in body.split("{", 1)[1].splitlines():
        if found := _FIELD.match(line):
            kind, field_name, size, meaning = found.groups()
            rows.append(f"| `{field_name}` | `{kind}{size}` | {plain(' '.join([*comment, meaning or '']).strip())} |")
            comment = []
        elif found := _CONSTANT.match(line):
            rows.append(
                f"| `{found.group(1)}` | constant | {plain(' '.join([*comment, found.group(2) or '']).strip())} |"
            )
            comment = []
        elif line.strip().startswith("//"):
            comment.append(line.strip().removeprefix("//").strip())
    return f"## {name}\n\n{plain(about)}\n\n| field | type | meaning |\n|---|---|---|\n" + "\n".join(rows) + "\n"


@dataclass
class CanMessage:
    name: str
    length: str
    sender: str
    comment: str = ""
    signals: list[tuple[str, str]] = field(default_factory=list)  # name, row without the words


_MESSAGE = re.compile(r"^BO_ (\d+) (\w+): (\d+) (\w+)")
_SIGNAL = re.compile(
    r'^ SG_ (\w+)(?: (m\d+|M))? : (\d+)\|(\d+)@1([+-]) \(([^,]+),([^)]+)\) \[([^|]*)\|([^\]]*)\] "([^"]*)"'
)


def can_page(dbc: str) -> str:
    messages: dict[str, CanMessage] = {}
    words: dict[tuple[str, str], str] = {}
    current = chooser = ""
    for line in dbc.splitlines():
        if found := _MESSAGE.match(line):
            current = found.group(1)
            messages[current] = CanMessage(found.group(2), found.group(3), found.group(4))
        elif (signal := _SIGNAL.match(line)) and current:
            name, chosen, begin, size, _sign, factor, offset, low, high, unit = signal.groups()
            if chosen == "M":
                chooser = name
            when = f", if {chooser} is {chosen[1:]}" if chosen and chosen != "M" else ""
            scale = factor + (f", from {offset}" if float(offset) else "")
            row = f"| `{name}`{when} | {begin} | {size} | {scale} | {low} to {high} | {plain(unit)} |"
            messages[current].signals.append((name, row))
        elif found := re.match(r'^CM_ BO_ (\d+) "(.*)";$', line):
            messages[found.group(1)].comment = found.group(2)
        elif found := re.match(r"^VAL_ (\d+) (\w+) (.*);$", line):
            values = re.findall(r'(\d+) "([^"]*)"', found.group(3))
            named = [f"{value} {word}" for value, word in values if word not in WITHOUT_VALUE]
            words[found.group(1), found.group(2)] = ", ".join(named)
    pieces = [CAN_ABOUT]
    for identifier, message in messages.items():
        rows = [f"{row} {plain(words.get((identifier, name), ''))} |" for name, row in message.signals]
        sender = "Earshot" if message.sender == "Earshot" else "a device of the vehicle"
        number = f"0x{int(identifier) & 0x1FFFFFFF:08X}"
        pieces += [
            f"## {message.name} ({message.comment.split(',')[0].split(';')[0]})\n",
            f"{plain(message.comment)}. Identifier {number}, {message.length} bytes, sent by {sender}.\n",
            "| signal | first bit | bits | scale | range | unit | words |\n|---|---|---|---|---|---|---|",
            "\n".join(rows) + "\n",
        ]
    return "\n".join(pieces)
