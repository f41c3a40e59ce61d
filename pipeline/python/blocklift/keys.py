"""What the keys of input files mean, from the declarations by which the program reads them."""

from __future__ import annotations

import difflib
import functools
import re
from collections.abc import Iterator
from typing import Any

from .program import schema


@functools.lru_cache(maxsize=None)
def _schema(kind: str) -> dict[str, Any]:
    return schema(kind)


def describe(kind: str, key: str = "") -> str:
    """The manual's text of a key of a kind of file ("lift case", "mechanism", "crane", ...), with
    its default and the keys below it; of the whole file without a key. Names of the user's own
    (of ropes, say) and places in lists are passed over: "ropes.R1.length", "operation[0].moves".

    Raises KeyError, with near names, if the format has no such key; ValueError, which names the
    kinds, if there is no such kind of file.
    """
    places = [_schema(kind)]
    for name in [part for part in re.split(r"[.\[\]]+", key) if part]:
        below = [found for place in places for found in _step(place, name)]
        if not below:
            known = sorted({one for place in places for one in _members(place)})
            near = difflib.get_close_matches(name, known, 1)
            meant = f'did you mean "{near[0]}"?' if near else f"its keys are {', '.join(known)}"
            raise KeyError(f'{key}: the format has no "{name}"; {meant}')
        places = below
    return _text(key, places)


def _forms(place: dict[str, Any]) -> Iterator[dict[str, Any]]:
    """A place of a schema and the alternatives that it gives."""
    yield place
    for word in ("anyOf", "oneOf", "allOf"):
        for form in place.get(word, []):
            if isinstance(form, dict):
                yield from _forms(form)


def _members(place: dict[str, Any]) -> list[str]:
    return [name for form in _forms(place) for name in form.get("properties", {})]


def _step(place: dict[str, Any], name: str) -> list[dict[str, Any]]:
    found = [form["properties"][name] for form in _forms(place)
             if name in form.get("properties", {})]
    if found:
        return found
    # A name of the user's own, or a place in a list.
    others = [form.get("items") if name.isdigit() else form.get("additionalProperties")
              for form in _forms(place)]
    return [other for other in others if isinstance(other, dict)]


def _text(key: str, places: list[dict[str, Any]]) -> str:
    lines: list[str] = []
    for place in places:
        for form in _forms(place):
            said = form.get("description")
            if said and said not in lines:
                lines.append(said)
            more = [form["$comment"]] if form.get("$comment") else []
            for word, members_of in (("for example", "examples"), ("one of", "enum")):
                if form.get(members_of):
                    more.append(f"{word} {', '.join(map(str, form[members_of]))}")
            lines += [line for line in more if line not in lines]
    members: dict[str, str] = {}
    for place in places:
        for form in _forms(place):
            for name, member in form.get("properties", {}).items():
                members.setdefault(name, str(member.get("description", "")))
    lines += [f"  {name}: {said}" for name, said in members.items()]
    return "\n".join([key, *lines] if key else lines)
