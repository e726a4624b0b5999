"""What runs give back."""
import csv
import json
import pathlib

import numpy as np

from . import _show


class Frames:
    """Fields at some times of a run: arrays whose first axis is that of the n frames.

    Attributes
    ----------
    step : ndarray of int, (n,)
        Step of each frame.
    time : ndarray of float, (n,)
        Time of each frame [s].
    displacement, velocity : ndarray of float, (n, n_cells, dim)
        Of the cells [m], [m/s].
    stress : ndarray of float, (n, n_cells, dim, dim)
        Of the cells [Pa].
    von_mises, plastic_strain : ndarray of float, (n, n_cells)
        Of the cells [Pa], [-].
    contact_pressure : ndarray of float, (n, n_faces)
        Of the boundary faces [Pa], in the order of `mesh.surface`.
    point_displacement : ndarray of float, (n, n_points, dim)
        Of the points [m].
    """

    def __init__(self, fields):
        for name, values in fields.items():
            setattr(self, name, np.array(values))

    def __len__(self):
        return len(self.step)

    def __repr__(self):
        return f"<abut.Frames: {len(self)} at t = {self.time[0]:g} to {self.time[-1]:g} s>" if len(self) else "<abut.Frames: none>"


# Figures that a summary leaves out where they are 0.
_no_bonds = {"made": [], "broken_share": 0.0, "dissipated": 0.0, "beyond_fracture_energy": 0.0, "dissipated_at_splits": 0.0}


class Result(dict):
    """A run that has come to its end.

    Each entry is an attribute as well: `result["ledger"]` is `result.ledger`.

    Attributes
    ----------
    name, title, comment : str
        Of the scene.
    mesh : Mesh2D or Mesh3D
        The bodies at rest.
    ledger : structured array
        Columns of energy.csv, a row for each record.
    probes : dict of structured array
        By name, with columns as in probes.csv.
    forces : structured array
        Columns of forces.csv, a row for each pair that touched.
    frames : Frames
        As many as the option `frames` says.
    eroded : structured array
        Cells that have left (erosion), in the order in which they did: cell, counted in `mesh`, step and time [s]. In
        frames they are NaN from then on.
    bonds : dict
        At the end: `made` (list of dict, one of each bond), `broken_share` of their area [-], and energies [J]: `dissipated`,
        its part `beyond_fracture_energy`, below 0 where it is less, and `dissipated_at_splits`. `cohesive_length` [-] where a
        bond has a fracture energy.
    fragments : list of dict
        Parts of bodies whose bonds may break, at the end: body, bodies, cells, mass [kg], centre [m], velocity [m/s] and
        spin [rad/s]; empty if none may.
    displacement : ndarray of float, (n_cells, dim)
        Of the cells at the end [m]; of those that are left.
    start, end : list of dict
        mass [kg], velocity [m/s] and rotation [rad] of each body.
    steps, resumed_after : int
        Steps of the run, and the step of the checkpoint from which it went on; 0: none.
    dt, stable_dt : float
        Length of the steps, and of the longest stable one [s].
    complete : bool
        Whether the run has come to its last step.
    energy_scale : float
        Energy over which figures are quoted [J].
    contact : dict
        Counters of contact.
    verdict : str
        What the run says of itself.
    good : bool
        Whether that is good.
    warnings : list of str
        Notes and warnings.
    summary : dict
        Contents of summary.json.
    table : str
        Figures that `abut run` prints.
    out : path or None
        Folder of its files.
    seconds : float
        Time that it took [s].
    """

    def __init__(self, figures):
        super().__init__(figures)
        self["summary"] = json.loads(figures["summary"])
        self["frames"] = Frames(figures["frames"])
        self["probes"] = {name: _table(columns) for name, columns in figures["probes"].items()}
        self["forces"] = _table(figures["forces"])
        self["eroded"] = _table(figures["eroded"])
        self["bonds"] = {**_no_bonds, **self["summary"].get("bonds", {})}
        self["fragments"] = self["summary"].get("fragments", [])
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
        """Draws a field of a frame on the bodies, and the energies over time, by matplotlib.

        Parameters
        ----------
        field : {'von_mises', 'speed', None}
            Field to draw; None: none.
        frame : int or sequence of int, default -1
            Frame, or several for pictures with one scale of colours side by side.

        Returns
        -------
        matplotlib.figure.Figure
            The figure.

        Raises
        ------
        ImportError
            If matplotlib is not installed.
        ValueError
            If the result has no frames, or there is no such field.
        """
        return _show.show_result(self, field, frame)

    def show_forces(self, axes=None):
        """Draws the forces between bodies over time by matplotlib, pressing and rubbing.

        Parameters
        ----------
        axes : matplotlib.axes.Axes, optional
            Where to draw; by default in a new figure.

        Returns
        -------
        matplotlib.axes.Axes
            The axes.

        Raises
        ------
        ImportError
            If matplotlib is not installed.
        """
        return _show.show_forces(self, axes)

    def show_probes(self, column, axes=None):
        """Draws a column of all probes that have it over time by matplotlib.

        Parameters
        ----------
        column : str
            Name of the column, such as "displacement_x".
        axes : matplotlib.axes.Axes, optional
            Where to draw; by default in a new figure.

        Returns
        -------
        matplotlib.axes.Axes
            The axes.

        Raises
        ------
        ImportError
            If matplotlib is not installed.
        ValueError
            If no probe has this column.
        """
        return _show.show_probes(self, column, axes)

    def to_pyvista(self, frame=-1):
        """Makes a grid of pyvista of one frame, displaced, with its fields on the cells.

        Parameters
        ----------
        frame : int, default -1
            Number of the frame.

        Returns
        -------
        pyvista.UnstructuredGrid
            With velocity [m/s], stress and von_mises [Pa].

        Raises
        ------
        ImportError
            If pyvista is not installed.
        """
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
