"""Integration by extrapolated midpoint steps; shares nothing with the program's integrators.

Source: Hairer, Norsett and Wanner (1993), Solving Ordinary Differential Equations I, section II.9:
the smoothed midpoint rule has an error in even powers of the step (Gragg), which Aitken's and
Neville's scheme extrapolates to zero.
"""

COLUMNS = 8  # order 16


def step(rate, t, y, h):
    """y at t + h, of y' = rate(t, y); y is a list of floats."""
    table = []
    for column in range(1, COLUMNS + 1):
        n = 2 * column
        part = h / n
        before, now = y, [a + part * b for a, b in zip(y, rate(t, y))]
        for i in range(1, n):
            slope = rate(t + i * part, now)
            before, now = now, [a + 2 * part * b for a, b in zip(before, slope)]
        slope = rate(t + h, now)
        row = [[(a + b + part * c) / 2 for a, b, c in zip(now, before, slope)]]
        for k, earlier in enumerate(table[-1] if table else [], 1):
            factor = 1 / ((column / (column - k)) ** 2 - 1)
            row.append([a + (a - b) * factor for a, b in zip(row[-1], earlier)])
        table.append(row)
    return table[-1][-1]


def states(rate, y, times, largest_step):
    """y at each of the rising times, from y at time 0."""
    t, found = 0.0, []
    for end in times:
        count = max(1, round((end - t) / largest_step + 0.5))
        h = (end - t) / count
        for i in range(count):
            y = step(rate, t + i * h, y, h)
        t = end
        found.append(y)
    return found
