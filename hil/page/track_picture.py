"""The way of a case's vehicle as an SVG picture: its surroundings, and the whole halt polygon beside them."""

from __future__ import annotations

from collections.abc import Callable

from bench_results import CaseResult, Place, TrackPoint
from markup import escaped
from plane import Panel, Window, extent_of, window_around

WIDTH, HEIGHT = 720, 440
_NEAR = {"left": 52.0, "top": 26.0, "side": 370.0}
_WHOLE = {"left": 486.0, "top": 26.0, "side": 190.0}
_LEGEND_LEFT, _LEGEND_TOP, _LEGEND_STEP = 452.0, 280.0, 19.0
# Of the way in what is seen of the plane.
_SMALLEST_SHARE = 0.25

# In the picture itself, so that it is one wherever it stands; a dark page changes the colours by their names.
STYLE = """
.track{--way:#0072b2;--fault:#c14a00;--halt:#b0176b;--mark:#1d2733;--grid:#d9e0e7;--text:#46535f;--ground:#fff}
.track text{font:11px system-ui,sans-serif;fill:var(--text)}.track .title{font-weight:600}
.track .tick{text-anchor:middle}.track .north{text-anchor:end}
.track .grid{stroke:var(--grid);fill:none;stroke-width:.7}.track .frame{stroke:var(--text);fill:none}
.track .way{stroke:var(--way);fill:none;stroke-width:2;stroke-linejoin:round}
.track .fault{stroke:var(--fault);fill:none;stroke-width:3;stroke-dasharray:6 3}
.track .halt{stroke:var(--halt);fill:none;stroke-width:1.5;stroke-dasharray:9 3 2 3}
.track .mark{stroke:var(--mark);fill:var(--ground);stroke-width:1.6}.track .full{fill:var(--mark)}
.track .view{stroke:var(--text);fill:none;stroke-dasharray:2 2}
@media screen and (prefers-color-scheme:dark){.track{--way:#5ab4e5;--fault:#ff9a52;--halt:#f08fc4;--mark:#e4eaf0;
--grid:#2d3843;--text:#b3bfca;--ground:#12181f}}
"""

Shape = Callable[[float, float], str]


def _circle(x: float, y: float) -> str:
    return f'<circle class="mark" cx="{x:.1f}" cy="{y:.1f}" r="5"/>'


def _star(x: float, y: float) -> str:
    spikes = ((0, -9), (2.4, -3), (8.6, -2.8), (3.6, 1.2), (5.3, 7.3), (0, 3.8), (-5.3, 7.3), (-3.6, 1.2), (-8.6, -2.8))
    corners = " ".join(f"{x + dx:.1f},{y + dy:.1f}" for dx, dy in (*spikes, (-2.4, -3)))
    return f'<polygon class="mark full" points="{corners}"/>'


def _square(x: float, y: float) -> str:
    return f'<rect class="mark" x="{x - 5:.1f}" y="{y - 5:.1f}" width="10" height="10"/>'


def _triangle(x: float, y: float) -> str:
    return f'<polygon class="mark" points="{x:.1f},{y - 8:.1f} {x + 7.5:.1f},{y + 5:.1f} {x - 7.5:.1f},{y + 5:.1f}"/>'


def _line_of(of_class: str) -> Shape:
    return lambda x, y: f'<path class="{of_class}" d="M{x - 14:.1f} {y:.1f}h28"/>'


def place_at(track: list[TrackPoint], time_s: float) -> Place:
    """Where the vehicle was then, on a straight line between two points of the track; at its ends, these."""
    for before, after in zip(track, track[1:], strict=False):
        if before.time_s <= time_s < after.time_s:
            share = (time_s - before.time_s) / (after.time_s - before.time_s)
            return Place(
                before.place.north_m + share * (after.place.north_m - before.place.north_m),
                before.place.east_m + share * (after.place.east_m - before.place.east_m),
            )
    return track[0].place if time_s < track[0].time_s else track[-1].place


