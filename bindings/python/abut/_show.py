"""Pictures of meshes and results: for notebooks, by matplotlib, by pyvista. The two are imported where they are asked for."""
import html

import numpy as np

COLOURS = ("#4477aa", "#ee6677", "#228833", "#ccbb44", "#66ccee", "#aa3377", "#bbbbbb")
MOST_POLYGONS = 4000  # of a picture within a page
LOOK = np.array([[0.82, 0.57, 0.0], [-0.25, 0.36, 0.9]])  # right and up of a picture of bodies in space
VTK_TYPES = {"triangle": 5, "quad": 9, "tetra": 10, "hexahedron": 12, "wedge": 13, "pyramid": 14}


def polygons(mesh, displacement=None):
    """Corners (m, dim) of what is drawn: of cells in 2D, of boundary faces in 3D; and the cell of each."""
    points = mesh.points if displacement is None else mesh.points + displacement
    if points.shape[1] == 2:
        return [points[corners] for _, data in mesh.cells for corners in data], np.arange(len(mesh.body))
    faces, offsets = mesh.surface["faces"], mesh.surface["offsets"]
    return [points[faces[a:b]] for a, b in zip(offsets, offsets[1:])], mesh.surface_cells


def svg(mesh, displacement=None):
    """A small picture of bodies as text; empty where they are too many cells for one."""
    drawn, cell = polygons(mesh, displacement)
    if len(drawn) > MOST_POLYGONS:
        return ""
    shade, order = np.ones(len(drawn)), range(len(drawn))
    if mesh.points.shape[1] == 3:
        towards = np.cross(*LOOK)
        normals = np.array([np.cross(p[1] - p[0], p[2] - p[0]) for p in drawn])
        facing = normals @ towards / np.linalg.norm(normals, axis=1)
        shade = 0.6 + 0.4 * facing
        order = [i for i in np.argsort([p.mean(axis=0) @ towards for p in drawn]) if facing[i] > 0]
        drawn = [p @ LOOK.T for p in drawn]
    corners = np.vstack(drawn)
    low, size = corners.min(axis=0), np.ptp(corners, axis=0)
    scale = 300.0 / size.max()
    width, height = size * scale + 4.0
    shapes = []
    for i in order:
        x = (drawn[i] - low) * scale + 2.0
        colour = _paler(COLOURS[mesh.body[cell[i]] % len(COLOURS)], shade[i])
        shapes.append(f'<polygon points="{" ".join(f"{a:.1f},{height - b:.1f}" for a, b in x)}" fill="{colour}"/>')
    return (f'<svg width="{width:.0f}" height="{height:.0f}" viewBox="0 0 {width:.1f} {height:.1f}" stroke="#333" '
            f'stroke-width="0.4">{"".join(shapes)}</svg>')


def html_of_mesh(mesh):
    """Bodies with their cells and groups, and a picture where it is small."""
    unit = "m²" if mesh.points.shape[1] == 2 else "m³"
    rows = "".join(f"<tr><td>{html.escape(name)}</td><td>{(mesh.body == b).sum()}</td><td>{mesh.measures[mesh.body == b].sum():.6g}</td></tr>"
                   for b, name in enumerate(mesh.body_names))
    groups = html.escape(", ".join(mesh.groups)) or "none"
    return (f"<div><b>{html.escape(mesh.name)}</b><table><tr><th>body</th><th>cells</th><th>{unit}</th></tr>{rows}</table>"
            f"<p>Groups: {groups}</p>{svg(mesh)}</div>")


def html_of_result(result):
    """The verdict, main figures and warnings, and the bodies at the end."""
    rows = [("steps", f"{result.steps} of {result.dt:.6g} s"), ("time", f"{result.ledger['time'][-1]:.6g} s"),
            ("contact events", result.contact["events"]), ("missed contacts", result.contact["missed_contacts"]),
            ("files", result.out or "none")]
    table = "".join(f"<tr><td>{name}</td><td>{html.escape(str(value))}</td></tr>" for name, value in rows)
    warnings = "".join(f"<li>{html.escape(text)}</li>" for text in result.warnings)
    picture = svg(result.mesh, result.frames.point_displacement[-1]) if len(result.frames) else ""
    return (f"<div><b>{html.escape(result.title or result.name)}</b><p>{html.escape(result.verdict)}</p><table>{table}</table>"
            f"{f'<ul>{warnings}</ul>' if warnings else ''}{picture}</div>")


