#!/usr/bin/env python3
"""Builds the site of the documentation: gathers pages, generates the manual and the register, runs
MkDocs strictly, and checks every link of what came out.

    build.py --blocklift EXECUTABLE --output FOLDER [--figures VERIFY.json]

The pages keep the places that they have in the repository, so that their relative links hold. A file of
the repository that a page links to and that is no page itself, such as a header, becomes a page with its
text.
"""

import argparse
import shutil
import subprocess
import sys
from pathlib import Path

from links import broken_links
from manual import write_manual
from register import write_register
from staging import Stage

ROOT = Path(__file__).resolve().parents[2]


def run(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def build(arguments):
    output = Path(arguments.output).resolve()
    shutil.rmtree(output / "pages", ignore_errors=True)
    shutil.rmtree(output / "site", ignore_errors=True)
    output.mkdir(parents=True, exist_ok=True)
    stage = Stage(ROOT, output / "pages")
    problems = stage.gather()
    write_manual(stage, run(arguments.blocklift, "schema", "--manual"))
    write_register(stage, run(arguments.blocklift, "verify", "--list"), arguments.figures)
    shutil.copy(Path(__file__).with_name("mkdocs.yml"), output / "mkdocs.yml")
    shutil.copy(Path(__file__).with_name("style.css"), output / "pages" / "style.css")
    for problem in problems:
        print(problem, file=sys.stderr)
    if problems:
        return 1
    if subprocess.run(["mkdocs", "build", "--strict", "--quiet"], cwd=output).returncode != 0:
        return 1
    broken = broken_links(output / "site")
    for link in broken:
        print(link, file=sys.stderr)
    print(f"{stage.pages} pages in {output / 'site'}, {len(broken)} broken links")
    return 1 if broken else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--blocklift", required=True, help="the executable")
    parser.add_argument("--output", required=True, help="folder for pages and site")
    parser.add_argument("--figures", help="what `blocklift verify --json` wrote")
    return build(parser.parse_args())


if __name__ == "__main__":
    sys.exit(main())
