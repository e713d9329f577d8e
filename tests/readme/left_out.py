"""Commands that are left out, each for a reason, where READMEs are run with programs that lack something.

A line of the file is `README | how the command begins | reason`; of a README's Python it is how the code begins.
Lines that begin with # say nothing. Whatever stands in it must still be a command of that README.
"""

from __future__ import annotations

from dataclasses import dataclass

from markdown import Command


@dataclass(frozen=True)
class Reason:
    file: str
    begins: str
    why: str

    def is_of(self, command: Command) -> bool:
        return str(command.file) == self.file and command.text.startswith(self.begins)


def read(text: str, where: str) -> tuple[list[Reason], list[str]]:
    """The reasons, and what is wrong with the file."""
    reasons, problems = [], []
    for number, line in enumerate(text.splitlines(), 1):
        if line.strip() and not line.startswith("#"):
            parts = [part.strip() for part in line.split(" | ")]
            if len(parts) == 3 and all(parts):
                reasons.append(Reason(*parts))
            else:
                problems.append(f"{where}:{number}: must be README | how the command begins | reason: {line}")
    return reasons, problems


def split(commands: list[Command], reasons: list[Reason]) -> tuple[list[Command], list[tuple[Command, str]], list[str]]:
    """Commands to run, those left out with their reasons, and what is wrong: reasons that no command needs."""
    whys = [(command, next((r.why for r in reasons if r.is_of(command)), None)) for command in commands]
    idle = [r for r in reasons if not any(r.is_of(command) for command in commands)]
    return (
        [command for command, why in whys if why is None],
        [(command, why) for command, why in whys if why is not None],
        [f"{r.file}: has no command that begins with: {r.begins}" for r in idle],
    )