def show_mesh(mesh, values=None, displacement=None, axes=None):
    """Draws the bodies by matplotlib.

    Parameters
    ----------
    values : array of float, (n_cells,), optional
        Values for colours; by default colours are those of the bodies.
    displacement : array of float, (n_points, dim), optional
        Displacement of the points [m].
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
    pyplot = _pyplot()
    in_space = mesh.points.shape[1] == 3
    if axes is None:
        axes = pyplot.figure().add_subplot(projection="3d" if in_space else None)
    drawn, cell = polygons(mesh, displacement)
    if in_space:
        from mpl_toolkits.mplot3d.art3d import Poly3DCollection as Collection
    else:
        from matplotlib.collections import PolyCollection as Collection
    look = dict(edgecolor="#333", linewidth=0.2)
    if values is None:
        shapes = Collection(drawn, facecolor=[COLOURS[mesh.body[c] % len(COLOURS)] for c in cell], **look)
    else:
        shapes = Collection(drawn, cmap="viridis", **look)
        shapes.set_array(np.asarray(values)[cell])
        axes.figure.colorbar(shapes, ax=axes)
    (axes.add_collection3d if in_space else axes.add_collection)(shapes)
    corners = np.vstack(drawn)
    low, high = corners.min(axis=0), corners.max(axis=0)
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), xlabel="x [m]", ylabel="y [m]")
    if in_space:
        axes.set(zlim=(low[2], high[2]), zlabel="z [m]")
        axes.set_box_aspect(high - low)
    else:
        axes.set_aspect("equal")
    return axes


def show_result(result, field="von_mises", frame=-1):
    """See Result.show."""
    pyplot = _pyplot()
    if not len(result.frames):
        raise ValueError("this result has no frames to show; run with frames=2 or more")
    shown = np.arange(len(result.frames))[frame if np.ndim(frame) else [frame]]
    fields = {None: None, "von_mises": result.frames.von_mises, "speed": np.linalg.norm(result.frames.velocity, axis=-1)}
    if field not in fields:
        raise ValueError(f"field is '{field}'; 'von_mises', 'speed' and None are allowed")
    values = None if field is None else fields[field][shown]
    figure = pyplot.figure(figsize=(5.0 * (len(shown) + 1), 4.5))
    pictures = [figure.add_subplot(1, len(shown) + 1, i + 1, projection="3d" if result.mesh.points.shape[1] == 3 else None)
                for i in range(len(shown))]
    unit = {"von_mises": "von Mises stress [Pa]", "speed": "speed [m/s]"}.get(field, "")
    for i, axes in enumerate(pictures):
        show_mesh(result.mesh, None if values is None else values[i], result.frames.point_displacement[shown[i]], axes)
        axes.set_title(f"{unit}{', ' if unit else ''}t = {result.frames.time[shown[i]]:.4g} s")
        if values is not None:
            axes.collections[0].set_clim(values.min(), values.max())
    energies = figure.add_subplot(1, len(shown) + 1, len(shown) + 1)
    for column in ("pseudo_energy", "energy", "kinetic", "potential"):
        energies.plot(result.ledger["time"], result.ledger[column], label=column.replace("_", "-"))
    energies.set(xlabel="time [s]", ylabel="energy [J]", title=_plain(result.title or result.name))
    energies.legend()
    figure.tight_layout()
    return figure


def show_forces(result, axes=None):
    """See Result.show_forces. A record in which a pair does not touch has no row: its force is 0."""
    axes = axes or _pyplot().figure().add_subplot()
    forces, times = result.forces, result.ledger["time"]
    for pair in dict.fromkeys(zip(forces["body_1"], forces["body_2"])):
        rows = forces[(forces["body_1"] == pair[0]) & (forces["body_2"] == pair[1])]
        at = np.searchsorted(result.ledger["step"], rows["step"])
        for column, label in (("normal_force", ""), ("rubbing_force", ", rubbing")):
            values = np.zeros(len(times))
            values[at] = rows[column]
            if column == "normal_force" or values.any():
                axes.plot(times, values, label=_plain(f"{pair[0]} on {pair[1]}{label}"))
    axes.set(xlabel="time [s]", ylabel="force [N/m]" if result.mesh.points.shape[1] == 2 else "force [N]",
             title=_plain(result.title or result.name))
    if axes.lines:
        axes.legend()
    return axes


def show_probes(result, column, axes=None):
    """See Result.show_probes."""
    with_it = {name: table for name, table in result.probes.items() if column in table.dtype.names}
    if not with_it:
        known = ", ".join(dict.fromkeys(name for table in result.probes.values() for name in table.dtype.names[2:]))
        raise ValueError(f"no probe has '{column}'; there are {known}" if known else "this result has no probes ([probes.NAME] in a scene)")
    axes = axes or _pyplot().figure().add_subplot()
    for name, table in with_it.items():
        axes.plot(table["time"], table[column], label=_plain(name))
    axes.set(xlabel="time [s]", ylabel=_plain(column.replace("_", " ")), title=_plain(result.title or result.name))
    axes.legend()
    return axes


def to_pyvista(mesh, displacement=None, **fields):
    """Makes a grid of pyvista of the mesh, with the cell array "body".

    Parameters
    ----------
    displacement : array of float, (n_points, dim), optional
        Displacement of the points [m].
    **fields
        Further cell arrays, one row per cell.

    Returns
    -------
    pyvista.UnstructuredGrid
        The grid.

    Raises
    ------
    ImportError
        If pyvista is not installed.
    """
    try:
        import pyvista
    except ImportError:
        raise ImportError("pyvista is not installed; install it (pip install pyvista), or take show(), which needs matplotlib") from None
    points = mesh.points if displacement is None else mesh.points + displacement
    if points.shape[1] == 2:
        points = np.column_stack([points, np.zeros(len(points))])
    cells = np.concatenate([np.column_stack([np.full(len(data), data.shape[1]), data]).ravel() for _, data in mesh.cells])
    types = np.concatenate([np.full(len(data), VTK_TYPES[name], np.uint8) for name, data in mesh.cells])
    grid = pyvista.UnstructuredGrid(cells, types, points)
    for name, values in {"body": mesh.body, **fields}.items():
        grid.cell_data[name] = np.asarray(values).reshape(len(mesh.body), -1).squeeze()
    return grid


def _plain(text):
    """A text for matplotlib that means itself: a name with two dollar signs is no formula."""
    return text.replace("$", r"\$")


def _paler(colour, share):
    """A colour that is mixed with white."""
    return "#" + "".join(f"{255 - round((255 - int(colour[i:i + 2], 16)) * share):02x}" for i in (1, 3, 5))


def _pyplot():
    try:
        from matplotlib import pyplot
    except ImportError:
        raise ImportError("matplotlib is not installed; install it (apt install python3-matplotlib)") from None
    return pyplot
