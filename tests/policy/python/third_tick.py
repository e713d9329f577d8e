"""Shows that long work lets signals in while it lasts, whatever the machine's speed."""

import contextlib
import signal
from collections.abc import Callable, Iterator


@contextlib.contextmanager
def third_tick_interrupts() -> Iterator[Callable[[], object]]:
    """Gives a function that starts a clock of 50 ms, of which the third tick that Python sees is a Ctrl-C.

    Work that lets no signal in lets Python see one tick, when it is over, however many there were.
    """
    seen = 0

    def tick(number: int, frame: object) -> None:
        nonlocal seen
        seen += 1
        if seen == 3:
            raise KeyboardInterrupt

    before = signal.signal(signal.SIGALRM, tick)
    try:
        yield lambda: signal.setitimer(signal.ITIMER_REAL, 0.05, 0.05)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        signal.signal(signal.SIGALRM, before)