def pieces(result: CaseResult) -> list[tuple[bool, list[Place]]]:
    """The track cut where faults begin and end to act; each piece says whether one acts on it."""
    track = result.track
    if not track:
        return []
    first, last = track[0].time_s, track[-1].time_s
    edges = {time for fault in result.faults for time in (fault.from_s, fault.until_s) if time is not None}
    cuts = [first, *sorted(time for time in edges if first < time < last), last]
    found: list[tuple[bool, list[Place]]] = []
    for begin, end in zip(cuts, cuts[1:], strict=False):
        places = [place_at(track, begin), *(p.place for p in track if begin < p.time_s < end), place_at(track, end)]
        acts = any(fault.acts_at((begin + end) / 2.0) for fault in result.faults)
        if found and found[-1][0] == acts:
            found[-1][1].extend(places[1:])
        else:
            found.append((acts, places))
    return found


def _marks(result: CaseResult) -> list[tuple[str, Shape, Place]]:
    marks: list[tuple[str, Shape, Place]] = [("source", _star, result.source), ("start", _circle, result.start)]
    if result.track:
        fired = result.first_firing
        if fired is not None:
            marks.append((f"first rule fires ({fired.rule})", _triangle, place_at(result.track, fired.time_s)))
        marks.append(("end", _square, result.track[-1].place))
    return marks


def _content(panel: Panel, result: CaseResult) -> str:
    parts = [f'<polygon class="halt" points="{panel.points(result.halt_polygon)}"/>']
    for acts, places in pieces(result):
        parts.append(f'<polyline class="{"fault" if acts else "way"}" points="{panel.points(places)}"/>')
    return "\n".join(parts)


def _legend(result: CaseResult) -> str:
    entries: list[tuple[str, Shape]] = [(words, shape) for words, shape, _ in _marks(result)]
    of_ways = {acts for acts, _ in pieces(result)}
    if False in of_ways:
        entries.append(("way of the vehicle", _line_of("way")))
    if True in of_ways:
        entries.append(("way while a fault acts", _line_of("fault")))
    entries.append(("halt polygon", _line_of("halt")))
    parts = []
    for index, (words, shape) in enumerate(entries):
        y = _LEGEND_TOP + index * _LEGEND_STEP
        parts.append(shape(_LEGEND_LEFT + 16, y))
        parts.append(f'<text x="{_LEGEND_LEFT + 38}" y="{y + 4:.1f}">{escaped(words)}</text>')
    return "\n".join(parts)


def surroundings(result: CaseResult) -> Window:
    """Of the way and the source; of the way alone where that would be too small to see beside the source."""
    way = [result.start, *(point.place for point in result.track)]
    seen = [*way, result.source]
    return window_around(seen if extent_of(way) >= _SMALLEST_SHARE * extent_of(seen) else way)


def track_svg(result: CaseResult, name: str) -> str:
    """@param name  a word that no other picture of the page has"""
    seen = [result.start, result.source, *(point.place for point in result.track)]
    near = Panel(surroundings(result), name=f"{name}-near", **_NEAR)
    whole = Panel(window_around([*result.halt_polygon, *seen]), name=f"{name}-whole", **_WHOLE)
    view = near.window
    corner = Place(view.south_m + view.side_m, view.west_m)
    side = view.side_m / whole.window.side_m * whole.side
    parts = [
        f'<svg class="track" viewBox="0 0 {WIDTH} {HEIGHT}" role="img" xmlns="http://www.w3.org/2000/svg">',
        f"<title>Where the vehicle went: {escaped(result.name)}</title>",
        near.frame("the vehicle's way"),
        f'<g clip-path="url(#{near.name})">',
        # Below the way, so that they do not hide a short piece of it.
        *(shape(near.x(place), near.y(place)) for _, shape, place in _marks(result)),
        f"{_content(near, result)}</g>",
        whole.frame("the whole halt polygon"),
        f'<g clip-path="url(#{whole.name})">{_content(whole, result)}',
        f"{_star(whole.x(result.source), whole.y(result.source))}</g>",
        f'<rect class="view" x="{whole.x(corner):.1f}" y="{whole.y(corner):.1f}" width="{side:.1f}" '
        f'height="{side:.1f}"/>',
        _legend(result),
        "</svg>\n",
    ]
    return "\n".join(parts)
