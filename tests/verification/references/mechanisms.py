"""The benchmark mechanisms by equations of their own, each in the fewest coordinates.

One coordinate s, kinetic energy M(s) s'^2 / 2 and potential V(s): Lagrange's equation is
M s'' + M' s'^2 / 2 + V' = 0. Derivatives over s are those along an imaginary step, which lose no
digits. Each function returns what it found: {time: {(output, column): value}}, in SI units.
"""

import cmath
import math

from extrapolation import states

G = 9.81
TINY = 1e-40  # imaginary step


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def open_chain():
    """Three rods by their absolute angles: sum_j c_ij (cos(i - j) j'' + sin(i - j) j'^2) = Q_i."""
    arm = [[0.5, 0, 0], [1, 0.5, 0], [1, 1, 0.5]]  # of the angles on the centres, m
    c = [[sum(a[i] * a[j] for a in arm) + (i == j) / 12 for j in range(3)] for i in range(3)]
    weight = [G * sum(a[i] for a in arm) for i in range(3)]

    def rate(_, y):
        angle, speed = y[:3], y[3:]
        mass = [[c[i][j] * math.cos(angle[i] - angle[j]) for j in range(3)] for i in range(3)]
        load = [weight[i] * math.cos(angle[i])
                - sum(c[i][j] * math.sin(angle[i] - angle[j]) * speed[j] ** 2 for j in range(3))
                for i in range(3)]
        columns = list(zip(*mass))
        whole = dot(columns[0], cross(columns[1], columns[2]))
        return speed + [dot(*[(load, cross(columns[1], columns[2])),
                              (columns[0], cross(load, columns[2])),
                              (columns[0], cross(columns[1], load))][k]) / whole
                        for k in range(3)]

    found = {}
    times = [1.0, 2.0]
    for time, y in zip(times, states(rate, [0.0] * 6, times, 0.02)):
        found[time] = {("q1", ""): y[0], ("q2", ""): y[1] - y[0], ("q3", ""): y[2] - y[1],
                       ("q1_rate", ""): y[3],
                       ("tip", "x"): sum(map(math.cos, y[:3])),
                       ("tip", "z"): -sum(map(math.sin, y[:3]))}
    return found


def one_coordinate(energies, s, rate_of_s, times, largest_step):
    """(s, s', s'') at the times; energies(s) gives M and V, of complex s too."""
    def acceleration(s, v):
        mass, potential = energies(complex(s, TINY))
        return -(mass.imag / TINY * v * v / 2 + potential.imag / TINY) / mass.real

    def rate(_, y):
        return [y[1], acceleration(*y)]

    return [(*y, acceleration(*y)) for y in states(rate, [s, rate_of_s], times, largest_step)]


def paper_loop():
    """By the crank's angle a; the rod's is -b with rod sin b = crank sin a - height."""
    crank, rod, height = 0.5, 1.5, 0.2

    def slopes(a):
        """sin and cos of the rod's angle, and its first derivative over a."""
        sine = (height - crank * cmath.sin(a)) / rod
        cosine = cmath.sqrt(1 - sine * sine)
        return sine, cosine, -crank * cmath.cos(a) / (rod * cosine)

    def energies(a):
        sine, cosine, turn = slopes(a)
        # Centres in the plane of motion (y, z); bodies turn about x.
        y1, z1 = 0.25, 0.02
        y2, z2 = 0.7, 0.05
        first = [-y1 * cmath.sin(a) - z1 * cmath.cos(a), y1 * cmath.cos(a) - z1 * cmath.sin(a)]
        pin = [-crank * cmath.sin(a), crank * cmath.cos(a)]
        second = [pin[0] + turn * (-y2 * sine - z2 * cosine),
                  pin[1] + turn * (y2 * cosine - z2 * sine)]
        slide = pin[0] - turn * rod * sine
        mass = (10 * dot(first, first) + 0.25 + 20 * dot(second, second) + 4 * turn * turn
                + 30 * slide * slide)
        potential = G * (10 * (y1 * cmath.sin(a) + z1 * cmath.cos(a))
                         + 20 * (crank * cmath.sin(a) + y2 * sine + z2 * cosine))
        return mass, potential

    found = {}
    times = [2.5, 5.0]
    for time, (a, v, w) in zip(times, one_coordinate(energies, math.radians(30), 4.0, times, 0.02)):
        sine, _, turn = slopes(complex(a, TINY))
        bend = turn.imag / TINY
        turn = turn.real
        found[time] = {("q1", ""): a, ("q1_rate", ""): v, ("q1_acceleration", ""): w,
                       ("q2", ""): math.asin(sine.real) - a, ("q2_rate", ""): turn * v - v,
                       ("q2_acceleration", ""): turn * w + bend * v * v - w}
    return found


