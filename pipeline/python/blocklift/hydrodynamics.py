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


class Hydrodynamics:
    """A database that `blocklift hydro` wrote."""

    def __init__(self, path: str | os.PathLike[str]) -> None:
        """Raises FileNotFoundError if there is none."""
        self.path = Path(path)
        if not self.path.is_file():
            raise FileNotFoundError(f"{self.path}: no such file")

    def arrays(self) -> dict[str, xarray.DataArray]:
        """Every array of the file by its path in it, with units."""
        import xarray

        found: dict[str, xarray.DataArray] = {}

        def take(name: str, data: Any) -> None:
            if not isinstance(data, h5py.Dataset) or not np.issubdtype(data.dtype, np.number):
                return
            attributes = {key: value.decode() if isinstance(value, bytes) else value
                          for key, value in data.attrs.items()}
            found[name] = xarray.DataArray(data[()], attrs=attributes)

        with h5py.File(self.path, "r") as file:
            file.visititems(take)
        return found


def hydro(vessel: str | os.PathLike[str], output: str | os.PathLike[str]) -> Hydrodynamics:
    """Computes the hydrodynamics of a vessel's file into a database; one that is there and fits is
    taken as it is. Raises InputError, RunError."""
    run(["hydro", vessel, "--output", output])
    return Hydrodynamics(output)
