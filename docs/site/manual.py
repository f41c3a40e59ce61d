"""The manual of keys: a page for each kind of file, from `blocklift schema --manual`."""

import re
from dataclasses import dataclass, field

KEYS_OF = re.compile(r"the keys of (?:a |an )?([a-z][a-z -]*?)(?=$|,| and | \(|;)")
FILES = {"lift case": "a lift: cranes, load, ropes, operation, sea, checks",
         "mechanism": "bodies, joints, loops, springs, forces, for `blocklift simulate`",
         "crane": "a crane that cases name", "block": "what is lifted", "rope": "a rope, sling or tackle",
         "part": "a part for `blocklift stress`", "vessel": "a floating hull",
         "vessels": "several floating hulls, for `blocklift hydro`",
         "standard": "rules that cases are checked by", "study": "many lifts of one case, for `blocklift sweep`"}


@dataclass
class Section:
    level: int
    title: str
    lines: list = field(default_factory=list)
    parts: list = field(default_factory=list)  # sections below, in the order of the keys that mention them

    def text(self):
        """All that it says, its parts included: two sections with the same text are one."""
        return "\n".join([self.title, *self.lines, *(part.text() for part in self.parts)])


def parse(manual):
    root = Section(1, "")
    open_sections = [root]
    for line in manual.splitlines():
        heading = re.match(r"(#+) (.*)", line)
        if not heading:
            open_sections[-1].lines.append(line)
            continue
        section = Section(len(heading[1]), heading[2])
        if section.level == 1:
            continue
        while open_sections[-1].level >= section.level:
            open_sections.pop()
        open_sections[-1].parts.append(section)
        open_sections.append(section)
    return root


class Page:
    """One kind of file: each table of keys once, however often others mention it."""

    def __init__(self, kind):
        self.anchors = {}
        self.lines = [f"# Keys of a {kind.title} file", ""]
        self._used = {}
        self._anchor(kind)
        self._write_body(kind)

    def _anchor(self, section):
        name = re.sub(r"[^a-z0-9]+", "-", section.title.lower()).strip("-")
        count = self._used[name] = self._used.get(name, 0) + 1
        self.anchors[section.text()] = name if count == 1 else f"{name}-{count}"

    def _write_body(self, section):
        waiting = list(section.parts)

        def link(match):
            for part in waiting:
                if part.title == match[1]:
                    waiting.remove(part)
                    if part.text() not in self.anchors:
                        self._anchor(part)
                        new.append(part)
                    return match[0].replace(match[1], f"[{match[1]}](#{self.anchors[part.text()]})")
            return match[0]

        new = []
        for line in section.lines:
            cells = line.split(" | ")
            if line.startswith("| `") and len(cells) > 2:
                cells[1] = KEYS_OF.sub(link, cells[1])
                line = " | ".join(cells)
            self.lines.append(line)
        for part in waiting:  # mentioned by a wording that is not recognised: still to be read
            if part.text() not in self.anchors:
                self._anchor(part)
                new.append(part)
        for part in new:
            self.lines += [f"## {part.title} {{: #{self.anchors[part.text()]} }}", ""]
            self._write_body(part)


def write_manual(stage, manual):
    root = parse(manual)
    table = ["| kind of file | what it describes |", "|---|---|"]
    for kind in root.parts:
        name = kind.title.replace(" ", "-")
        stage.write(f"docs/manual/{name}.md", "\n".join(Page(kind).lines) + "\n")
        table.append(f"| [{kind.title}](manual/{name}.md) | {FILES.get(kind.title, kind.lines[1])} |")
    stage.fill("docs/manual.md", "manual", "\n".join([*root.lines, *table]))
