#!/usr/bin/env python3
"""What moves the loads of the launch: the ship hoisted and hanging for a minute, one thing varied at a time.

    cases/floating-crane-launch/sweep.py build/release/blocklift

prints the table of this case's README. It needs nothing but the program and Python.
"""

import csv
import pathlib
import subprocess
import sys
import tempfile

CASE = pathlib.Path(__file__).resolve().parent / "case.yaml"
SLINGS = [f"H{i}" for i in range(1, 9)]
HANGING = 60.0  # s, at the end of the run
WAVE = "{amplitude: 0.5 m, frequency: 0.628 rad/s, heading: 45 deg, phase: 0 deg}"
DRAUGHTS = "  draughts: [0.8 m, 1.6 m, 2.4 m]\n"  # she stays dry here: what she radiates need not be known
HOIST = "{drives: [F1.left, F1.right, F2.left, F2.right], by: -9 m}"
SHARED = " equalised: [left, right],"  # hooks are independent here


def wave(frequency="0.628 rad/s", heading="45 deg"):
    return WAVE, f"{{amplitude: 0.5 m, frequency: {frequency}, heading: {heading}}}"


def speed(value):
    return HOIST, HOIST.replace("-9 m", f"-11 m, speed: {value}")


def stiffness(value):
    return "base: B", f"parameters: {{hook_stiffness: {value}}}, base: B"


VARIANTS = [
    ("the case: 45 degrees, 10 s, 3 m/min, hooks on 60 MN/m", None),
    ("waves along the pontoons, 0 degrees", wave(heading="0 deg")),
    ("waves abeam, 90 degrees", wave(heading="90 deg")),
    ("period 8 s", wave(frequency="0.785 rad/s")),
    ("period 12 s", wave(frequency="0.524 rad/s")),
    ("hoisted at 1.5 m/min", speed("1.5 m/min")),
    ("hooks on 20 MN/m", stiffness("20 MN/m")),
]


def hanging_case(text, change):
    """The case's text up to the hoist, a pause after it, and one passage changed."""
    first = text.index("  - stage: hoist")
    rest = text.index("settle:")
    text = text[:first] + f"  - stage: hang\n    pause: {HANGING:g} s\n" + text[rest:]
    # Independent hooks, hoisted at once.
    base = [(DRAUGHTS, ""), (SHARED, "")] + ([] if change and change[0] == HOIST else [(HOIST, HOIST.replace("-9 m", "-11 m"))])
    for passage, replacement in base + ([change] if change else []):
        if passage not in text:
            sys.exit(f'{CASE}: the passage "{passage}" is not in it any more')
        text = text.replace(passage, replacement)
    return text


def run(program, text, folder):
    """Largest static tension of each sling, and the series of the dynamic ones, t."""
    (folder / "case.yaml").write_text(text)
    out = folder / "out"
    done = subprocess.run([program, "simulate", folder / "case.yaml", "--csv", "-o", out],
                          capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(done.stderr)
    static = {}
    for line in done.stdout.splitlines():
        words = line.split()
        if words and words[0] in SLINGS:
            static[words[0]] = float(words[1])
    with open(out / "results.csv", newline="") as file:
        rows = list(csv.reader(file))
    column = {name: rows[0].index(f"{name}.tension [N]") for name in SLINGS}
    time = [float(row[0]) for row in rows[1:]]
    tension = {name: [float(row[k]) / 9806.65 for row in rows[1:]] for name, k in column.items()}
    return static, time, tension


def percent(value, reference):
    return f"{100 * (value / reference - 1):+.0f} %"


def figures(static, time, tension):
    """Hanging: H3, H4, all eight; lifting off: H3, H4; each over the largest static one."""
    hangs = [i for i, t in enumerate(time) if t >= time[-1] - HANGING]
    largest = {name: max(tension[name][i] for i in hangs) for name in SLINGS}
    sums = [sum(tension[name][i] for name in SLINGS) for i in hangs]
    at_rest = sum(static.values())
    off = {name: max(tension[name]) for name in ("H3", "H4")}
    return [percent(largest["H3"], static["H3"]), percent(largest["H4"], static["H4"]),
            f"{100 * (max(sums) / at_rest - 1):+.1f} %",
            f"{percent(off['H3'], static['H3'])}, {percent(off['H4'], static['H4'])}"]


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    text = CASE.read_text()
    print("| | H3 | H4 | all eight | lifting off, H3 and H4 |\n|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as name:
        for title, change in VARIANTS:
            row = figures(*run(sys.argv[1], hanging_case(text, change), pathlib.Path(name)))
            print(f"| {title} | " + " | ".join(row) + " |", flush=True)


if __name__ == "__main__":
    main()
