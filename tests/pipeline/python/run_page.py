"""Runs the Python examples of a page of the documentation, one after another, in a temporary
folder."""

import os
import re
import sys
import tempfile
from pathlib import Path

examples = re.findall(r"^```python\n(.*?)^```", Path(sys.argv[1]).read_text(encoding="utf-8"),
                      re.DOTALL | re.MULTILINE)
assert examples, "the page has no examples"
with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    names = {}
    for number, example in enumerate(examples, 1):
        print(f"-- example {number}")
        exec(compile(example, f"example {number}", "exec"), names)  # the page's own text
    os.chdir("/")
