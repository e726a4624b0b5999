#!/bin/bash
# DOLFIN (FEniCS): which way cells of a box and triangles of its boundary are turned
# Packages of Debian 12: python3-dolfin=2019.2.0~git20230116.bd54183-2, python3-dolfin-real of the same version.
#   Needs pkg-config and the python3 of Debian with numpy.
# Guess: cells of UnitCubeMesh have positive volumes in the order of VTK, and triangles of BoundaryMesh(mesh, "exterior") face outwards.
# Seen: half of the cells are turned over, and triangles face either way: the volume that they enclose is 0.08 for a cube of volume 1.
#   Nodes of cells and triangles are in the order of their numbers. With BoundaryMesh(mesh, "exterior", False) all triangles face outwards.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install python3-dolfin=2019.2.0~git20230116.bd54183-2 python3-dolfin-real=2019.2.0~git20230116.bd54183-2
for deb in *.deb; do dpkg -x "$deb" .; done
folders() { find "$work" -name "$1" -printf "%h\n" | sort -u | paste -sd:; }
LD_LIBRARY_PATH=$(folders "*.so*") PKG_CONFIG_PATH=$(folders "*.pc")
PYTHONPATH=$work/usr/lib/petscdir/petsc3.18/x86_64-linux-gnu-real/lib/python3/dist-packages:$work/usr/lib/python3/dist-packages
export LD_LIBRARY_PATH PKG_CONFIG_PATH PYTHONPATH HOME=$work

/usr/bin/python3 - <<'P' 2> /dev/null | tee output
import dolfin
import numpy as np

def volume(surface):
    a, b, c = np.moveaxis(surface.coordinates()[surface.cells()], 1, 0)
    return np.einsum("ij,ij->", a, np.cross(b, c)) / 6

mesh = dolfin.UnitCubeMesh(2, 2, 2)
corners = mesh.coordinates()[mesh.cells()]
sizes = np.linalg.det(corners[:, 1:] - corners[:, :1]) / 6
print(f"{np.sum(sizes < 0)} of {len(sizes)} cells are turned over, the sizes add up to {np.sum(abs(sizes)):.2f}")
print(f"boundary as it is made: {volume(dolfin.BoundaryMesh(mesh, 'exterior')):.2f}")
print(f"boundary that is not ordered: {volume(dolfin.BoundaryMesh(mesh, 'exterior', False)):.2f}")
P
diff output - <<'P'
24 of 48 cells are turned over, the sizes add up to 1.00
boundary as it is made: 0.08
boundary that is not ordered: 1.00
P
