"""What a program that gives Earshot orders over LCM needs: the words of an answer, and the mark of a vehicle's key."""

import hashlib
import pathlib
import struct
import sys

from earshot import operator_command_t

OUTCOMES = (
    "OBEYED",
    "REPEATED",
    "TOO_OLD",
    "EXPIRED",
    "NOT_IN_THIS_STATE",
    "UNKNOWN_ORDER",
    "NOT_CONFIGURED",
    "OUT_OF_ORDER",
    "NOT_VERIFIED",
    "NOT_TIGHTER",
    "AUTOPILOT_SILENT",
    "OLD_MARK",
    "UNREADABLE",
    "OBEYED_NOT_DURABLE",
)


def outcome_of(number: int) -> str:
    """In words; a newer Earshot may answer what this program does not know."""
    return OUTCOMES[number] if 0 <= number < len(OUTCOMES) else f"outcome {number}, which this program does not know"


def read_key(file: pathlib.Path) -> bytes:
    """The key of a vehicle: 64 hexadecimal digits."""
    try:
        key = bytes.fromhex(file.read_text())
    except (OSError, ValueError) as error:
        sys.exit(f"{file}: {error}")
    if len(key) != 32:
        sys.exit(f"{file}: must hold 64 hexadecimal digits")
    return key


def mark_of(order: operator_command_t, key: bytes | None) -> bytes:
    """What shows that the sender knows the vehicle's key (firmware/authority/README.md); zeros without one."""
    if key is None:
        return bytes(16)
    numbers = (order.utime, order.expiry_utime, order.issuer & 0xFFFFFFFF, order.number & 0xFFFFFFFF, order.command)
    limits = (order.max_depth_m, order.max_speed_mps, order.max_time_s)
    return hashlib.blake2b(struct.pack("<qqIIB3d", *numbers, *limits), key=key, digest_size=16).digest()
