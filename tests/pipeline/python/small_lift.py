"""The small lift in a temporary folder, in which its tests run."""

import os
import shutil
import tempfile
import unittest
from pathlib import Path

import blocklift

SMALL_LIFT = Path(os.environ["BLOCKLIFT_SMALL_LIFT"])
MECHANISMS = Path(os.environ["BLOCKLIFT_MECHANISMS"])
VESSELS = MECHANISMS.parent / "vessels"


class InATemporaryFolder(unittest.TestCase):
    def setUp(self):
        self._folder = tempfile.TemporaryDirectory()
        self.addCleanup(self._folder.cleanup)
        self._before = os.getcwd()
        self.addCleanup(os.chdir, self._before)
        os.chdir(self._folder.name)
        shutil.copytree(SMALL_LIFT, "lift")

    def set_down(self):
        """The lift as it is set down: a member whose sling is not slack in time fails when it runs.

        Returns a study of two such times, the second of which is too short.
        """
        case = blocklift.Case("lift")
        case.set("operation", [{
            "stage": "set down", "moves": [{"drives": ["C1.left", "C1.right"], "by": "1.5 m"}],
            "until": {"slack": "R1", "within": "30 s"}}])
        case.set("ground", "0 m")
        case.set("ground_contact", {"stiffness": "5 MN/m", "damping": "200 kN s/m"})
        for hoist in ("left", "right"):
            case.set(f"cranes.C1.start.{hoist}", "6.4 m")
        case.save()
        return ("study: late\ncase: lift\nfigures: [ropes.R1.max_dynamic_tension_N]\n"
                "vary: {within: {keys: ['operation[1].until.within'], values: [30 s, 0.5 s]}}\n")
