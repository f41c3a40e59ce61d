"""Databases of floating hulls."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

import h5py
import numpy as np

from .program import run

if TYPE_CHECKING:
    import xarray

MODES = ("surge", "sway", "heave", "roll", "pitch", "yaw")

# By the last part of an array's path. `mode` is a force's, `motion` what it comes from.
_RADIATION = ("frequency", "mode", "motion")
_WAVES = ("frequency", "mode", "heading")
_DIMENSIONS = {
    "frequencies": ("frequency",),
    "headings": ("heading",),
    "reference_points": ("body", "axis"),
    "centres_of_buoyancy": ("body", "axis"),
    "centres_of_mass": ("body", "axis"),
    "displaced_volumes": ("body",),
    "hydrostatic_stiffness": ("mode", "motion"),
    "change_from_coarser": ("mode",),
    "excitation_change_from_coarser": ("mode",),
    "cut_off_by_end": ("mode",),
    "infinite_added_mass": ("mode", "motion"),
    "added_mass": _RADIATION,
    "damping": _RADIATION,
    "retardation": ("time", "mode", "motion"),
    "froude_krylov": _WAVES,
    "diffraction": _WAVES,
    "mean_drift": _WAVES,
    "directions": ("direction",),
    "radiated": ("frequency", "direction", "motion"),
    "scattered": ("frequency", "direction", "heading"),
}


class Hydrodynamics:
    """A database that `blocklift hydro` wrote."""

    def __init__(self, path: str | os.PathLike[str]) -> None:
        """Raises FileNotFoundError if there is none."""
        self.path = Path(path)
        if not self.path.is_file():
            raise FileNotFoundError(f"{self.path}: no such file")

    @property
    def draughts(self) -> list[float]:
        """Of the lowered body, m, a state each; 0 where it is not known, or the body dry."""
        with h5py.File(self.path, "r") as file:
            return [float(file[f"states/{k}"].attrs["draught"])
                    for k in range(len(file["states"]))]

    def arrays(self) -> dict[str, xarray.DataArray]:
        """Every array of the file by its path in it, with units, dimensions and their coordinates:
        frequency (rad/s), heading (rad), time (s), mode of force and of motion, body, axis."""
        found: dict[str, xarray.DataArray] = {}

        with h5py.File(self.path, "r") as file:
            def take(name: str, data: Any) -> None:
                if isinstance(data, h5py.Dataset) and np.issubdtype(data.dtype, np.number):
                    found[name] = _labelled(file, name, data)

            file.visititems(take)
        return found

    def state(self, number: int = 0) -> xarray.Dataset:
        """What the file has of one draught. Forces of waves are complex (Re X a exp(i w t)), and
        `excitation` is the sum of `froude_krylov` and `diffraction`. Raises IndexError if the file
        has fewer states."""
        import xarray

        draughts = self.draughts
        if not 0 <= number < len(draughts):
            raise IndexError(f"{self.path}: states are numbered from 0 to {len(draughts) - 1}, "
                             f"and {number} is none")
        within = f"states/{number}/"
        arrays = {name.removeprefix(within): array for name, array in self.arrays().items()
                  if name.startswith(within)}
        imaginary = {name.removesuffix("/im"): array for name, array in arrays.items()
                     if name.endswith("/im")}
        real = {name.removesuffix("/re"): array for name, array in arrays.items()
                if not name.endswith("/im")}
        found = {}
        for name, array in real.items():
            if name in imaginary:
                attributes = array.attrs
                array = array + 1j * imaginary[name]
                array.attrs = {**attributes, "description": str(attributes["description"]).replace(
                    ", real part", ": Re x a exp(i w t)")}
            if not name.endswith("directions"):
                found[name.removeprefix("far_field/")] = array
        if "froude_krylov" in found and "diffraction" in found:
            found["excitation"] = found["froude_krylov"] + found["diffraction"]
            found["excitation"].attrs = {**found["diffraction"].attrs,
                                         "description": "force of waves on the held body"}
        return xarray.Dataset(found, attrs={"draught": draughts[number]})


def _labelled(file: h5py.File, name: str, data: h5py.Dataset) -> xarray.DataArray:
    import xarray

    attributes = {key: value.decode() if isinstance(value, bytes) else value
                  for key, value in data.attrs.items()}
    key = name.removesuffix("/re").removesuffix("/im").rsplit("/", 1)[-1]
    dimensions = _DIMENSIONS.get(key, ())
    if len(dimensions) != data.ndim:
        return xarray.DataArray(data[()], attrs=attributes)
    bodies = [body.decode() if isinstance(body, bytes) else str(body)
              for body in file["bodies/names"][()]]
    modes = [mode if len(bodies) == 1 else f"{body} {mode}" for body in bodies for mode in MODES]
    labels: dict[str, Any] = {"mode": modes, "motion": modes, "body": bodies, "axis": list("xyz")}
    for dimension, places in (("frequency", "frequencies"), ("heading", "headings")):
        labels[dimension] = file[places][()]
    if "direction" in dimensions:
        group = name[:name.index("far_field")]
        labels["direction"] = file[f"{group}far_field/directions"][()]
    if "time" in dimensions:
        labels["time"] = attributes["time_step"] * np.arange(data.shape[0])
    units = {"frequency": "rad s-1", "heading": "rad", "direction": "rad", "time": "s"}
    return xarray.DataArray(
        data[()], dims=dimensions, attrs=attributes,
        coords={d: (d, labels[d], {"units": units[d]} if d in units else {}) for d in dimensions})


def hydro(vessel: str | os.PathLike[str], output: str | os.PathLike[str]) -> Hydrodynamics:
    """Computes the hydrodynamics of a vessel's file into a database; one that is there and fits is
    taken as it is. Raises InputError, RunError."""
    run(["hydro", vessel, "--output", output])
    return Hydrodynamics(output)
