"""What Earshot raises where an argument or a file is not as it must be."""

from __future__ import annotations

import re
from typing import Any

__all__ = ["BadInput", "BadType"]

# "FILE:LINE: KEY = VALUE: what is allowed", as all of Earshot says it; file, line and value may be left out.
_PROBLEM = re.compile(
    r"(?:(?P<file>(?:(?! = )[^\n])*?):(?:(?P<line>\d+):)? )?"
    r"(?P<key>[\w.\[\]()][\w.\[\]() ,/-]*?)(?: = (?P<value>[^\n]+?))?(?:: | is missing: )(?P<what>[^\n]+)"
)

# "FILE: cannot be read: it is a folder": about the whole of it.
_FILE_ALONE = re.compile(
    r"(?P<file>(?=[^:\n]*/)(?:(?! = |: )[^\n])+?):(?:(?P<line>\d+):)? (?:cannot|no|not|is|has|its|truncated)\b"
)


class BadInput(ValueError):
    """An argument or a file is not as it must be; the message names it and says what is allowed, a line each problem.

    file, line  where the first problem stands, None for an argument
    key         name of the argument, or the key in the file
    value       what was given, or its text
    """

    file: str | None
    line: int | None
    key: str | None
    value: Any

    def __init__(self, message: str, *, key: str | None = None, value: Any = None) -> None:
        super().__init__(message)
        alone = _FILE_ALONE.match(message) if key is None else None
        found = _PROBLEM.match(message) if key is None and alone is None else None
        stands = found or alone
        self.file = stands["file"] if stands else None
        self.line = int(stands["line"]) if stands and stands["line"] else None
        self.key = found["key"] if found else key
        self.value = found["value"] if found else value

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), self.args, self.__dict__


class BadType(BadInput, TypeError):
    """An argument is of a type that cannot be what is asked for."""
