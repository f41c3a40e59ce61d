"""The module by which lifts run in this process, with laws of drives that are written in Python."""

from __future__ import annotations

import importlib.util
import os
import sys
import sysconfig
import threading
import warnings
from collections.abc import Callable, Mapping
from pathlib import Path
from types import ModuleType
from typing import Union

from .errors import LiftWarning
from .program import executable

#: Gives the speed (m/s or rad/s) that a drive is asked for, of a winch positive where it lets rope
#: out, after the time (s) and what is seen, by name: the drive's own "position" and "speed", and
#: what the case's `sees` names. SI units.
Law = Callable[[float, dict[str, float]], float]
#: A law, or a class whose objects are laws with a memory: each drive and each run has its own.
LawOrClass = Union[Law, Callable[[], Law]]

_NAME = "blocklift._kernel"
_loading = threading.Lock()


def simulate(case: Path, folder: Path, laws: Mapping[str, LawOrClass],
             changes: list[str]) -> None:
    """Simulates a case file in this process and writes its results into a folder.

    changes: keys that have other values than in their files, "block:mass=9 t".

    One lift runs in a process at a time: other threads that begin one wait. Raises ImportError if
    the module is not built, InputError, RunError, also where a law begins a lift itself, TypeError
    if a law cannot be called or gives no number, and whatever a law raises. So do the others.
    """
    load().simulate(os.fspath(case), os.fspath(folder), os.fspath(executable()), _checked(laws),
                    changes)


def assess(case: Path, folder: Path, laws: Mapping[str, LawOrClass], decks: bool,
           changes: list[str]) -> None:
    """Assesses a case file in this process and writes its results into a folder."""
    load().assess(os.fspath(case), os.fspath(folder), os.fspath(executable()), _checked(laws),
                  decks, changes)


def sweep(study: Path, folder: Path, laws: Mapping[str, LawOrClass]) -> None:
    """Runs a study in this process, a member after another, and writes its results. What is
    doubtful about them is a LiftWarning."""
    for doubt in load().sweep(os.fspath(study), os.fspath(folder), os.fspath(executable()),
                              _checked(laws)):
        warnings.warn(doubt, LiftWarning, stacklevel=2)


def _checked(laws: Mapping[str, LawOrClass]) -> dict[str, LawOrClass]:
    for name, law in laws.items():
        if not callable(law):
            raise TypeError(f'law "{name}" is {law!r}, which cannot be called')
    return dict(laws)


def load() -> ModuleType:
    """The module: that of the package, or of the build that the program is of.

    Raises ImportError, with what to install, if there is none for this Python.
    """
    with _loading:
        return sys.modules[_NAME] if _NAME in sys.modules else _load()


def _load() -> ModuleType:
    spec = importlib.util.find_spec(_NAME)
    if spec is None:
        file = f"_kernel{sysconfig.get_config_var('EXT_SUFFIX')}"
        beside = executable().parent / file
        if not beside.is_file():
            raise ImportError(
                f"laws of drives need the module {_NAME} for Python {sysconfig.get_python_version()}"
                f", and there is no {file} in the package or beside {executable()}. Debian's"
                " package python3-blocklift has it for /usr/bin/python3; a build of the sources"
                " makes it where python3-dev and pybind11-dev are installed", name=_NAME)
        spec = importlib.util.spec_from_file_location(_NAME, beside)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    sys.modules[_NAME] = module
    return module
