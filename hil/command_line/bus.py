"""The CAN bus that cases are flown on: one of this machine, or a virtual one that with-can makes for them.

Cases over LCM need none: they are flown on this machine as it is.
"""

from __future__ import annotations

import errno
import subprocess
from pathlib import Path

from bad_input import BadInput

VIRTUAL = "vcan0"
INTERFACES = Path("/sys/class/net")
# Of if_arp.h and if.h.
_CAN_TYPE = 280
_IS_UP = 1


def require_bus(interface: str, interfaces: Path = INTERFACES) -> None:
    """Raises BadInput that says what to do when there is no such bus, or it is down."""
    make = f"ip link set {interface} up type can bitrate 250000"
    folder = interfaces / interface
    try:
        kind, flags = ((folder / name).read_text() for name in ("type", "flags"))
    except OSError as e:
        if e.errno not in (errno.ENOENT, errno.ENOTDIR, errno.EINVAL, errno.ENAMETOOLONG):
            raise BadInput(f"--interface {interface}: {e.strerror}") from e
        raise BadInput(
            f"--interface {interface}: there is no such interface; without --interface a virtual bus is used"
        ) from e
    if int(kind) != _CAN_TYPE:
        raise BadInput(f"--interface {interface}: is no CAN interface")
    if not int(flags, 16) & _IS_UP:
        raise BadInput(f"--interface {interface}: is down; set it up first: {make}")


def why_no_virtual_bus(root: Path) -> str:
    """Gets what one takes, too. Returns what is missing; empty: nothing is."""
    command = [str(root / "hil/bus/with-can"), "--prepare"]
    asked = subprocess.run(
        command, stdin=subprocess.DEVNULL, capture_output=True, text=True, errors="replace", check=False
    )
    lines = asked.stderr.strip().splitlines() or [f"with-can ended with status {asked.returncode}"]
    return "" if asked.returncode == 0 else lines[-1]


def command_on_bus(root: Path, interface: str | None, command: list[str], *, needs_can: bool) -> list[str]:
    """@param interface  None: a virtual bus, one boot of it for all cases, if one of them needs it"""
    return [str(root / "hil/bus/with-can"), *command] if needs_can and interface is None else command
