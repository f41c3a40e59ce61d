"""Computes the references of models/benchmarks anew and holds the files against them.

    check_references.py MODELS [NAME ...]

A figure of a file is met where it lies within the tolerance that the file gives; each must be found
by the equations in mechanisms.py or andrews_squeezer.py. Figures with a source of their own, such
as published ones, are not looked at.
"""

import re
import sys
from pathlib import Path

import mechanisms
from andrews_squeezer import andrews_squeezer

UNITS = {"ms": 1e-3, "s": 1.0}
FIGURE = re.compile(r"- \{output: (\w+), (?:column: (\w+), )?time: (\S+) (m?s), "
                    r"value: (\S+?)(?: [^,]+)?, tolerance: (\S+?)(?: [^,}]+)?\}")


def figures(file):
    """Of a reference file: time, (output, column), value and tolerance."""
    for output, column, time, unit, value, tolerance in FIGURE.findall(file.read_text()):
        yield float(time) * UNITS[unit], (output, column), float(value), float(tolerance)


def main():
    models, names = Path(sys.argv[1]), sys.argv[2:]
    failures = 0
    for name, compute in (mechanisms.ALL | {"andrews-squeezer": andrews_squeezer}).items():
        if names and name not in names:
            continue
        found = {round(time, 9): values for time, values in compute().items()}
        held = 0
        for time, key, value, tolerance in figures(models / "benchmarks" / name / "reference.yaml"):
            computed = found.get(round(time, 9), {}).get(key)
            label = f"{name}: {' '.join(filter(None, key))} at {time:g} s"
            if computed is None:
                print(f"{label} is found by no equation here")
                failures += 1
                continue
            held += 1
            if abs(computed - value) > tolerance:
                print(f"{label} is {computed:.13g}, the file has {value:.13g} +- {tolerance:g}")
                failures += 1
        print(f"{name}: {held} figures")
        failures += held == 0
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
