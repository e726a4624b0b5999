/* long_calls [rounds]: a million rounds of step, pairs, friction, report and state take no more memory than the first 10,000.
   Each tenth round has a step that is refused and goes on from its state, each thousandth makes the contact again.

   One page more is allowed, for buffers of the C library: a block of malloc has 32 bytes at least, so that one lost in each
   2,000 rounds is seen. Below 100,000 rounds memory is printed and not judged: that is for checkers of memory, which count
   blocks themselves and keep what is freed. */
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "abut.h"

enum { n_nodes = 8, n_faces = 8, state_capacity = 4096 };

/* [kB] without pages of libraries, which come as their code is first used. From the page tables: what statm and getrusage
   tell is a sum over processors that lags behind by dozens of pages. */
static long own_memory(void) {
    char line[256];
    long kilobytes = -1;
    FILE* file = fopen("/proc/self/smaps_rollup", "r");
    while (file != NULL && kilobytes < 0 && fgets(line, sizeof(line), file) != NULL)
        sscanf(line, "Anonymous: %ld", &kilobytes);
    if (kilobytes < 0) exit(2);
    fclose(file);
    return kilobytes;
}

/* Two unit squares one over the other, the upper one lowered by so much and moved aside, so that it rubs. */
static void place(double by, double aside, double* x) {
    static const double square[8] = {0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0, 1.0};
    for (int i = 0; i < 8; ++i) x[i] = square[i], x[8 + i] = square[i] + (i % 2 == 0 ? 0.2 + aside : 1.1 - by);
}

static abut_contact* made(abut_array rest) {
    static const int32_t corners[2 * n_faces] = {0, 1, 1, 2, 2, 3, 3, 0, 4, 5, 5, 6, 6, 7, 7, 4};
    static const int32_t body[n_faces] = {0, 0, 0, 0, 1, 1, 1, 1};
    static const double depth[n_faces] = {0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1}, stiffness[2] = {3.0, 6.0};
    static const double shear_stiffness[2] = {1.0, 2.0};
    abut_options options;
    abut_options_init(&options);
    options.friction = 0.3;
    abut_faces faces = ABUT_FACES_INIT;
    faces.n_faces = n_faces, faces.nodes = corners, faces.n_nodes = 2 * n_faces, faces.body = body;
    faces.depth = depth, faces.stiffness = stiffness, faces.n_bodies = 2;
    faces.shear_stiffness = shear_stiffness;
    abut_contact* contact = NULL;
    abut_create(2, rest, &faces, &options, &contact, NULL);
    return contact;
}

int main(int argc, char** argv) {
    const long rounds = argc > 1 ? atol(argv[1]) : 1000000, warm_up = rounds < 20000 ? rounds / 2 : 10000;
    /* Pressed in, deeper, apart, and so far apart that the list does not hold. */
    static const double lowered[4] = {0.13, 0.15, 0.0, -0.9};
    double x[4][2 * n_nodes], broken[2 * n_nodes], force[2 * n_nodes];
    abut_array at[4];
    for (int i = 0; i < 4; ++i) {
        place(lowered[i], 0.05 * (i % 2), x[i]);
        at[i] = (abut_array){x[i], n_nodes, 2, 1};
    }
    place(0.0, 0.0, broken);
    broken[11] = (double)NAN;
    const abut_array not_finite = {broken, n_nodes, 2, 1}, f = {force, n_nodes, 2, 1};

    abut_contact* contact = NULL;
    int64_t pairs_seen = 0, faces_seen = 0, refused = 0, n = 0;
    long warm = 0;
    for (long round = 0; round < rounds; ++round) {
        if (round == warm_up) warm = own_memory();
        if (round % 1000 == 0) {
            abut_destroy(contact);
            contact = made(at[2]);
            if (abut_step(contact, 1.0, at[2], at[0], ABUT_MEAN, f, NULL, NULL) != ABUT_OK) return puts("no first step"), 1;
        }
        abut_error error = ABUT_ERROR_INIT;
        abut_step_result result = ABUT_STEP_RESULT_INIT;
        abut_report report = ABUT_REPORT_INIT;
        abut_pair pairs[4];
        abut_face_friction faces[8];
        unsigned char state[state_capacity];
        const abut_array from = at[round % 4], to = at[(round + 1) % 4];
        const int is_tenth = round % 10 == 9;
        if (is_tenth) refused += abut_step(contact, 1.0, from, not_finite, ABUT_MEAN, f, &result, &error) == ABUT_DIVERGED;
        if (abut_step(contact, 1.0, from, to, ABUT_MEAN, f, &result, &error) != ABUT_OK ||
            abut_pairs(contact, pairs, sizeof(abut_pair), 4, &n, &error) != ABUT_OK ||
            abut_get_report(contact, &report, &error) != ABUT_OK || report.missed_contacts != 0) {
            printf("round %ld: %s, %" PRId64 " missed\n", round, error.message, report.missed_contacts);
            return 1;
        }
        pairs_seen += n;
        if (abut_friction(contact, faces, sizeof(abut_face_friction), 8, &n, &error) != ABUT_OK) return puts(error.message), 1;
        faces_seen += n;
        if (abut_save(contact, state, state_capacity, &n, &error) != ABUT_OK || n > state_capacity ||
            (is_tenth && abut_restore(contact, state, n, &error) != ABUT_OK)) {
            printf("round %ld: state of %" PRId64 " bytes: %s\n", round, n, error.message);
            return 1;
        }
    }
    const long growth = own_memory() - warm;
    abut_destroy(contact);
    printf("%ld rounds, %" PRId64 " pairs, %" PRId64 " faces with friction, %" PRId64 " refused: %ld kB more than the %ld kB after %ld rounds\n", rounds,
           pairs_seen, faces_seen, refused, growth, warm, warm_up);
    return refused == rounds / 10 && pairs_seen > rounds / 2 && faces_seen > rounds / 2 && (rounds < 100000 || growth <= 4) ? 0 : 1;
}
