"""What a run wrote, as arrays with units."""

from __future__ import annotations

import io
import json
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

import h5py
import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    import matplotlib.axes
    import pandas
    import xarray

_NEWTON_PER_TONNE = 9806.65
_SIX = ["rx", "ry", "rz", "x", "y", "z"]
_POSE = ["x", "y", "z", "qw", "qx", "qy", "qz"]


class Result:
    """A folder of results, of an assessed or simulated lift or of a mechanism."""

    def __init__(self, folder: str | os.PathLike[str], *, in_memory: bool = False) -> None:
        """in_memory: read all of it now, so that the folder may go.

        Raises FileNotFoundError if the folder has no results, ValueError if its files belong
        to different runs."""
        self.folder = Path(folder)
        self._whole: bytes | None = None
        path = self.folder / "summary.json"
        if not path.is_file():
            raise FileNotFoundError(f"{self.folder}: there is no summary.json in it")
        #: All figures, as docs/results.md names them.
        self.summary: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
        if in_memory:
            self._whole = (self.folder / "results.h5").read_bytes()
        with self._file() as file:
            run = file["case"].attrs.get("run", "") if "case" in file else ""
            run = run.decode() if isinstance(run, bytes) else run
        if run and self.summary.get("run") and run != self.summary["run"]:
            raise ValueError(f"{self.folder}: results.h5 and summary.json belong to different runs")

    def __repr__(self) -> str:
        verdict = f", {self.verdict}" if self.verdict else ""
        where = self.folder if self._whole is None else "in memory"
        return f"<Result of {self.summary.get('case', '?')}{verdict}, {where}>"

    def _file(self) -> h5py.File:
        if self._whole is not None:
            return h5py.File(io.BytesIO(self._whole), "r")
        return h5py.File(self.folder / "results.h5", "r")

    @property
    def verdict(self) -> str | None:
        """"pass" or "fail"; None of what was only simulated."""
        return self.summary.get("verdict")

    @property
    def passed(self) -> bool:
        """Does the lift pass all its checks? Raises ValueError if it was only simulated."""
        if self.verdict is None:
            raise ValueError("the lift was simulated, not assessed: it has no verdict")
        return self.verdict == "pass"

    @property
    def stress_increase(self) -> float:
        """By how much motion raises the block's largest checked stress over the whole lift, 1.

        Raises KeyError without a block whose stress was asked.
        """
        return self._increase("stress_increase_percent")

    @property
    def deformation_increase(self) -> float:
        """The same of the largest displacement."""
        return self._increase("deformation_increase_percent")

    def _increase(self, name: str) -> float:
        structure = self.summary["structure"]
        return float((structure.get("history") or structure["simultaneous"])[name]) / 100

    @property
    def checks(self) -> pandas.DataFrame:
        """A check a row: demand, limit, unit, utilisation, pass."""
        return self._table("checks")

    @property
    def ropes(self) -> pandas.DataFrame:
        """A rope a row: largest tension at rest and in motion, their instants and ratio."""
        return self._table("ropes")

    def _table(self, name: str) -> pandas.DataFrame:
        import pandas

        table = pandas.DataFrame(self.summary.get(name, []))
        return table.set_index("name") if "name" in table else table

    def history(self, state: str = "dynamic") -> xarray.Dataset:
        """The lift at rest ("static": equilibria) or in motion ("dynamic") over time.

        Variables, as far as the run has them: tension and elongation (time, rope), hoist_tension,
        hoist_length (time, hoist), pose (time, body, x y z qw qx qy qz), velocity and acceleration
        (time, body, rx ry rz x y z; in the world), elastic_coordinate, elastic_rate and
        elastic_acceleration (time, elastic_mode), drive_position, drive_force (time, drive),
        energy (time, term).

        Raises KeyError if the run has no such history.
        """
        import xarray

        with self._file() as file:
            if state not in file:
                raise KeyError(f'{self.folder}: there is no history "{state}"')
            group = file[state]
            time = ("time", group["time"][:], _attributes(group["time"]))
            variables: dict[str, Any] = {}
            for kind, of, members in (
                ("ropes", "rope", {"tension": "tension", "elongation": "elongation"}),
                ("hoists", "hoist", {"tension": "hoist_tension", "length": "hoist_length",
                                     "elongation": "hoist_elongation", "swing": "hoist_swing"}),
                ("bodies", "body", {"pose": "pose", "velocity": "velocity",
                                    "acceleration": "acceleration"}),
                ("elastic_modes", "elastic_mode", {"coordinate": "elastic_coordinate",
                                                   "rate": "elastic_rate",
                                                   "acceleration": "elastic_acceleration"}),
                ("drives", "drive", {"position": "drive_position", "force": "drive_force"}),
            ):
                for member, variable in members.items():
                    array = _gather(group, kind, member, of)
                    if array is not None:
                        variables[variable] = array
            if "energy" in group:
                terms = list(group["energy"])
                variables["energy"] = xarray.DataArray(
                    np.stack([group["energy"][term][:] for term in terms], axis=1),
                    dims=("time", "term"), coords={"term": terms}, attrs={"units": "J"})
            return xarray.Dataset(variables, coords={"time": time})

    def outputs(self) -> xarray.Dataset:
        """What a mechanism's file asks for, over time. Raises KeyError if there is nothing."""
        import xarray

        with self._file() as file:
            if "outputs" not in file:
                raise KeyError(f"{self.folder}: these results have no outputs")
            variables: dict[str, Any] = {}
            for name, data in file["outputs"].items():
                values = data[:]
                columns = data.attrs.get("columns", "")
                columns = columns.decode() if isinstance(columns, bytes) else columns
                if values.ndim == 1 or values.shape[1] == 1:
                    variables[name] = ("time", values.reshape(len(values)), _attributes(data))
                    continue
                labels = [label.strip() for label in columns.split(",")]
                if len(labels) != values.shape[1]:
                    labels = [str(column) for column in range(values.shape[1])]
                variables[name] = xarray.DataArray(
                    values, dims=("time", f"{name}_column"),
                    coords={f"{name}_column": labels}, attrs=_attributes(data))
            return xarray.Dataset(variables, coords={"time": ("time", file["time"][:])})

    def measures(self, state: str = "dynamic") -> xarray.Dataset:
        """What follows from the motion over time, by name: "load: tilt", "R1: sling angle",
        "load to ground: clearance"; with units.

        Raises KeyError if the run has none, as that of a mechanism.
        """
        import xarray

        with self._file() as file:
            if f"{state}/measures" not in file:
                raise KeyError(f'{self.folder}: there are no measures of "{state}"')
            variables = {name: ("time", data[:], _attributes(data))
                         for name, data in file[f"{state}/measures"].items()}
            time = file[state]["time"]
            return xarray.Dataset(variables, coords={"time": ("time", time[:], _attributes(time))})

    def envelope(self, state: str = "dynamic") -> xarray.Dataset:
        """The largest checked stress of each square of the block's plating over the whole lift, no
        instant passed over.

        Variables (square): von_mises, Pa; time, when it occurs, s; rope, that with the largest
        share in it ("" if none); plate; centre (square, axis), m, in the block's frame.

        Raises KeyError without a block whose stress was asked.
        """
        import xarray

        with self._file() as file:
            if f"structure/history/{state}/patches" not in file:
                raise KeyError(f'{self.folder}: there is no envelope of "{state}"')
            history = file["structure/history"]
            patches = history[state]["patches"]
            ropes = [*_texts(history["ropes"]), ""]  # -1: none
            plates = _texts(history["patches/plates"])
            centres = history["patches/points"]

            def take(name: str) -> Any:
                return "square", patches[name][:], _attributes(patches[name])

            return xarray.Dataset(
                {"von_mises": take("von_mises"), "time": take("time"),
                 "rope": ("square", [ropes[place] for place in patches["rope"][:]]),
                 "plate": ("square", [plates[place] for place in history["patches/plate"][:]]),
                 "centre": (("square", "axis"), centres[:], _attributes(centres))},
                coords={"axis": ["x", "y", "z"]})

    def stress(self, state: str = "dynamic") -> xarray.Dataset:
        """Stress over time at the places that are followed: von_mises, and normal_stress across the
        plane of the largest principal stress, whose cycles tire the weld (time, place), Pa.

        Raises KeyError without a block whose stress was asked.
        """
        import xarray

        with self._file() as file:
            if "structure/history/points" not in file or state not in ("static", "dynamic"):
                raise KeyError(f'{self.folder}: there is no stress over time of "{state}"')
            points = file["structure/history/points"]
            names = list(points)
            variables = {
                kind: xarray.DataArray(
                    np.stack([points[name][state][kind][:] for name in names], axis=1),
                    dims=("time", "place"), attrs=_attributes(points[names[0]][state][kind]))
                for kind in ("von_mises", "normal_stress")}
            variables["point"] = xarray.DataArray(
                np.stack([points[name]["point"][:] for name in names]), dims=("place", "axis"),
                attrs={"units": "m"})
            time = file[state]["time"]
            return xarray.Dataset(variables, coords={
                "time": ("time", time[:], _attributes(time)), "place": names,
                "axis": ["x", "y", "z"]})

    def unit_responses(self) -> xarray.Dataset:
        """Stress under each unit load at the hot spot, near each lug, and at the worst place of
        each group of plates in motion.

        Variables: stress (place, component, unit_load), Pa for a factor of 1, xx yy zz xy yz zx, of
        plating the membrane stress in the plate's own axes; point (place, axis), m, in the block's
        frame. The coordinate unit (unit_load) is that of the load's factor: forces at the pins of
        lugs, "L1 x", N, and products of angular velocities, rad2/s2, each with the rigid
        acceleration that balances it, so that forces of your own need no more; loads that were
        added (water, edges), 1; the acceleration that a load lacks in balance.

        `responses.stress @ result.load_factors()` is the stress over time.

        Raises KeyError without a block whose stress was asked.
        """
        import xarray

        with self._file() as file:
            if "structure/history/unit_stress" not in file:
                raise KeyError(f"{self.folder}: there are no unit responses of a block")
            group = file["structure/history/unit_stress"]
            return xarray.Dataset(
                {name: (dims, group[data][:], _attributes(group[data]))
                 for name, data, dims in (("stress", "stress", ("place", "component", "unit_load")),
                                          ("point", "points", ("place", "axis")))},
                coords={"place": _texts(group["places"]), "unit_load": _texts(group["loads"]),
                        "unit": ("unit_load", _texts(group["load_units"])),
                        "component": ["xx", "yy", "zz", "xy", "yz", "zx"],
                        "axis": ["x", "y", "z"]})

    def load_factors(self, state: str = "dynamic") -> xarray.DataArray:
        """Factors of the unit loads (time, unit_load) at each sample, each in its load's unit: of
        the loads at a lug the force on its pin in the block's frame, N.

        Raises KeyError without a block whose stress was asked.
        """
        import xarray

        with self._file() as file:
            name = f"structure/history/{state}/factors"
            if name not in file:
                raise KeyError(f'{self.folder}: there are no unit loads of "{state}"')
            group, time = file["structure/history/unit_stress"], file[state]["time"]
            return xarray.DataArray(
                file[name][:], dims=("time", "unit_load"), attrs=_attributes(file[name]),
                coords={"time": ("time", time[:], _attributes(time)),
                        "unit_load": _texts(group["loads"]),
                        "unit": ("unit_load", _texts(group["load_units"]))})

    def surface(self) -> dict[str, npt.NDArray[Any]]:
        """The block's surface: points (n, 3), m, in its frame, quads (m, 4), indices, and the
        largest von Mises stress of each point over the lift, Pa, `static` and `dynamic`.

        Raises KeyError without a block whose stress was asked.
        """
        with self._file() as file:
            surface = file["structure/surface"]
            arrays = {"points": surface["points"][:], "quads": surface["quads"][:]}
            way = "history" if "structure/history/dynamic" in file else "simultaneous"
            for state in ("static", "dynamic"):
                arrays[state] = file[f"structure/{way}/{state}/von_mises"][:]
            return arrays

    def to_dataframe(self, state: str = "dynamic",
                     variable: str = "tension") -> pandas.DataFrame:
        """A variable of :meth:`history` over time, SI units: tensions, a rope a column; of arrays
        with more indices ("pose") a column for each.

        Raises KeyError if the run has no such history or variable.
        """
        array = self.history(state)[variable]
        others = [str(dim) for dim in array.dims if dim != "time"]
        if len(others) > 1:
            array = array.stack(column=others)
        frame = array.to_pandas()
        if len(others) == 1:
            frame.columns.name = others[0]
        return frame

    @property
    def natural_periods(self) -> list[dict[str, Any]]:
        """Of free swinging, by stage: as summary.json has them; empty if none were found."""
        found: list[dict[str, Any]] = self.summary.get("natural_periods") or []
        return found

    def plot_tensions(self, ax: matplotlib.axes.Axes | None = None,
                      state: str = "dynamic") -> matplotlib.axes.Axes:
        """Draws the ropes' tensions over time, t."""
        ax = _axes(ax)
        for name, tension in self.to_dataframe(state).items():
            ax.plot(tension.index, tension / _NEWTON_PER_TONNE, label=name, linewidth=0.8)
        ax.set_xlabel("time, s")
        ax.set_ylabel("tension, t")
        ax.legend()
        return ax

    def plot_path(self, body: str = "load", ax: matplotlib.axes.Axes | None = None,
                  state: str = "dynamic") -> matplotlib.axes.Axes:
        """Draws where a body's origin goes over time, m from where it begins.

        Raises KeyError if there is no such body.
        """
        ax = _axes(ax)
        pose = self.history(state).pose.sel(body=body)
        for axis in ("x", "y", "z"):
            place = pose.sel(coordinate=axis)
            ax.plot(place.time, place - place[0], label=axis, linewidth=0.8)
        ax.set_xlabel("time, s")
        ax.set_ylabel(f"way of {body}, m")
        ax.legend()
        return ax

    def plot_stress(self, ax: matplotlib.axes.Axes | None = None,
                    state: str = "dynamic") -> matplotlib.axes.Axes:
        """Draws the block's surface, coloured by the largest von Mises stress over the lift, MPa.

        ax: axes of three dimensions; made if not given. Raises KeyError without a block whose
        stress was asked.
        """
        import matplotlib.pyplot
        from mpl_toolkits.mplot3d.art3d import Poly3DCollection

        surface = self.surface()
        if ax is None:
            ax = matplotlib.pyplot.figure().add_subplot(projection="3d")
        corners = surface["points"][surface["quads"]]
        faces = Poly3DCollection(corners, linewidths=0)
        faces.set_array(surface[state][surface["quads"]].mean(axis=1) / 1e6)
        ax.add_collection3d(faces)
        low, high = corners.reshape(-1, 3).min(axis=0), corners.reshape(-1, 3).max(axis=0)
        ax.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=(low[2], high[2]),
               xlabel="x, m", ylabel="y, m", zlabel="z, m")
        ax.set_box_aspect(high - low)
        ax.figure.colorbar(faces, ax=ax, pad=0.15, label="largest von Mises stress, MPa")
        return ax


