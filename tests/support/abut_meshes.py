"""Mesh files for tests and scenes whose meshes no shape of a scene has."""
import math
import pathlib
import struct

KINDS = {(1, 2): 1, (2, 3): 2, (2, 4): 3, (3, 4): 4, (3, 8): 5, (3, 6): 6}  # of Gmsh, by dimension and number of corners


def write_msh(path, nodes, elements):
    """Gmsh 2.2. `nodes`: places of two or three coordinates [m]; `elements`: (dimension, name of the group, corners counted from 0)."""
    groups = sorted({(dim, name) for dim, name, _ in elements})
    tags = {group: i + 1 for i, group in enumerate(groups)}
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", len(groups)]
    lines += [f'{dim} {tags[dim, name]} "{name}"' for dim, name in groups]
    lines += ["$EndPhysicalNames", "$Nodes", len(nodes)]
    lines += [f"{i} {' '.join(repr(float(x)) for x in (*node, 0)[:3])}" for i, node in enumerate(nodes, 1)]
    lines += ["$EndNodes", "$Elements", len(elements)]
    lines += [f"{i} {KINDS[dim, len(corners)]} 2 {tags[dim, name]} {tags[dim, name]} {' '.join(str(c + 1) for c in corners)}"
              for i, (dim, name, corners) in enumerate(elements, 1)]
    path = pathlib.Path(path)
    path.write_text("\n".join(map(str, [*lines, "$EndElements", ""])))
    return path


def write_binary_msh(path, nodes, elements):
    """As write_msh, in the binary format 4.1 of Gmsh: an entity per group, numbered in the order in which they come. Nodes and elements
    keep their order. Coordinates are rounded to twelve digits, so that machines whose sines differ in the last bit write one file."""
    nodes = [tuple(float(f"{x:.12g}") for x in (*node, 0)[:3]) for node in nodes]
    tags, blocks, entity_of = {}, {}, {}
    for i, (dim, name, corners) in enumerate(elements, 1):
        tag = tags.setdefault((dim, name), len(tags) + 1)
        blocks.setdefault((dim, tag, KINDS[dim, len(corners)]), []).append((i, *(c + 1 for c in corners)))
        for corner in corners:
            entity_of[corner] = max(entity_of.get(corner, (0, 0)), (dim, tag), key=lambda entity: entity[0])
    runs = []  # of nodes one after the other that are of one entity: that with the highest dimension
    for i in range(len(nodes)):
        if not runs or runs[-1][0] != entity_of[i]:
            runs.append((entity_of[i], []))
        runs[-1][1].append(i)

    entities = [sum(dim == d for dim, _ in tags) for d in range(4)]
    data = [b"$MeshFormat\n4.1 1 8\n", struct.pack("<i", 1), b"\n$EndMeshFormat\n$PhysicalNames\n%d\n" % len(tags)]
    data += [f'{dim} {tag} "{name}"\n'.encode() for (dim, name), tag in tags.items()]
    data += [b"$EndPhysicalNames\n$Entities\n", struct.pack("<4Q", *entities)]
    for (dim, _), tag in sorted(tags.items(), key=lambda group: group[0][0]):
        used = {c - 1 for (d, t, _), block in blocks.items() if (d, t) == (dim, tag) for _, *corners in block for c in corners}
        box = [bound(nodes[c][k] for c in used) for bound in (min, max) for k in range(3)]
        data.append(struct.pack("<i6dQiQ", tag, *box, 1, tag, 0))
    data += [b"\n$EndEntities\n$Nodes\n", struct.pack("<4Q", len(runs), len(nodes), 1, len(nodes))]
    for (dim, tag), run in runs:
        data.append(struct.pack(f"<3i{len(run) + 1}Q", dim, tag, 0, len(run), *(i + 1 for i in run)))
        data += [struct.pack("<3d", *nodes[i]) for i in run]
    data += [b"\n$EndNodes\n$Elements\n", struct.pack("<4Q", len(blocks), len(elements), 1, len(elements))]
    for (dim, tag, kind), block in blocks.items():
        data.append(struct.pack("<3iQ", dim, tag, kind, len(block)))
        data += [struct.pack(f"<{len(element)}Q", *element) for element in block]
    path = pathlib.Path(path)
    path.write_bytes(b"".join([*data, b"\n$EndElements\n"]))
    return path


