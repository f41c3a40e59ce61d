"""Kills assessments at random moments, and looks at what they leave behind.

    kill_runs.py BLOCKLIFT CASE [--kills N] [--seed S]

Each run goes into the same folder as the one before. After each kill the folder has no verdict, or
summary and report are of one run, and `blocklift report` accepts it or says that there is none. Every
tenth time the run is repeated until it ends: it goes on with what was kept, and its figures are those
of a run that was never stopped, bit for bit. Exit code 1 and a sentence if anything else is found.
"""

import argparse
import collections
import json
import os
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile
import time


def figures(folder):
    summary = json.loads((folder / "summary.json").read_text())
    for name in ("run", "created", "timing"):
        summary.pop(name)
    summary["solver"].pop("times_faster_than_real_time")
    return summary


def fail(text):
    sys.exit(f"kill_runs: {text}")


class Killing:
    def __init__(self, program, case, folder):
        self.command = [program, "assess", case, "-o", str(folder), "--threads", "2"]
        self.report = [program, "report", str(folder)]
        self.folder = folder
        self.found = collections.Counter()

    def run(self, seconds=None):
        """Runs to the end, or is killed after some seconds. Returns the output, None if killed."""
        # Everything that is done is kept, however quick it was.
        process = subprocess.Popen(self.command, env={**os.environ, "BLOCKLIFT_KEEP_AFTER": "0"},
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        try:
            out, err = process.communicate(timeout=seconds)
        except subprocess.TimeoutExpired:
            process.kill()
            process.communicate()
            return None
        if process.returncode != 0:
            fail(f"exit code {process.returncode}: {err}")
        return out

    def look(self):
        """The folder as a kill has left it."""
        has_verdict = (self.folder / "summary.json").exists()
        page = self.folder / "report.html"
        if has_verdict and page.exists():
            run = json.loads((self.folder / "summary.json").read_text())["run"]
            if run not in page.read_text():
                fail("summary and report are of two runs")
        moved = (self.folder / ".in-preparation" / "moves.txt").exists()
        if not has_verdict and not moved:
            self.found["without a verdict"] += 1
            return
        self.found["a move to complete" if moved else "earlier or new results, whole"] += 1
        report = subprocess.run(self.report, capture_output=True, text=True)
        if report.returncode != 0:
            fail(f"report: exit code {report.returncode}: {report.stderr}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("program")
    parser.add_argument("case")
    parser.add_argument("--kills", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    choice = parser.parse_args()
    moment = random.Random(choice.seed)
    with tempfile.TemporaryDirectory() as place:
        killing = Killing(choice.program, choice.case, pathlib.Path(place) / "results")
        start = time.monotonic()
        killing.run()
        usual = time.monotonic() - start
        expected = figures(killing.folder)
        resumed = 0
        kill = 0
        while kill < choice.kills:
            if kill % 10 == 5:
                # First runs of a folder; those before take the place of one that ended.
                shutil.rmtree(killing.folder, ignore_errors=True)
            start = time.monotonic()
            if killing.run(usual * moment.uniform(0.02, 1)) is not None:
                # What is kept, and a machine that has less to do, make runs quicker.
                usual = time.monotonic() - start
                continue
            kill += 1
            killing.look()
            if kill % 10 == 0:
                resumed += "going on with" in killing.run()
                if figures(killing.folder) != expected:
                    fail(f"other figures after kill {kill}")
    found = ", ".join(f"{count} {what}" for what, count in sorted(killing.found.items()))
    print(f"{choice.kills} kills: {found}; {choice.kills // 10} runs repeated, {resumed} of them "
          "went on with what was kept, all with the same figures")


main()
