"""Detection between surfaces in space: what is near, where, and how much area is shared.

Meshes are paths of files (read by meshio), anything with `vertices` and `faces` (trimesh has), meshes of meshio (of cells with a
volume the boundary is taken), or a tuple (vertices, faces). Lengths are in metres, areas in square metres. A transform is a matrix (4, 4), as trimesh's: points go
to `T[:3, :3] @ x + T[:3, 3]`; None leaves them where they are.

>>> import numpy, abut
>>> square = numpy.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], dtype=float)
>>> lower, upper = (square, [[0, 1, 2, 3]]), (square, [[3, 2, 1, 0]])
>>> up = numpy.eye(4)
>>> up[:3, 3] = 0.25, 0.0, 0.05
>>> found = abut.detect(lower, upper, transforms=[None, up], distance=0.1)
>>> round(found.contacts[0].area, 12), round(found.contacts[0].gap, 12)
(0.75, 0.05)

Meshes in motion are objects of a manager, as in trimesh:

>>> manager = abut.CollisionManager()
>>> manager.add_object("lower", lower)
>>> manager.add_object("upper", upper)
>>> for z in (0.2, 0.1, 0.0):
...     up[2, 3] = z
...     manager.set_transform("upper", up)
...     print(round(manager.min_distance_internal(), 12), manager.in_collision_internal())
0.2 False
0.1 False
0.0 True
"""
import collections
import html
import itertools
import os
import pathlib

import numpy

from ._contact import find_overlaps
from ._nearest import is_inside as _is_inside, nearest as _nearest, penetration_depth as _penetration_depth

__all__ = ["CollisionManager", "Contact", "Detected", "Nearest", "detect"]

Nearest = collections.namedtuple("Nearest", "distance names faces points inside depth", defaults=[None, None])
Nearest.__doc__ = """Where two meshes are nearest.

Attributes
----------
distance : float
    Distance of their surfaces [m]; 0: they touch.
names : tuple of str
    Names of both.
faces : tuple of int
    A face of each.
points : tuple of array of float, (3,)
    A point of each [m].
inside : str or None
    Name of the mesh that is wholly inside of the other one, whose surface is closed with normals outwards; None:
    neither is.
depth : float
    How deep they lie in each other [m], a lower bound from corners, middles of faces and edges; 0: they touch; below 0: they
    are apart by so much.
"""
Contact = collections.namedtuple("Contact", "names area gap overlaps")
Contact.__doc__ = """Two meshes that look at each other within a distance.

Attributes
----------
names : tuple of str
    Names of both.
area : float
    Area of all pairs of faces [m^2].
gap : float
    Least gap of them [m].
overlaps : structured array
    The pairs: face_1 and face_2 (of the meshes), area, normal (from the first into the second), gap, and distance in
    space. A face with four corners appears by halves.
"""


