"""Gathers the pages of the site from the repository."""

import json
import os
import re
import shutil
import subprocess

# Pages are these Markdown files; everything else is taken along only where a page links to it.
PAGES = ["README.md", "docs/*.md", "cases/*/README.md", "models/*.md", "models/**/README.md",
         "tests/benchmarks/README.md"]
PICTURES = {".png", ".svg"}
LANGUAGES = {".h": "cpp", ".cc": "cpp", ".inc": "cpp", ".yaml": "yaml", ".py": "python", ".sh": "bash",
             ".ts": "typescript", ".json": "json", ".cmake": "cmake"}
LINK = re.compile(r"(!?\[[^\]]*\]\()([^)\s]+)(\))")
FENCE = re.compile(r"^(\s*)(```+|~~~+)")


class Stage:
    """The folder of pages that MkDocs reads."""

    def __init__(self, root, folder):
        self.root = root
        self.folder = folder
        self.pages = 0
        self._sources = {}

    def gather(self):
        """Copies pages and what they link to; returns a complaint for each link that leads nowhere."""
        listed = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard", *PAGES],
                                cwd=self.root, check=True, capture_output=True, text=True).stdout
        problems = []
        for name in sorted(set(listed.split())):
            path = self.root / name
            if not path.exists():
                continue
            self.write(name, self._with_links(path, problems))
        for source, name in self._sources.items():
            self._write_source(source, name)
        return problems

    def write(self, name, text):
        target = self.folder / name
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(text)
        self.pages += 1

    def fill(self, name, mark, text):
        """Puts text in place of the line <!-- mark --> of a page."""
        target = self.folder / name
        page = target.read_text()
        line = f"<!-- {mark} -->"
        if line not in page:
            raise SystemExit(f"{name} lacks the line {line}")
        target.write_text(page.replace(line, text))

    def _with_links(self, path, problems):
        lines, fence = [], None
        for number, line in enumerate(path.read_text().splitlines(), 1):
            mark = FENCE.match(line)
            if mark and fence is None:
                fence = mark.group(2)
            elif mark and mark.group(2).startswith(fence):
                fence = None
            elif fence is None and not line.startswith("    "):
                def follow(match, number=number):
                    return match[1] + self._follow(path, number, match[2], problems) + match[3]
                line = LINK.sub(follow, line)
            lines.append(line)
        return "\n".join(lines) + "\n"

    def _follow(self, path, number, link, problems):
        """Where a link of the page `path` leads on the site; takes along what it leads to."""
        if re.match(r"[a-z]+:", link) or link.startswith("#"):
            return link
        name, hash_mark, fragment = link.partition("#")
        target = (path.parent / name).resolve()
        if target.is_dir():
            target, name = target / "README.md", name.rstrip("/") + "/README.md"
        if not target.is_file() or self.root not in target.parents:
            problems.append(f"{path.relative_to(self.root)}:{number}: {link} is not in the repository")
            return link
        relative = target.relative_to(self.root)
        if target.suffix in PICTURES:
            (self.folder / relative).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(target, self.folder / relative)
        elif target.suffix != ".md":
            # MkDocs passes over folders whose names begin with a point.
            page = f"{relative}.md".removeprefix(".")
            self._sources[target] = page
            name = os.path.relpath(self.root / page, path.parent)
        return name + hash_mark + fragment

    def _write_source(self, source, name):
        language = LANGUAGES.get(source.suffix, "text")
        text = source.read_text()
        if source.suffix == ".ipynb":
            self.write(name, _notebook(text))
            return
        fence = "`" * (3 + max((len(run) for run in re.findall(r"`{3,}", text)), default=0))
        self.write(name, f"# {source.relative_to(self.root)}\n\n{fence}{language}\n{text}{fence}\n")


def _notebook(text):
    """The cells of a notebook as a page."""
    parts = []
    for cell in json.loads(text)["cells"]:
        content = "".join(cell["source"])
        parts.append(content if cell["cell_type"] == "markdown" else f"```python\n{content}\n```")
    return "\n\n".join(parts) + "\n"
