"""The frames on the bus around the first rule that fired, or before the end of a case in which none did."""

from __future__ import annotations

from bench_results import CaseResult, TracedFrame
from markup import escaped, number, table

BEFORE_S, AFTER_S = 3.0, 1.0
# Of one case, so that a page of many can still be scrolled.
MOST_FRAMES = 200


def frames_around(result: CaseResult) -> tuple[str, list[TracedFrame]]:
    """What the frames are, in words, and these: those nearest to the moment, in their order."""
    trace = result.trace
    if not trace:
        return "There is no trace of the bus.", []
    fired = result.first_firing
    moment = fired.time_s if fired is not None else trace[-1].time_s
    what = f"around the first rule that fired ({fired.rule})" if fired is not None else "at the end"
    missed = ""
    if moment < trace[0].time_s:
        missed = f" The trace begins at {number(trace[0].time_s)} s, after that: these are the last before the end."
        moment, what = trace[-1].time_s, "at the end"
    inside = [frame for frame in trace if moment - BEFORE_S <= frame.time_s <= moment + AFTER_S]
    nearest = sorted(range(len(inside)), key=lambda i: (abs(inside[i].time_s - moment), -i))[:MOST_FRAMES]
    shown = [inside[i] for i in sorted(nearest)]
    span = f"{number(shown[0].time_s)} s to {number(shown[-1].time_s)} s"
    kind = "messages" if result.bus == "LCM" else "frames"
    return f"{len(shown)} of {len(trace)} {kind} that were kept, {what}: {span}.{missed}", shown


def _frame_row(frame: TracedFrame, group_names: dict[int, str]) -> list[str]:
    data = " ".join(frame.data[i : i + 2] for i in range(0, len(frame.data), 2))
    sender = "Earshot" if frame.from_earshot else "vehicle"
    group = f"{frame.pgn} {group_names.get(frame.pgn, '')}"
    return [
        number(frame.time_s),
        sender if frame.channel else f"{sender} {frame.source}",
        escaped(frame.channel or group),
        f"<code>{escaped(data)}</code>",
    ]


def _remarks(result: CaseResult) -> list[tuple[float, int, list[str]]]:
    """Rows that say what else happened: a fault before the frames of its second, a rule behind them."""
    remarks = []
    for fault in result.faults:
        remarks.append((fault.from_s, 0, ["fault begins", fault.words]))
        if fault.until_s is not None:
            remarks.append((fault.until_s, 0, ["fault ends", fault.words]))
    for event in result.events:
        measured = f"{number(event.measure, 2)} (limit {number(event.limit, 2)}): {event.response}"
        remarks.append((event.time_s, 2, [f"rule {'fires' if event.begins else 'ends'}", f"{event.rule}, {measured}"]))
    return [
        (time, order, [number(time), *(f"<strong>{escaped(cell)}</strong>" for cell in cells), ""])
        for time, order, cells in remarks
    ]


def trace_html(result: CaseResult, group_names: dict[int, str]) -> str:
    words, frames = frames_around(result)
    if not frames:
        return f"<p>{escaped(words)}</p>\n"
    first, last = frames[0].time_s, frames[-1].time_s
    rows = [(frame.time_s, 1, _frame_row(frame, group_names)) for frame in frames]
    rows += [remark for remark in _remarks(result) if first <= remark[0] <= last]
    rows.sort(key=lambda row: row[:2])
    of_can, of_lcm = ("sender, address", "parameter group", "data"), ("sender", "channel", "first 64 bytes")
    shown = table(("time (s)", *(of_lcm if result.bus == "LCM" else of_can)), (cells for *_, cells in rows), "trace")
    return f"<details><summary>{escaped(words)}</summary>\n{shown}</details>\n"