class Detected(collections.namedtuple("Detected", "distance nearest contacts surfaces")):
    """Result of `detect`. Its text is the answer in a line, notebooks show it as a table.

    Attributes
    ----------
    distance : float
        Distance within which contacts are [m].
    nearest : Nearest or None
        The two meshes that are nearest; None with fewer than two.
    contacts : list of Contact
        Meshes that look at each other within the distance.
    surfaces : dict of tuple
        By name (vertices, faces) of each mesh, where it is [m].
    """

    def __repr__(self):
        lines = [_answer(self.nearest)] if self.nearest else []
        lines += [f"'{one.names[0]}' and '{one.names[1]}': {one.area:.4g} m^2 lie opposite each other within {self.distance:.4g} m"
                  for one in self.contacts]
        return "\n".join(lines) or "fewer than two meshes"

    def _repr_html_(self):
        rows = [(one.names[0], one.names[1], f"{one.area:.4g}", f"{one.gap:.4g}", str(len(one.overlaps))) for one in self.contacts]
        head = ("mesh", "mesh", "area [m^2]", "least gap [m]", "pairs of faces")
        lines = ["<tr>" + "".join(f"<th>{text}</th>" for text in head) + "</tr>"]
        lines += ["<tr>" + "".join(f"<td>{html.escape(text)}</td>" for text in row) + "</tr>" for row in rows]
        answer = html.escape(_answer(self.nearest)) if self.nearest else ""
        return f"<p>{answer}</p><table>{''.join(lines)}</table>"

    def to_meshio(self):
        """Makes a mesh of meshio of all faces, with what touches them.

        Returns
        -------
        meshio.Mesh
            Cell arrays: "mesh" (its number), "face" (its number in the mesh), "area [m^2]" that it shares, and "gap [m]", the
            least one (not a number without).

        Raises
        ------
        ImportError
            If meshio is not installed.
        """
        meshio = _import_meshio()
        points, blocks, values = [], [], []
        first = 0
        for number, (name, (vertices, faces)) in enumerate(self.surfaces.items()):
            area, gap = self._of_faces(name, len(faces))
            for face, corners in enumerate(faces):
                kind = {3: "triangle", 4: "quad"}.get(len(corners), "polygon")
                if not blocks or blocks[-1][0] != kind or len(blocks[-1][1][-1]) != len(corners):
                    blocks.append((kind, []))
                    values.append([])
                blocks[-1][1].append([first + corner for corner in corners])
                values[-1].append((number, face, area[face], gap[face]))
            points.append(vertices)
            first += len(vertices)
        tables = [numpy.array(block, dtype=float).T for block in values]
        data = {name: [table[i] for table in tables] for i, name in enumerate(("mesh", "face", "area [m^2]", "gap [m]"))}
        return meshio.Mesh(numpy.concatenate(points), [(kind, numpy.array(rows)) for kind, rows in blocks], cell_data=data)

    def to_pyvista(self):
        """Makes a mesh of pyvista of all faces, with the arrays of `to_meshio`.

        Returns
        -------
        pyvista.UnstructuredGrid

        Raises
        ------
        ImportError
            If meshio or pyvista is not installed.
        """
        try:
            import pyvista
        except ImportError:
            raise ImportError("pyvista is not installed; install it (pip install pyvista), or take to_meshio()") from None
        return pyvista.from_meshio(self.to_meshio())

    def _of_faces(self, name, n_faces):
        """Area in contact and least gap of each face of a mesh."""
        area, gap = numpy.zeros(n_faces), numpy.full(n_faces, numpy.nan)
        for contact in self.contacts:
            for side, mesh in enumerate(contact.names, 1):
                if mesh == name:
                    faces = contact.overlaps[f"face_{side}"]
                    numpy.add.at(area, faces, contact.overlaps["area"])
                    numpy.fmin.at(gap, faces, contact.overlaps["gap"])
        return area, gap


def _answer(nearest):
    """In the words of `abut detect`."""
    one, two = nearest.names
    if nearest.inside is not None:
        return f"'{nearest.inside}' is wholly inside of '{two if nearest.inside == one else one}', {nearest.distance:.4g} m from its surface"
    how = (f"are {nearest.distance:.4g} m apart" if nearest.distance > 0.0 else
           f"cross each other, {nearest.depth:.4g} m deep," if nearest.depth > 0.0 else "touch each other")
    return f"'{one}' and '{two}' {how} at ({', '.join(f'{x:.4g}' for x in nearest.points[0])})"


def _import_meshio():
    try:
        import meshio
    except ImportError:
        raise ImportError("meshio is not installed; install it (apt install python3-meshio, or pip install meshio)") from None
    return meshio


# The faces of cells with a volume, in the order of meshio, which is VTK's.
_FACES_OF_CELLS = {
    "tetra": [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]],
    "hexahedron": [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]],
    "wedge": [[0, 1, 2], [3, 5, 4], [0, 3, 4, 1], [1, 4, 5, 2], [2, 5, 3, 0]],
    "pyramid": [[0, 3, 2, 1], [0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]],
}


def _boundary(points, blocks):
    """The faces of cells with a volume that belong to one of them alone, counter-clockwise seen from outside."""
    seen = {}
    for kind, cells in blocks:
        cells = numpy.asarray(cells)
        middle = points[cells].mean(axis=1)
        for corners in _FACES_OF_CELLS[kind]:
            faces = cells[:, corners]
            x = points[faces]
            outward = numpy.einsum("ij,ij->i", numpy.cross(x[:, 1] - x[:, 0], x[:, 2] - x[:, 0]), x.mean(axis=1) - middle)
            faces[outward < 0.0] = faces[outward < 0.0][:, ::-1]
            for face in faces.tolist():
                key = tuple(sorted(face))
                seen[key] = None if key in seen else face
    return [face for face in seen.values() if face is not None]