def spatial_slider_crank():
    """By the crank's angle a. The universal joint's second axis is across the shaft and the rod."""
    length = 0.3

    def place(a):
        """Of the pin (y, z), of the slider along x, and the derivatives of both over a."""
        y, z = 0.1 - 0.08 * cmath.sin(a), 0.12 + 0.08 * cmath.cos(a)
        dy, dz = -0.08 * cmath.cos(a), -0.08 * cmath.sin(a)
        x = cmath.sqrt(length ** 2 - y * y - z * z)
        return y, z, x, dy, dz, -(y * dy + z * dz) / x

    def energies(a):
        y, z, x, dy, dz, dx = place(a)
        along = [x / length, -y / length, -z / length]
        d_along = [dx / length, -dy / length, -dz / length]
        reach = cmath.sqrt(y * y + z * z)
        d_reach = (y * dy + z * dz) / reach
        second = [0, z / reach, -y / reach]
        d_second = [0, dz / reach - z * d_reach / reach ** 2, -dy / reach + y * d_reach / reach ** 2]
        third = cross(along, second)
        d_third = [p + q for p, q in zip(cross(d_along, second), cross(along, d_second))]
        turn = [sum(c) / 2 for c in zip(cross(along, d_along), cross(second, d_second),
                                        cross(third, d_third))]
        spin = dot(turn, along)
        centre = [dx / 2, dy / 2, dz / 2]
        mass = (1e-4 + 0.12 * 0.04 ** 2 + 0.5 * dot(centre, centre)
                + 4e-3 * (dot(turn, turn) - spin * spin) + 4e-4 * spin * spin + 2 * dx * dx)
        return mass, G * (0.12 * (0.12 + 0.04 * cmath.cos(a)) + 0.5 * z / 2)

    found = {}
    times = [0.2, 0.5, 1.0, 2.0]
    for time, (a, _, _) in zip(times, one_coordinate(energies, 0.0, 6.0, times, 0.01)):
        found[time] = {("slider", ""): place(a)[2].real, ("angle", ""): a}
    return found


def heavy_top():
    """Euler's equations about the tip, and the attitude's quaternion."""
    inertia = [15 + 0.234375, 0.46875, 15 + 0.234375]

    def vertical(q):
        """The world's upward direction in the body's axes."""
        w, x, y, z = q
        return [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z]

    def rate(_, y):
        w, x, j, z = y[:4]
        a, b, c = speed = y[4:]
        moment = cross([0, 1, 0], [-15 * G * u for u in vertical(y[:4])])
        gyroscopic = cross(speed, [i * s for i, s in zip(inertia, speed)])
        return [(-x * a - j * b - z * c) / 2, (w * a + j * c - z * b) / 2,
                (w * b + z * a - x * c) / 2, (w * c + x * b - j * a) / 2,
                *[(m - g) / i for m, g, i in zip(moment, gyroscopic, inertia)]]

    start = [1.0, 0.0, 0.0, 0.0, 0.0, 150.0, -4.61538]
    times = [0.2, 1.0]
    early, late = states(rate, start, times, 0.005)
    w, x, y, z = late[:4]
    sign = math.copysign(1, early[0])  # q and -q are one attitude; the program gives w >= 0
    return {0.2: {("attitude", name): sign * value for name, value in zip("wxyz", early)},
            1.0: {("centre", "x"): 2 * (x * y - w * z), ("centre", "y"): w * w - x * x + y * y - z * z,
                  ("centre", "z"): 2 * (y * z + w * x)}}


