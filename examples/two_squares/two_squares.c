/* Contact in a solver of one's own, in C: two squares of four nodes each run into each other and part. */
#include <stdio.h>
#include <string.h>

#include "abut.h"

int main(void) {
    /* Two unit squares, 0.05 m apart; faces run so that their body lies to the left */
    const double rest[8][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {1.05, 0.1}, {2.05, 0.1}, {2.05, 1.1}, {1.05, 1.1}};
    const int32_t nodes[16] = {0, 1, 1, 2, 2, 3, 3, 0, 4, 5, 5, 6, 6, 7, 7, 4}, body[8] = {0, 0, 0, 0, 1, 1, 1, 1};
    const double depth[8] = {0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5}; /* [m] half the height of the element behind a face */
    const double mass[8] = {0.25, 0.25, 0.25, 0.25, 0.25, 0.25, 0.25, 0.25}; /* [kg/m] */
    double x_0[8][2], x_1[8][2], force[8][2], v[8][2] = {{0.1}, {0.1}, {0.1}, {0.1}, {-0.1}, {-0.1}, {-0.1}, {-0.1}},
                                              k = 0.0;
    abut_contact* contact = NULL;
    abut_error error = ABUT_ERROR_INIT;
    abut_stable stable = ABUT_STABLE_INIT;
    abut_step_result result = ABUT_STEP_RESULT_INIT;
    abut_report report = ABUT_REPORT_INIT;
    abut_skin_stiffness(1.0, depth, 8, &k, &error); /* lambda + 2 mu = 1 Pa */
    const double stiffness[2] = {k, k};
    abut_faces faces = ABUT_FACES_INIT;
    faces.n_faces = 8, faces.n_nodes = 16, faces.n_bodies = 2;
    faces.nodes = nodes, faces.body = body, faces.depth = depth, faces.stiffness = stiffness;
    const abut_array at_rest = {(double*)rest, 8, 2, 1}, from = {*x_0, 8, 2, 1}, to = {*x_1, 8, 2, 1}, f = {*force, 8, 2, 1};
    if (abut_create(2, at_rest, &faces, NULL, &contact, &error) != ABUT_OK) return puts(error.message), 1;

    abut_stable_step(contact, mass, 8, 2.0, &stable, &error); /* 2 rad/s: the fastest swing of a square alone */
    memcpy(x_0, rest, sizeof(rest));
    for (int step = 0; step < 4.0 / stable.dt; ++step) {
        memset(force, 0, sizeof(force));
        for (int i = 0; i < 16; ++i) x_1[i / 2][i % 2] = x_0[i / 2][i % 2] + stable.dt * v[i / 2][i % 2];
        /* all there is to contact */
        if (abut_step(contact, stable.dt, from, to, ABUT_END, f, &result, &error) != ABUT_OK) return puts(error.message), 1;
        for (int b = 0; b < 8; b += 4) /* your elements: here springs to the mean motion */
            for (int i = 0; i < 2; ++i) {
                double mean = 0.0;
                for (int n = b; n < b + 4; ++n) mean += (x_1[n][i] - rest[n][i]) / 4;
                for (int n = b; n < b + 4; ++n) force[n][i] -= x_1[n][i] - rest[n][i] - mean;
            }
        for (int i = 0; i < 16; ++i) v[i / 2][i % 2] += stable.dt / mass[i / 2] * force[i / 2][i % 2];
        memcpy(x_0, x_1, sizeof(x_1));
    }
    abut_get_report(contact, &report, &error);
    printf("left (%.3f, %.3f), right (%.3f, %.3f), missed contacts: %d\n", (v[0][0] + v[1][0] + v[2][0] + v[3][0]) / 4,
           (v[0][1] + v[1][1] + v[2][1] + v[3][1]) / 4, (v[4][0] + v[5][0] + v[6][0] + v[7][0]) / 4,
           (v[4][1] + v[5][1] + v[6][1] + v[7][1]) / 4, (int)report.missed_contacts);
    abut_destroy(contact);
    return 0;
}
