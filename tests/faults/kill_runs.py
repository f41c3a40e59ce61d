"""Kills runs at random moments, and looks at what they leave behind.

    kill_runs.py BLOCKLIFT CASE [--command assess|simulate|sweep] [--kills N] [--seed S] [--interrupt]

CASE is a study for `sweep`. Each run goes into the same folder as the one before. After each kill the
folder has no summary, or summary and report are of one run, and `blocklift report` accepts it or says
that there is none. A study has no result, or one whose table and figures are those of a whole study.
Every tenth time the run is repeated until it ends: its figures are those of a run that was never
stopped, bit for bit. Exit code 1 and a sentence if anything else is found.

--interrupt stops them as Ctrl-C does instead: then a run ends by that signal within ten seconds, which
a busy machine may need to write its results whole, and leaves nothing half-written.
"""

import argparse
import collections
import json
import os
import pathlib
import random
import shutil
import signal
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


def study_figures(folder):
    return json.loads((folder / "study.json").read_text()), (folder / "study.csv").read_text()


def fail(text):
    sys.exit(f"kill_runs: {text}")


class Killing:
    def __init__(self, program, command, case, folder, interrupts):
        bound = ["--workers", "2"] if command == "sweep" else ["--threads", "2"]
        self.command = [program, command, case, "-o", str(folder), *bound]
        self.is_study = command == "sweep"
        self.expected = None
        self.interrupts = interrupts
        self.longest = 0
        self.program = program
        self.folder = folder
        self.found = collections.Counter()

    def begin_folder(self, folder):
        shutil.rmtree(self.folder, ignore_errors=True)
        self.command[self.command.index(str(self.folder))] = str(folder)
        self.folder = folder

    def run(self, seconds=None):
        """Runs to the end, or is killed after some seconds. Returns the output, None if killed."""
        # Everything that is done is kept, however quick it was.
        process = subprocess.Popen(self.command, env={**os.environ, "BLOCKLIFT_KEEP_AFTER": "0"},
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                   # What runs in the background may ignore interrupts.
                                   preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
        try:
            out, err = process.communicate(timeout=seconds)
        except subprocess.TimeoutExpired:
            if self.interrupts:
                self.interrupt(process)
            else:
                process.kill()
                process.communicate()
            return None
        if process.returncode != 0:
            fail(f"exit code {process.returncode}: {err}")
        return out

    def interrupt(self, process):
        begin = time.monotonic()
        process.send_signal(signal.SIGINT)
        try:
            process.communicate(timeout=10)
        except subprocess.TimeoutExpired:
            process.kill()
            fail("an interrupt did not end the run within ten seconds")
        self.longest = max(self.longest, time.monotonic() - begin)
        # A run that had just ended has its own exit code.
        if process.returncode not in (-signal.SIGINT, 0):
            fail(f"exit code {process.returncode} after an interrupt")
        for name in (".in-preparation", "*.part-*", ".*.part-*"):
            if left := list(self.folder.glob(name)):
                fail(f"an interrupt left {left[0].name}")

    def figures(self):
        return study_figures(self.folder) if self.is_study else figures(self.folder)

    def look(self):
        """The folder as a kill has left it."""
        if self.is_study:
            self.look_at_study()
        else:
            self.look_at_lift()

    def look_at_study(self):
        if not (self.folder / "study.json").exists():
            self.found["without a result"] += 1
            return
        if self.figures() != self.expected:
            fail("a study that was killed has other figures")
        missing = [name for name in ("study.h5", "study.html") if not (self.folder / name).exists()]
        if missing:
            fail(f"a study has figures, but no {missing[0]}")
        self.found["earlier or new results, whole"] += 1

    def look_at_lift(self):
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
        report = subprocess.run([self.program, "report", str(self.folder)], capture_output=True,
                                text=True)
        if report.returncode != 0:
            fail(f"report: exit code {report.returncode}: {report.stderr}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("program")
    parser.add_argument("case")
    parser.add_argument("--command", choices=("assess", "simulate", "sweep"), default="assess")
    parser.add_argument("--kills", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--interrupt", action="store_true")
    choice = parser.parse_args()
    moment = random.Random(choice.seed)
    # A worker of a killed study may end a moment after it, while it still writes.
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as place:
        killing = Killing(choice.program, choice.command, choice.case,
                          pathlib.Path(place) / "results", choice.interrupt)
        start = time.monotonic()
        killing.run()
        whole = usual = time.monotonic() - start
        killing.expected = killing.figures()
        resumed = 0
        kill = 0
        while kill < choice.kills:
            if kill % 10 == 5:
                # First runs of a folder; those before take the place of one that ended.
                killing.begin_folder(pathlib.Path(place) / f"results-{kill}")
                usual = whole
            start = time.monotonic()
            if killing.run(usual * moment.uniform(0.02, 1)) is not None:
                # What is kept, and a machine that has less to do, make runs quicker.
                usual = time.monotonic() - start
                continue
            kill += 1
            killing.look()
            if kill % 10 == 0:
                resumed += "going on with" in killing.run()
                if killing.figures() != killing.expected:
                    fail(f"other figures after kill {kill}")
    found = ", ".join(f"{count} {what}" for what, count in sorted(killing.found.items()))
    if choice.interrupt:
        print(f"an interrupt ended a run within {killing.longest:.2f} s")
    ways = "interrupts" if choice.interrupt else "kills"
    print(f"{choice.kills} {ways} of {choice.command}: {found}; {choice.kills // 10} runs repeated, "
          f"{resumed} of them said that they went on with what was kept, all with the same figures")


main()
