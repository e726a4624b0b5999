/* A finite element code in C with contact by Abut: two discs of triangles run into each other off centre and slip off.

   R = E = rho = 1, nu = 0.3, plane strain, small strain, at +-0.05 along x, centres 0.8 apart along y; central differences. Other
   codes of this kind find that the left disc leaves at (-0.0279, -0.0400). Prints its velocity, and writes forces of the step of
   the deepest contact to a file if one is named, other than "-". A second argument is a coefficient of friction, up to 0.08, so
   that the discs slide all along: friction then takes what it takes from rigid discs, to 5 %. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "abut.h"

enum { rings = 13, disc_nodes = 1 + 3 * rings * (rings + 1), disc_elements = 6 * rings * rings, disc_faces = 6 * rings };
enum { n_nodes = 2 * disc_nodes, n_elements = 2 * disc_elements, n_faces = 2 * disc_faces };

static double rest[n_nodes][2], x[n_nodes][2], next[n_nodes][2], v[n_nodes][2], f[n_nodes][2], mass[n_nodes];
static int32_t element[n_elements][3], face[n_faces][2], body[n_faces];
static double slope[n_elements][3][2], area[n_elements], depth[n_faces];
static const double lambda = 0.3 / (1.3 * 0.4), mu = 0.5 / 1.3, pi = 3.14159265358979323846;

/* Node k of ring r: ring r has 6 r nodes, the centre is ring 0. */
static int node(int r, int k) { return r == 0 ? 0 : 1 + 3 * r * (r - 1) + (k + 6 * r) % (6 * r); }

static void make_disc(int b, double x_0, double y_0, double turn) {
    const int first = b * disc_nodes;
    int e = b * disc_elements, last_element[disc_faces];
    for (int r = 0; r <= rings; ++r)
        for (int k = 0; k < (r == 0 ? 1 : 6 * r); ++k) {
            const double angle = r == 0 ? 0.0 : 2.0 * pi * k / (6 * r) + turn, radius = (double)r / rings;
            rest[first + node(r, k)][0] = x_0 + radius * cos(angle);
            rest[first + node(r, k)][1] = y_0 + radius * sin(angle);
        }
    for (int r = 1; r <= rings; ++r)
        for (int side = 0; side < 6; ++side)
            for (int k = 0; k < r; ++k) {
                const int out = side * r + k, in = side * (r - 1) + k;
                if (r == rings) last_element[out] = e;
                const int32_t outer[3] = {node(r - 1, in), node(r, out), node(r, out + 1)};
                for (int i = 0; i < 3; ++i) element[e][i] = first + outer[i];
                ++e;
                if (k == r - 1) continue;
                const int32_t inner[3] = {node(r - 1, in), node(r, out + 1), node(r - 1, in + 1)};
                for (int i = 0; i < 3; ++i) element[e][i] = first + inner[i];
                ++e;
            }
    for (e = b * disc_elements; e < (b + 1) * disc_elements; ++e) {
        const int32_t* n = element[e];
        for (int i = 0; i < 3; ++i) { /* of the shape functions, times twice the area */
            const double *p = rest[n[(i + 1) % 3]], *q = rest[n[(i + 2) % 3]];
            slope[e][i][0] = p[1] - q[1], slope[e][i][1] = q[0] - p[0];
        }
        area[e] = 0.5 * (slope[e][1][0] * slope[e][2][1] - slope[e][1][1] * slope[e][2][0]);
        for (int i = 0; i < 3; ++i) {
            slope[e][i][0] /= 2.0 * area[e], slope[e][i][1] /= 2.0 * area[e];
            mass[n[i]] += area[e] / 3.0;
        }
    }
    for (int k = 0; k < disc_faces; ++k) {
        const int i = b * disc_faces + k;
        face[i][0] = first + node(rings, k), face[i][1] = first + node(rings, k + 1);
        body[i] = b;
        const double *p = rest[face[i][0]], *q = rest[face[i][1]];
        depth[i] = area[last_element[k]] / hypot(q[0] - p[0], q[1] - p[1]); /* half the height of the element */
    }
}

/* Forces of linear elasticity at x. */
static void add_elastic_forces(void) {
    for (int e = 0; e < n_elements; ++e) {
        double g[2][2] = {{0.0, 0.0}, {0.0, 0.0}};
        for (int i = 0; i < 3; ++i)
            for (int a = 0; a < 2; ++a)
                for (int b = 0; b < 2; ++b) g[a][b] += (x[element[e][i]][a] - rest[element[e][i]][a]) * slope[e][i][b];
        const double trace = lambda * (g[0][0] + g[1][1]), shear = mu * (g[0][1] + g[1][0]);
        const double stress[2][2] = {{trace + 2.0 * mu * g[0][0], shear}, {shear, trace + 2.0 * mu * g[1][1]}};
        for (int i = 0; i < 3; ++i)
            for (int a = 0; a < 2; ++a)
                f[element[e][i]][a] -= area[e] * (stress[a][0] * slope[e][i][0] + stress[a][1] * slope[e][i][1]);
    }
}

/* The largest eigenvalue of M^-1 K is at most the largest one of an element, and that is at most its trace. */
static double highest_frequency(void) {
    double largest = 0.0;
    for (int e = 0; e < n_elements; ++e) {
        double sum = 0.0;
        for (int i = 0; i < 3; ++i)
            sum += 3.0 * (lambda + 3.0 * mu) * (slope[e][i][0] * slope[e][i][0] + slope[e][i][1] * slope[e][i][1]);
        if (sum > largest) largest = sum;
    }
    return sqrt(largest);
}

