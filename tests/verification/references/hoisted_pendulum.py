"""A load that swings on a rope while it is wound up, by its polar coordinates.

    hoisted_pendulum.py CASE

Holds the references in the source of the verification case against what it computes anew:
    r'' = r theta'^2 + g cos theta - T/m,   theta'' = -(2 r' theta' + g sin theta) / r
with T = k (r - l) + c (r' - l'), k = EA / l and c = damping time times k.
"""

import math
import re
import sys
from pathlib import Path

from extrapolation import states

MASS, LENGTH, EA, DAMPING_TIME, G = 1e4, 20.0, 4e7, 5e-3, 9.81
# Its jerk is 1, -1, 0, -1, 1 m/s3 up to these times, s: up to 1 m/s within 2 s, and down from it.
JERK = [(1.0, 1.0), (2.0, -1.0), (8.0, 0.0), (9.0, -1.0), (10.0, 1.0)]


def wound_up(t):
    """Length taken in, and its rate: the cubics of the jerk, one after another."""
    taken = rate = acceleration = begin = 0.0
    for end, jerk in JERK:
        h = max(0.0, min(t, end) - begin)
        taken += h * (rate + h * (acceleration / 2 + h * jerk / 6))
        rate += h * (acceleration + h * jerk / 2)
        acceleration += h * jerk
        begin = end
    return taken, rate


def rate_from(begin):
    """Of the state after this time: the integration of a stretch starts at its own zero."""
    def rate(t, y):
        r, theta, r_rate, theta_rate = y
        taken, speed = wound_up(begin + t)
        length = LENGTH - taken
        stiffness = EA / length
        tension = stiffness * (r - length + DAMPING_TIME * (r_rate + speed))
        return [r_rate, theta_rate, r * theta_rate ** 2 + G * math.cos(theta) - tension / MASS,
                -(2 * r_rate * theta_rate + G * math.sin(theta)) / r]
    return rate


def place():
    """x and z of the load after 10 s, from 0.3 rad at rest, stretched by its weight."""
    state, begin = [LENGTH + MASS * G * LENGTH / EA, 0.3, 0.0, 0.0], 0.0
    # Each stretch ends where the jerk jumps, so that the order holds.
    for end, _ in JERK:
        state = states(rate_from(begin), state, [end - begin], 0.01)[0]
        begin = end
    r, theta = state[:2]
    return {"x": r * math.sin(theta), "z": -r * math.cos(theta)}


def main():
    held = re.findall(r'"load at 10 s, (.)", "m", ([-\d.]+)', Path(sys.argv[1]).read_text())
    failures = len(held) != 2
    for axis, value in held:
        found = place()[axis]
        print(f"load at 10 s, {axis}: {found:.12f} m, the case has {value}")
        failures += abs(found - float(value)) > 1e-11
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
