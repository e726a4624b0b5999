"""try_wheel.py BUILD: the wheel that `pip install .` packs from a build holds what RECORD says, and runs a host without an install."""
import base64
import csv
import hashlib
import pathlib
import subprocess
import sys
import tempfile
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "bindings/python/wheel"))
import abut_wheel  # noqa: E402

with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    with zipfile.ZipFile(folder / abut_wheel.build_wheel(folder, {"build": sys.argv[1]})) as wheel:
        rows = list(csv.reader(wheel.read(f"abut-{abut_wheel.version()}.dist-info/RECORD").decode().splitlines()))
        assert sorted(row[0] for row in rows) == sorted(wheel.namelist()), "RECORD lists other files than those of the wheel"
        for path, digest, size in rows[:-1]:
            data = wheel.read(path)
            assert len(data) == int(size), path
            assert digest == "sha256=" + base64.urlsafe_b64encode(hashlib.sha256(data).digest()).decode().rstrip("="), path
        wheel.extractall(folder / "site")
    said = subprocess.run([sys.executable, ROOT / "examples/two_squares/two_squares.py"], cwd=folder, capture_output=True, text=True,
                          env={"PYTHONPATH": str(folder / "site")}, check=True).stdout
    assert said.startswith("left (-0.090, -0.010), right (0.090, 0.010)"), said
    try:
        abut_wheel.build_wheel(folder, {"biuld": "."})
    except SystemExit as error:
        assert "biuld" in str(error), error
    else:
        raise AssertionError("a setting that is not there is taken")