/* Rigid discs meet with the normal impulse of discs without friction, and each kg m/s along their faces slows sliding by 3/m on
   each disc. Over K0. */
static double taken_from_rigid_discs(double friction) {
    const double impulse = hypot(0.0279 + 0.05, 0.0400), sliding = 0.1 * 0.0400 / impulse;
    return friction * impulse * (sliding - 3.0 * friction * impulse) / (0.05 * 0.05);
}

static void stop(const char* what, const abut_error* error) {
    fprintf(stderr, "%s: %s\n", what, error->message);
    exit(1);
}

int main(int argc, char** argv) {
    const double friction = argc > 2 ? atof(argv[2]) : 0.0;
    make_disc(0, 0.0, 0.0, 0.0);
    make_disc(1, sqrt(2.02 * 2.02 - 0.8 * 0.8), 0.8, 0.1);

    abut_error error = ABUT_ERROR_INIT;
    double k = 0.0;
    if (abut_skin_stiffness(lambda + 2.0 * mu, depth, n_faces, &k, &error) != ABUT_OK) stop("stiffness", &error);
    const double k_shear = mu / (lambda + 2.0 * mu) * k, stiffness[2] = {k, k}, shear_stiffness[2] = {k_shear, k_shear};
    abut_faces faces = ABUT_FACES_INIT;
    faces.n_faces = n_faces, faces.n_nodes = 2 * n_faces, faces.n_bodies = 2;
    faces.nodes = &face[0][0], faces.body = body, faces.depth = depth, faces.stiffness = stiffness;
    faces.shear_stiffness = shear_stiffness; /* friction alone reads it */
    abut_options options;
    abut_options_init(&options);
    options.friction = friction;
    const abut_array at_rest = {&rest[0][0], n_nodes, 2, 1}, from = {&x[0][0], n_nodes, 2, 1}, to = {&next[0][0], n_nodes, 2, 1},
                     force = {&f[0][0], n_nodes, 2, 1};
    abut_contact* contact = NULL;
    if (abut_create(2, at_rest, &faces, &options, &contact, &error) != ABUT_OK) stop("create", &error);
    abut_stable stable = ABUT_STABLE_INIT;
    if (abut_stable_step(contact, mass, n_nodes, highest_frequency(), &stable, &error) != ABUT_OK) stop("step", &error);

    memcpy(x, rest, sizeof(x));
    for (int i = 0; i < n_nodes; ++i) v[i][0] = i < disc_nodes ? 0.05 : -0.05; /* at half steps */
    abut_step_result result = ABUT_STEP_RESULT_INIT;
    double deepest = 0.0, of_deepest[n_nodes][2] = {{0.0}};
    int64_t steps = 0;
    for (double time = 0.0; time < 15.0; time += stable.dt, ++steps) {
        for (int i = 0; i < n_nodes; ++i)
            for (int d = 0; d < 2; ++d) next[i][d] = x[i][d] + stable.dt * v[i][d];
        memset(f, 0, sizeof(f));
        if (abut_step(contact, stable.dt, from, to, ABUT_END, force, &result, &error) != ABUT_OK) stop("contact", &error);
        if (result.energy > deepest) deepest = result.energy, memcpy(of_deepest, f, sizeof(f));
        memcpy(x, next, sizeof(x));
        add_elastic_forces();
        for (int i = 0; i < n_nodes; ++i)
            for (int d = 0; d < 2; ++d) v[i][d] += stable.dt * f[i][d] / mass[i];
    }

    double momentum[2] = {0.0, 0.0}, of_left = 0.0, all[2] = {0.0, 0.0};
    for (int i = 0; i < n_nodes; ++i)
        for (int d = 0; d < 2; ++d) {
            all[d] += mass[i] * v[i][d];
            if (i < disc_nodes) momentum[d] += mass[i] * v[i][d], of_left += 0.5 * mass[i];
        }
    const double left[2] = {momentum[0] / of_left, momentum[1] / of_left};
    abut_report report = ABUT_REPORT_INIT;
    abut_get_report(contact, &report, &error);
    printf("%lld steps of %.4f, left disc: (%.4f, %.4f), momentum of both %.0e, %lld missed\n", (long long)steps, stable.dt, left[0],
           left[1], hypot(all[0], all[1]), (long long)report.missed_contacts);
    if (argc > 1 && strcmp(argv[1], "-") != 0) {
        FILE* file = fopen(argv[1], "wb");
        if (file == NULL || fwrite(of_deepest, sizeof(of_deepest), 1, file) != 1 || fclose(file) != 0) return 1;
    }
    abut_destroy(contact);
    if (report.missed_contacts != 0) return 1;
    if (friction == 0.0) return hypot(left[0] + 0.0279, left[1] + 0.0400) < 0.01 * 0.0488 ? 0 : 1;
    const double taken = report.friction_dissipated / (of_left * 0.05 * 0.05), expected = taken_from_rigid_discs(friction);
    printf("friction took %.4f of K0, %.4f of rigid discs\n", taken, expected);
    return fabs(taken - expected) < 0.05 * expected ? 0 : 1;
}
