"""run_readme.py README.md: the first program in Python of the page runs as it stands, has 11 lines at most, and two blocks push each
other off: all momentum that one loses the other gains, energy is kept to round-off, and nothing warns."""
import os
import pathlib
import re
import sys
import tempfile

import numpy as np

text = re.search(r"^```python\n(.*?)^```$", pathlib.Path(sys.argv[1]).read_text(), re.S | re.M)[1]
assert len(text.splitlines()) <= 11, f"{len(text.splitlines())} lines"
names = {}
with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    exec(compile(text, "README.md", "exec"), names)
    assert pathlib.Path("out/blocks/report.html").exists()
    os.chdir("/")
result = names["result"]
assert result["good"], (result["verdict"], result["warnings"])

before, after = ([np.array(body["mass"]) * body["velocity"] for body in result[when]] for when in ("start", "end"))
assert np.abs(sum(after) - sum(before)).max() < 1e-13 * np.abs(before).max(), after
assert before[0][0] > 0 > after[0][0] and before[1][0] < 0 < after[1][0], "they push each other off"
assert after[0][1] < 0 and all(body["rotation"] > 0 for body in result["end"]), "the lower is pushed down, and both turn to the left"
