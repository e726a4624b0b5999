#!/bin/bash
# pygalmesh: the boundary and the corners of a cube that is filled with tetrahedra
# Packages of Debian 12: python3-pygalmesh=0.10.6-1+b3, python3-meshio=7.0.0-3. Needs the python3 of Debian with numpy.
# Guess: generate_volume_mesh_from_surface_mesh gives, beside its tetrahedra, each triangle of the boundary once, facing outwards. The cube
#   keeps its corners and edges, and with one seed its mesh is the same each time.
# Seen: each boundary triangle stands there twice, once facing outwards and once inwards: the area is doubled, and the volume that they
#   enclose is 0. Corners are cut off: no node lies within 0.01 m of some corners, where edges of cells are 0.15 m long. With seed=0 nodes
#   still differ from call to call.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install python3-pygalmesh=0.10.6-1+b3 python3-meshio=7.0.0-3
for deb in *.deb; do dpkg -x "$deb" .; done
export PYTHONPATH="$work/usr/lib/python3/dist-packages"
LD_LIBRARY_PATH=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH

/usr/bin/python3 - <<'P' 2> /dev/null | sed -n "s/^seen: //p" | tee output
from collections import Counter
import meshio
import numpy as np
import pygalmesh

corners = np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
squares = np.array([(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)])
meshio.Mesh(corners, [("triangle", np.vstack([squares[:, [0, 1, 2]], squares[:, [0, 2, 3]]]))]).write("cube.off")

def cube():
    return pygalmesh.generate_volume_mesh_from_surface_mesh(
        "cube.off", min_facet_angle=25.0, max_radius_surface_delaunay_ball=0.15, max_facet_distance=0.008, max_circumradius_edge_ratio=3.0,
        verbose=False, seed=0)

def boundary(cells):  # faces of one cell alone, by their nodes
    faces = Counter(tuple(sorted(cell[list(face)])) for cell in cells for face in ((1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1)))
    return {face for face, count in faces.items() if count == 1}

mesh = cube()
cells, triangles = mesh.cells_dict["tetra"], mesh.cells_dict["triangle"]
a, b, c = np.moveaxis(mesh.points[triangles], 1, 0)
area = np.sum(np.linalg.norm(np.cross(b - a, c - a), axis=1)) / 2
volume = np.einsum("ij,ij->", a, np.cross(b, c)) / 6
times = Counter(tuple(sorted(triangle)) for triangle in triangles)
print("seen: the triangles are the boundary of the cells: %s, each of them %s times" % (times.keys() == boundary(cells), set(times.values())))
print("seen: area %.0f of 6, volume %.2f" % (area, abs(volume)))
print("seen: some corner is more than 0.01 m from all nodes:", max(np.min(np.linalg.norm(mesh.points - corner, axis=1)) for corner in corners) > 0.01)
print("seen: ten meshes differ:", len({cube().points.tobytes() for _ in range(10)}) > 1)
P
diff output - <<'P'
the triangles are the boundary of the cells: True, each of them {2} times
area 12 of 6, volume 0.00
some corner is more than 0.01 m from all nodes: True
ten meshes differ: True
P
