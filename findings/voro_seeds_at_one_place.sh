#!/bin/bash
# Voro++: seeds of a tessellation into grains that lie at one place, or outside of the box
# Packages of Debian 12: voro++=0.5+revert-to-0.4.6+dfsg1-1, libvoro++1=0.5+revert-to-0.4.6+dfsg1-1.
# Guess: two seeds at one place are an error, or one of them has a cell; a seed outside is refused; cells stand in the file in
#   the order of the seeds.
# Seen: neither of two seeds at one place has a cell. The box has a hole there, the status is 0, and nothing is said. A seed
#   outside is left out in silence, too. Cells are ordered by blocks of space: only their numbers tell whose they are.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install voro++=0.5+revert-to-0.4.6+dfsg1-1 libvoro++1=0.5+revert-to-0.4.6+dfsg1-1
for deb in *.deb; do dpkg -x "$deb" .; done
export PATH="$work/usr/bin:$PATH"
libraries=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH="$libraries"

cat > seeds.py <<'E'
import sys
places = [(0.5 + (i * 0.754877666) % 1, 0.5 + (i * 0.569840291) % 1, 0.5 + (i * 0.362316) % 1) for i in range(40)]
places = [tuple(x % 1 for x in place) for place in places]
if sys.argv[1] == "twice":
    places.append(places[4])
if sys.argv[1] == "outside":
    places.append((1.2, 0.5, 0.5))
for number, place in enumerate(places, start=1):
    print(number, *(f"{x:.9f}" for x in place))
E
for case in once twice outside; do
    python3 seeds.py $case > seeds
    status=0
    said=$(voro++ -c "%i %v" 0 1 0 1 0 1 seeds 2>&1) || status=$?
    missing=$(comm -23 <(cut -d' ' -f1 seeds | sort) <(cut -d' ' -f1 seeds.vol | sort) | sort -n | paste -sd' ')
    order=$(cut -d' ' -f1 seeds.vol | sort -nc 2>/dev/null && echo "that of the seeds" || echo "another than that of the seeds")
    echo "$case: $(wc -l < seeds) seeds, $(wc -l < seeds.vol) cells of volume $(awk '{v += $2} END {printf "%.3f", v}' seeds.vol)," \
        "without a cell: ${missing:-none}; status $status, '$said'; order: $order"
done | tee output
diff output - <<'E'
once: 40 seeds, 40 cells of volume 1.000, without a cell: none; status 0, ''; order: another than that of the seeds
twice: 41 seeds, 39 cells of volume 0.981, without a cell: 5 41; status 0, ''; order: another than that of the seeds
outside: 41 seeds, 40 cells of volume 1.000, without a cell: 41; status 0, ''; order: another than that of the seeds
E
