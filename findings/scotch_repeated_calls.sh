#!/bin/bash
# Scotch: parts of one mesh, asked for several times with one strategy
# Packages of Debian 12: libscotch-dev=7.0.3-2, libscotch-7.0=7.0.3-2. Needs gcc.
# Guess: SCOTCH_graphPart gives a rank the same cells each time it is called with the same graph; at least once SCOTCH_randomReset is
#   called before it, on whatever number of threads.
# Seen: many of 30 calls on 900 cells for 7 ranks give other owners than all calls before. After SCOTCH_randomReset they agree
#   on one thread, and differ among themselves on four. They agree on four where the context has SCOTCH_OPTIONNUMDETERMINISTIC set
#   *and* its random numbers are reset; neither of the two is enough.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install libscotch-dev=7.0.3-2 libscotch-7.0=7.0.3-2
for deb in *.deb; do dpkg -x "$deb" .; done
lib="$work/usr/lib/x86_64-linux-gnu"
export LD_LIBRARY_PATH="$lib"

cat > a.c <<'E'
#include <stdint.h>
#include <stdio.h>
#include <scotch.h>
#include <string.h>
enum { side = 30, n_cells = side * side, n_calls = 30 };
SCOTCH_Num first[n_cells + 1], neighbour[4 * n_cells], owner[n_cells], seen[n_calls][n_cells];

void make_squares(void) {
    SCOTCH_Num n = 0;
    for (int i = 0; i < n_cells; ++i) {
        first[i] = n;
        if (i % side > 0) neighbour[n++] = i - 1;
        if (i % side < side - 1) neighbour[n++] = i + 1;
        if (i >= side) neighbour[n++] = i - side;
        if (i < n_cells - side) neighbour[n++] = i + side;
    }
    first[n_cells] = n;
}

/* Fills owner; on n_threads of its own where that is not 0. */
void part(SCOTCH_Graph* graph, int n_threads, int resets, int is_deterministic) {
    SCOTCH_Strat strategy;
    SCOTCH_stratInit(&strategy);
    if (n_threads == 0) {
        SCOTCH_graphPart(graph, 7, &strategy, owner);
    } else {
        SCOTCH_Context context;
        SCOTCH_Graph bound;
        SCOTCH_contextInit(&context);
        SCOTCH_contextThreadSpawn(&context, n_threads, NULL);
        SCOTCH_contextOptionSetNum(&context, SCOTCH_OPTIONNUMDETERMINISTIC, is_deterministic);
        if (resets) {
            SCOTCH_contextRandomClone(&context);
            SCOTCH_contextRandomReset(&context);
        }
        SCOTCH_graphInit(&bound);
        SCOTCH_contextBindGraph(&context, graph, &bound);
        SCOTCH_graphPart(&bound, 7, &strategy, owner);
        SCOTCH_graphExit(&bound);
        SCOTCH_contextExit(&context);
    }
    SCOTCH_stratExit(&strategy);
}

int n_results(int n_threads, int resets, int is_deterministic) {
    SCOTCH_Graph graph;
    SCOTCH_graphInit(&graph);
    SCOTCH_graphBuild(&graph, 0, n_cells, first, NULL, NULL, NULL, first[n_cells], neighbour, NULL);
    int n = 0;
    for (int call = 0; call < n_calls; ++call) {
        part(&graph, n_threads, resets, is_deterministic);
        int known = 0;
        while (known < n && memcmp(seen[known], owner, sizeof owner) != 0) ++known;
        if (known == n) memcpy(seen[n++], owner, sizeof owner);
    }
    SCOTCH_graphExit(&graph);
    return n;
}

const char* number(int n) { return n == 1 ? "one result" : "several results"; }

int main(void) {
    make_squares();
    printf("as it is: %s\n", number(n_results(0, 0, 0)));
    printf("one thread, not reset: %s\n", number(n_results(1, 0, 0)));
    printf("one thread, reset: %s\n", number(n_results(1, 1, 0)));
    printf("four threads, reset: %s\n", number(n_results(4, 1, 0)));
    printf("four threads, deterministic, not reset: %s\n", number(n_results(4, 0, 1)));
    printf("four threads, deterministic, reset: %s\n", number(n_results(4, 1, 1)));
}
E
gcc -I"$work/usr/include/scotch" a.c -L"$lib" -lscotch -lscotcherr -lm -lpthread -o a
./a | tee output
diff output - <<'E'
as it is: several results
one thread, not reset: several results
one thread, reset: one result
four threads, reset: several results
four threads, deterministic, not reset: several results
four threads, deterministic, reset: one result
E