def _texts(data: h5py.Dataset) -> list[str]:
    return [text.decode() if isinstance(text, bytes) else str(text) for text in data[:]]


def _axes(ax: matplotlib.axes.Axes | None) -> matplotlib.axes.Axes:
    if ax is not None:
        return ax
    import matplotlib.pyplot

    return matplotlib.pyplot.subplots()[1]


def _attributes(data: Any) -> dict[str, str]:
    def text(value: Any) -> str:
        return value.decode() if isinstance(value, bytes) else str(value)

    return {name: text(data.attrs[name]) for name in ("units", "description") if name in data.attrs}


def _gather(group: Any, kind: str, member: str, of: str) -> xarray.DataArray | None:
    """One array of the member of all objects of a kind that have it."""
    import xarray

    names = [name for name in group.get(kind, {}) if member in group[kind][name]]
    if not names:
        return None
    values = np.stack([group[kind][name][member][:] for name in names], axis=1)
    dims: list[str] = ["time", of]
    coords: dict[str, Any] = {of: names}
    if values.ndim == 3:
        dims.append("coordinate" if member == "pose" else "component")
        coords[dims[-1]] = _POSE if member == "pose" else _SIX
    return xarray.DataArray(values, dims=dims, coords=coords,
                            attrs=_attributes(group[kind][names[0]][member]))
