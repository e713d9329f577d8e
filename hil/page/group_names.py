"""Names of NMEA 2000 parameter groups, from the DBC file that Earshot writes of its tables."""

from __future__ import annotations

import re
from pathlib import Path

_MESSAGE = re.compile(r"^BO_ (\d+) (\w+):", re.MULTILINE)
# A DBC file marks an identifier of 29 bits by the highest of 32.
_IDENTIFIER_BITS = (1 << 29) - 1


def pgn_of(identifier: int) -> int:
    """The group of a frame; where its lower byte is an address (PDU1), that is no part of it. Source: SAE J1939-21."""
    group = (identifier & _IDENTIFIER_BITS) >> 8 & 0x3FFFF
    return group if group >> 8 & 0xFF >= 240 else group & ~0xFF


def read_group_names(dbc: Path) -> dict[int, str]:
    """Where two messages share a group, the first one's. No file: no names."""
    names: dict[int, str] = {}
    if dbc.is_file():
        for identifier, name in _MESSAGE.findall(dbc.read_text(encoding="utf-8", errors="replace")):
            names.setdefault(pgn_of(int(identifier)), name)
    return names
