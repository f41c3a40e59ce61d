"""Andrews' squeezer by its crank's angle alone, and the forces at the point where its loops meet.

Names, lengths and masses are those of the Test Set for IVP Solvers, after Schiehlen (1990),
Multibody Systems Handbook. Its seven bodies have one freedom: every point is where two bars of
known ends meet.
"""

import cmath
import math

from mechanisms import TINY, dot, one_coordinate

A, B, C = [-0.06934, -0.00227], [-0.03635, 0.03273], [0.014, 0.072]
RR, D, SS, E, ZT, U, ZF = 0.007, 0.028, 0.035, 0.02, 0.04, 0.04, 0.02
STILL = [0, 0]
STIFFNESS, FREE_LENGTH, TORQUE = 4530, 0.07785, 0.033
SPRING_END = 0.02, -0.018  # in K3's axes
# Mass, moment of inertia about the centre of mass, and its place in the body's own axes.
BODIES = {"K1": (0.04325, 2.194e-6, 0.00092, 0), "K2": (0.00365, 4.410e-7, -0.0115, 0),
          "K3": (0.02373, 5.255e-6, 0.01043, -0.01874), "K5": (0.07050, 1.169e-5, 0.02308, 0.00916),
          "K4": (0.00706, 5.667e-7, 0, 0.01421 - E), "K7": (0.05498, 1.912e-5, -0.00449, -0.01228),
          "K6": (0.00706, 5.667e-7, ZF - 0.01421, 0)}


def across(v):
    """Turned by a quarter to the left."""
    return [-v[1], v[0]]


def turn(a, b):
    """Of a plane's cross product, the part out of the plane."""
    return a[0] * b[1] - a[1] * b[0]


def minus(a, b):
    return [p - q for p, q in zip(a, b)]


def scaled(factor, v):
    return [factor * p for p in v]


def from_moments(first, first_moment, second, second_moment):
    """The vector that has these moments about two points, at these arms."""
    whole = turn(first, second)
    return [(first_moment * q - second_moment * p) / whole for p, q in zip(first, second)]


def meeting(p, dp, p_length, q, dq, q_length, side):
    """The end of two bars hinged at p and at q, and its velocity."""
    line = minus(q, p)
    square = dot(line, line)
    part = (square + p_length ** 2 - q_length ** 2) / (2 * square)
    height = side * cmath.sqrt(p_length ** 2 / square - part * part)
    end = [o + part * a + height * b for o, a, b in zip(p, line, across(line))]
    arms = [minus(end, p), minus(end, q)]
    # Both bars keep their lengths.
    return end, scaled(-1, across(from_moments(arms[0], dot(arms[0], dp), arms[1],
                                               dot(arms[1], dq))))


class Pose:
    """Points of the mechanism and axes of its bodies at an angle of the crank, with slopes."""

    def __init__(self, beta):
        axis = [cmath.cos(beta), cmath.sin(beta)]
        p, dp = scaled(RR, axis), scaled(RR, across(axis))
        e, de = meeting(p, dp, D, B, STILL, SS, 1)
        q, dq = meeting(A, STILL, ZT, e, de, E, 1)
        r, dr = meeting(A, STILL, U, e, de, ZF, -1)
        self.e, self.joints = e, {"K1": STILL, "K2": p, "K3": B, "K5": A, "K4": q, "K7": A, "K6": r}
        slopes = {"K1": STILL, "K2": dp, "K3": STILL, "K5": STILL, "K4": dq, "K7": STILL, "K6": dr}
        # Bars along their bodies' first axes, then those against the second.
        self.axes = {"K1": (axis, across(axis))}
        for name, start, end, speed, length in (("K2", e, p, minus(dp, de), D),
                                                ("K5", A, q, dq, ZT),
                                                ("K6", r, e, minus(de, dr), ZF)):
            self.axes[name] = scaled(1 / length, minus(end, start)), scaled(1 / length, speed)
        for name, start, end, speed, length in (("K3", B, e, de, SS),
                                                ("K4", q, e, minus(de, dq), E),
                                                ("K7", A, r, dr, U)):
            self.axes[name] = (across(scaled(1 / length, minus(end, start))),
                               across(scaled(1 / length, speed)))
        self.spins = {name: turn(*axes) for name, axes in self.axes.items()}
        self.centres, self.speeds = {}, {}
        for name, (_, _, x, y) in BODIES.items():
            self.centres[name] = self.point(name, x, y)
            u, du = self.axes[name]
            self.speeds[name] = [o + x * a + y * b
                                 for o, a, b in zip(slopes[name], du, across(du))]

    def point(self, name, x, y):
        """A body's point, by its own axes."""
        u = self.axes[name][0]
        return [o + x * a + y * b for o, a, b in zip(self.joints[name], u, across(u))]

    def spring(self):
        """From the spring's end on K3 to its end on the ground; its length."""
        line = minus(C, self.point("K3", *SPRING_END))
        return line, cmath.sqrt(dot(line, line))

    def angle(self, name):
        x, y = self.axes[name][0]
        return math.atan2(y.real, x.real)


