#!/bin/bash
# CalculiX: exit status of a run that failed
# Packages of Debian 12: calculix-ccx=2.20-1, libspooles2.2=2.2-14, libarpack2=3.8.0-3.
# Guess: ccx ends with another status than 0 after an *ERROR, so that a script can tell.
# Seen: 201 after an error in the input file, but 0 where the file cannot be opened, with *ERROR in the text alone.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install calculix-ccx=2.20-1 libspooles2.2=2.2-14 libarpack2=3.8.0-3
for deb in *.deb; do dpkg -x "$deb" .; done
export PATH="$work/usr/bin:$PATH" PYTHONPATH="$work/usr/lib/python3/dist-packages"
libraries=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH="$libraries"

cat > loose.inp <<'E'
*NODE
1, 0, 0, 0
2, 1, 0, 0
3, 0, 1, 0
4, 0, 0, 1
*ELEMENT, TYPE=C3D4
1, 1, 2, 3, 4
*STEP
*STATIC
*END STEP
E
for name in loose absent; do
    status=0
    ccx $name > log 2>&1 || status=$?
    echo "$name: status $status, $(grep -o '\*ERROR in [a-z]*' log | head -n 1)"
done | tee output
diff output - <<'E'
loose: status 201, *ERROR in calinput
absent: status 0, *ERROR in readinput
E
