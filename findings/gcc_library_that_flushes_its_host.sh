#!/bin/bash
# GCC: a shared library that was linked with -ffast-math, loaded by a program that was not
# Packages of Debian 12: gcc-12=12.2.0-14+deb12u1, libgcc-12-dev and cpp-12 of the same version. Needs python3.
# Guess: -ffast-math holds for the code that is compiled with it. A program that loads a library computes as before, and all its threads
#   compute alike.
# Seen: the library has no function but an empty one. As it is loaded, subnormal numbers become 0 in the thread that loads it and in all
#   that this thread starts later: half of the least normal number is 0. Threads that run already keep them, so that a result depends on
#   which thread computes it. The link decides: code that was compiled with -ffast-math and linked without it changes nothing.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install gcc-12=12.2.0-14+deb12u1 libgcc-12-dev=12.2.0-14+deb12u1 cpp-12=12.2.0-14+deb12u1
for deb in *.deb; do dpkg -x "$deb" .; done
LD_LIBRARY_PATH=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH
gcc=usr/bin/x86_64-linux-gnu-gcc-12

echo "void nothing(void) {}" > a.c
$gcc -fPIC -O2 -ffast-math -c a.c -o a.o
$gcc -shared a.o -o compiled.so
$gcc -shared -ffast-math a.o -o linked.so
cat > host.py <<'P'
import ctypes, sys, threading
least = sys.float_info.min
loaded = threading.Event()
seen = {}

def halve(name, wait=None):
    if wait:
        wait.wait()
    seen[name] = f"{least / 2:.1e}"  # as text, since printing is changed as well

old = threading.Thread(target=halve, args=("old thread", loaded))
old.start()
halve("before")
ctypes.CDLL("./" + sys.argv[1])
halve("after")
loaded.set()
new = threading.Thread(target=halve, args=("new thread",))
new.start()
for thread in old, new:
    thread.join()
print(sys.argv[1] + ":", ", ".join(f"{name} {seen[name]}" for name in ("before", "after", "old thread", "new thread")))
P
for name in compiled linked; do python3 host.py $name.so; done | tee output
diff output - <<'P'
compiled.so: before 1.1e-308, after 1.1e-308, old thread 1.1e-308, new thread 1.1e-308
linked.so: before 1.1e-308, after 0.0e+00, old thread 1.1e-308, new thread 0.0e+00
P
