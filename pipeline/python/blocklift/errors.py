"""What can go wrong, with file and line."""

from __future__ import annotations

import re
from dataclasses import dataclass, field

_PLACE = re.compile(
    r"^(?P<file>[^\n]*?)(?::(?P<line>\d+)(?::(?P<column>\d+))?)?: error: (?P<message>.*)$")


@dataclass(frozen=True)
class Complaint:
    """One mistake of an input file."""

    file: str
    line: int | None  #: from 1; None where the whole file is meant
    column: int | None
    message: str
    hints: list[str] = field(default_factory=list)

    def __str__(self) -> str:
        place = ":".join(str(part) for part in (self.file, self.line, self.column) if part)
        return "\n    ".join([f"{place}: {self.message}", *self.hints])


class InputError(ValueError):
    """The input is wrong; nothing was run. `complaints` has each mistake with its place."""

    def __init__(self, complaints: list[Complaint]) -> None:
        super().__init__("\n".join(str(complaint) for complaint in complaints))
        self.complaints = complaints

    def __reduce__(self) -> tuple[type[InputError], tuple[list[Complaint]]]:
        # On its way from another process it is made again: of complaints, and not of their text.
        return type(self), (self.complaints,)


class RunError(RuntimeError):
    """The input is right, but the run failed."""


class LiftWarning(UserWarning):
    """What the program warns of: the run goes on, and something in it is doubtful."""


def warnings_of(text: str) -> list[str]:
    """The warnings that the program wrote to its standard output, each in one line."""
    found: list[str] = []
    is_within = False
    for line in text.splitlines():
        if line.startswith("warning: "):
            found.append(line[len("warning: "):])
        elif is_within and line.startswith("    "):
            found[-1] += " " + line.strip()
        else:
            is_within = False
            continue
        is_within = True
    return found


def complaints_of(text: str) -> list[Complaint]:
    """The complaints that the program wrote to its standard error."""
    found: list[Complaint] = []
    for line in text.splitlines():
        if line.startswith("    ") and found:
            found[-1].hints.append(line.strip())
            continue
        place = _PLACE.match(line)
        if place:
            number = {key: int(place[key]) if place[key] else None for key in ("line", "column")}
            found.append(Complaint(place["file"], number["line"], number["column"],
                                   place["message"]))
    return found
