"""What Earshot raises where an argument or a file is not as it must be."""

from __future__ import annotations

import re
from typing import Any

__all__ = ["BadInput", "BadType"]

# All of Earshot says "FILE:LINE: KEY = VALUE: what is allowed", and leaves out what it does not know.
_PLACE = re.compile(r"(?P<file>[^\n]*?):(?P<line>\d+): ")
_FILE = re.compile(r"(?P<file>[^\n:]*[/.][^\n:]*): (?=[\w.\[\]]+ (?:= |is missing: ))")  # no argument has such a name
_KEY = re.compile(r"(?P<key>[\w.\[\]() ,/-]+?)(?: = (?P<value>[^\n]+?): | is missing: )")
_FILE_ALONE = re.compile(r"(?P<file>[^\n:]*/[^\n:]*): ")  # about the whole of it
_BARE_KEY = re.compile(r"(?P<key>[\w.\[\]() ,/-]+?): ")
_ARGUMENT = re.compile(r"(?P<key>[a-z][a-z_0-9]*): ")


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
        self.file, self.line, self.key, self.value = None, None, key, value
        if key is None:
            self._read(message)

    def _read(self, message: str, file: str | None = None) -> None:
        """Takes from the message what is certain; `file`: how it begins where it is about that file."""
        if file is not None and message.startswith(f"{file}: "):
            self.file, rest = file, message[len(file) + 2 :]
        elif place := _PLACE.match(message):
            self.file, self.line, rest = place["file"], int(place["line"]), message[place.end() :]
        else:
            found = _FILE.match(message)
            self.file, rest = (found["file"], message[found.end() :]) if found else (None, message)
        if found := _KEY.match(rest):
            self.key, self.value = found["key"], found["value"]
            if self.value is not None and len(self.value) > 1 and self.value[0] == self.value[-1] == '"':
                self.value = self.value[1:-1]
        elif self.line is not None:
            found = None if rest.startswith("not TOML: ") else _BARE_KEY.match(rest)
            self.key = found["key"] if found else self.key
        elif self.file is None:
            found = _ARGUMENT.match(rest)
            self.key = found["key"] if found else self.key
            alone = None if found else _FILE_ALONE.match(rest)
            self.file = alone["file"] if alone else None

    def about(self, file: str, shown: str, *, key: str, value: Any) -> BadInput:
        """The same, where `file` was read: what is wrong with all of that is wrong with the argument that names it.

        shown  the file's name as messages have it
        """
        refusal = BadInput(str(self), key=key, value=value)
        refusal._read(str(self), shown)
        if refusal.file == shown:
            refusal.file = file
        elif refusal.file is None:
            refusal.key, refusal.value = key, value
        return refusal

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), self.args, self.__dict__


class BadType(BadInput, TypeError):
    """An argument is of a type that cannot be what is asked for."""
