"""What the page says of one case."""

from __future__ import annotations

import math

from bench_results import CaseResult
from bus_trace import trace_html
from markup import bullets, escaped, number, table
from track_picture import track_svg


def verdict(result: CaseResult) -> str:
    """In a word and a sign, so that the colour is not needed."""
    if result.passed:
        return '<span class="passed">\N{CHECK MARK} passed</span>'
    return '<span class="failed">\N{MULTIPLICATION X} failed</span>'


def _story(result: CaseResult) -> str:
    rules = ", ".join(result.expected_rules)
    defence = result.defence or (f"the rules: {rules}" if rules else "")
    rows = [("given", result.given), ("when", result.when), ("then", result.then), ("by", defence)]
    return "<dl>" + "".join(f"<dt>{name}</dt><dd>{escaped(text)}</dd>" for name, text in rows if text) + "</dl>\n"


def _faults(result: CaseResult) -> str:
    if not result.faults:
        return "<p>No fault.</p>\n"
    return bullets(fault.words for fault in result.faults)


def _rules_that_fire(result: CaseResult) -> str:
    rules = ", ".join(result.expected_rules)
    if result.others_may_fire:
        return f"Rules fire: {rules or 'none has to'}; others may."
    return f"Rules fire: {rules}; no other may." if rules else "No rule fires."


def _had_to_happen(result: CaseResult) -> str:
    sentences = [f"End of the mission: {result.expected_end}.", _rules_that_fire(result)]
    for what, is_refused in (("fix", result.refuses_navigation), ("order", result.refuses_commands)):
        sentences += [] if is_refused is None else [f"{'At least one' if is_refused else 'No'} {what} is refused."]
    for is_asked, words in (
        (result.loses_nothing, "Nothing is lost on its way in."),
        (result.least_decisions, f"Decisions after the first fault: at least {result.least_decisions}."),
        (result.comes_up, "The vehicle is at the surface at the end."),
        (result.releases_weight, "The drop weight is released."),
        (result.refuses_frames, "The kernel has no room for at least one frame."),
        (result.refuses_to_fly, "Earshot refuses to fly."),
    ):
        sentences += [words] if is_asked else []
    return bullets(sentences)


def _places(result: CaseResult) -> list[str]:
    if not result.track:
        return ["The vehicle has no track."]
    deepest = max(point.depth_m for point in result.track)
    last, source = result.track[-1], result.source
    away_m = math.hypot(source.north_m - last.place.north_m, source.east_m - last.place.east_m)
    return [
        f"The vehicle was at most {number(deepest)} m deep, and {number(last.depth_m)} m at the end, "
        f"{number(away_m, 0)} m from the source."
    ]


def _happened(result: CaseResult) -> str:
    counts = result.counts
    what = "Datagrams" if result.bus == "LCM" else "Frames"
    sentences = [
        f"End of the mission: {result.end}, after {number(result.at_sea_s)} s at sea ({number(result.wall_s)} s here).",
        *_places(result),
        f"{counts['setpoints']} set-points; {counts['navigation_refused']} fixes and {counts['commands_refused']} "
        "orders were refused.",
        f"{what}: {counts['frames_sent']} sent by the vehicle, {counts['frames_received']} by Earshot; "
        f"{counts['frames_lost_by_kernel']} lost by the kernel, {counts['frames_afflicted']} befallen by a fault.",
    ]
    return bullets(sentences)


def _rules(result: CaseResult) -> str:
    if not result.events:
        return "<p>No rule fired.</p>\n"
    rows = [
        [
            number(event.time_s),
            f"<code>{escaped(event.rule)}</code>",
            "fires" if event.begins else "ends",
            number(event.measure, 2),
            number(event.limit, 2),
            escaped(event.response),
        ]
        for event in result.events
    ]
    return table(("time (s)", "rule", "what it does", "measured", "limit", "response"), rows, "rules")


def case_section(result: CaseResult, group_names: dict[int, str], number_of_case: int) -> str:
    parts = [
        f'<section id="case-{number_of_case}"><h2>{escaped(result.name)} {verdict(result)}</h2>\n',
        _story(result),
        "" if result.passed else "<h3>What is wrong</h3>\n" + bullets(result.wrong, "wrong"),
        "<h3>What was done</h3>\n" + _faults(result),
        "<h3>What had to happen</h3>\n" + _had_to_happen(result),
        "<h3>What happened</h3>\n" + _happened(result) + _rules(result),
        f'<div class="picture">{track_svg(result, f"case-{number_of_case}")}</div>\n',
        "<h3>On the bus</h3>\n" + trace_html(result, group_names),
        "</section>\n",
    ]
    return "".join(parts)
