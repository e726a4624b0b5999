#!/bin/bash
# METIS: a mesh that is parted among as many ranks as it has cells, or half as many
# Packages of Debian 12: libmetis-dev=5.1.0.dfsg-7, libmetis5=5.1.0.dfsg-7. Needs gcc.
# Guess: no rank of a mesh of equal cells is left empty while another has several, or else an error is returned.
# Seen: METIS_PartGraphKway gives 11 of 16 ranks nothing of 4x4 squares and others up to 4 squares, and returns METIS_OK. On 32x32
#   squares 24 of 512 ranks are empty. METIS_PartGraphRecursive fills these; with it 8 of 1024 ranks are empty on 32x32 squares.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install libmetis-dev=5.1.0.dfsg-7 libmetis5=5.1.0.dfsg-7
for deb in *.deb; do dpkg -x "$deb" .; done
lib="$work/usr/lib/x86_64-linux-gnu"
export LD_LIBRARY_PATH="$lib"

cat > a.c <<'E'
#include <metis.h>
#include <stdio.h>
enum { most = 1024 };
idx_t first[most + 1], neighbour[4 * most], owner[most];

void make_squares(int side) {
    idx_t n = 0;
    for (int i = 0; i < side * side; ++i) {
        first[i] = n;
        if (i % side > 0) neighbour[n++] = i - 1;
        if (i % side < side - 1) neighbour[n++] = i + 1;
        if (i >= side) neighbour[n++] = i - side;
        if (i < side * (side - 1)) neighbour[n++] = i + side;
    }
    first[side * side] = n;
}

void show(int side, idx_t n_ranks, int is_kway) {
    idx_t n_cells = side * side, n_weights = 1, cut;
    make_squares(side);
    const int result = (is_kway ? METIS_PartGraphKway : METIS_PartGraphRecursive)(
        &n_cells, &n_weights, first, neighbour, NULL, NULL, NULL, &n_ranks, NULL, NULL, NULL, &cut, owner);
    int n_of[most] = {0}, n_empty = 0, largest = 0;
    for (int i = 0; i < n_cells; ++i) ++n_of[owner[i]];
    for (int rank = 0; rank < n_ranks; ++rank) {
        n_empty += n_of[rank] == 0;
        if (n_of[rank] > largest) largest = n_of[rank];
    }
    printf("%s, %d squares: %s, %d of %d ranks empty, %d squares at most\n", is_kway ? "k-way" : "recursive", (int)n_cells,
           result == METIS_OK ? "METIS_OK" : "error", n_empty, (int)n_ranks, largest);
}

int main(void) {
    for (int is_kway = 1; is_kway >= 0; --is_kway) {
        show(4, 16, is_kway);
        show(8, 64, is_kway);
        show(32, 512, is_kway);
        show(32, 1024, is_kway);
    }
}
E
gcc -I"$work/usr/include" a.c -L"$lib" -lmetis -o a
./a | tee output
diff output - <<'E'
k-way, 16 squares: METIS_OK, 11 of 16 ranks empty, 4 squares at most
k-way, 64 squares: METIS_OK, 35 of 64 ranks empty, 3 squares at most
k-way, 1024 squares: METIS_OK, 24 of 512 ranks empty, 3 squares at most
k-way, 1024 squares: METIS_OK, 621 of 1024 ranks empty, 3 squares at most
recursive, 16 squares: METIS_OK, 0 of 16 ranks empty, 1 squares at most
recursive, 64 squares: METIS_OK, 0 of 64 ranks empty, 1 squares at most
recursive, 1024 squares: METIS_OK, 0 of 512 ranks empty, 3 squares at most
recursive, 1024 squares: METIS_OK, 8 of 1024 ranks empty, 2 squares at most
E
