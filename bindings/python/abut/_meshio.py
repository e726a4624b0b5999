"""Meshes of meshio in the words of abut.solid.mesh."""
import re
import warnings

import numpy as np

from ._contact import surface_of

CORNERS = {"vertex": 1, "line": 2, "triangle": 3, "quad": 4, "tetra": 4, "hexahedron": 8, "wedge": 6, "pyramid": 5}
DIMENSIONS = {"vertex": 0, "line": 1, "triangle": 2, "quad": 2, "tetra": 3, "hexahedron": 3, "wedge": 3, "pyramid": 3}
TAGS = ("gmsh:physical", "cell_tags", "medit:ref", "nastran:ref", "avsucd:material", "su2:tag", "CellEntityIds")  # by format: numbers of sets


def arguments(given):
    """points, cells, body, body_names and groups of a meshio.Mesh."""
    types = [_base(block.type) for block in given.cells]
    dim = max((DIMENSIONS[type] for type in types), default=0)
    if dim < 2:
        raise ValueError(f"the mesh has no cells that fill a body; it has {', '.join(sorted(set(types))) or 'none'}")
    for k, block in enumerate(given.cells):
        _check_numbers(np.asarray(block.data), len(given.points), f"block {k} of cells ('{block.type}')", "point")
    tables = [np.asarray(block.data)[:, :CORNERS[type]] for block, type in zip(given.cells, types)]
    if any(block.data.shape[1] > CORNERS[type] for block, type in zip(given.cells, types) if DIMENSIONS[type] == dim):
        warnings.warn("abut: cells with nodes between their corners become cells with straight sides", RuntimeWarning, stacklevel=3)
    inside = [i for i, type in enumerate(types) if DIMENSIONS[type] == dim]
    used = np.unique(np.concatenate([tables[i].ravel() for i in inside]))
    number = np.full(len(given.points), -1)
    number[used] = np.arange(len(used))
    points = _points(given.points, dim)[used]
    cells = [(types[i], number[tables[i]]) for i in inside]
    sets = _sets(given)
    body, names = _bodies({name: _rows(chosen, inside, tables) for name, chosen in sets.items()}, cells, len(points))
    groups = {}
    for name, chosen in sets.items():
        faces = [number[tables[i][chosen[i]]] for i, type in enumerate(types) if DIMENSIONS[type] == dim - 1 and len(chosen[i])]
        if faces:
            groups[name] = faces
    surface = surface_of(points, cells, body) if given.point_sets else None
    for name, nodes in given.point_sets.items():
        _check_numbers(np.asarray(nodes), len(given.points), f"the set of points '{name}'", "point")
        is_in = np.zeros(len(given.points), bool)
        is_in[np.asarray(nodes, int)] = True
        faces = _faces_between(surface, is_in[used])
        if faces and name not in groups:
            groups[name] = faces
    return dict(points=points, cells=cells, body=body, body_names=names, groups=groups)


def _check_numbers(numbers, n, where, what):
    """Of points or cells: numpy counts negative ones from the end."""
    wrong = numbers[(numbers < 0) | (numbers >= n)]
    if wrong.size:
        raise ValueError(f"{where} names the {what} {wrong.ravel()[0]}, there are 0 to {n - 1}. Correct the numbers.")


def _base(type):
    """Of "tetra10" tetra."""
    match = re.fullmatch(r"(vertex|line|triangle|quad|tetra|hexahedron|wedge|pyramid)\d*", type)
    if not match:
        raise ValueError(f"there are no cells '{type}' here; there are {', '.join(CORNERS)}, also with nodes between their corners")
    return match[1]


def _points(points, dim):
    points = np.asarray(points, float)
    if dim == 3 or points.shape[1] == 2:
        return points
    size = np.ptp(points[:, :2], axis=0).max()
    if np.ptp(points[:, 2]) > 1e-9 * size:
        raise ValueError(f"the mesh has faces alone, and is not in a plane: z goes from {points[:, 2].min():g} to "
                         f"{points[:, 2].max():g} m. Give the cells inside of it.")
    return points[:, :2]


def _sets(given):
    """{name: [rows of each block]}"""
    sets = {name: [_whole_numbers(rows) for rows in chosen] for name, chosen in given.cell_sets.items()
            if not name.startswith("gmsh:")}
    for name, rows in sets.items():
        _check_set(name, rows, given.cells)
    sets.update(_sets_of_abut(given))
    if sets:
        return sets
    for key in TAGS:
        if key in given.cell_data:
            return _sets_of_numbers(given, key)
    return {}


def _whole_numbers(rows):
    """As an array; lists of different lengths within each other as they are, which _check_set refuses."""
    try:
        return np.asarray([] if rows is None else rows, int)
    except ValueError:
        return np.zeros((len(rows), 0), int)