def bricard():
    """By the length s of a path on the curve of its two angles.

    The first, third and fifth joint turn by a, the others by b, and the sixth hinge closes where
    (1 + sin a)(1 + sin b) = 1. Along a' = cos b (1 + sin a), b' = -cos a (1 + sin b) this holds.
    """
    axes = [1, 2, 0, 1, 2]
    origins = [[0, 0, 0], [1, 0, 0], [0, -1, 0], [0, 0, 1], [-1, 0, 0]]
    centres = [[0.5, 0, 0], [0, -0.5, 0], [0, 0, 0.5], [-0.5, 0, 0], [0, 0.5, 0]]
    along, across = 0.01 / 6, 1.01 / 12

    def turned(columns, axis, angle):
        """Axes of a body, columns, turned about one of them."""
        i, j = (axis + 1) % 3, (axis + 2) % 3
        c, s = cmath.cos(angle), cmath.sin(angle)
        out = list(columns)
        out[i] = [c * p + s * q for p, q in zip(columns[i], columns[j])]
        out[j] = [c * q - s * p for p, q in zip(columns[i], columns[j])]
        return out

    def apply(columns, vector):
        return [sum(column[k] * x for column, x in zip(columns, vector)) for k in range(3)]

    def rods(a, b):
        """Of each rod: axes, origin, velocities of turning and of the origin for s' = 1."""
        slopes = cmath.cos(b) * (1 + cmath.sin(a)), -cmath.cos(a) * (1 + cmath.sin(b))
        columns = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
        place, turn, speed = [0, 0, 0], [0, 0, 0], [0, 0, 0]
        for i in range(5):
            reach = apply(columns, origins[i])
            place = [p + q for p, q in zip(place, reach)]
            speed = [p + q for p, q in zip(speed, cross(turn, reach))]
            turn = [p + slopes[i % 2] * q for p, q in zip(turn, columns[axes[i]])]
            columns = turned(columns, axes[i], (a, b)[i % 2])
            yield columns, place, turn, speed

    def energies(a, b):
        mass = potential = 0
        for (columns, place, turn, speed), centre in zip(rods(a, b), centres):
            reach = apply(columns, centre)
            fast = [p + q for p, q in zip(speed, cross(turn, reach))]
            spin = 2 * dot(turn, reach)  # about the rod, which is 1 m long
            mass += dot(fast, fast) + across * (dot(turn, turn) - spin * spin) + along * spin * spin
            potential += G * (place[1] + reach[1])
        return mass, potential

    def rate(_, y):
        a, b, v = y
        up, down = math.cos(b) * (1 + math.sin(a)), -math.cos(a) * (1 + math.sin(b))
        mass, potential = energies(complex(a, TINY * up), complex(b, TINY * down))
        return [up * v, down * v,
                -(mass.imag / TINY * v * v / 2 + potential.imag / TINY) / mass.real]

    found = {}
    times = [0.5, 1.0, 10.0]
    for time, (a, b, _) in zip(times, states(rate, [0.0] * 3, times, 0.02)):
        *_, (_, fourth, _, _), (columns, fifth, _, _) = rods(a, b)
        last = [p + q for p, q in zip(fifth, columns[1])]
        assert max(map(abs, (last[0], last[1], last[2] - 1))) < 1e-9, "the linkage has come open"
        found[time] = {("P4", name): value.real for name, value in zip("xyz", fourth)}
    return found


def pendulum():
    """A point mass on a rod, by the angle from the plumb."""
    times = [5.0, 10.0]
    path = one_coordinate(lambda t: (1 + 0j, -G * cmath.cos(t)), -math.pi / 2, 0.0, times, 0.02)
    return {time: {("mass", "x"): math.sin(t), ("mass", "y"): -math.cos(t)}
            for time, (t, _, _) in zip(times, path)}


def four_bars(count):
    """Equal posts that turn together by q, with bars between their tops that do not turn."""
    mass = (count + 1) / 3 + count
    weight = G * ((count + 1) / 2 + count)
    path = one_coordinate(lambda q: (mass + 0j, weight * cmath.cos(q)), 0.0, -1.0, [10.0], 0.02)
    q = path[0][0]
    return {10.0: {("B0", "x"): -math.sin(q), ("B0", "y"): math.cos(q)}}


ALL = {"open-chain": open_chain, "paper-loop": paper_loop,
       "spatial-slider-crank": spatial_slider_crank, "heavy-top": heavy_top, "bricard": bricard,
       "pendulum": pendulum, "four-bar": lambda: four_bars(1), "two-four-bars": lambda: four_bars(2)}
