"""test_pandas.py docs/start_python.md: the lines of the tutorial that make tables of pandas run as they stand, and have what the arrays have."""
import pathlib
import re
import sys

import numpy as np

import abut

BLOCK = {"shape": "structured_box", "lower": [0, 0], "upper": [1, 1], "counts": [4, 4], "young": 1.0, "poisson": 0.3, "density": 1.0}
SCENE = {"dim": 2, "run": {"time": 4.0}, "bodies": {"left": {**BLOCK, "velocity": [0.1, 0]}, "right": {**BLOCK, "place": [1.1, 0.1]}}}


def main():
    lines = re.search(r"```python\n( +import pandas\n.*?)```", pathlib.Path(sys.argv[1]).read_text(), re.S)[1]
    result = abut.run(SCENE)
    assert len(result.forces) > 0, "the blocks do not touch"
    names = {"result": result}
    exec(re.sub(r"^ {3}", "", lines, flags=re.M), names)
    energies, largest = names["energies"], names["largest"]
    assert np.array_equal(energies.index, result.ledger["time"])
    for column in energies.columns:
        assert np.array_equal(energies[column], result.ledger[column]), column
    assert set(energies.columns) | {"time"} == set(result.ledger.dtype.names)
    assert largest.index.tolist() == [("left", "right")] and largest.iloc[0] == result.forces["normal_force"].max()


main()
