"""Text as HTML and XML may hold it."""

from __future__ import annotations

import html
from collections.abc import Iterable

# XML has no way to write them at all, and a page should not hold marks that turn the direction of writing.
_SPELLED_OUT = [*range(0x20), *range(0x7F, 0xA0), 0x200E, 0x200F, *range(0x202A, 0x202F), *range(0x2066, 0x206A)]
_SPELLED_OUT += [*range(0xD800, 0xE000), 0xFFFE, 0xFFFF]
_LAYOUT = "\n\t"
_SPELLING = {code: f"\\u{code:04x}" for code in _SPELLED_OUT if chr(code) not in _LAYOUT}


def printable(text: str) -> str:
    """What no reader could take is spelled out: "\\u001b". Lines stay."""
    return text.translate(_SPELLING)


def escaped(text: str) -> str:
    return html.escape(printable(text))


def number(value: float | None, decimals: int = 1) -> str:
    """Without needless zeros; a dash where there is none."""
    if value is None:
        return "\N{EN DASH}"
    text = f"{value:.{decimals}f}"
    return (text.rstrip("0").rstrip(".") if "." in text else text).replace("-", "\N{MINUS SIGN}")


def table(header: Iterable[str], rows: Iterable[Iterable[str]], of_class: str = "") -> str:
    """@param rows  of cells that are HTML already"""
    head = "".join(f'<th scope="col">{escaped(cell)}</th>' for cell in header)
    body = "\n".join("<tr>" + "".join(f"<td>{cell}</td>" for cell in row) + "</tr>" for row in rows)
    attribute = f' class="{of_class}"' if of_class else ""
    return f'<div class="table"><table{attribute}><thead><tr>{head}</tr></thead>\n<tbody>{body}</tbody></table></div>\n'


def bullets(items: Iterable[str], of_class: str = "") -> str:
    """@param items  text"""
    attribute = f' class="{of_class}"' if of_class else ""
    return f"<ul{attribute}>" + "".join(f"<li>{escaped(item)}</li>" for item in items) + "</ul>\n"
