"""The small lift in a temporary folder, in which its tests run."""

import os
import shutil
import tempfile
import unittest
from pathlib import Path

SMALL_LIFT = Path(os.environ["BLOCKLIFT_SMALL_LIFT"])
MECHANISMS = Path(os.environ["BLOCKLIFT_MECHANISMS"])


class InATemporaryFolder(unittest.TestCase):
    def setUp(self):
        self._folder = tempfile.TemporaryDirectory()
        self.addCleanup(self._folder.cleanup)
        self._before = os.getcwd()
        self.addCleanup(os.chdir, self._before)
        os.chdir(self._folder.name)
        shutil.copytree(SMALL_LIFT, "lift")
