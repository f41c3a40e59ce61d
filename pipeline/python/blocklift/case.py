"""Lift cases and mechanisms: read, changed, checked and run."""

from __future__ import annotations

import contextlib
import difflib
import os
import re
import shutil
import tempfile
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from ruamel.yaml import YAML

from . import kernel
from .errors import Complaint, InputError
from .keys import describe
from .program import run
from .results import Result

_PIECE = re.compile(r"([^\[\]]*)((?:\[\d+\])*)")
_INDEX = re.compile(r"\[(\d+)\]")


def _yaml() -> Any:
    """Of its own for each use: it has a state, and threads may read cases side by side."""
    yaml: Any = YAML()
    yaml.preserve_quotes = True
    yaml.width = 4096
    return yaml


class Case:
    """A case, or a mechanism, as its file says it, to be changed in memory.

    `data` is the file's content, nested dictionaries and lists whose quantities are texts with
    their unit ("10 m"). The file itself stays as it is until :meth:`save`. `model_values` has what
    keys of its models, "block:mass", were set to; the models' files stay as they are.
    """

    def __init__(self, path: str | os.PathLike[str]) -> None:
        """Reads a file, or the `case.yaml` or `mechanism.yaml` of a folder.

        Raises FileNotFoundError if there is none, InputError if it is no YAML.
        """
        self.file = _file_of(Path(path))
        try:
            data = _yaml().load(self.file.read_text(encoding="utf-8"))
        except Exception as error:  # of ruamel's many
            mark = getattr(error, "problem_mark", None)
            raise InputError([Complaint(str(self.file), mark.line + 1 if mark else None,
                                        mark.column + 1 if mark else None,
                                        str(getattr(error, "problem", error)))]) from error
        if not isinstance(data, dict):
            raise InputError([Complaint(str(self.file), None, None, "the file has no keys")])
        self.data: dict[str, Any] = data
        self._begun_with = _text_of(self.data)
        self.model_values: dict[str, str] = {}

    @property
    def name(self) -> str:
        """What the file calls it."""
        return str(self.data.get("case") or self.data.get("mechanism") or self.file.parent.name)

    def get(self, key: str) -> Any:
        """The value of a key: "ropes.R1.length", "operation[2].moves[0].speed". Of a model's key,
        "block:mass", what it was set to.

        Raises KeyError, with near names, if a part of it is not there; of a model's key that was
        not set.
        """
        if ":" in key:
            if key not in self.model_values:
                raise KeyError(f"{key}: this key of a model was not set; its value is in its file")
            return self.model_values[key]
        value: Any = self.data
        for part in _parts(key):
            value = _step(value, part, key)
        return value

    def set(self, key: str, value: Any) -> None:
        """Changes a value, or adds a key to a part that is there. Quantities are texts with their
        unit: `case.set("ropes.R1.length", "10.05 m")`. Numbers may be NumPy's.

        Before a colon stands the crane, block, rope or standard that a key belongs to, as the case
        calls it, as in a study: `case.set("blocks/hull-860t:mass", "870 t")`. Such a key must be
        in the model's file and have one value; the program says so when the case is read.

        Raises KeyError, with near names, if a part before the last is not there, or if the key is
        none; TypeError if a model's key is given more than one value.
        """
        if ":" in key:
            text = _scalar_text(key, value)
            _change_of(key, text)
            self.model_values[key] = text
            return
        *way, last = _parts(key)
        place: Any = self.data
        for part in way:
            place = _step(place, part, key)
        if isinstance(last, int):
            _step(place, last, key)
        elif not isinstance(place, dict):
            raise KeyError(f'{key}: there are no keys in what stands before "{last}"')
        place[last] = _plain(value)

    def describe(self, key: str) -> str:
        """What the manual says of a key, with unit, limits and default, from the declaration by
        which the program reads it: `case.describe("wind.speed")`.

        Raises KeyError, with near names, if the format has no such key.
        """
        return describe("mechanism" if "mechanism" in self.data else "lift case", key)

    def save(self, path: str | os.PathLike[str] | None = None) -> Path:
        """Writes the file, in place or under another name. Models are looked for beside it.

        Raises ValueError if keys of models were set: they are in other files.
        """
        if self.model_values:
            raise ValueError(f"{', '.join(self.model_values)}: keys of models are not in the file "
                             "of the case; change their files, or clear model_values")
        target = Path(path) if path is not None else self.file
        target.parent.mkdir(parents=True, exist_ok=True)
        beside = target.with_name(f".{target.name}.part")
        beside.write_text(_text_of(self.data), encoding="utf-8")
        beside.replace(target)
        return target

    def validate(self) -> None:
        """Reads the case with all that it names. Raises InputError with every mistake."""
        with self._on_disk() as file:
            self._run(["validate", file, *self._asked()], file)

    def assess(self, output: str | os.PathLike[str] | None = None, *, decks: bool = False,
               laws: Mapping[str, kernel.LawOrClass] | None = None) -> Result:
        """The whole lift: motion, stress, checks. A lift that fails its checks is a result.

        output: folder of the results, results/<name> if not given.
        decks: write the governing load cases for other solvers, too.
        laws: functions that steer drives, as :meth:`simulate` has them. Each run of the lift
        within the assessment (what errors in lengths of slings do, the worst instant of a fault)
        begins with laws of its own.

        Raises InputError, RunError, and with laws what :meth:`simulate` raises.
        """
        folder = Path(output) if output is not None else Path("results") / self.name
        with self._on_disk() as file:
            if laws is None:
                self._run(["assess", file, "--output", folder, *self._asked(),
                           *(["--decks"] if decks else [])], file)
            else:
                with self._naming_own_file(file):
                    kernel.assess(file, folder, laws, decks, self._changes())
        return Result(folder)

    def simulate(self, output: str | os.PathLike[str] | None = None, *, files: bool = True,
                 laws: Mapping[str, kernel.LawOrClass] | None = None) -> Result:
        """The motion alone.

        output: folder of the results, results/<name> if not given.
        files: False leaves no folder: the result is in memory. What reads folders (`measured`,
        `blocklift compare`) cannot have it then.

        laws: functions that steer drives, by the names under which moves of the case have them
        (`keeps: {law: NAME}`); the lift then runs in this process. A law is called at each look
        with the time, s, and a dictionary of what it sees: the drive's own "position" and "speed",
        and what the case's `sees` names, in m, rad, N and 1. It gives the speed that the drive is
        asked for a reaction later, m/s or rad/s, of a winch positive where it lets rope out. A
        class is called at the beginning of each run, once a drive: its objects are laws with a
        memory.

        Raises InputError, RunError (also where a law gives nan); with laws ImportError if the
        module for them is not built, TypeError if a law gives no number, and what a law raises.
        """
        if not files and output is not None:
            raise ValueError("output names a folder, and files=False asks for none")
        if files:
            folder = Path(output) if output is not None else Path("results") / self.name
            self._simulate_into(folder, laws)
            return Result(folder)
        with tempfile.TemporaryDirectory(prefix="blocklift-") as aside:
            self._simulate_into(Path(aside) / "result", laws)
            return Result(Path(aside) / "result", in_memory=True)

    def _simulate_into(self, folder: Path, laws: Mapping[str, kernel.LawOrClass] | None) -> None:
        with self._on_disk() as file:
            if laws is None:
                self._run(["simulate", file, "--output", folder, *self._asked()], file)
                return
            with self._naming_own_file(file):
                kernel.simulate(file, folder, laws, self._changes())

    def _changes(self) -> list[str]:
        """The values of models' keys, as `--set` takes them."""
        return [_change_of(key, value) for key, value in self.model_values.items()]

    def _asked(self) -> list[str]:
        return [word for change in self._changes() for word in ("--set", change)]

    def _run(self, arguments: list[str | os.PathLike[str]], file: Path) -> str:
        with self._naming_own_file(file):
            return run(arguments)

    @contextlib.contextmanager
    def _naming_own_file(self, file: Path) -> Iterator[None]:
        try:
            yield
        except InputError as error:
            # Complaints name the case's own files and not those of the copy that was run.
            if file == self.file:
                raise

            def own(text: str) -> str:
                return text.replace(str(file.parent), str(self.file.parent))

            raise InputError([
                Complaint(str(self.file) if Path(one.file) == file else own(one.file), one.line,
                          one.column, own(one.message), [own(hint) for hint in one.hints])
                for one in error.complaints]) from None

    @contextlib.contextmanager
    def _on_disk(self) -> Iterator[Path]:
        """The file, or, where it was changed, a copy of its folder with the changes."""
        text = _text_of(self.data)
        if text == self._begun_with:
            yield self.file
            return
        with tempfile.TemporaryDirectory(prefix="blocklift-") as folder:
            copy = Path(folder) / "case"
            shutil.copytree(self.file.parent, copy, ignore=_left_out)
            (copy / self.file.name).write_text(text, encoding="utf-8")
            yield copy / self.file.name