def block_of_rows(path, name, lower, upper, counts, uneven=0.0, held=()):
    """A rectangle of quadrangles. Inner nodes are up to `uneven` of a row higher or lower. `held`: sides in the group "held", of
    "left", "right", "below" and "above"."""
    nx, ny = counts
    at = lambda i, j: (nx + 1) * j + i
    height = (upper[1] - lower[1]) / ny
    inner = lambda i, j: uneven * height * math.sin(5 * i + 3 * j) if 0 < i < nx and 0 < j < ny else 0
    nodes = [(lower[0] + (upper[0] - lower[0]) * i / nx, lower[1] + height * j + inner(i, j)) for j in range(ny + 1) for i in range(nx + 1)]
    sides = {"left": [(at(0, j), at(0, j + 1)) for j in range(ny)], "right": [(at(nx, j), at(nx, j + 1)) for j in range(ny)],
             "below": [(at(i, 0), at(i + 1, 0)) for i in range(nx)], "above": [(at(i, ny), at(i + 1, ny)) for i in range(nx)]}
    cells = [(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)) for j in range(ny) for i in range(nx)]
    return write_msh(path, nodes, [(1, "held", edge) for side in held for edge in sides[side]] + [(2, name, cell) for cell in cells])


def append_ring(nodes, elements, name, inner, outer, layers, sectors, angle=2 * math.pi, cut=False):
    """Appends a ring about the origin, or a sector of it from the x axis on: quadrangles, or triangles if `cut`. Returns the edges of
    the inner and of the outer circle, and of a sector those of its first and last ray."""
    first, columns = len(nodes), sectors + (angle < 2 * math.pi)
    at = lambda layer, i: first + layer * columns + i % columns
    for layer in range(layers + 1):
        radius = inner + (outer - inner) * layer / layers
        nodes += [(radius * math.cos(angle * i / sectors), radius * math.sin(angle * i / sectors)) for i in range(columns)]
    for layer in range(layers):
        for i in range(sectors):
            corners = at(layer, i), at(layer + 1, i), at(layer + 1, i + 1), at(layer, i + 1)
            elements += [(2, name, [corners[k] for k in one]) for one in (((0, 1, 2), (0, 2, 3)) if cut else ((0, 1, 2, 3),))]
    circles = [[(at(layer, i), at(layer, i + 1)) for i in range(sectors)] for layer in (0, layers)]
    return circles + [[(at(layer, i), at(layer + 1, i)) for layer in range(layers)] for i in (0, sectors)]


def ring(path, name, sides, *size, **more):
    """A file of one such ring, whose edges have the groups `sides`: inner, outer, and of a sector its first and last ray."""
    nodes, elements = [], []
    for side, edges in zip(sides, append_ring(nodes, elements, name, *size, **more)):
        elements += [(1, side, edge) for edge in edges]
    return write_msh(path, nodes, elements)


def cylinder_of_rings(path, name, radius, length, rings, sectors, layers):
    """A cylinder that stands on z = 0: prisms about its axis and rings of hexahedra around them."""
    at = lambda k, i, j: k * (1 + rings * sectors) + (1 + (i - 1) * sectors + j % sectors if i else 0)
    nodes, cells = [], []
    for k in range(layers + 1):
        nodes.append((0, 0, length * k / layers))
        nodes += [(radius * i / rings * math.cos(a), radius * i / rings * math.sin(a), length * k / layers)
                  for i in range(1, rings + 1) for a in (2 * math.pi * j / sectors for j in range(sectors))]
    for k in range(layers):
        for j in range(sectors):
            for i in range(rings):
                base = [(i, j), (i + 1, j), (i + 1, j + 1), *([(i, j + 1)] if i else [])]
                cells.append((3, name, [at(h, *corner) for h in (k, k + 1) for corner in base]))
    return write_msh(path, nodes, cells)
