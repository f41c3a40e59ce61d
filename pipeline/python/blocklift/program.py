"""The program `blocklift`, run as a process."""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import warnings
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from .errors import InputError, LiftWarning, RunError, complaints_of, warnings_of

_DONE, _RUN_FAILED, _WRONG_INPUT, _LIFT_FAILS = range(4)


def executable() -> Path:
    """The program: what the variable BLOCKLIFT names, or `blocklift` of the PATH, or that of a
    build of the clone that this package is in.

    Raises FileNotFoundError if there is none.
    """
    named = os.environ.get("BLOCKLIFT")
    if named:
        if not Path(named).is_file():
            raise FileNotFoundError(f'BLOCKLIFT names "{named}", which is no file')
        return Path(named)
    found = shutil.which("blocklift")
    if found:
        return Path(found)
    built = Path(__file__).resolve().parents[3] / "build" / "release" / "blocklift"
    if built.is_file():
        return built
    raise FileNotFoundError(
        "the program blocklift is not on the PATH; let the variable BLOCKLIFT name it")


def run(arguments: Sequence[str | os.PathLike[str]],
        environment: dict[str, str] | None = None) -> str:
    """Runs the program to its end.

    Returns what it printed; a lift that fails its checks is no error here. What it warns of is a
    LiftWarning.

    Raises InputError for wrong input, RunError if the run fails. Ctrl-C ends the program as on a
    terminal before KeyboardInterrupt goes on.
    """
    with subprocess.Popen([str(executable()), *(os.fspath(one) for one in arguments)],
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                          env={**os.environ, **(environment or {})}) as process:
        try:
            said, complained = process.communicate()
        except KeyboardInterrupt:
            # Notebooks interrupt Python alone. Results that are being written are finished.
            process.send_signal(signal.SIGINT)
            process.communicate()
            raise
        except BaseException:
            process.kill()
            raise
    doubts = warnings_of(said)
    if process.returncode in (_DONE, _LIFT_FAILS):
        for doubt in doubts:
            warnings.warn(doubt, LiftWarning, stacklevel=2)
        return said
    if process.returncode == _WRONG_INPUT:
        complaints = complaints_of(complained)
        if complaints:
            raise InputError(complaints)
        raise ValueError(complained.strip())
    if process.returncode < 0:  # what it said last has nothing to do with it
        complained += f"\nblocklift was ended by signal {-process.returncode}"
    raise RunError("\n".join([complained.strip(), *doubts]).strip() or said.strip())


def version() -> str:
    """Version of the program."""
    return run(["--version"]).split()[-1]


def new(kind: str, folder: str | os.PathLike[str]) -> Path:
    """Writes a commented case that runs into a new folder, to begin with: "two-hoists",
    "turn-over", "study", ..., as `blocklift new` does. Returns the folder.

    Raises InputError if the folder is there already, ValueError, with all kinds, if there is no
    such kind.
    """
    run(["new", kind, folder])
    return Path(folder)


def schema(kind: str | None = None) -> dict[str, Any]:
    """JSON schema of the input files, or of one kind: "case", "crane", "block", ..."""
    loaded: dict[str, Any] = json.loads(run(["schema", *(["--kind", kind] if kind else [])]))
    return loaded