def _left_out(folder: str, names: list[str]) -> list[str]:
    """What a copy of a case's folder does without: results, and what is hidden. Of many lifts that
    are run into the case's own folder each copy would hold all earlier ones."""
    return [name for name in names
            if name == "results" or name.startswith(".")
            or all((Path(folder) / name / one).is_file() for one in ("summary.json", "results.h5"))]


def _file_of(path: Path) -> Path:
    if path.is_file():
        return path
    for name in ("case.yaml", "mechanism.yaml"):
        if (path / name).is_file():
            return path / name
    raise FileNotFoundError(f"{path}: no such file, and no folder with a case.yaml")


def _text_of(data: Any) -> str:
    import io

    text = io.StringIO()
    _yaml().dump(data, text)
    return text.getvalue()


def _plain(value: Any) -> Any:
    """A value as YAML knows it: scalars and arrays of NumPy, paths and tuples are none."""
    if isinstance(value, (np.generic, np.ndarray)):
        return _plain(value.tolist())
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if isinstance(value, tuple):
        return [_plain(one) for one in value]
    # In place: what ruamel keeps of comments stays.
    places = range(len(value)) if isinstance(value, list) else value
    if isinstance(value, (list, dict)):
        for place in places:
            plain = _plain(value[place])
            if plain is not value[place]:
                value[place] = plain
    return value


