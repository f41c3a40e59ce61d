"""The verification register: the figures of `blocklift verify`, or the list of its cases without them."""

import json
import math
from collections import Counter
from pathlib import Path

PASS, FAIL = "#2f7d4f", "#b3261e"


def number(value):
    return "–" if value is None else f"{value:.6g}"


def small(value):
    return "–" if value is None else f"{value:.1e}"


def cell(text):
    return str(text).replace("|", "\\|")


def plot(rows):
    """Each figure's error over its tolerance, one mark a figure, as SVG on a scale of decades."""
    width, height, left, bottom, lowest = 760, 220, 44, 28, -6.0
    def across(i):
        return left + (width - left - 8) * (i + 0.5) / len(rows)
    def up(decade):
        return 8 + (height - bottom - 8) * (1 - (min(max(decade, lowest), 1.0) - lowest) / (1.0 - lowest))
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" '
             'font-family="sans-serif" font-size="11">']
    for decade in range(int(lowest), 2):
        colour = "#666" if decade == 0 else "#ddd"
        parts.append(f'<line x1="{left}" x2="{width - 8}" y1="{up(decade):.1f}" y2="{up(decade):.1f}" '
                     f'stroke="{colour}"/><text x="{left - 6}" y="{up(decade) + 4:.1f}" '
                     f'text-anchor="end" fill="#555">{"1" if decade == 0 else f"1e{decade}"}</text>')
    for i, row in enumerate(rows):
        error, tolerance = row["error"], row["tolerance"]
        ratio = error / tolerance if error and tolerance else 0.0
        decade = math.log10(ratio) if ratio > 0 else lowest
        parts.append(f'<circle cx="{across(i):.1f}" cy="{up(decade):.1f}" r="2.5" '
                     f'fill="{PASS if row["pass"] else FAIL}"/>')
    parts.append(f'<text x="{left}" y="{height - 8}" fill="#555">error over tolerance of the '
                 f'{len(rows)} figures in their order; smaller ones stand on the lowest line</text></svg>')
    return "\n".join(parts)


def figures_of(stage, rows):
    text = []
    for name in dict.fromkeys(row["stage"] for row in rows):
        own = [row for row in rows if row["stage"] == name]
        failed = sum(not row["pass"] for row in own)
        picture = f"docs/verification-{name}.svg"
        stage.write(picture, plot(own))
        text += [f"## Register: {name}", "",
                 f"{len(own) - failed} of {len(own)} figures agree with their references.", "",
                 f"![Errors over tolerances, {name}](verification-{name}.svg)", ""]
        for case in dict.fromkeys(row["name"] for row in own):
            chosen = [row for row in own if row["name"] == case]
            sources = Counter(row["source"] for row in chosen)
            text += [f"### {case} {{: #{name}-{case} }}", "", "; ".join(map(cell, sources)), "",
                     "| figure | unit | reference | computed | error | tolerance | |",
                     "|---|---|--:|--:|--:|--:|---|"]
            text += [f"| {cell(row['quantity'])} | {row['unit']} | {number(row['reference'])} | "
                     f"{number(row['computed'])} | {small(row['error'])} | {small(row['tolerance'])} | "
                     f"{'agrees' if row['pass'] else '**differs**'} |" for row in chosen]
            text.append("")
    return text


def list_of(listed):
    text = ["## Register", "", "These are the cases; the figures were not computed for this copy of the site.", "",
            "| case | reference |", "|---|---|"]
    for line in listed.splitlines():
        name, _, source = line.partition(" ")
        text.append(f"| {name} | {cell(source.strip())} |")
    return text


def write_register(stage, listed, figures):
    if figures and Path(figures).is_file():
        rows = json.loads(Path(figures).read_text())["results"]
        text = figures_of(stage, rows)
    else:
        text = list_of(listed)
    stage.fill("docs/verification.md", "register", "\n".join(text))
