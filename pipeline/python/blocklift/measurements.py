"""Measurements beside a computed lift."""

from __future__ import annotations

import json
import os
import warnings
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from .errors import LiftWarning
from .program import run
from .results import Result

if TYPE_CHECKING:
    import pandas


class Measured:
    """What `blocklift measured` finds, in SI units."""

    def __init__(self, figures: dict[str, Any]) -> None:
        #: All figures: records with their shifts, channels, weight, wind, waves, doubts.
        self.figures = figures

    @property
    def shifts(self) -> dict[str, float]:
        """Seconds that were added to the clock of each record."""
        return {record["file"]: record["shift_s"] for record in self.figures["records"]}

    @property
    def channels(self) -> pandas.DataFrame:
        """A channel a row: differences, correlation, scale, amplification, shares, decays."""
        import pandas

        return pandas.json_normalize(self.figures["channels"]).set_index("name")

    @property
    def weight(self) -> dict[str, Any] | None:
        """Mass and centre of mass with standard deviations; None if no rest was named."""
        weight: dict[str, Any] | None = self.figures.get("weight")
        return weight

    @property
    def doubts(self) -> list[str]:
        """What is to be doubted, sentences."""
        doubts: list[str] = self.figures["doubts"]
        return doubts


def _window(name: str, window: tuple[float, float] | None) -> list[str]:
    if window is None:
        return []
    begin, end = window
    # In one word: a window may begin with a minus, as options do.
    return [f"{name}={float(begin)!r}:{float(end)!r}"]


def measured(result: Result | str | os.PathLike[str],
             records: str | os.PathLike[str] | Sequence[str | os.PathLike[str]], *,
             shifts: float | Sequence[float] | None = None,
             window: tuple[float, float] | None = None,
             decay: tuple[float, float] | None = None,
             rest: tuple[float, float] | None = None,
             cell_accuracy: float = 0.01,
             page: str | os.PathLike[str] | None = None) -> Measured:
    """Holds CSV records against the results of a lift.

    shifts: seconds that are added to the records' clocks, one for all or one for each; found by
    correlation if left out. window, decay, rest: from and to in seconds of the lift: what is
    compared, when the load swings freely, when it hangs and is weighed. cell_accuracy: standard
    deviation of a load cell's scale, a share. page: an HTML page to write as well.

    What is to be doubted is a LiftWarning, too.

    Raises InputError for records that cannot be used.
    """
    folder = result.folder if isinstance(result, Result) else result
    files = [records] if isinstance(records, (str, os.PathLike)) else list(records)
    arguments: list[str | os.PathLike[str]] = ["measured", Path(folder), *map(Path, files),
                                               "--json"]
    if shifts is not None:
        values = np.atleast_1d(np.asarray(shifts, dtype=float)).tolist()
        arguments.append("--shift=" + ",".join(repr(value) for value in values))
    arguments += _window("--window", window) + _window("--decay", decay) + _window("--rest", rest)
    arguments += ["--cell-accuracy", f"{100 * float(cell_accuracy)!r}%"]
    if page is not None:
        arguments += ["--output", page]
    found = Measured(json.loads(run(arguments)))
    for doubt in found.doubts:
        warnings.warn(doubt, LiftWarning, stacklevel=2)
    return found