def _check_set(name, rows, blocks):
    """Rows of each block. Of a set that an .inp file makes of other sets, meshio has a list by those sets instead."""
    remedy = "If the file makes that set of other sets, write its elements instead."
    if len(rows) != len(blocks):
        raise ValueError(f"the set of cells '{name}' has {len(rows)} lists of cells, the mesh has {len(blocks)} blocks of cells, and "
                         f"each needs one. {remedy}")
    for k, (chosen, block) in enumerate(zip(rows, blocks)):
        if chosen.ndim != 1:
            raise ValueError(f"the set of cells '{name}' has a list of lists for block {k}, a list of cells is needed. {remedy}")
        _check_numbers(chosen, len(block.data), f"the set of cells '{name}' of block {k} ('{block.type}')", "cell")


def _sets_of_abut(given):
    """As _sets, of the arrays that VTU files of Abut have: bodies by their numbers, groups by flags."""
    dimension = [DIMENSIONS[_base(block.type)] for block in given.cells]
    sets = {key[len("group: "):]: [np.flatnonzero(np.asarray(flags) != 0) for flags in arrays]
            for key, arrays in given.cell_data.items() if key.startswith("group: ")}
    for key, value in given.field_data.items():
        if key.startswith("body: ") and "body" in given.cell_data:
            sets[key[len("body: "):]] = [np.flatnonzero(np.asarray(body) == np.ravel(value)[0]) if d == max(dimension)
                                         else np.array([], int) for d, body in zip(dimension, given.cell_data["body"])]
    return sets


def _sets_of_numbers(given, key):
    """As _sets. Numbers are those of one dimension; 0 is no set."""
    dimension = [DIMENSIONS[_base(block.type)] for block in given.cells]
    found = sorted({(dim, tag) for dim, tags in zip(dimension, given.cell_data[key]) for tag in np.unique(tags).tolist() if tag != 0})
    of_gmsh = {(int(dim), int(tag)): [name] for name, (tag, dim) in given.field_data.items()} if key == "gmsh:physical" else {}
    of_med = getattr(given, "cell_tags", {}) if key == "cell_tags" else {}  # a number may stand for several sets
    sets = {}
    for dim, tag in found:
        rows = [np.flatnonzero(np.asarray(tags) == tag) if d == dim else np.array([], int)
                for d, tags in zip(dimension, given.cell_data[key])]
        for name in of_med.get(tag) or of_gmsh.get((dim, tag)) or [f"set_{tag}"]:
            sets[name] = rows if name not in sets else [np.union1d(a, b).astype(int) for a, b in zip(sets[name], rows)]
    return sets


def _rows(chosen, inside, tables):
    """Of all cells, those of `inside` one behind the other."""
    first = np.cumsum([0] + [len(tables[i]) for i in inside])
    return np.concatenate([first[k] + chosen[i] for k, i in enumerate(inside)]).astype(int)


def _bodies(sets, cells, n_points):
    """Numbers of bodies and their names: of sets within others the smaller one counts, of equal ones the first, and parts in no set
    are bodies each."""
    owner = np.full(sum(len(data) for _, data in cells), -1)
    names = list(sets)
    for k in sorted(range(len(names)), key=lambda k: -len(sets[names[k]])):
        before = np.unique(owner[sets[names[k]]])
        if len(before) == 1 and before[0] >= 0 and len(sets[names[before[0]]]) == len(sets[names[k]]):
            continue
        if len(before) > 1:
            others = " and ".join("no set" if i < 0 else f"'{names[i]}'" for i in before)
            raise ValueError(f"cells of the set '{names[k]}' are in {others} as well; a cell is of one body. Give sets apart, or one "
                             f"within another.")
        owner[sets[names[k]]] = k
    loose = np.flatnonzero(owner < 0)
    parts = _parts(cells, n_points)[loose]
    for k, part in enumerate(np.unique(parts)):
        owner[loose[parts == part]] = len(names) + k
    names += [f"body_{k + 1}" for k in range(len(np.unique(parts)))]
    there, body = np.unique(owner, return_inverse=True)
    return body, [names[k] for k in there]


def _parts(cells, n_points):
    """A number for each cell, the same for those that hang together by points."""
    label = np.arange(n_points)
    while True:
        before = label.copy()
        for _, data in cells:
            np.minimum.at(label, data, label[data].min(axis=1)[:, None])
        label = label[label]
        if np.array_equal(label, before):
            return np.concatenate([label[data[:, 0]] for _, data in cells])


def _faces_between(surface, is_in):
    """Boundary faces all of whose corners are among some points, by their number of corners."""
    begin, count = surface["offsets"][:-1], np.diff(surface["offsets"])
    faces = []
    for corners in np.unique(count):
        table = surface["faces"][begin[count == corners][:, None] + np.arange(corners)]
        table = table[is_in[table].all(axis=1)]
        if len(table):
            faces.append(table)
    return faces
