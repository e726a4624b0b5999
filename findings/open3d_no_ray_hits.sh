#!/bin/bash
# Open3D and Embree: signed distances and rays of a closed cube
# Packages of Debian 12: python3-open3d=0.16.1+ds-2+b4 and what it needs, libembree3-3=3.13.5+dfsg-2. Needs the python3 of Debian with numpy.
# Guess: RaycastingScene has the distance of a point inside a closed surface with a minus, and rays that go through the surface hit it.
# Seen: no ray hits anything, and all points are outside: the centre of a unit cube has the distance +0.5 and occupancy 0, without a word.
#   Distances without a sign are right. The likely reason: this Embree is built with EMBREE_RAY_MASK, and rays with a mask of 0 see nothing.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install python3-open3d=0.16.1+ds-2+b4 libembree3-3=3.13.5+dfsg-2
for deb in *.deb; do dpkg -x "$deb" .; done
export PYTHONPATH="$work/usr/lib/python3/dist-packages"
LD_LIBRARY_PATH=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH

/usr/bin/python3 - <<'P' | tee output
import numpy as np
import open3d

cube = open3d.geometry.TriangleMesh.create_box()
scene = open3d.t.geometry.RaycastingScene()
scene.add_triangles(open3d.t.geometry.TriangleMesh.from_legacy(cube))
points = open3d.core.Tensor(np.array([[0.5, 0.5, 0.5], [0.3, 0.4, 0.45], [2, 0.5, 0.5]], np.float32))
rays = open3d.core.Tensor(np.array([[-1, 0.4, 0.45, 1, 0, 0], [0.3, 0.4, -2, 0, 0, 1], [0.3, 0.4, 0.45, 0, 1, 0]], np.float32))
show = lambda values: " ".join("%.2g" % value for value in values.numpy())
print("closed", cube.is_watertight(), "volume", cube.get_volume())
print("distances", show(scene.compute_distance(points)))
print("signed distances", show(scene.compute_signed_distance(points)))
print("occupancy", show(scene.compute_occupancy(points)))
print("hits of rays", show(scene.count_intersections(rays)), "at", show(scene.cast_rays(rays)["t_hit"]))
P
diff output - <<'P'
closed True volume 1.0
distances 0.5 0.3 1
signed distances 0.5 0.3 1
occupancy 0 0 0
hits of rays 0 0 0 at inf inf inf
P