def energies(beta):
    pose = Pose(beta)
    mass = sum(m * dot(pose.speeds[name], pose.speeds[name]) + inertia * pose.spins[name] ** 2
               for name, (m, inertia, _, _) in BODIES.items())
    return mass, STIFFNESS * (pose.spring()[1] - FREE_LENGTH) ** 2 / 2 - TORQUE * beta


def forces(beta, rate, acceleration):
    """Of K2 on K3, K4 and K6 at the point E, by balances of moments."""
    pose, beside = Pose(beta), Pose(complex(beta, TINY))

    def second(slope, slope_beside):
        return slope.real * acceleration + slope_beside.imag / TINY * rate ** 2

    def moment(about, *names):
        """What must act on these bodies about this point."""
        total = 0
        for name in names:
            m, inertia, _, _ = BODIES[name]
            pull = [m * second(a, b) for a, b in zip(pose.speeds[name], beside.speeds[name])]
            total += turn(minus(pose.centres[name], about), pull)
            total += inertia * second(pose.spins[name], beside.spins[name])
        return total

    line, length = pose.spring()
    pull = scaled(STIFFNESS * (1 - FREE_LENGTH / length), line)
    arm = {name: minus(pose.e, joint) for name, joint in pose.joints.items()}
    on_k4 = from_moments(arm["K4"], moment(pose.joints["K4"], "K4"), arm["K5"],
                         moment(A, "K4", "K5"))
    on_k6 = from_moments(arm["K6"], moment(pose.joints["K6"], "K6"), arm["K7"],
                         moment(A, "K6", "K7"))
    by_spring = turn(minus(pose.point("K3", *SPRING_END), B), pull)
    on_others = [p + q for p, q in zip(on_k4, on_k6)]
    on_k3 = from_moments(arm["K3"], moment(B, "K3") - by_spring, arm["K2"],
                         -moment(pose.joints["K2"], "K2") - turn(arm["K2"], on_others))
    return {(loop, f"force_{axis}"): value.real
            for loop, force in (("E3", on_k3), ("E4", on_k4), ("E6", on_k6))
            for axis, value in zip("xy", force)}


def andrews_squeezer():
    time = 0.03
    start = -0.0617138900142764496
    beta, rate, acceleration = one_coordinate(energies, start, 0.0, [time], 5e-5)[0]
    pose = Pose(complex(beta))
    angle = {name: pose.angle(name) for name in BODIES}
    spin = {name: pose.spins[name].real * rate for name in BODIES}
    found = {("beta", ""): beta, ("beta_rate", ""): rate}
    for joint, body, carrier in (("Theta", "K2", "K1"), ("gamma", "K3", None), ("Phi", "K4", "K5"),
                                 ("delta", "K5", None), ("Omega", "K6", "K7"),
                                 ("epsilon", "K7", None)):
        carried = beta if carrier == "K1" else angle[carrier] if carrier else 0.0
        found[joint, ""] = angle[body] - carried
        found[f"{joint}_rate", ""] = spin[body] - (spin[carrier] if carrier else 0.0)
    found.update(forces(beta, rate, acceleration))
    return {time: found}
