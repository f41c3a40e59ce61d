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


class RunError(RuntimeError):
    """The input is right, but the run failed."""


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
