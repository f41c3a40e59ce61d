"""Studies: many lifts of one case."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import kernel
from .program import run
from .results import Result

if TYPE_CHECKING:
    import matplotlib.axes
    import pandas
    import xarray


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

    def __repr__(self) -> str:
        return (f"<Study {self.summary['study']}, {self.summary['members']} members, "
                f"{len(self.summary['failures'])} failed, {self.folder}>")

    @property
    def members(self) -> pandas.DataFrame:
        """A lift a row: its values, its figures, and why it failed, if it did. SI units."""
        import pandas

        return pandas.read_csv(self.folder / "study.csv", index_col="member")

    @property
    def spreads(self) -> pandas.DataFrame:
        """A figure a row: mean, deviation, smallest, largest and in which members."""
        import pandas

        table = pandas.DataFrame(self.summary["figures"])
        if table.empty:  # no figure that all members have
            return table
        nested = ["quantiles", "extremes", "rank_correlation", "swings"]
        return table.set_index("name").drop(columns=nested, errors="ignore")

    @property
    def worst(self) -> Result:
        """The whole results of the member with the worst leading figure.

        Raises FileNotFoundError of a search, which has a best member.
        """
        return Result(self.folder / "worst")

    @property
    def quantiles(self) -> pandas.DataFrame:
        """Quantiles by figure and share: value, and low and high, the bounds of its confidence.
        Empty of a grid and of a search, which are no samples."""
        return self._table_of("quantiles", ["figure", "share"])

    @property
    def extremes(self) -> pandas.DataFrame:
        """Extremes by figure, law and share, fitted to the members' largest: value, low, high, and
        how well the law fits (p_value). Empty if there are too few members, or they are no
        sample."""
        return self._table_of("extremes", ["figure", "law", "share"])

    @property
    def correlations(self) -> pandas.DataFrame:
        """Rank correlation of each figure, a row, with each variable, a column: -1 to 1."""
        import pandas

        table = pandas.DataFrame({figure["name"]: figure["rank_correlation"]
                                  for figure in self.summary["figures"]}).T
        table.index.name = "figure"
        return table

    @property
    def swings(self) -> pandas.DataFrame:
        """How far each figure goes, in its unit, while one variable goes through the middle 90 % of
        its values and the others stay, by straight lines: swing, with low and high, its interval
        of 95 %, and from and to, the variable's values, SI units. A row a figure and variable, the
        largest swing of a figure first; empty of a search."""
        import pandas

        rows = [{"figure": figure["name"], "variable": variable, **swing}
                for figure in self.summary["figures"]
                for variable, swing in figure.get("swings", {}).items()]
        table = pandas.DataFrame(rows)
        if not rows:
            return table
        return table.set_index(["figure", "variable"]).astype(float)

    @property
    def sobol_indices(self) -> pandas.DataFrame:
        """Sobol' indices by figure and variable, first order and total, with their bounds; empty of
        a study whose design is not for them."""
        import pandas

        rows = [{"figure": figure, "variable": variable, **index}
                for figure, variables in self.summary.get("sobol_indices", {}).items()
                for variable, index in variables.items()]
        table = pandas.DataFrame(rows)
        return table.set_index(["figure", "variable"]) if rows else table

    @property
    def limits(self) -> xarray.Dataset:
        """The limiting significant height (heading, period), m, governed_by, the figure that
        decides, and alpha, the share of the height that may be forecast, of a study of sea states:
        not numbers where the lift at the lowest height failed. Raises KeyError of another one."""
        import pandas

        if "limits" not in self.summary:
            raise KeyError(f"{self.folder}: the study does not ask for limiting sea states")
        table = pandas.DataFrame(self.summary["limits"]["sea_states"]).rename(
            columns={"peak_period_s": "period", "heading_rad": "heading",
                     "significant_height_m": "height"})
        for name in {"height", "alpha"} & set(table.columns):
            table[name] = table[name].astype(float)  # a limit that is not known has neither
        data: xarray.Dataset = table.set_index(["heading", "period"]).to_xarray()
        for name, unit in (("height", "m"), ("period", "s"), ("heading", "rad")):
            data[name].attrs["units"] = unit
        return data

    @property
    def search(self) -> dict[str, Any]:
        """The answer of a search: figure, value, variables, bounds, is_feasible, is_converged.
        Raises KeyError of another study."""
        if "search" not in self.summary:
            raise KeyError(f"{self.folder}: the study's design is not a search")
        found: dict[str, Any] = self.summary["search"]
        return found

    @property
    def best(self) -> Result:
        """The whole results of the member that a search found best. Raises KeyError of another
        study."""
        assert self.search is not None
        return Result(self.folder / "best")

    def plot_tornado(self, figure: str | None = None,
                     ax: matplotlib.axes.Axes | None = None) -> matplotlib.axes.Axes:
        """Draws how far each variable moves a figure, the study's first if none is named: its
        swings with their intervals of 95 %, in its unit, the largest on top. What is not known
        has no bar; a search has no swings.

        Raises KeyError if there is no such figure.
        """
        swings = self.swings
        if figure is None and swings.empty:
            raise KeyError(f"{self.folder}: the study has no figure with swings")
        name = figure if figure is not None else swings.index[0][0]
        # The file has the largest first; a chart is filled from below.
        bars = swings.loc[name].iloc[::-1]
        if ax is None:
            import matplotlib.pyplot

            ax = matplotlib.pyplot.subplots()[1]
        reach = [(bars.swing - bars.low).fillna(0), (bars.high - bars.swing).fillna(0)]
        ax.barh(bars.index, bars.swing, xerr=reach)
        ax.axvline(0, color="black", linewidth=0.8)
        ax.set_xlabel(f"swing of {name}")
        return ax

    def _table_of(self, kind: str, index: list[str]) -> pandas.DataFrame:
        import pandas

        rows = [{"figure": figure["name"], **entry}
                for figure in self.summary["figures"] for entry in figure[kind]]
        table = pandas.DataFrame(rows)
        return table.set_index(index) if rows else table


def sweep(study: str | os.PathLike[str], output: str | os.PathLike[str], *,
          workers: int | None = None,
          laws: Mapping[str, kernel.LawOrClass] | None = None) -> Study:
    """Runs a study's file; one that was stopped goes on.

    workers: lifts side by side, as many as the machine has processors if not given.
    laws: functions that steer drives, as :meth:`Case.simulate` has them. They cannot be handed to
    other processes: members run in this one, one after another, and what an earlier run left is
    not gone on with, since nobody knows whether its laws were the same.

    Raises InputError, also where the folder has members of an earlier run with laws; RunError, also
    where more than 5 % of a sample's members failed, or one of a grid without limits: all results
    are written then, and `Study(output)` has them; with laws what :meth:`Case.simulate` raises.
    """
    if laws is None:
        run(["sweep", study, "--output", output,
             *(["--workers", str(workers)] if workers is not None else [])])
    elif workers not in (None, 1):
        raise ValueError("laws are functions of this process, in which one member runs at a time; "
                         "leave workers out")
    else:
        kernel.sweep(Path(study), Path(output), laws)
    return Study(output)
