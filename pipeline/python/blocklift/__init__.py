"""Heavy lifts from Python: read, change and run cases, and have the results as arrays.

    import blocklift

    case = blocklift.Case("cases/goliath-turnover")
    case.set("wind.speed", "12 m/s")
    result = case.assess()
    print(result.verdict, result.stress_increase)
    tension = result.history("dynamic").tension.sel(rope="R3")

The package runs the program `blocklift` in a process of its own (see :func:`executable`) and reads
the files that it writes; lifts whose drives are steered by laws of Python run in this process. All
numbers are in SI units; arrays carry theirs in the attribute `units`.
"""

from .case import Case
from .errors import Complaint, InputError, LiftWarning, RunError
from .hydrodynamics import Hydrodynamics, hydro
from .keys import describe
from .kernel import Law
from .measurements import Measured, measured
from .program import executable, new, schema, version
from .results import Result
from .study import Study, sweep

__all__ = [
    "Case",
    "Complaint",
    "Hydrodynamics",
    "InputError",
    "Law",
    "LiftWarning",
    "Measured",
    "Result",
    "RunError",
    "Study",
    "describe",
    "executable",
    "hydro",
    "measured",
    "new",
    "schema",
    "sweep",
    "version",
]
