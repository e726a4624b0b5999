"""Runs of `abut run` for tests and scripts that claim something of their results."""
import csv
import json
import pathlib
import subprocess
import sys
import tempfile


class Run:
    """A run of `abut run` and what it left. `scene`: its file; `folder`: of the results, by default one that goes with this."""

    def __init__(self, programs, scene, *options, seconds=240, folder=None):
        self._folder = tempfile.TemporaryDirectory()
        self.out = pathlib.Path(folder or self._folder.name) / "out"
        command = [programs / "abut", "run", scene, "--out", self.out, *options]
        done = subprocess.run(list(map(str, command)), capture_output=True, text=True, timeout=seconds)
        self.code, self.said = done.returncode, done.stdout + done.stderr
        summary = self.out / "summary.json"
        self.summary = json.loads(summary.read_text()) if summary.exists() else None

    def require_end(self):
        require(self.code == 0 and self.summary is not None and self.summary["complete"], f"it did not end:\n{self.said}")
        return self

    def body(self, name=None):
        """That of this name, or the first one."""
        return next(body for body in self.summary["bodies"] if name in (None, body["name"]))

    def rows(self, file="energy.csv"):
        return rows_of(self.out / file)

    def balance(self):
        """Largest |H~ - H~0 + D - W| over the energy in play."""
        return open_by(self.rows()) / self.summary["energy_in_play"]

    def excess(self):
        """Largest H - H~ [J]."""
        return excess(self.rows())

    def probe(self, key):
        """[(time, value)] of a column of probes.csv."""
        return [(row["time"], row[key]) for row in self.rows("probes.csv")]

    def warns_of(self, *words):
        """Whether a warning, or the message of an error, has all of these words."""
        return all(word in self.said for word in words) and (self.code != 0 or "warning" in self.said.lower())


def scenes_that_warn():
    """Scenes of scenes/ that need not end clean, each with the reason."""
    lines = (pathlib.Path(__file__).parent.parent / "word/scenes_that_warn.txt").read_text().splitlines()
    return dict(line.split(": ", 1) for line in lines if line and not line.startswith("#"))


def rows_of(file):
    with open(file, newline="") as lines:
        return [{key.split(" [")[0]: number(value) for key, value in row.items()} for row in csv.DictReader(lines)]


def open_by(rows):
    """Largest |H~ - H~0 + D - W| of rows of energy.csv [J], with what cells took along; neutral restarts keep H~."""
    kept = [row["pseudo_energy"] + row["dissipated"] + row["eroded_kinetic"] + row["eroded_potential"] - row["work"] for row in rows]
    return max(abs(value - kept[0]) for value in kept)


def excess(rows):
    """Largest H - H~ of rows of energy.csv [J]."""
    return max(row["energy"] - row["pseudo_energy"] for row in rows)


def balance_of_moved(rows):
    """`open_by` over the energies that moved, where these are less than the energy in play."""
    names = "kinetic", "potential", "work", "dissipated"
    return open_by(rows) / sum(max(abs(row[name] - rows[0][name]) for row in rows) for name in names)


def keys(**values):
    """keys(bodies__block__velocity="[1, 0]") sets bodies.block.velocity."""
    return [word for key, value in values.items() for word in ("--set", f"{key.replace('__', '.')}={value}")]


def mean(values):
    values = list(values)
    return sum(values) / len(values)


def slope(points):
    """Of the line through [(x, y)] by least squares."""
    x, y = mean(p[0] for p in points), mean(p[1] for p in points)
    return sum((p[0] - x) * (p[1] - y) for p in points) / sum((p[0] - x)**2 for p in points)


def number(text):
    try:
        return float(text)
    except ValueError:
        return text


def require(condition, otherwise):
    if not condition:
        raise AssertionError(otherwise)


def near(value, expected, tolerance, what):
    require(abs(value - expected) <= tolerance, f"{what} is {value:.6g}, {expected:.6g} +- {tolerance:.2g} is right")


class Claims(dict):
    """Functions by name, in the order in which they are decorated with it."""

    def __call__(self, function):
        self[function.__name__] = function
        return function


def main(claims):
    """FILE.py FOLDER_OF_PROGRAMS [CLAIM ...], or --list; the exit code of the program."""
    programs = pathlib.Path(sys.argv[1])
    wanted = sys.argv[2:] or list(claims)
    if wanted == ["--list"]:
        print("\n".join(claims))
        return 0
    failed = 0
    for name in wanted:
        try:
            claims[name](programs)
            print(f"{name}: holds")
        except (AssertionError, subprocess.TimeoutExpired) as fault:
            failed += 1
            print(f"{name}: FAILS: {str(fault)[-1500:]}")
    return 1 if failed else 0
