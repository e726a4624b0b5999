#!/bin/bash
# FreeFEM: a field of one mesh, asked for on a second mesh that lies beside it
# Packages of Debian 12: freefem++=4.11+dfsg1-3, libfreefem++=4.11+dfsg1-3.
# Guess: a traction that is brought from a fluid's mesh to a solid's is 0, or an error, where the solid has no fluid beside it.
# Seen: every point outside takes the value of the nearest point of the boundary, at any distance. The integral of a field of the unit
#   square over a square that is half a side, or a hundred sides, away is that of the boundary's value, by interpolation and in int2d.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install freefem++=4.11+dfsg1-3 libfreefem++=4.11+dfsg1-3
for deb in *.deb; do dpkg -x "$deb" .; done
LD_LIBRARY_PATH=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH

cat > beside.edp <<'E'
mesh own = square(8, 8);
fespace Own(own, P1);
Own u = 3 * x;
real[int] offs = [0.5, 100.];
for (int i = 0; i < offs.n; ++i) {
    mesh other = square(8, 8, [x + 1 + offs[i], y]);
    fespace Other(other, P1);
    Other v = u;
    cout << "seen: " << offs[i] << " away: interpolated " << v[].min << " to " << v[].max << ", integral " << int2d(other)(u) << endl;
}
E
usr/bin/FreeFem++-nw -nw -v 0 beside.edp | grep "^seen" | tee seen
diff seen - <<'E'
seen: 0.5 away: interpolated 3 to 3, integral 3
seen: 100 away: interpolated 3 to 3, integral 3
E
