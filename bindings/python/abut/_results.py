"""What runs give back."""
import csv
import json
import pathlib

import numpy as np

from . import _show


class Frames:
    """Fields at some times of a run, arrays whose first axis is that of the frames.

    step; time [s]; displacement and velocity (n, n_cells, dim) [m], [m/s]; stress (n, n_cells, dim, dim) [Pa]; von_mises
    (n, n_cells) [Pa]; plastic_strain (n, n_cells); contact_pressure (n, n_faces) [Pa], in the order of mesh.surface; point_displacement (n, n_points, dim) [m].
    """

    def __init__(self, fields):
        for name, values in fields.items():
            setattr(self, name, np.array(values))

    def __len__(self):
        return len(self.step)

    def __repr__(self):
        return f"<abut.Frames: {len(self)} at t = {self.time[0]:g} to {self.time[-1]:g} s>" if len(self) else "<abut.Frames: none>"


class Result(dict):
    """A run that has come to its end: each entry is an attribute as well, result["ledger"] is result.ledger.

    ledger: a structured array with the columns of energy.csv. probes: {name: structured array}, columns as in probes.csv. forces:
    a structured array with the columns of forces.csv, a row for each pair that touched. frames: see Frames; as many as the option
    frames says. mesh; displacement of the cells at the end [m]; start and end: mass [kg], velocity [m/s], rotation [rad] of each
    body; steps, dt and stable_dt [s], complete, energy_scale [J], contact (counters); verdict (a text), good (whether it is),
    warnings (texts); summary: what summary.json says, a dict; out: the folder of its files, or None; seconds.
    """

    def __init__(self, figures):
        super().__init__(figures)
        self["summary"] = json.loads(figures["summary"])
        self["frames"] = Frames(figures["frames"])
        self["probes"] = {name: _table(columns) for name, columns in figures["probes"].items()}
        self["forces"] = _table(figures["forces"])
        if figures["resumed_after"] > 0:  # what was before is in the files
            folder = pathlib.Path(figures["out"])
            if self.probes:
                self["probes"] = _probes_of_file(folder / "probes.csv", self.probes)
            if (folder / "forces.csv").exists():
                self["forces"] = _rows_of_file(folder / "forces.csv")

    def __getattr__(self, name):
        try:
            return self[name]
        except KeyError:
            raise AttributeError(f"a result has no '{name}'; it has {', '.join(self)}") from None

    def __reduce__(self):
        return _copied, (dict(self),)

    def __dir__(self):
        return [*super().__dir__(), *self]

    def show(self, field="von_mises", frame=-1):
        """Draws a field of a frame on the bodies, and the energies over time, by matplotlib; gives back the figure. field:
        "von_mises" or "speed"; None: none. frame: a number, or several for pictures with one scale of colours side by side."""
        return _show.show_result(self, field, frame)

    def show_forces(self, axes=None):
        """Draws the forces between bodies over time by matplotlib, pressing and rubbing, and gives back the axes."""
        return _show.show_forces(self, axes)

    def show_probes(self, column, axes=None):
        """Draws a column of all probes that have it over time by matplotlib, as "displacement_x", and gives back the axes."""
        return _show.show_probes(self, column, axes)

    def to_pyvista(self, frame=-1):
        """One frame as a pyvista.UnstructuredGrid, displaced, with its fields on the cells."""
        frames = self.frames
        return _show.to_pyvista(self.mesh, frames.point_displacement[frame], velocity=frames.velocity[frame], stress=frames.stress[frame],
                                von_mises=frames.von_mises[frame])

    def _repr_html_(self):
        return _show.html_of_result(self)

    def __repr__(self):
        return f"<abut.Result '{self.name}': {self.steps} steps, {self.verdict}>"


def _copied(entries):
    """A result with entries of another one: what pickle and copy call."""
    result = Result.__new__(Result)
    result.update(entries)
    return result


def _table(columns):
    """A structured array of columns by name."""
    arrays = {name: np.asarray(values) for name, values in columns.items()}
    n = len(next(iter(arrays.values())))
    table = np.empty(n, [(name, "U1" if n == 0 and name.startswith("body_") else array.dtype) for name, array in arrays.items()])
    for name, array in arrays.items():
        table[name] = array
    return table


def _rows_of_file(path):
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.reader(line for line in file if not line.startswith("#")))
    columns = {name.partition(" [")[0]: [row[i] for row in rows[1:]] for i, name in enumerate(rows[0])}  # without its unit
    return _table({name: np.array(values, object).astype(_type_of(name)) for name, values in columns.items()})


def _type_of(column):
    return {"step": "i8", "body_1": "U", "body_2": "U"}.get(column, "f8")


def _probes_of_file(path, known):
    """`known`: tables of the same probes, in the order of the file."""
    rows = _rows_of_file(path)
    names = iter(rows.dtype.names[2:])
    return {probe: _table({"step": rows["step"], "time": rows["time"], **{column: rows[next(names)] for column in table.dtype.names[2:]}})
            for probe, table in known.items()}
