"""The page of a run of the bench: one HTML file that needs nothing else, no network and no script."""

from __future__ import annotations

from bench_results import CaseResult
from case_section import case_section, verdict
from markup import escaped, number, table
from track_picture import STYLE as TRACK_STYLE

BEGINNING = "<!DOCTYPE html>"
# Screens of any width, light or dark, and paper. Letters have a contrast of at least 4.5 with what is behind them.
STYLE = """
:root{color-scheme:light dark;--ink:#1d2733;--soft:#54626f;--line:#d9e0e7;--paper:#fff;--card:#f4f7fa;--good:#16694a;
--bad:#a8321a}
@media screen and (prefers-color-scheme:dark){:root{--ink:#e4eaf0;--soft:#a3b0bc;--line:#2d3843;--paper:#12181f;
--card:#1a222b;--good:#4fcb9a;--bad:#f08a6e}}
body{margin:0 auto;max-width:62rem;padding:2rem 1.25rem 4rem;background:var(--paper);color:var(--ink);
font:16px/1.5 system-ui,sans-serif;overflow-wrap:anywhere}
h1{font-size:1.7rem;margin:0 0 .25rem}h2{font-size:1.25rem;margin:2.75rem 0 .5rem;padding-top:.75rem;
border-top:2px solid var(--line)}h3{font-size:1rem;margin:1.1rem 0 .2rem}
p,ul{margin:.25rem 0}.made,summary{color:var(--soft)}a{color:inherit}summary{cursor:pointer}
.passed{color:var(--good);font-weight:600}.failed,.wrong{color:var(--bad);font-weight:600}h2 span{font-size:1rem}
dl{display:grid;grid-template-columns:auto 1fr;gap:.1rem .9rem;background:var(--card);padding:.6rem .8rem;margin:0}
dt{color:var(--soft);font-variant:small-caps}dd{margin:0}
.table{overflow-x:auto}table{border-collapse:collapse;width:100%;font-size:.85rem;font-variant-numeric:tabular-nums}
th,td{text-align:left;vertical-align:top;padding:.2rem .6rem .2rem 0;border-bottom:1px solid var(--line)}
th{color:var(--soft);font-weight:600}th,td{overflow-wrap:normal}
.trace td,.rules td,.summary td:nth-child(2){white-space:nowrap}code{font-size:.95em}
.picture{max-width:46rem;margin:1rem auto}.picture svg{display:block;width:100%;height:auto}
@media screen and (max-width:40rem){.summary tr>:nth-child(3){display:none}.picture{overflow-x:auto}
.picture svg{width:40rem}}
@media print{body{font-size:11px;max-width:none;padding:0}section{break-before:page}tr,.picture{break-inside:avoid}
.trace{font-size:8px}}
"""

# For one who has read nothing else of Earshot.
_IN_SHORT = """Each case is a search by Earshot, the software of an underwater vehicle, with something
made wrong on purpose. A rule is a limit that Earshot watches by itself; when it fires, it does what its mission orders
(response).
The source is reached where the operator sends COMPLETE: one step of the search (mostly 1 km) away from it."""


def headline(results: list[CaseResult], not_flown: list[str]) -> str:
    if not results:
        return '<h1 class="failed">\N{MULTIPLICATION X} No case was flown</h1>\n'
    failed = sum(not result.passed for result in results)
    if failed == 0 and not not_flown:
        return f'<h1 class="passed">\N{CHECK MARK} All {len(results)} cases passed</h1>\n'
    sentences = [f"{failed} of {len(results)} cases failed"] if failed else []
    sentences += [f"{len(not_flown)} of {len(results) + len(not_flown)} cases were not flown"] if not_flown else []
    return f'<h1 class="failed">\N{MULTIPLICATION X} {", ".join(sentences)}</h1>\n'


def _what_is_missing(results: list[CaseResult], not_flown: list[str]) -> str:
    """A reader of a long page wants these first."""
    items = [
        f'<li><a href="#case-{index}">{escaped(result.name)}</a>: {escaped(result.wrong[0])}</li>'
        for index, result in enumerate(results, 1)
        if not result.passed
    ]
    items += [f"<li>Not flown: {escaped(', '.join(not_flown))}</li>"] if not_flown else []
    return f"<ul>{''.join(items)}</ul>\n" if items else ""


def _breakable(words: str) -> str:
    """Behind each underscore a line may end."""
    return escaped(words).replace("_", "_<wbr>")


def _summary_row(index: int, result: CaseResult) -> list[str]:
    fired = dict.fromkeys(event.rule for event in result.events if event.begins)
    return [
        f'<a href="#case-{index}">{_breakable(result.name)}</a>',
        verdict(result),
        escaped(result.when),
        _breakable(", ".join(fired)) or "\N{EN DASH}",
        escaped(result.end),
        number(result.at_sea_s, 0),
    ]


def page(results: list[CaseResult], group_names: dict[int, str], made: str, not_flown: list[str]) -> str:
    """@param made       how these results came to be, a sentence
    @param not_flown  names of cases that were to be flown, too
    """
    header = ("case", "verdict", "when", "rules that fired", "how it ended", "at sea (s)")
    rows = [_summary_row(index, result) for index, result in enumerate(results, 1)]
    sections = [case_section(result, group_names, index) for index, result in enumerate(results, 1)]
    return "".join(
        [
            f'{BEGINNING}\n<html lang="en"><head><meta charset="utf-8">',
            '<meta name="viewport" content="width=device-width, initial-scale=1">',
            f"<title>Earshot: bench</title><style>{STYLE}{TRACK_STYLE}</style></head><body>\n",
            headline(results, not_flown),
            f'<p class="made">{escaped(made)}</p>\n<p>{escaped(_IN_SHORT)}</p>\n',
            _what_is_missing(results, not_flown),
            table(header, rows, "summary"),
            *sections,
            "</body></html>\n",
        ]
    )
