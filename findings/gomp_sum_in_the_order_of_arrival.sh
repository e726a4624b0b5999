#!/bin/bash
# GNU OpenMP: a sum with reduction(+), schedule(static) and a fixed number of threads
# Packages of Debian 12: libgomp1=12.2.0-14+deb12u1. Needs gcc 12.
# Guess: with a static schedule each thread has the same terms in each run, and their sums are added in the order of the threads: on four
#   threads a program repeats its bits.
# Seen: the sums of the threads are added in the order in which the threads end. Of 1e16, 1, -1e16 and 1 on four threads the sum is 0, 1
#   or 2, as one or another of them is slower. No schedule cures it. An array with one entry per thread, added in a loop, gives 1 always.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install libgomp1=12.2.0-14+deb12u1
for deb in *.deb; do dpkg -x "$deb" .; done
LD_LIBRARY_PATH=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH

cat > a.c <<'C'
#include <stdio.h>
#include <unistd.h>
int main(void) {
    const double x[4] = {1e16, 1, -1e16, 1};
    for (int slow = 0; slow < 4; ++slow) {  // the thread that ends last, after the others in their order
        double sum = 0, of_thread[4], in_order = 0;
#pragma omp parallel for reduction(+ : sum) schedule(static) num_threads(4)
        for (int i = 0; i < 4; ++i) {
            sum += x[i];
            of_thread[i] = x[i];
            usleep(300000 * (i == slow ? 4 : i));
        }
        for (int i = 0; i < 4; ++i) in_order += of_thread[i];
        printf("thread %d ends last: sum %g, added in a loop %g\n", slow, sum, in_order);
    }
}
C
gcc -O2 -fopenmp a.c -o a
./a | tee output
diff output - <<'C'
thread 0 ends last: sum 0, added in a loop 1
thread 1 ends last: sum 2, added in a loop 1
thread 2 ends last: sum 0, added in a loop 1
thread 3 ends last: sum 1, added in a loop 1
C