def _read(path):
    """The mesh of a file, by meshio, which names no file in some of its errors."""
    if not os.path.exists(path):
        raise FileNotFoundError(f"{os.fspath(path)}: there is no such file. Check the path.")
    meshio = _import_meshio()
    try:
        return meshio.read(path)
    except (meshio.ReadError, ValueError, IndexError, SystemExit) as error:
        raise ValueError(f"{os.fspath(path)}: meshio cannot read it ({error}). abut info tells what is wrong with it.") from None


def _named(meshes):
    """Meshes by their names, those of files without folder and ending; a number tells equal ones apart."""
    if len(meshes) == 1 and isinstance(meshes[0], dict):
        return dict(meshes[0])
    if len(meshes) == 1 and isinstance(meshes[0], (list, tuple)):
        meshes = meshes[0]
    named = {}
    for i, mesh in enumerate(meshes):
        stem = pathlib.Path(mesh).stem if isinstance(mesh, (str, os.PathLike)) else f"mesh_{i}"
        name = next(name for name in itertools.chain([stem], (f"{stem}_{k}" for k in itertools.count(2))) if name not in named)
        named[name] = mesh
    return named


class _Surface:
    """Vertices (n, 3), and faces by offsets and corners."""

    def __init__(self, mesh):
        if isinstance(mesh, (str, os.PathLike)):
            mesh = _read(mesh)
        if isinstance(mesh, tuple):
            vertices, faces = mesh
        elif hasattr(mesh, "points") and hasattr(mesh, "cells"):
            vertices, faces = mesh.points, self.faces_of_meshio(mesh)
        elif hasattr(mesh, "vertices") and hasattr(mesh, "faces"):
            vertices, faces = mesh.vertices, mesh.faces
        else:
            raise TypeError(f"a mesh must be a path, have vertices and faces, or points and cells (meshio), or be a tuple "
                            f"(vertices, faces); this is a {type(mesh).__name__}")
        self.vertices = numpy.array(vertices, dtype=float)
        if self.vertices.ndim != 2 or self.vertices.shape[1] not in (2, 3):
            raise ValueError(f"vertices must have the shape (n, 3); this is {self.vertices.shape}")
        unknown = numpy.flatnonzero(~numpy.isfinite(self.vertices).all(axis=1))
        if unknown.size > 0:
            raise ValueError(f"vertex {unknown[0]} is not finite: {self.vertices[unknown[0]]}")
        if self.vertices.shape[1] == 2:
            self.vertices = numpy.hstack([self.vertices, numpy.zeros((len(self.vertices), 1))])
        sizes = [len(face) for face in faces]
        if not sizes:
            raise ValueError("the mesh has no faces")
        self.offsets = numpy.concatenate([[0], numpy.cumsum(sizes)]).astype(numpy.int32)
        self.corners = numpy.fromiter(itertools.chain.from_iterable(faces), numpy.int32, self.offsets[-1])
        outside = (self.corners < 0) | (self.corners >= len(self.vertices))
        if outside.any():
            raise ValueError(f"a face names vertex {self.corners[outside][0]}, but there are {len(self.vertices)}")

    @staticmethod
    def faces_of_meshio(mesh):
        volume = [(block.type, block.data) for block in mesh.cells if block.type in _FACES_OF_CELLS]
        if volume:
            return _boundary(numpy.asarray(mesh.points, dtype=float), volume)
        return [face for block in mesh.cells if block.type in ("triangle", "quad", "polygon") for face in block.data.tolist()]

    def mean_face_size(self):
        x = self.vertices[self.corners]
        sizes = []
        for begin, end in zip(self.offsets[:-1], self.offsets[1:]):
            corners = x[begin:end]
            normal = 0.5 * numpy.cross(corners[1:-1] - corners[0], corners[2:] - corners[0]).sum(axis=0)
            sizes.append(numpy.sqrt(numpy.linalg.norm(normal)))
        return sum(sizes) / len(sizes)

    def first_of_parts(self):
        """The lowest vertex of each part of the surface whose faces hang together by vertices."""
        first, sizes = numpy.arange(len(self.vertices)), numpy.diff(self.offsets)
        while True:
            before = first.copy()
            lowest = numpy.minimum.reduceat(first[self.corners], self.offsets[:-1])
            numpy.minimum.at(first, self.corners, numpy.repeat(lowest, sizes))
            first = first[first]
            if (first == before).all():
                return numpy.unique(first[self.corners])


