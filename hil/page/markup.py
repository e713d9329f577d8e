"""Text as HTML and XML may hold it."""

from __future__ import annotations

from typing import Any

# XML has no way to write them at all, and a page should not hold marks that turn the direction of writing.
_SPELLED_OUT = [*range(0x20), *range(0x7F, 0xA0), 0x200E, 0x200F, *range(0x202A, 0x202F), *range(0x2066, 0x206A)]
_SPELLED_OUT += [*range(0xD800, 0xE000), 0xFFFE, 0xFFFF]
_LAYOUT = "\n\t"
_SPELLING = {code: f"\\u{code:04x}" for code in _SPELLED_OUT if chr(code) not in _LAYOUT}


def printable(text: str) -> str:
    """What no reader could take is spelled out: "\\u001b". Lines stay."""
    return text.translate(_SPELLING)


def printable_values(content: Any) -> Any:
    """The same with every text that is a value of it, as JSON nests them."""
    if isinstance(content, dict):
        return {key: printable_values(value) for key, value in content.items()}
    if isinstance(content, list):
        return [printable_values(value) for value in content]
    return printable(content) if isinstance(content, str) else content
