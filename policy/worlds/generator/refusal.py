"""What a command says in one line, instead of doing something."""

from __future__ import annotations


class Refusal(Exception):
    """Bad input: what is wrong with which, for a person to read. The command ends with 2."""
