"""Meshes, solids of linear elasticity in contact, and their runs. docs/languages.md walks through it."""
import re

import numpy as np

from . import _scenes, _show

_solid = _scenes.built_solid()  # says what is missing where this is contact alone
from ._solid import (Material, Memm2D, Memm3D, Mesh2D, Mesh3D, State2D, State3D, box, combine, cylinder, disc, known_materials, memm,
                     read_mesh, sphere, structured_box)

__all__ = ["Material", "Memm2D", "Memm3D", "Mesh2D", "Mesh3D", "State2D", "State3D", "box", "combine", "cylinder", "disc",
           "known_materials", "memm", "mesh", "read_mesh", "simulate", "sphere", "structured_box"]


def mesh(points, cells=None, body=None, body_names=(), groups=None, **options):
    """Makes a mesh of arrays, or of a meshio.Mesh.

    A meshio.Mesh alone brings all of it along, so that .inp, .bdf, .med, Exodus, .vtk and other files come in: sets of cells are
    bodies, of sets within others the smaller ones, of equal ones the first, and what is in no set is a body for each part that hangs
    together; sets of boundary cells are groups, and so are sets of points, with the boundary faces that lie between them. Where the
    file has numbers in place of sets, a set is called as the file calls it, or set_7. Points of no cell are left out.

    Parameters
    ----------
    points : array of float, (n_points, dim), or meshio.Mesh
        Positions [m].
    cells : dict of array of int, (n, corners)
        By type, {"triangle": (n, 3), ...}, or pairs, or blocks with type and data: triangle, quad; tetra, hexahedron,
        wedge, pyramid.
    body : array of int, (n_cells,), optional
        Body of each cell. Bodies that share points are one piece of several materials where a scene has them.
    body_names : sequence of str
        Names of the bodies; by default body0, body1, ...
    groups : dict of array of int, (n, corners), optional
        Points of each face of a group, or a list of such arrays.
    **options
        name: what messages call the mesh. non_planar: "fail" or "split", for faces with a corner farther off their
        plane than planarity_tolerance times their size.

    Returns
    -------
    Mesh2D or Mesh3D
        The bodies.

    Raises
    ------
    BadInput
        If cells or groups are none of a mesh.
    TypeError
        If cells are missing, and points are no meshio.Mesh.
    ValueError
        If an array has another shape.

    Examples
    --------
    >>> from abut import solid
    >>> square = solid.mesh([[0, 0], [2, 0], [2, 1], [0, 1]], {"quad": [[0, 1, 2, 3]]}, groups={"foot": [[0, 1]]})
    >>> square.measures.tolist(), square.groups["foot"].tolist()
    ([2.0], [0])
    """
    given = dict(cells=cells, body=body, body_names=list(body_names), groups=groups or {})
    if cells is None:
        if not hasattr(points, "cells"):
            raise TypeError("mesh needs cells beside points, or a meshio.Mesh alone")
        from ._meshio import arguments
        of_meshio = arguments(points)
        points = of_meshio.pop("points")
        given = {**of_meshio, **{name: value for name, value in given.items() if value is not None and len(value)}}
    return _solid.mesh(points, **given, **options)


def simulate(mesh, materials, velocity=None, *, acceleration=None, held={}, rollers=(), traction={}, temperature_rise={}, displacement=None,
             added_velocity=None, contact=True, energy_scale=None, look=None, **kwargs):
    n_bodies, dim = len(mesh.body_names), mesh.points.shape[1]
    if isinstance(materials, Material):
        materials = [materials] * n_bodies
    if velocity is None:
        velocity = np.zeros((n_bodies, dim))
    return _solid.simulate(mesh, list(materials), velocity, acceleration=acceleration, held=held, rollers=list(rollers), traction=traction,
                           temperature_rise=temperature_rise, displacement=displacement, added_velocity=added_velocity, contact=contact,
                           energy_scale=energy_scale, look=look, **kwargs)


# Without the signatures that stand in front of it: of both dimensions there is one text.
simulate.__doc__ = re.split(r"^\d+\. simulate\(.*$", _solid.simulate.__doc__, flags=re.M)[1].strip() + "\n"


def _reduced(mesh):
    """What pickle and copy make a mesh of again: its arrays."""
    faces, offsets = mesh.surface["faces"], mesh.surface["offsets"]
    groups = {name: [faces[offsets[i]:offsets[i + 1]] for i in rows] for name, rows in mesh.groups.items()}
    return _copied, (mesh.points, mesh.cells, mesh.body, list(mesh.body_names), groups, mesh.name, mesh.label)


def _copied(points, cells, body, body_names, groups, name, label):
    made = _solid.mesh(points, cells, body=body, body_names=body_names, groups=groups, name=name)
    if not all(np.array_equal(new, old) for (_, new), (_, old) in zip(made.cells, cells)):
        raise ValueError(f"{name}: the cells of a copy would have other numbers; make the mesh anew in its place")
    made._set_label(label)
    return made


for _name in __all__:
    if isinstance(globals()[_name], type):
        globals()[_name].__module__ = __name__
for _class in (Mesh2D, Mesh3D):
    _class.__reduce__ = _reduced
    _class.show, _class.to_pyvista, _class._repr_html_ = _show.show_mesh, _show.to_pyvista, _show.html_of_mesh
