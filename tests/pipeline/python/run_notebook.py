"""Runs a notebook from its first cell to its last in a temporary folder; fails with the cell that
fails."""

import os
import sys
import tempfile

import nbformat
from nbconvert.preprocessors import ExecutePreprocessor

notebook = nbformat.read(sys.argv[1], as_version=4)
nbformat.validate(notebook)
assert not any(cell.get("outputs") for cell in notebook.cells), "a notebook is kept without outputs"
with tempfile.TemporaryDirectory() as folder:
    for name in ("HOME", "IPYTHONDIR", "JUPYTER_RUNTIME_DIR", "MPLCONFIGDIR"):
        os.environ[name] = folder
    ExecutePreprocessor(timeout=300, kernel_name="python3").preprocess(
        notebook, {"metadata": {"path": folder}})
texts = [output.get("text", "") for cell in notebook.cells for output in cell.get("outputs", [])]
print("".join(texts))
