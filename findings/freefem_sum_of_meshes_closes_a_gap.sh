#!/bin/bash
# FreeFEM: the sum of two meshes of blocks that stand apart
# Packages of Debian 12: freefem++=4.11+dfsg1-3, libfreefem++=4.11+dfsg1-3.
# Guess: + joins vertices that are equal up to roundings. Blocks with a gap between them stay two bodies.
# Seen: all vertices within a tenth of an edge are joined, in 2D and 3D: two blocks with cells of 0.25 become one body across a gap of
#   0.024, and the gap is filled: the volume is larger by it. At 0.026 they are two. Nothing is said of it.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install freefem++=4.11+dfsg1-3 libfreefem++=4.11+dfsg1-3
for deb in *.deb; do dpkg -x "$deb" .; done
LD_LIBRARY_PATH=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
FF_LOADPATH=$(dirname "$(find "$work" -name msh3.so | head -1)")
export LD_LIBRARY_PATH FF_LOADPATH

cat > sum.edp <<'E'
load "msh3"
real[int] gaps = [1e-9, 0.024, 0.026];
for (int i = 0; i < gaps.n; ++i) {
    real gap = gaps[i];
    mesh square1 = square(4, 4);
    mesh two = square1 + movemesh(square1, [x + 1 + gap, y]);
    mesh3 cube1 = cube(4, 4, 4);
    mesh3 three = cube1 + movemesh(cube1, [x + 1 + gap, y, z]);
    cout << "seen: gap " << gap << ": " << two.nv << " of 50 vertices, area - 2 = " << round(int2d(two)(1.) * 1e4 - 2e4) * 1e-4
         << "; " << three.nv << " of 250 vertices, volume - 2 = " << round(int3d(three)(1.) * 1e4 - 2e4) * 1e-4 << endl;
}
E
usr/bin/FreeFem++-nw -nw -v 0 sum.edp | grep "^seen" | sed "s,= -0,= 0,g" | tee seen
diff seen - <<'E'
seen: gap 1e-09: 45 of 50 vertices, area - 2 = 0; 225 of 250 vertices, volume - 2 = 0
seen: gap 0.024: 45 of 50 vertices, area - 2 = 0.024; 225 of 250 vertices, volume - 2 = 0.024
seen: gap 0.026: 50 of 50 vertices, area - 2 = 0; 250 of 250 vertices, volume - 2 = 0
E
