"""What a program that gives Earshot orders over LCM needs: the words of an answer, and the mark of a vehicle's key."""

import argparse
import hashlib
import hmac
import pathlib
import struct
import sys
from dataclasses import dataclass

from earshot import challenge_t, operator_command_t

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


def blake2b(key: bytes, *parts: bytes) -> bytes:
    """Of who knows the key (firmware/authority/README.md)."""
    return hashlib.blake2b(b"".join(parts), key=key, digest_size=16).digest()


def challenge_bytes(challenge: challenge_t) -> bytes:
    """What marks are made for besides the order: this start of this vehicle, with this mission."""
    return bytes(challenge.nonce) + bytes(challenge.vehicle) + bytes(challenge.mission)


def order_bytes(order: operator_command_t) -> bytes:
    """An order's fields as they are marked."""
    numbers = (order.utime, order.expiry_utime, order.issuer & 0xFFFFFFFF, order.number & 0xFFFFFFFF, order.command)
    limits = (order.max_depth_m, order.max_speed_mps, order.max_time_s)
    return struct.pack("<qqIIB3d", *numbers, *limits)


@dataclass
class Start:
    """Of the vehicle: its newest challenge, when it was heard, and how many orders were marked for it."""

    challenge: challenge_t
    heard: int
    tries: int = 0


class Marker:
    """Marks orders for the vehicle that is meant, as it tells its challenge; without a key with zeros."""

    MOST_TRIES = 12  # of one start, while the vehicle refuses the marks

    def __init__(self, options: argparse.Namespace):
        """From the options of add_options()."""
        self.key = read_key(options.key_file) if options.key_file else None
        self.vehicle = options.vehicle_id.encode("ascii", "replace").ljust(32, b"\0")
        self.mission = hashlib.sha256(options.mission.read_bytes()).digest() if options.mission else None
        self.starts: dict[bytes, Start] = {}  # by nonce
        self.count = 0  # of challenges that were kept
        self.heard: set[str] = set()

    @staticmethod
    def add_options(parser: argparse.ArgumentParser) -> None:
        """What says for which vehicle orders are marked, and with what."""
        parser.add_argument(
            "--key-file", type=pathlib.Path, help="of a mission that names one: orders must bear its mark"
        )
        parser.add_argument("--vehicle-id", default="", help="of the vehicle that is meant, where it has a name")
        parser.add_argument("--mission", type=pathlib.Path, help="its mission's file: orders are for no other")

    def subscribe(self, bus) -> None:
        """Every vehicle that has a key tells its challenge once a turn."""
        if self.key is not None:
            bus.subscribe("EARSHOT_CHALLENGE", lambda _channel, data: self.hear(challenge_t.decode(data)))

    def hear(self, challenge: challenge_t) -> None:
        """Keeps those of the vehicle's starts, told by who knows the key: a made-up one gets no mark.

        A start goes on when its date rises; one that is over does not, though somebody sends its recording again. Dates
        of two starts say nothing: a computer without a battery for its clock may begin behind.
        """
        if self.key is None:
            return
        name = bytes(challenge.vehicle).rstrip(b"\0").decode("ascii", "replace")
        self.heard.add("".join(letter if letter.isprintable() else "?" for letter in name))  # anybody may say so
        true_mark = blake2b(
            self.key, b"EARSHOT CHALLENGE1", struct.pack("<q", challenge.utime), challenge_bytes(challenge)
        )
        is_true = hmac.compare_digest(bytes(challenge.mark), true_mark) and bytes(challenge.vehicle) == self.vehicle
        if not is_true or self.mission not in (None, bytes(challenge.mission)):
            return
        nonce = bytes(challenge.nonce)
        start = self.starts.get(nonce)
        if start is None or challenge.utime > start.challenge.utime:
            self.count += 1
            self.starts[nonce] = Start(challenge, self.count, start.tries if start else 0)

    def start(self) -> Start | None:
        """The start to mark the next order for.

        The one that was tried least: what was refused may have been marked for a recording that this program had not
        heard before. Among equals the one whose date rose last.
        """
        return min(self.starts.values(), key=lambda start: (start.tries, -start.heard), default=None)

    def is_final(self, outcome: str) -> bool:
        """Whether an answer settles an order. A refused mark does once every start has been tried often."""
        return outcome != "NOT_VERIFIED" or all(start.tries >= self.MOST_TRIES for start in self.starts.values())

    def silence(self, waited_s: float) -> str:
        """Why an order could not be marked in so long a time."""
        name = self.vehicle.rstrip(b"\0").decode("ascii")
        meant = f'no vehicle named "{name}"' if name else "no vehicle without a name (--vehicle-id)"
        mission = " and mission" if self.mission else ""
        who = ", ".join(f'"{heard}"' if heard else "one without a name" for heard in sorted(self.heard))
        others = (
            f"heard: {who}; is --vehicle-id, --mission or --key-file another's?"
            if who
            else "none was: does earshotd run there, with a key?"
        )
        return f"{meant} with this key{mission} was heard within {waited_s:g} s ({others})"

    def mark(self, order: operator_command_t) -> bool:
        """Sets its mark. False: it cannot be marked yet, because the vehicle has not told its challenge."""
        order.mark = bytes(16)  # always all 16: what is shorter lcm-gen's code sends short, without a word
        if self.key is None:
            return True
        start = self.start()
        if start is None:
            return False
        start.tries += 1
        order.mark = blake2b(self.key, b"EARSHOT ORDER2", challenge_bytes(start.challenge), order_bytes(order))
        return True
