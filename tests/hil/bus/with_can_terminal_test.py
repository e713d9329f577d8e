"""At a terminal with-can leaves the terminal as it is, and Ctrl-C ends what it runs. One argument: with-can."""

import os
import pty
import select
import sys
import termios
import time

PATIENCE_S = 60


def main(with_can: str) -> str:
    """Returns what is wrong, nothing where all is as it should be."""
    process, terminal = pty.fork()
    if process == 0:
        os.environ["EARSHOT_CAN"] = "uml"
        command = "test -t 1 && echo it runs; test -t 2 && echo errors too >&2; sleep 1000"
        os.execl(with_can, with_can, "bash", "-c", command)
    before = termios.tcgetattr(terminal)
    said = b""
    ends = time.monotonic() + PATIENCE_S
    typed = False
    while time.monotonic() < ends:
        if not typed and b"it runs" in said and b"errors too" in said:
            if termios.tcgetattr(terminal) != before:
                return "the terminal is another while the command runs"
            os.write(terminal, b"\x03")
            typed = True
        if select.select([terminal], [], [], 0.1)[0]:
            try:
                said += os.read(terminal, 4096)
            except OSError:  # the other end is closed
                break
    else:
        os.kill(process, 9)
    status = os.waitstatus_to_exitcode(os.waitpid(process, 0)[1])
    return "" if typed and status == 130 else f"status {status} after Ctrl-C (wanted 130); it said {said!r}"


wrong = main(sys.argv[1])
if wrong:
    sys.exit(wrong)
