#!/usr/bin/env python3
"""`blocklift stress` on one and on two processes: a bent bar of quadratic hexahedra, directly and by iteration.

    tests/benchmarks/processes.py build/release/blocklift [ELEMENTS]

ELEMENTS (12) lie across the bar, 8 times as many along it. Strong scaling: the same bar on both numbers of
processes; weak scaling: half its length on one, all of it on two. Prints seconds of the slowest process and the
part of two processes that is made use of. Run alone on the machine.
"""

import json
import os
import pathlib
import subprocess
import sys
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


def run(program, folder, method, elements, share, processes):
    bar = folder / f"{method}-{share}-{processes}"
    bar.mkdir()
    (bar / "bar.geo").write_text(
        GEOMETRY.format(length=0.8 * share, along=int(8 * elements * share) + 1, across=elements + 1))
    (bar / "part.yaml").write_text(PART + f"solver: {{method: {method}}}\n")
    command = [program, "stress", str(bar), "-o", str(bar / "out")]
    if processes > 1:
        command = ["mpirun", "--allow-run-as-root", "-n", str(processes)] + command
    environment = dict(os.environ, OPENBLAS_NUM_THREADS="1")  # a core a process in both
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, env=environment)
    return json.loads((bar / "out" / "summary.json").read_text())


def main():
    program = str(pathlib.Path(sys.argv[1]).resolve())
    elements = int(sys.argv[2]) if len(sys.argv) > 2 else 12
    stages = ["assembly_s", "factorisation_s", "solve_s", "recovery_s"]
    print("| solver | processes | unknowns | assembly | factorisation | solution | stress | all | made use of |")
    print("|---|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as name:
        for method in ["direct", "iterative"]:
            alone = {}
            for share, processes in [(0.5, 1), (1, 1), (1, 2)]:
                result = run(program, pathlib.Path(name), method, elements, share, processes)
                seconds = [result["timing"][stage] for stage in stages]
                alone.setdefault((share, processes), sum(seconds))
                use = ""
                if processes == 2:
                    strong = alone[1, 1] / 2 / sum(seconds)
                    weak = alone[0.5, 1] / sum(seconds)
                    use = f"{100 * strong:.0f} % (strong), {100 * weak:.0f} % (weak)"
                row = " | ".join(f"{s:.2f}" for s in seconds)
                print(f"| {result['solver']['name']} | {processes} | {result['unknowns']:,} | {row} "
                      f"| {sum(seconds):.2f} | {use} |", flush=True)


if __name__ == "__main__":
    main()
