"""The bench as a driver of labgrid: it gives hil/run to whatever shell the target has, on this computer or over SSH."""

from __future__ import annotations

import shlex
import xml.etree.ElementTree as ET

import attr
from labgrid import step, target_factory
from labgrid.driver import Driver, ExecutionError
from labgrid.protocol import CommandProtocol

# With a build before the first.
_LONGEST_FLIGHT_S = 1800.0
_PASSED, _FAILED = 0, 1


def _text(lines: list[str]) -> str:
    return "\n".join(lines).strip()


@target_factory.reg_driver
@attr.s(eq=False)
class EarshotBenchDriver(Driver):
    """Flies cases of hil/cases.

    Args:
        tree (str): Earshot's tree on the computer that flies
        interface (str): its CAN interface; empty: a virtual bus
        earshotd (str): an earshotd with earshot-bench beside it; empty: hil/run builds them
        out (str): folder of the results
    """

    bindings = {"shell": CommandProtocol}
    tree = attr.ib(validator=attr.validators.instance_of(str))
    interface = attr.ib(default="", validator=attr.validators.instance_of(str))
    earshotd = attr.ib(default="", validator=attr.validators.instance_of(str))
    out = attr.ib(default="out/labgrid", validator=attr.validators.instance_of(str))

    @Driver.check_active
    @step(args=["case"])
    def fly(self, case: str) -> list[str]:
        """What is wrong with a case; nothing: it passed. Raises ExecutionError when it could not be flown."""
        words = ["hil/run", "--case", case, "--out", self.out, "--junit", f"{self.out}/junit.xml"]
        words += ["--interface", self.interface] if self.interface else []
        words += ["--earshotd", self.earshotd] if self.earshotd else []
        printed, _, status = self.shell.run(self._in_tree(words), timeout=_LONGEST_FLIGHT_S)
        if status not in (_PASSED, _FAILED):
            raise ExecutionError(f"hil/run ended with status {status}: {_text(printed)}")
        report, _, _ = self.shell.run(self._in_tree(["cat", f"{self.out}/junit.xml"]))
        failures = ET.fromstring(_text(report)).iter("failure")
        return [line for failure in failures for line in (failure.text or "").splitlines()]

    def _in_tree(self, words: list[str]) -> str:
        return f"cd {shlex.quote(self.tree)} && {shlex.join(words)}"
