"""Studies: many lifts of one case."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .program import run
from .results import Result

if TYPE_CHECKING:
    import pandas


class Study:
    """A folder of results of `blocklift sweep`."""

    def __init__(self, folder: str | os.PathLike[str]) -> None:
        """Raises FileNotFoundError if the folder has no study."""
        self.folder = Path(folder)
        path = self.folder / "study.json"
        if not path.is_file():
            raise FileNotFoundError(f"{self.folder}: there is no study.json in it")
        #: Mean, deviation, quantiles, extremes, correlations of each figure.
        self.summary: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))

    @property
    def members(self) -> pandas.DataFrame:
        """A lift a row: its values, its figures, and why it failed, if it did. SI units."""
        import pandas

        return pandas.read_csv(self.folder / "study.csv", index_col="member")

    @property
    def spreads(self) -> pandas.DataFrame:
        """A figure a row: mean, deviation, smallest, largest and in which members."""
        import pandas

        table = pandas.DataFrame(self.summary["figures"]).set_index("name")
        return table.drop(columns=["quantiles", "extremes", "rank_correlation"])

    @property
    def worst(self) -> Result:
        """The whole results of the member with the largest leading figure."""
        return Result(self.folder / "worst")


def sweep(study: str | os.PathLike[str], output: str | os.PathLike[str], *,
          workers: int | None = None) -> Study:
    """Runs a study's file; one that was stopped goes on. Raises InputError, RunError."""
    run(["sweep", study, "--output", output,
         *(["--workers", str(workers)] if workers else [])])
    return Study(output)
