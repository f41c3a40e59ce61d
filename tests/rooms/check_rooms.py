"""Reads every include of the tree against .ci/rooms.txt and prints those that cross a wall.

A file may include headers of its own folder and of the rooms that the list grants to its folder; a room
may be granted only rooms that stand above it in the list, and none that it does not use. Tests may
include everything, but nothing in the rooms may include a test. Libraries: only structure/ may include
deal.II, only the rooms named in LIBRARIES may include Gmsh, HDF5 and the others; so it is with the headers
in HEADERS. Two types of one name in one namespace are found, too: no compiler sees both, and the linker
silently gives one the functions of the other. So are tests that no CMakeLists.txt names: they would never
run, and nobody would miss them.

Usage: check_rooms.py FOLDER; exit code 1 if a wall is crossed.
"""

import pathlib
import re
import sys

HOUSES = ("algebra", "parallel", "dynamics", "structure", "pipeline")
INCLUDE = re.compile(r'^\s*#\s*include\s*(?:"([^"]+)"|<([^>]+)>)')
SOURCE = re.compile(r"[\w./]+_test\.cc")
# What opens and closes scopes, once comments and texts are left out.
SCOPE = re.compile(r"namespace\s*(?P<space>[\w:]*)\s*\{|"
                   r"(?:struct|class)\s+(?P<type>\w+)\s*(?:final\s*)?(?::(?!:)[^;{]*)?\{|"
                   r"enum\s+class\s+(?P<list>\w+)[^;{]*\{|\{|\}")
NOT_CODE = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"', re.DOTALL)
# Libraries that stay behind walls of their own: beginning of the header's name, and where it may be included.
LIBRARIES = {
    "deal.II/": ("structure",),
    "gmsh.h": ("structure", "pipeline/formats", "pipeline/verification"),
    "hdf5.h": ("pipeline/formats",),
    "yaml-cpp/": ("pipeline",),
    "cvodes/": ("dynamics/simulation",),
    "kinsol/": ("dynamics/simulation",),
    "fftw3.h": ("dynamics/marine/radiation", "dynamics/marine/waves"),
    "hmat/": ("dynamics/algebra",),
}
# Headers of the tree that stand behind walls of their own, and what serves instead.
HEADERS = {
    "dynamics/simulation/equilibrium.h": (
        ("dynamics/simulation", "pipeline/build", "pipeline/simulation", "pipeline/verification"),
        "a lift is brought to rest by pipeline/build/held_heading.h, which holds its heading"),
}


def read_rooms(path):
    """The rooms in their order with what each may include; what is wrong with the list is returned, too."""
    rooms, complaints, name = {}, [], None
    for number, line in enumerate(path.read_text().splitlines(), 1):
        text = line.split("#")[0].rstrip()
        if not text:
            continue
        if not text.startswith(" "):
            name, _, text = text.partition(":")
            if name in rooms:
                complaints.append(f"{path}:{number}: error: the room {name} stands in the list twice")
            rooms[name] = set()
        for used in text.split():
            if used not in rooms or used == name:
                complaints.append(
                    f"{path}:{number}: error: {name} may not use {used}, which does not stand above it")
            else:
                rooms[name].add(used)
    return rooms, complaints


def check_library(header, room):
    """None if the room may include this header of a library."""
    for beginning, allowed in LIBRARIES.items():
        if header.startswith(beginning):
            if not any(room == one or room.startswith(one + "/") for one in allowed):
                return f"includes <{header}>, which is for {', '.join(allowed)}"
    return None


def check_header(header, room):
    """None if the room may include this header of the tree, whatever else of its room it may include."""
    allowed, instead = HEADERS.get(header, ((room,), ""))
    if any(room == one or room.startswith(one + "/") for one in allowed):
        return None
    return f'may not include "{header}": {instead}'


def check_file(path, root, rooms, entered):
    """Complaints about one source or header; the rooms that it uses are added to those its room has entered."""
    room = str(path.parent.relative_to(root))
    shown = path.relative_to(root)
    if room not in rooms:
        return [f"{shown}:1: error: the room {room} does not stand in .ci/rooms.txt"]
    complaints = []
    for number, line in enumerate(path.read_text().splitlines(), 1):
        match = INCLUDE.match(line)
        if not match:
            continue
        own, library = match.groups()
        if library:
            why = check_library(library, room)
        elif not (root / own).is_file():
            why = f'includes "{own}", which is not a file of the tree'
        else:
            used = str(pathlib.PurePosixPath(own).parent)
            entered.setdefault(room, set()).add(used)
            crossing = used != room and used not in rooms[room]
            why = f"{room} may not include {used}" if crossing else check_header(own, room)
        if why:
            complaints.append(f"{shown}:{number}: error: {why}")
    return complaints


def types_of(path):
    """Full names and lines of the types that a file defines in named namespaces."""
    text = NOT_CODE.sub(lambda match: "\n" * match[0].count("\n"), path.read_text())
    scopes = []  # what each open brace belongs to; None where no type of others can stand
    for match in SCOPE.finditer(text):
        if match[0] == "}":
            if scopes:
                scopes.pop()
            continue
        name = match["type"] or match["list"]
        if name and None not in scopes:
            yield "::".join([*scopes, name]), text.count("\n", 0, match.start()) + 1
        scopes.append(match["space"] or None)


def check_types(paths, root):
    """Complaints about types that have the name of another one."""
    homes, complaints = {}, []
    for path in paths:
        for name, line in types_of(path):
            shown = path.relative_to(root)
            home = homes.setdefault(name, f"{shown}:{line}")
            if home != f"{shown}:{line}":
                complaints.append(f"{shown}:{line}: error: a second {name}; the first is in {home}")
    return complaints


def check_tests(root):
    """Complaints about sources of tests that belong to no program."""
    named = set()
    for listing in (root / "tests").rglob("CMakeLists.txt"):
        named |= {(listing.parent / source).resolve() for source in SOURCE.findall(listing.read_text())}
    return [f"{path.relative_to(root)}:1: error: no CMakeLists.txt names this test"
            for path in sorted((root / "tests").rglob("*_test.cc")) if path.resolve() not in named]


def check_tree(root):
    """All complaints about a tree."""
    rooms, complaints = read_rooms(root / ".ci" / "rooms.txt")
    files = [path for house in HOUSES for path in sorted((root / house).rglob("*"))
             if path.suffix in (".h", ".cc", ".inc") and "node_modules" not in path.parts]
    entered = {}
    for path in files:
        complaints += check_file(path, root, rooms, entered)
    complaints += check_types(files, root) + check_tests(root)
    inhabited = {str(path.parent.relative_to(root)) for path in files}
    complaints += [f".ci/rooms.txt: error: the room {room} is empty" for room in rooms if room not in inhabited]
    complaints += [f".ci/rooms.txt: error: {room} is granted {used} and does not use it"
                   for room in rooms if room in inhabited for used in sorted(rooms[room] - entered.get(room, set()))]
    return complaints


if __name__ == "__main__":
    found = check_tree(pathlib.Path(sys.argv[1]).resolve())
    print("\n".join(found) or "no include crosses a wall, no type has the name of another, every test has its program")
    sys.exit(1 if found else 0)
