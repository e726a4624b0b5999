#!/bin/bash
# Open MPI: the least of the ranks' numbers, where that of one rank is NaN
# Packages of Debian 12: libopenmpi-dev=4.1.4-3+b1, libopenmpi3=4.1.4-3+b1, openmpi-bin=4.1.4-3+b1, openmpi-common=4.1.4-3. Needs gcc.
# Guess: a stable time step that is NaN on one rank is NaN in MPI_MIN over all ranks, or else is passed over, whichever rank has it.
# Seen: it depends on the rank. Allreduce of three ranks gives NaN for rank 0, and passes over the NaN of ranks 1 and 2: the run goes on
#   with the step of others. Reduce of the same numbers gives NaN for rank 2, and for rank 0 it gives 3, the largest of the numbers 2 and
#   3 that are left.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install libopenmpi-dev=4.1.4-3+b1 libopenmpi3=4.1.4-3+b1 openmpi-bin=4.1.4-3+b1 openmpi-common=4.1.4-3
for deb in *.deb; do dpkg -x "$deb" .; done
lib="$work/usr/lib/x86_64-linux-gnu"
export OPAL_PREFIX="$work/usr" LD_LIBRARY_PATH="$lib:$lib/openmpi/lib" OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1

cat > a.c <<'C'
#include <math.h>
#include <mpi.h>
#include <stdio.h>
int main(int argc, char** argv) {
    int rank;
    MPI_Init(&argc, &argv);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    for (int bad = 0; bad < 3; ++bad) {
        const double mine = rank == bad ? NAN : rank + 1.0;
        double all[3], least, reduced;
        MPI_Allreduce(&mine, &least, 1, MPI_DOUBLE, MPI_MIN, MPI_COMM_WORLD);
        MPI_Gather(&least, 1, MPI_DOUBLE, all, 1, MPI_DOUBLE, 0, MPI_COMM_WORLD);
        MPI_Reduce(&mine, &reduced, 1, MPI_DOUBLE, MPI_MIN, 0, MPI_COMM_WORLD);
        if (rank == 0) {
            printf("of");
            for (int i = 0; i < 3; ++i) printf(i == bad ? " nan" : " %g", i + 1.0);
            printf(": Allreduce");
            for (int i = 0; i < 3; ++i) printf(isnan(all[i]) ? " nan" : " %g", all[i]);
            printf(isnan(reduced) ? ", Reduce nan\n" : ", Reduce %g\n", reduced);
        }
    }
    MPI_Finalize();
}
C
"$work/usr/bin/mpicc.openmpi" a.c -o a
"$work/usr/bin/mpiexec.openmpi" --oversubscribe -n 3 ./a | tee output
diff output - <<'C'
of nan 2 3: Allreduce nan nan nan, Reduce 3
of 1 nan 3: Allreduce 1 1 1, Reduce 1
of 1 2 nan: Allreduce 1 1 1, Reduce nan
C
