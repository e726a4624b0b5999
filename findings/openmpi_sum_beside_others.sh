#!/bin/bash
# Open MPI: the sum of four numbers of four ranks, by Reduce, Allreduce and Scan, alone and in longer messages
# Packages of Debian 12: libopenmpi-dev=4.1.4-3+b1, libopenmpi3=4.1.4-3+b1, openmpi-bin=4.1.4-3+b1, openmpi-common=4.1.4-3. Needs gcc.
# Guess: on the same ranks the order of a sum is always the same. What Reduce gives to rank 0, Allreduce gives to all, and Scan to the
#   last; a number has the same sum alone and among others of one message.
# Seen: of 1e16, 1, -1e16 and 1 Reduce makes 2 and Allreduce 0. Scan makes 1. In a message of 1,000 numbers Reduce makes 0 of the
#   same four. A value that is added to a message can so change the last bits of those that were there before.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install libopenmpi-dev=4.1.4-3+b1 libopenmpi3=4.1.4-3+b1 openmpi-bin=4.1.4-3+b1 openmpi-common=4.1.4-3
for deb in *.deb; do dpkg -x "$deb" .; done
lib="$work/usr/lib/x86_64-linux-gnu"
export OPAL_PREFIX="$work/usr" LD_LIBRARY_PATH="$lib:$lib/openmpi/lib" OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1

cat > a.c <<'C'
#include <mpi.h>
#include <stdio.h>
enum { longest = 100000 };
double mine[longest], sum[longest];
int main(int argc, char** argv) {
    int rank;
    MPI_Init(&argc, &argv);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    const double number[4] = {1e16, 1.0, -1e16, 1.0};
    const int lengths[] = {1, 100, 1000, longest};
    for (int k = 0; k < 4; ++k) {
        for (int i = 0; i < lengths[k]; ++i) mine[i] = number[rank];
        MPI_Reduce(mine, sum, lengths[k], MPI_DOUBLE, MPI_SUM, 0, MPI_COMM_WORLD);
        const double reduced = sum[0];
        MPI_Allreduce(mine, sum, lengths[k], MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
        const double all_reduced = sum[0];
        MPI_Scan(mine, sum, lengths[k], MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
        MPI_Bcast(sum, 1, MPI_DOUBLE, 3, MPI_COMM_WORLD);
        if (rank == 0) printf("%d numbers: Reduce %g, Allreduce %g, Scan %g\n", lengths[k], reduced, all_reduced, sum[0]);
    }
    MPI_Finalize();
}
C
"$work/usr/bin/mpicc.openmpi" a.c -o a
"$work/usr/bin/mpiexec.openmpi" --oversubscribe -n 4 ./a | tee output
diff output - <<'C'
1 numbers: Reduce 2, Allreduce 0, Scan 1
100 numbers: Reduce 2, Allreduce 0, Scan 1
1000 numbers: Reduce 0, Allreduce 0, Scan 1
100000 numbers: Reduce 0, Allreduce 0, Scan 1
C