def _change_of(key: str, value: str) -> str:
    """A change of a model's key as the command line has it, where lists count from 1."""
    model, _, own = key.partition(":")
    way = "".join(f"[{part + 1}]" if isinstance(part, int) else f".{part}" for part in _parts(own))
    if not model or not way.startswith("."):
        raise KeyError(f'"{key}" is no key of a model: "block:mass" is, the model as the case '
                       "calls it before the colon")
    return f"{model}:{way[1:]}={value}"


def _scalar_text(key: str, value: Any) -> str:
    plain = _plain(value)
    if not isinstance(plain, (str, int, float)):
        raise TypeError(f"{key}: a key of a model takes one value, and not {plain!r}")
    return str(plain).lower() if isinstance(plain, bool) else str(plain)


def _parts(key: str) -> list[str | int]:
    parts: list[str | int] = []
    for piece in key.split("."):
        found = _PIECE.fullmatch(piece)
        if not piece or found is None:
            raise KeyError(f'"{key}" is no key: names with dots between them are, and places in '
                           "lists from 0 on: operation[2].moves[0].speed")
        if found[1]:
            parts.append(found[1])
        parts.extend(int(index) for index in _INDEX.findall(found[2]))
    return parts


def _step(value: Any, part: str | int, key: str) -> Any:
    if isinstance(part, int):
        if not isinstance(value, list) or part >= len(value):
            count = len(value) if isinstance(value, list) else 0
            raise KeyError(f"{key}: there is no [{part}]; the list has {count}")
        return value[part]
    if not isinstance(value, dict) or part not in value:
        names = [str(name) for name in value] if isinstance(value, dict) else []
        near = difflib.get_close_matches(part, names, 1)
        meant = f'; did you mean "{near[0]}"?' if near else f"; its keys are {', '.join(names)}"
        raise KeyError(f'{key}: there is no "{part}"{meant if names else ""}')
    return value[part]