class CollisionManager:
    """Named meshes with transforms, as trimesh.collision.CollisionManager.

    Distances are exact up to rounding, and contacts say which faces share how much area at what gap.
    """

    def __init__(self):
        self._surfaces, self._placed = {}, {}

    def add_object(self, name, mesh, transform=None):
        """Adds a mesh, or replaces the one of that name.

        Parameters
        ----------
        name : str
            Name of the mesh.
        mesh : mesh with vertices and faces, meshio.Mesh, or tuple (vertices, faces)
            Surface; of cells with a volume the boundary is taken.
        transform : array of float, (4, 4), optional
            Where it is; None: where its vertices are.

        Returns
        -------
        None

        Raises
        ------
        TypeError
            If this is no mesh.
        ValueError
            If an array has another shape, or the transform turns the mesh inside out.
        """
        try:
            surface = _Surface(mesh)
        except ValueError as error:
            raise ValueError(f"'{name}': {error}") from None
        self._surfaces[name] = surface
        self.set_transform(name, transform)

    def remove_object(self, name):
        """Removes a mesh.

        Parameters
        ----------
        name : str
            Name of the mesh.

        Returns
        -------
        None

        Raises
        ------
        KeyError
            If there is no mesh of that name.
        """
        self._require(name)
        del self._surfaces[name], self._placed[name]

    def set_transform(self, name, transform):
        """Sets where a mesh is from now on.

        Parameters
        ----------
        name : str
            Name of the mesh.
        transform : array of float, (4, 4), or None
            Points go to `transform[:3, :3] @ x + transform[:3, 3]`; None: to where its vertices are.

        Returns
        -------
        None

        Raises
        ------
        KeyError
            If there is no mesh of that name.
        ValueError
            If the transform has another shape, or turns the mesh inside out.
        """
        self._require(name)
        rest = self._surfaces[name].vertices
        if transform is None:
            self._placed[name] = rest
            return
        matrix = numpy.asarray(transform, dtype=float)
        if matrix.shape != (4, 4) or not (matrix[3] == [0, 0, 0, 1]).all():
            raise ValueError(f"the transform of '{name}' must be a matrix (4, 4) whose last row is 0 0 0 1")
        if numpy.linalg.det(matrix[:3, :3]) <= 0.0:
            raise ValueError(f"the transform of '{name}' turns the mesh inside out: its determinant must be above 0")
        self._placed[name] = rest @ matrix[:3, :3].T + matrix[:3, 3]

    def set_vertices(self, name, vertices):
        """Sets where the vertices of a mesh that deforms are from now on.

        Parameters
        ----------
        name : str
            Name of the mesh.
        vertices : array of float, (n, 3)
            Positions [m].

        Returns
        -------
        None

        Raises
        ------
        KeyError
            If there is no mesh of that name.
        ValueError
            If the array has another shape.
        """
        self._require(name)
        vertices = numpy.array(vertices, dtype=float)
        if vertices.shape != self._surfaces[name].vertices.shape:
            raise ValueError(f"'{name}' has vertices of the shape {self._surfaces[name].vertices.shape}, not {vertices.shape}")
        self._placed[name] = vertices

    @property
    def names(self):
        """Names of the meshes, in the order in which they came."""
        return list(self._surfaces)

    def surfaces(self):
        """Makes arrays of all meshes where they are.

        Returns
        -------
        dict of tuple
            By name vertices (n, 3) [m], and faces, a list of their corners.
        """
        return {name: (self._placed[name], [face.tolist() for face in numpy.split(one.corners, one.offsets[1:-1])])
                for name, one in self._surfaces.items()}

    def nearest(self):
        """Finds the two meshes that are nearest to each other.

        Returns
        -------
        Nearest or None
            None with fewer than two meshes.
        """
        best = None
        for bound, pair in self._pairs():
            if best is not None and bound >= best.distance:
                break
            found = self._nearest_of(pair)
            if best is None or found.distance < best.distance:
                best = found
        return best

    def all_nearest(self):
        """Finds where each pair of meshes is nearest.

        Returns
        -------
        list of Nearest
            For every pair, sorted by distance.
        """
        return sorted((self._nearest_of(pair) for _, pair in self._pairs()), key=lambda one: one.distance)

    def min_distance_internal(self, return_names=False, return_data=False):
        """Finds the least distance of two meshes, as trimesh does.

        A mesh inside of another one is as far away as the surface around it; `Nearest.inside` tells it.

        Parameters
        ----------
        return_names : bool, default False
            Whether names are returned, too.
        return_data : bool, default False
            Whether details are returned, too.

        Returns
        -------
        float or tuple
            The distance [m]; where asked for, a tuple of their names and the `Nearest` behind it.

        Raises
        ------
        ValueError
            If there are fewer than two meshes.
        """
        best = self.nearest()
        if best is None:
            raise ValueError("a distance needs two objects; add_object adds them")
        extra = ([best.names] if return_names else []) + ([best] if return_data else [])
        return (best.distance, *extra) if extra else best.distance

    def in_collision_internal(self, return_names=False, return_data=False):
        """Tells whether two meshes touch, cross, or one is wholly inside of another one.

        The surface of that other one is closed with normals outwards.

        Parameters
        ----------
        return_names : bool, default False
            Whether names are returned, too.
        return_data : bool, default False
            Whether details are returned, too.

        Returns
        -------
        bool or tuple
            Whether they do; where asked for, the set of pairs of names and a list of `Nearest` behind it.
        """
        touching = [found for found in (self._nearest_of(pair) for bound, pair in self._pairs() if bound == 0.0)
                    if found.distance == 0.0 or found.inside is not None]
        extra = ([{found.names for found in touching}] if return_names else []) + ([touching] if return_data else [])
        return (bool(touching), *extra) if extra else bool(touching)

    def contacts(self, distance=None):
        """Finds every two meshes with faces that look at each other and share an area.

        Parameters
        ----------
        distance : float, optional
            Largest gap [m], apart or pressed in; by default half the mean size of a face, sqrt(area).

        Returns
        -------
        list of Contact
            One for each two meshes.
        """
        names = self.names
        if not names:
            return []
        if distance is None:
            distance = self._default_distance()
        if not distance >= 0.0:
            raise ValueError(f"distance is {distance}; 0 m or more is needed")
        surfaces = [self._surfaces[name] for name in names]
        first_face = numpy.concatenate([[0], numpy.cumsum([len(one.offsets) - 1 for one in surfaces])])
        first_node = numpy.concatenate([[0], numpy.cumsum([len(one.vertices) for one in surfaces])])
        first_corner = numpy.concatenate([[0], numpy.cumsum([len(one.corners) for one in surfaces])])
        corners = numpy.concatenate([one.corners + first for one, first in zip(surfaces, first_node)])
        offsets = numpy.concatenate([one.offsets[:-1] + first for one, first in zip(surfaces, first_corner)] + [first_corner[-1:]])
        body = numpy.repeat(numpy.arange(len(names)), numpy.diff(first_face))
        overlaps = find_overlaps(numpy.concatenate([self._placed[name] for name in names]), corners, body, distance, offsets=offsets)
        bodies = numpy.stack([body[overlaps["face_1"]], body[overlaps["face_2"]]], axis=1)
        contacts = []
        for i, k in numpy.unique(numpy.sort(bodies, axis=1), axis=0):
            ours = overlaps[(bodies == (i, k)).all(axis=1) | (bodies == (k, i)).all(axis=1)]
            turned = body[ours["face_1"]] != i  # the first face is that of the first mesh
            ours["face_1"][turned], ours["face_2"][turned] = ours["face_2"][turned], ours["face_1"][turned]
            ours["normal"][turned] *= -1.0
            ours["face_1"] -= first_face[i]
            ours["face_2"] -= first_face[k]
            contacts.append(Contact((names[i], names[k]), float(ours["area"].sum()), float(ours["gap"].min()), ours))
        return contacts

    def _default_distance(self):
        return 0.5 * sum(one.mean_face_size() for one in self._surfaces.values()) / len(self._surfaces)

    def _require(self, name):
        if name not in self._surfaces:
            raise KeyError(f"there is no object '{name}'; there are {', '.join(map(repr, self._surfaces)) or 'none'}")

    def _pairs(self):
        """Distances of the boxes of all pairs, and their names, the least first."""
        boxes = {name: (x.min(axis=0), x.max(axis=0)) for name, x in self._placed.items()}
        pairs = []
        for one, two in itertools.combinations(boxes, 2):
            apart = numpy.maximum(boxes[one][0] - boxes[two][1], boxes[two][0] - boxes[one][1])
            pairs.append((float(numpy.linalg.norm(numpy.maximum(apart, 0.0))), (one, two)))
        return sorted(pairs, key=lambda pair: pair[0])

    def _nearest_of(self, pair):
        one, two = (self._surfaces[name] for name in pair)
        distance, face_1, face_2, point_1, point_2 = _nearest(self._placed[pair[0]], one.offsets, one.corners,
                                                              self._placed[pair[1]], two.offsets, two.corners)
        inside = self._inside(pair) if distance > 0.0 else None
        depth = -distance if distance > 0.0 and inside is None else _penetration_depth(
            self._placed[pair[0]], one.offsets, one.corners, self._placed[pair[1]], two.offsets, two.corners)
        return Nearest(distance, pair, (face_1, face_2), (point_1, point_2), inside, depth)

    def _inside(self, pair):
        """The name of the one of two meshes, whose surfaces are apart, that is wholly inside of the other one; None: neither is. One
        vertex of each connected part tells of all of it; of more than 64 parts, as of faces without common vertices, every so many do."""
        for inner, outer in (pair, pair[::-1]):
            one, around, placed = self._surfaces[inner], self._surfaces[outer], self._placed[outer]
            corners = self._placed[inner][one.corners]
            hull = placed[around.corners]
            if (corners.min(axis=0) < hull.min(axis=0)).any() or (corners.max(axis=0) > hull.max(axis=0)).any():
                continue
            firsts = one.first_of_parts()
            if all(_is_inside(placed, around.offsets, around.corners, self._placed[inner][first])
                   for first in firsts[::1 + len(firsts) // 64]):
                return inner
        return None


def detect(*meshes, transforms=None, distance=None):
    """Finds what is near between meshes.

    Parameters
    ----------
    *meshes : meshes, or one list or dict of them
        Each is a body; a dict has their names. A path is a file that meshio reads, in metres.
    transforms : list or dict of array of float, (4, 4), optional
        One for each; None: where it is.
    distance : float, optional
        Gaps up to here are contacts [m]; by default half the mean size of a face.

    Returns
    -------
    Detected
        The nearest two, and contacts.

    Raises
    ------
    KeyError
        If a transform is of no mesh.
    TypeError
        If something is no mesh.
    FileNotFoundError, ImportError
        If a path names no file, or meshio is not installed.
    ValueError
        If an array has another shape, a file cannot be read, or the number of transforms is not that of the meshes.

    Examples
    --------
    >>> import numpy, abut
    >>> square = numpy.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], dtype=float)
    >>> found = abut.detect({"lower": (square, [[0, 1, 2, 3]]), "upper": (square + [0.0, 0.0, 0.2], [[3, 2, 1, 0]])})
    >>> round(found.nearest.distance, 12)
    0.2
    """
    named = _named(meshes)
    if transforms is None:
        transforms = {}
    elif not isinstance(transforms, dict):
        if len(transforms) != len(named):
            raise ValueError(f"{len(transforms)} transforms for {len(named)} meshes: give one each, None where there is none")
        transforms = dict(zip(named, transforms))
    manager = CollisionManager()
    for name, mesh in named.items():
        manager.add_object(name, mesh, transforms.get(name))
    for name in transforms:
        manager._require(name)
    if distance is None:
        distance = manager._default_distance()
    return Detected(distance, manager.nearest(), manager.contacts(distance), manager.surfaces())
