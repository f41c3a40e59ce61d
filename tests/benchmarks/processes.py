#!/usr/bin/env python3
"""`blocklift stress` on one and on two processes: a bar of solids, and a double hull of shells.

    tests/benchmarks/processes.py build/release/blocklift [--solids ELEMENTS]
    tests/benchmarks/processes.py build/release/blocklift --shells SIZE

A bent bar of quadratic hexahedra, directly and by iteration: ELEMENTS (12) lie across it, 8 times as many along it.
Strong scaling: the same bar on both numbers of processes; weak scaling: half its length on one, all of it on two. A
double hull of 56 x 36 x 8 m in squares of SIZE (m, a divisor of 1, 2 or 4) of degree 3, held at four corners, with 30
pressures, directly: strong scaling. Prints seconds of the first process and the part of two processes that is made use
of, of all and of analysis, factorisation and solution alone. Run alone on the machine.
"""

import argparse
import json
import os
import pathlib
import subprocess
import tempfile

GEOMETRY = """SetFactory("OpenCASCADE");
Box(1) = {{0, 0, 0, {length}, 0.1, 0.1}};
Mesh.MeshSizeMax = 1;
Transfinite Curve{{9, 10, 11, 12}} = {along};
Transfinite Curve{{1, 2, 3, 4, 5, 6, 7, 8}} = {across};
Transfinite Surface{{:}};
Recombine Surface{{:}};
Transfinite Volume{{1}};
Mesh.ElementOrder = 2;
Physical Volume("bar") = {{1}};
Physical Surface("root") = {{1}};
Physical Surface("end") = {{2}};
"""

PART = """part: bar
mesh: {file: bar.geo, length_unit: m}
materials:
  steel: {youngs_modulus: 206 GPa, poisson_ratio: 0.3, density: 7850 kg/m^3, yield_stress: 355 MPa}
supports:
  root: {groups: [root], fixed: [x, y, z]}
loads:
  end: {groups: [end], force: [0 N, 0 N, -10 kN]}
"""

BLOCK = """kind: block
title: Double hull
mesh: {file: hull.bdf, units: m-kg-N, yield_stress: 355 MPa}
"""

CASES = 30
STAGES = ["assembly_s", "factorisation_s", "solve_s", "recovery_s"]


def plates(length, breadth, depth, bottom):
    """Corner, two sides along axes of plates, and the number of their thickness."""
    for height in (0, bottom, depth):
        yield (0, 0, height), (length, 0, 0), (0, breadth, 0), 1
    for x in range(0, length + 1, 4):
        yield (x, 0, 0), (0, breadth, 0), (0, 0, bottom), 2
    for y in range(0, breadth + 1, 4):
        yield (0, y, 0), (length, 0, 0), (0, 0, bottom), 2
    for y in (0, breadth):
        yield (0, y, bottom), (length, 0, 0), (0, 0, depth - bottom), 1
    for x in (0, 16, 28, 40, length):
        yield (x, 0, bottom), (0, breadth, 0), (0, 0, depth - bottom), 3


def double_hull(size):
    """A deck of Nastran's."""
    nodes, cells = {}, []
    for corner, a, b, thickness in plates(56, 36, 8, 2):
        na, nb = (round(max(side) / size) for side in (a, b))
        for i in range(na):
            for j in range(nb):
                around = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
                places = [tuple(round(corner[d] / size + a[d] / size * s / na + b[d] / size * t / nb) for d in range(3))
                          for s, t in around]
                cells.append((thickness, [nodes.setdefault(place, len(nodes) + 1) for place in places]))
    held = [nodes[round(x / size), round(y / size), 0] for x in (0, 56) for y in (0, 36)]
    lines = ["SOL 101", "CEND"]
    for case in range(1, CASES + 1):
        lines += [f"SUBCASE {case}", "SPC = 1", f"LOAD = {case}"]
    lines += ["BEGIN BULK", "MAT1,1,206.+9,,.3,7850."]
    lines += [f"PSHELL,{number},1,{t},1,,1" for number, t in ((1, 0.016), (2, 0.012), (3, 0.010))]
    lines += [f"GRID,{n},," + ",".join(f"{size * index:.6f}" for index in place) for place, n in nodes.items()]
    lines += [f"CQUAD4,{number},{t}," + ",".join(map(str, of)) for number, (t, of) in enumerate(cells, 1)]
    lines += [f"SPC1,1,123456,{node}" for node in held]
    for case in range(CASES):
        first = 1 + 997 * case % 1900  # all on the bottom
        lines.append(f"PLOAD4,{case + 1},{first},2.+4,,,,THRU,{first + 40}")
    return "\n".join(lines + ["ENDDATA", ""])


def run(program, model, options, processes):
    """Results of a folder's model."""
    out = model / f"out-{processes}"
    command = [program, "stress", str(model), "-o", str(out)] + options
    if processes > 1:
        command = ["mpirun", "--allow-run-as-root", "-n", str(processes)] + command
    # A core a process in both.
    environment = dict(os.environ, OPENBLAS_NUM_THREADS="1", OMP_NUM_THREADS="1")
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, env=environment)
    return json.loads((out / "summary.json").read_text())


def print_row(name, processes, result, use):
    seconds = [result["timing"][stage] for stage in STAGES]
    row = " | ".join(f"{s:.2f}" for s in seconds)
    print(f"| {name} | {processes} | {result['unknowns']:,} | {row} | {sum(seconds):.2f} | {use} |", flush=True)


def time_of(result, stages):
    return sum(result["timing"][stage] for stage in stages)


def measure_solids(program, folder, elements):
    for method in ["direct", "iterative"]:
        alone = {}
        for share, processes in [(0.5, 1), (1, 1), (1, 2)]:
            bar = folder / f"{method}-{share}-{processes}"
            bar.mkdir()
            (bar / "bar.geo").write_text(
                GEOMETRY.format(length=0.8 * share, along=int(8 * elements * share) + 1, across=elements + 1))
            (bar / "part.yaml").write_text(PART + f"solver: {{method: {method}}}\n")
            result = run(program, bar, [], processes)
            seconds = time_of(result, STAGES)
            alone.setdefault((share, processes), seconds)
            use = ""
            if processes == 2:
                strong, weak = alone[1, 1] / 2 / seconds, alone[0.5, 1] / seconds
                use = f"{100 * strong:.0f} % (strong), {100 * weak:.0f} % (weak)"
            print_row(result["solver"]["name"], processes, result, use)


def measure_shells(program, folder, size):
    (folder / "hull.bdf").write_text(double_hull(size))
    (folder / "block.yaml").write_text(BLOCK)
    alone = run(program, folder, ["--degree", "3"], 1)
    print_row("shells, directly", 1, alone, "")
    both = run(program, folder, ["--degree", "3"], 2)
    use = [time_of(alone, stages) / 2 / time_of(both, stages) for stages in (STAGES, STAGES[1:3])]
    print_row("shells, directly", 2, both, f"{100 * use[0]:.0f} %; of factorisation and solution {100 * use[1]:.0f} %")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--solids", type=int, default=12, metavar="ELEMENTS")
    parser.add_argument("--shells", type=float, metavar="SIZE")
    options = parser.parse_args()
    program = str(options.program.resolve())
    print("| solver | processes | unknowns | assembly | factorisation | solution | stress | all | made use of |")
    print("|---|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as name:
        if options.shells:
            measure_shells(program, pathlib.Path(name), options.shells)
        else:
            measure_solids(program, pathlib.Path(name), options.solids)


if __name__ == "__main__":
    main()
