"""reproduction.html and reproduction.md: the same content, the figures beside the claims."""

import html

CAPTIONS = {
    "figure2": "Figure 2. The ocean: Munk profile (a) and what it does to a call of 20 Hz from 30 m depth (b). "
    "Brown: the sea floor.",
    "figure3": "Figure 3. SNR (a) and detections (b) over 100 km × 100 km at the vehicle's depth, source at the "
    "star; the search domain as it lies around the fixed source.",
    "figure4": "Figure 4. A search with a high and one with a low reward (the 95th and 5th percentile; changing "
    "source, memory and position, the longer training, seed 1). Circle: start; square: source reached; cross: not "
    "reached. Pale blue: where the source is heard. Dotted: border.",
    "figure5": "Figure 5. Reward in training: running median of the last 50 episodes; line and band: median and "
    "interquartile range of the seeds. (c): starts at least 7.5 km from every edge, border b = 0.5 km.",
    "figure6": "Figure 6. Fixed source, simple state: the first four searches of an evaluation, not chosen, as they "
    "are (a) and relative to the source (b).",
    "figure7": "Figure 7. Changing source, simple state, the longer training: the first four searches of an "
    "evaluation. Each source in its path's colour.",
    "figure8": "Figure 8. Changing source, memory state, the longer training: the first four searches of an "
    "evaluation, from the same starts.",
    "figure8b": "Figure 8, other reading. Memory and position, the longer training: the same four searches.",
    "figure9": "Figure 9. Reward of the evaluation's searches, all seeds together.",
    "sweep": "What the paper leaves open, one thing changed at a time: median reward of each training's evaluation.",
}
CLAIMS_HEADER = ["Figure", "The paper", "Earshot", "Where they differ, and why"]
SWEEP_HEADER = ["Left open", "Value", "Simple state", "Memory state", "Memory and position"]
STYLE = """
body{font:15px/1.5 system-ui,sans-serif;max-width:1060px;margin:2em auto;padding:0 1em;color:#1c2733;background:#fff;
overflow-wrap:anywhere}
h1{font-size:1.5em;margin-bottom:.2em}h2{font-size:1.15em;margin-top:2em;border-bottom:1px solid #d5dde5}
table{border-collapse:collapse;font-size:.9em;width:100%}
td,th{vertical-align:top;text-align:left;padding:.45em .7em;border-bottom:1px solid #e3e8ee}
th{background:#f3f6f9}figure{margin:1.6em 0}figure img{width:100%}figcaption{font-size:.9em;color:#4a5866}
code{background:#f3f6f9;padding:.1em .3em}.made{color:#4a5866;font-size:.9em}
.table{overflow-x:auto}table{min-width:34em;overflow-wrap:normal}
@media print{body{font-size:11px;max-width:none;margin:0;padding:0}.table{overflow:visible}table{min-width:0}
tr,figure{break-inside:avoid}h2{break-after:avoid}}
"""


def write(folder, intro, made, claims, sweep_rows, sweep_note):
    """@param intro  paragraphs; @param made  command, commit and machine; @param claims, sweep_rows  rows of text"""
    (folder / "reproduction.md").write_text(as_markdown(intro, made, claims, sweep_rows, sweep_note))
    (folder / "reproduction.html").write_text(as_html(intro, made, claims, sweep_rows, sweep_note))


TITLE = "Clark, Hunter, Isupova and Donnelly (2022), reproduced"


def as_markdown(intro, made, claims, sweep_rows, sweep_note):
    def table(header, rows):
        lines = [header, ["---"] * len(header), *rows]
        return "\n".join("| " + " | ".join(cell.replace("|", "\\|") for cell in line) + " |" for line in lines)

    def figure(name):
        return f"![{CAPTIONS[name]}]({name}.png)\n\n{CAPTIONS[name]}"

    parts = [f"# {TITLE}", *intro, f"Made by `{made['command']}` at commit `{made['commit']}`, {made['rest']}."]
    parts += ["## Claims", table(CLAIMS_HEADER, claims), "## Figures"]
    parts += [figure(name) for name in CAPTIONS if name != "sweep"]
    parts += ["## What the paper leaves open", sweep_note, table(SWEEP_HEADER, sweep_rows), figure("sweep")]
    return "\n\n".join(parts) + "\n"


def as_html(intro, made, claims, sweep_rows, sweep_note):
    text = html.escape

    def cells(tag, line):
        return "".join(f"<{tag}>{text(cell)}</{tag}>" for cell in line)

    def table(header, rows):
        body = "".join(f"<tr>{cells('td', row)}</tr>\n" for row in rows)
        return f'<div class="table"><table><tr>{cells("th", header)}</tr>{body}</table></div>'

    def figure(name):
        caption = text(CAPTIONS[name])
        return f'<figure><img src="{name}.png" alt="{caption}"><figcaption>{caption}</figcaption></figure>\n'

    command, commit, rest = text(made["command"]), text(made["commit"]), text(made["rest"])
    made_line = f'<p class="made">Made by <code>{command}</code> at commit <code>{commit}</code>, {rest}.</p>'
    return "".join(
        [
            '<!doctype html>\n<html lang="en"><meta charset="utf-8">',
            '<meta name="viewport" content="width=device-width, initial-scale=1">',
            f"<title>{TITLE}</title><style>{STYLE}</style>\n<h1>{TITLE}</h1>\n",
            *(f"<p>{text(p)}</p>\n" for p in intro),
            made_line,
            "\n<h2>Claims</h2>\n" + table(CLAIMS_HEADER, claims),
            "\n<h2>Figures</h2>\n",
            *(figure(name) for name in CAPTIONS if name != "sweep"),
            f"\n<h2>What the paper leaves open</h2>\n<p>{text(sweep_note)}</p>\n",
            table(SWEEP_HEADER, sweep_rows) + figure("sweep"),
            "</html>\n",
        ]
    )
