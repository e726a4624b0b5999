/* Every function of abut.h, called from C99. Two unit squares one over the other: the expected values follow from their geometry. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "abut.h"

static int failures = 0;
#define CHECK(condition)                                                     \
    do {                                                                     \
        if (!(condition)) {                                                  \
            printf("%s:%d: failed: %s\n", __FILE__, __LINE__, #condition);   \
            ++failures;                                                      \
        }                                                                    \
    } while (0)

enum { n_nodes = 8, n_faces = 8 };
/* Counter-clockwise: the outside is on the right of each segment. */
static const double rest[2 * n_nodes] = {0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0, 1.0, 0.2, 1.1, 1.2, 1.1, 1.2, 2.1, 0.2, 2.1};
static const int32_t corners[2 * n_faces] = {0, 1, 1, 2, 2, 3, 3, 0, 4, 5, 5, 6, 6, 7, 7, 4};
static const int32_t body[n_faces] = {0, 0, 0, 0, 1, 1, 1, 1};
static const double depth[n_faces] = {0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1};
static const double stiffness[2] = {3.0, 6.0};       /* in series: 2 */
static const double shear_stiffness[2] = {1.0, 2.0}; /* in series: 2/3 */

static abut_faces faces_from(int32_t base, const int32_t* nodes, const int32_t* of_body) {
    abut_faces faces = ABUT_FACES_INIT;
    faces.n_faces = n_faces;
    faces.nodes = nodes;
    faces.n_nodes = 2 * n_faces;
    faces.body = of_body;
    faces.depth = depth;
    faces.stiffness = stiffness;
    faces.n_bodies = 2;
    faces.index_base = base;
    return faces;
}

static abut_array packed(double* data) {
    abut_array array = {data, n_nodes, 2, 1};
    return array;
}
static const abut_array nothing = {NULL, 0, 0, 0};

/* The upper square moved down by so much. */
static void lowered(double by, double* x) {
    memcpy(x, rest, sizeof(rest));
    for (int i = 4; i < n_nodes; ++i) x[2 * i + 1] -= by;
}

static abut_contact* made(const abut_options* options) {
    abut_error error = ABUT_ERROR_INIT;
    const abut_faces faces = faces_from(0, corners, body);
    abut_contact* contact = NULL;
    double x[2 * n_nodes];
    lowered(0.0, x);
    CHECK(abut_create(2, packed(x), &faces, options, &contact, &error) == ABUT_OK);
    CHECK(contact != NULL && error.status == ABUT_OK);
    return contact;
}

static int upper_on_lower(int32_t face_1, int32_t face_2, void* user) {
    ++*(int*)user;
    return face_1 + face_2 == 2 + 4;
}

/* Overlapping by d at the start on purpose: W grows from 0 to k/2 d^2 0.8, which is work from outside. */
static void an_overlap_on_purpose_comes_to_act(void) {
    abut_options options;
    abut_options_init(&options);
    int asked = 0;
    options.interference_time = 0.5, options.interferes = upper_on_lower, options.user = &asked;
    abut_contact* contact = made(&options);
    abut_error error = ABUT_ERROR_INIT;
    abut_step_result result = ABUT_STEP_RESULT_INIT;
    double x[2 * n_nodes], work = 0.0;
    const double d = 0.05, k = 2.0;
    lowered(0.1 + d, x);
    for (int i = 0; i < 6; ++i) {
        CHECK(abut_step(contact, 0.1, packed(x), packed(x), ABUT_MEAN, nothing, &result, &error) == ABUT_OK);
        work += result.interference_work;
        CHECK(fabs(work - result.energy) < 1e-15);
    }
    CHECK(asked > 0 && result.interference_work == 0.0 && fabs(result.energy - 0.5 * k * d * d * 0.8) < 1e-15);
    abut_destroy(contact);
    const abut_faces faces = faces_from(0, corners, body);
    options.interference_time = 0.0;
    CHECK(abut_create(2, packed(x), &faces, &options, &contact, &error) == ABUT_BAD_INPUT);
    CHECK(strstr(error.message, "no `interference_time`") != NULL);
}

/* Pressed in by d over a width of 0.8: W = k/2 d^2 0.8, and the force is k d 0.8. */
static void presses_by_the_spring_in_series(void) {
    abut_contact* contact = made(NULL);
    abut_error error = ABUT_ERROR_INIT;
    abut_step_result result = ABUT_STEP_RESULT_INIT;
    double x_0[2 * n_nodes], x_1[2 * n_nodes], force[2 * n_nodes] = {0.0};
    const double d = 0.05, k = 2.0;
    lowered(0.0, x_0);
    lowered(0.1 + d, x_1);
    CHECK(abut_step(contact, 1.0, packed(x_0), packed(x_0), ABUT_END, nothing, NULL, NULL) == ABUT_OK);
    CHECK(abut_step(contact, 1.0, packed(x_0), packed(x_1), ABUT_END, packed(force), &result, &error) == ABUT_OK);
    CHECK(result.active_pairs == 1 && fabs(result.energy - 0.5 * k * d * d * 0.8) < 1e-15);
    double up = 0.0, down = 0.0;
    for (int i = 0; i < 4; ++i) down += force[2 * i + 1], up += force[2 * (i + 4) + 1];
    CHECK(fabs(up - k * d * 0.8) < 1e-14 && fabs(up + down) < 1e-15);

    abut_pair pair;
    int64_t n = 0;
    CHECK(abut_pairs(contact, NULL, sizeof(abut_pair), 0, &n, &error) == ABUT_OK && n == 1);
    CHECK(abut_pairs(contact, &pair, sizeof(abut_pair), 1, &n, &error) == ABUT_OK);
    CHECK(pair.face_1 == 2 && pair.face_2 == 4 && fabs(pair.normal[1] - 1.0) < 1e-15 && pair.normal[2] == 0.0);
    CHECK(fabs(pair.gap_1 + d) < 1e-15 && fabs(pair.area - 0.8) < 1e-15 && fabs(pair.force[1] - up) < 1e-15);
    CHECK(fabs(pair.compression - d / 0.2) < 1e-14);
    CHECK(abut_pairs(contact, &pair, sizeof(abut_pair) - 8, 1, &n, &error) == ABUT_MISUSE);

    abut_body bodies[2];
    CHECK(abut_bodies(contact, bodies, sizeof(abut_body), 2, &n, &error) == ABUT_OK && n == 2);
    CHECK(bodies[0].body == 0 && fabs(bodies[0].force[1] - down) < 1e-15 && fabs(bodies[1].force[1] - up) < 1e-15);
    /* In the middle of the overlap, from 0.2 to 1; and what pushes its end aside, k d^2/2, halfway between the faces: at
       1.025 + d/2, the face itself being at 1.025 in the middle of the step. */
    CHECK(fabs(fabs(bodies[1].force[0]) - 0.5 * k * d * d) < 1e-15);
    CHECK(fabs(bodies[1].moment[2] - 0.6 * up + (1.025 + 0.5 * d) * bodies[1].force[0]) < 1e-14);
    abut_body_pair of_bodies;
    CHECK(abut_body_pairs(contact, &of_bodies, sizeof(abut_body_pair), 1, &n, &error) == ABUT_OK && n == 1);
    CHECK(of_bodies.body_1 == 0 && of_bodies.body_2 == 1 && fabs(of_bodies.normal_force - up) < 1e-15);

    abut_report report = ABUT_REPORT_INIT;
    CHECK(abut_get_report(contact, &report, &error) == ABUT_OK);
    CHECK(report.missed_contacts == 0 && report.active_pairs == 1 && report.rebuilds >= 1);

    double energy = 0.0;
    lowered(0.1 + 2.0 * d, x_1);
    CHECK(abut_evaluate(contact, packed(x_1), nothing, &energy, &error) == ABUT_OK);
    CHECK(fabs(energy - 4.0 * 0.5 * k * d * d * 0.8) < 1e-14);
    abut_destroy(contact);
}

/* The mean of the force times the motion is the energy, whatever the step. */
static void mean_force_is_exact_for_energy(void) {
    abut_contact* contact = made(NULL);
    abut_step_result result = ABUT_STEP_RESULT_INIT;
    double x_0[2 * n_nodes], x_1[2 * n_nodes], force[2 * n_nodes] = {0.0}, work = 0.0;
    lowered(0.0, x_0);
    CHECK(abut_step(contact, 1.0, packed(x_0), packed(x_0), ABUT_MEAN, nothing, NULL, NULL) == ABUT_OK);
    lowered(0.17, x_1);
    x_1[9] += 0.02; /* one corner less: it turns, too */
    CHECK(abut_step(contact, 1.0, packed(x_0), packed(x_1), ABUT_MEAN, packed(force), &result, NULL) == ABUT_OK);
    for (int i = 0; i < 2 * n_nodes; ++i) work += force[i] * (x_1[i] - x_0[i]);
    CHECK(result.energy > 1e-4 && fabs(work + result.energy - result.energy_0) < 1e-16);
    abut_destroy(contact);
}

/* u(3, n), u[n][3] and one array per component are the same points; indices from 1 are the same faces. */
static void any_strides_and_bases(void) {
    abut_contact *by_one = NULL, *contact = made(NULL);
    abut_error error = ABUT_ERROR_INIT;
    double x[2 * n_nodes], y[2 * n_nodes], columns_x[2 * n_nodes], columns_y[2 * n_nodes];
    double force[2 * n_nodes] = {0.0}, columns[2 * n_nodes] = {0.0};
    int32_t corners_from_1[2 * n_faces], body_from_1[n_faces];
    for (int i = 0; i < 2 * n_faces; ++i) corners_from_1[i] = corners[i] + 1;
    for (int i = 0; i < n_faces; ++i) body_from_1[i] = body[i] + 1;
    const abut_faces faces = faces_from(1, corners_from_1, body_from_1);
    lowered(0.0, x);
    lowered(0.14, y);
    for (int i = 0; i < n_nodes; ++i)
        for (int d = 0; d < 2; ++d) columns_x[d * n_nodes + i] = x[2 * i + d], columns_y[d * n_nodes + i] = y[2 * i + d];
    const abut_array from_x = {columns_x, n_nodes, 1, n_nodes}, from_y = {columns_y, n_nodes, 1, n_nodes};
    const abut_array to = {columns, n_nodes, 1, n_nodes};
    CHECK(abut_create(2, from_x, &faces, NULL, &by_one, &error) == ABUT_OK);
    CHECK(abut_step(by_one, 1.0, from_x, from_x, ABUT_MEAN, nothing, NULL, &error) == ABUT_OK);
    CHECK(abut_step(by_one, 1.0, from_x, from_y, ABUT_MEAN, to, NULL, &error) == ABUT_OK);
    CHECK(abut_step(contact, 1.0, packed(x), packed(x), ABUT_MEAN, nothing, NULL, &error) == ABUT_OK);
    CHECK(abut_step(contact, 1.0, packed(x), packed(y), ABUT_MEAN, packed(force), NULL, &error) == ABUT_OK);
    for (int i = 0; i < n_nodes; ++i)
        for (int d = 0; d < 2; ++d) CHECK(columns[d * n_nodes + i] == force[2 * i + d]);
    abut_pair pair;
    int64_t n = 0;
    CHECK(abut_pairs(by_one, &pair, sizeof(pair), 1, &n, &error) == ABUT_OK && pair.face_1 == 3 && pair.face_2 == 5);
    abut_stable stable = ABUT_STABLE_INIT;
    const double mass[n_nodes] = {1, 1, 1, 1, 1, 1, 1, 1};
    CHECK(abut_stable_step(by_one, mass, n_nodes, 1.0, &stable, &error) == ABUT_OK);
    /* omega^2 = 1 + twice 2 times the share of two faces, 1/2 each, over 1 kg */
    CHECK(fabs(stable.omega - sqrt(5.0)) < 1e-14 && fabs(stable.dt - 1.7 / sqrt(5.0)) < 1e-14 && stable.node >= 1);
    CHECK(strstr(stable.reason, "estimate") != NULL);
    abut_destroy(by_one);
    abut_destroy(contact);
}

static void state_goes_on_with_the_same_bits(void) {
    abut_contact *contact = made(NULL), *again = made(NULL);
    abut_error error = ABUT_ERROR_INIT;
    double x[2 * n_nodes], y[2 * n_nodes], z[2 * n_nodes], force[2 * n_nodes] = {0.0}, other[2 * n_nodes] = {0.0};
    lowered(0.0, x);
    lowered(0.15, y);
    lowered(0.16, z);
    CHECK(abut_step(contact, 1.0, packed(x), packed(x), ABUT_MEAN, nothing, NULL, &error) == ABUT_OK);
    CHECK(abut_step(contact, 1.0, packed(x), packed(y), ABUT_MEAN, nothing, NULL, &error) == ABUT_OK);
    int64_t n = 0;
    CHECK(abut_save(contact, NULL, 0, &n, &error) == ABUT_OK && n > 0);
    unsigned char* bytes = malloc((size_t)n);
    CHECK(abut_save(contact, bytes, n, &n, &error) == ABUT_OK);
    CHECK(abut_restore(again, bytes, n, &error) == ABUT_OK);
    CHECK(abut_step(contact, 1.0, packed(y), packed(z), ABUT_MEAN, packed(force), NULL, &error) == ABUT_OK);
    CHECK(abut_step(again, 1.0, packed(y), packed(z), ABUT_MEAN, packed(other), NULL, &error) == ABUT_OK);
    CHECK(memcmp(force, other, sizeof(force)) == 0 && force[9] > 0.0);
    bytes[n / 2] ^= 1;
    CHECK(abut_restore(again, bytes, n, &error) == ABUT_BAD_INPUT);
    CHECK(abut_restore(again, bytes, 3, &error) == ABUT_BAD_INPUT);
    free(bytes);

    /* The upper body's lower face erodes; what was its left side stays. */
    int32_t fewer[2 * (n_faces - 1)], of_body[n_faces - 1], old[n_faces - 1];
    int m = 0;
    for (int face = 0; face < n_faces; ++face) {
        if (face == 4) continue;
        fewer[2 * m] = corners[2 * face], fewer[2 * m + 1] = corners[2 * face + 1];
        of_body[m] = body[face], old[m++] = face;
    }
    abut_faces faces = faces_from(0, fewer, of_body);
    faces.n_faces = m, faces.n_nodes = 2 * m;
    CHECK(abut_replace_surface(contact, packed(x), &faces, old, &error) == ABUT_OK);
    abut_step_result result = ABUT_STEP_RESULT_INIT;
    CHECK(abut_step(contact, 1.0, packed(z), packed(z), ABUT_MEAN, nothing, &result, &error) == ABUT_OK && result.active_pairs == 0);
    old[0] = old[1];
    CHECK(abut_replace_surface(contact, packed(x), &faces, old, &error) == ABUT_BAD_INPUT);
    abut_destroy(contact);
    abut_destroy(again);
}

/* The upper square moved down by so much, and aside. */
static void aside(double by, double down, double* x) {
    lowered(down, x);
    for (int i = 4; i < n_nodes; ++i) x[2 * i] += by;
}

static abut_contact* rubbing(const abut_options* options) {
    abut_error error = ABUT_ERROR_INIT;
    abut_faces faces = faces_from(0, corners, body);
    faces.shear_stiffness = shear_stiffness;
    abut_contact* contact = NULL;
    double x[2 * n_nodes], y[2 * n_nodes];
    lowered(0.0, x);
    lowered(0.15, y);
    CHECK(abut_create(2, packed(x), &faces, options, &contact, &error) == ABUT_OK);
    CHECK(abut_step(contact, 0.1, packed(x), packed(y), ABUT_MEAN, nothing, NULL, &error) == ABUT_OK);
    return contact;
}

/* Both faces, of length 1, stick by half of the 2/3 of the pair. */
static void friction_sticks_by_the_shear_in_series_and_slides_at_its_limit(void) {
    abut_options options;
    abut_options_init(&options);
    CHECK(options.friction == 0.0 && isnan(options.sliding_friction) && isinf(options.relaxation_time));
    options.friction = 0.5;
    const double s = 0.003, kappa = 2.0 / 3.0;
    for (int take = ABUT_MEAN; take <= ABUT_END; ++take) {
        abut_contact* contact = rubbing(&options);
        abut_step_result result = ABUT_STEP_RESULT_INIT;
        double x_0[2 * n_nodes], x_1[2 * n_nodes], force[2 * n_nodes] = {0.0};
        aside(0.0, 0.15, x_0);
        aside(s, 0.15, x_1);
        CHECK(abut_step(contact, 0.1, packed(x_0), packed(x_1), take, packed(force), &result, NULL) == ABUT_OK);
        CHECK(fabs(result.friction_energy - 0.5 * kappa * s * s) < 1e-17);
        CHECK(fabs(result.dissipated) < 1e-17 && result.sticking_faces == 2 && result.sliding_faces == 0);
        abut_pair pair;
        abut_face_friction faces[2];
        int64_t n = 0;
        CHECK(abut_pairs(contact, &pair, sizeof(pair), 1, &n, NULL) == ABUT_OK && n == 1);
        const double friction = take == ABUT_MEAN ? 0.5 * kappa * s : kappa * s; /* its mean, or at the end */
        CHECK(fabs(pair.friction[0] + friction) < 1e-15 && fabs(pair.friction[1]) < 1e-17 && pair.friction[2] == 0.0);
        CHECK(fabs(pair.slip[0] - s) < 1e-15 && fabs(pair.slip[1]) < 1e-17);
        CHECK(pair.point[0] > 0.55 && pair.point[0] < 0.65 && pair.point[1] > 0.9 && pair.point[1] < 1.0);
        CHECK(abut_friction(contact, NULL, sizeof(faces[0]), 0, &n, NULL) == ABUT_OK && n == 2);
        CHECK(abut_friction(contact, faces, sizeof(faces[0]) - 8, 2, &n, NULL) == ABUT_MISUSE);
        CHECK(abut_friction(contact, faces, sizeof(faces[0]), 2, &n, NULL) == ABUT_OK);
        CHECK(faces[0].face == 2 && faces[1].face == 4 && faces[0].slip == 0.0);
        CHECK(fabs(faces[0].normal_force - 0.5 * pair.normal_force) < 1e-6 && fabs(faces[1].force - 0.5 * friction) < 1e-15);
        CHECK(fabs(faces[0].limit - 0.5 * faces[0].normal_force) < 1e-15);

        const double energy = result.energy + result.friction_energy;
        double work = 0.0;
        aside(0.2, 0.15, x_0);
        memset(force, 0, sizeof(force));
        CHECK(abut_step(contact, 0.1, packed(x_1), packed(x_0), take, packed(force), &result, NULL) == ABUT_OK);
        CHECK(result.sliding_faces == 2 && result.dissipated > 1e-3);
        for (int i = 0; i < 2 * n_nodes; ++i) work += force[i] * (x_0[i] - x_1[i]);
        if (take == ABUT_MEAN)
            CHECK(fabs(work + result.energy + result.friction_energy - energy + result.dissipated) < 1e-16);
        abut_report report = ABUT_REPORT_INIT;
        CHECK(abut_get_report(contact, &report, NULL) == ABUT_OK);
        CHECK(report.friction_dissipated >= result.dissipated && report.sliding_faces == 2 && report.sliding_faces_max == 2);
        CHECK(report.sticking_faces_max == 2 && report.friction_ratio_max <= 1.0 + 1e-12 && report.least_dissipated > -1e-17);
        CHECK(report.sliding_force > 0.0 && report.sliding_force <= report.sliding_limit * (1.0 + 1e-12));
        abut_destroy(contact);
    }
}

typedef struct Laws {
    int32_t law, asked;
    double mu;
} Laws;
static int32_t tells_law(int32_t face_1, int32_t face_2, void* user) {
    Laws* laws = user;
    laws->asked += face_1 == 2 && face_2 == 4;
    return laws->law;
}
static double tells_mu(double speed, double slid, double pressure, void* user) {
    (void)speed, (void)slid, (void)pressure;
    return ((Laws*)user)->mu;
}

static void laws_of_friction_are_told_by_pair(void) {
    abut_error error = ABUT_ERROR_INIT;
    Laws laws = {0, 0, 0.25};
    abut_options options;
    abut_options_init(&options);
    options.friction = 0.5;
    abut_friction_law more[2];
    for (int i = 0; i < 2; ++i)
        more[i] = (abut_friction_law){0.125 * i, options.sliding_friction, options.decay_speed,
                                      options.decay_slip, options.shear_strength, options.relaxation_time};
    options.law_of = tells_law, options.laws = more, options.n_laws = 2, options.user = &laws;
    const double mu[4] = {0.0, 0.5, 0.0, 0.125}; /* of law -1, 0, 1, 2 */
    for (laws.law = -1; laws.law <= 2; ++laws.law) {
        abut_contact* contact = rubbing(&options);
        abut_face_friction faces[2];
        int64_t n = 0;
        CHECK(abut_friction(contact, faces, sizeof(faces[0]), 2, &n, &error) == ABUT_OK);
        CHECK(n == (mu[laws.law + 1] > 0.0 ? 2 : 0));
        if (n == 2) CHECK(fabs(faces[0].limit - mu[laws.law + 1] * faces[0].normal_force) < 1e-15);
        abut_destroy(contact);
    }
    CHECK(laws.asked >= 4);
    abut_faces faces = faces_from(0, corners, body);
    faces.shear_stiffness = shear_stiffness;
    double x[2 * n_nodes], y[2 * n_nodes];
    lowered(0.0, x);
    lowered(0.15, y);
    abut_contact* contact = NULL;
    laws.law = 3;
    CHECK(abut_create(2, packed(x), &faces, &options, &contact, &error) == ABUT_OK);
    CHECK(abut_step(contact, 1.0, packed(x), packed(y), ABUT_MEAN, nothing, NULL, &error) == ABUT_BAD_INPUT);
    CHECK(strstr(error.message, "law_of gives 3") != NULL && error.allowed == 2.0);
    abut_destroy(contact);

    options.law_of = NULL;
    CHECK(abut_create(2, packed(x), &faces, &options, &contact, &error) == ABUT_BAD_INPUT && strstr(error.message, "law_of"));
    options.law_of = tells_law;
    static const char* names[6] = {"friction", "sliding_friction", "decay_speed", "decay_slip", "shear_strength", "relaxation_time"};
    for (int i = 0; i < 6; ++i) {
        abut_friction_law wrong = more[1];
        ((double*)&wrong)[i] = -7.0;
        char text[64];
        snprintf(text, sizeof(text), "laws: %s is -7", names[i]);
        options.laws = &wrong, options.n_laws = 1;
        CHECK(abut_create(2, packed(x), &faces, &options, &contact, &error) == ABUT_BAD_INPUT && strstr(error.message, text));
    }

    options.law_of = NULL, options.laws = NULL, options.n_laws = 0, options.own_coefficient = tells_mu;
    contact = rubbing(&options);
    abut_face_friction of_faces[2];
    int64_t n = 0;
    CHECK(abut_friction(contact, of_faces, sizeof(of_faces[0]), 2, &n, &error) == ABUT_OK && n == 2);
    CHECK(fabs(of_faces[0].limit - 0.25 * of_faces[0].normal_force) < 1e-15);
    laws.mu = -0.25;
    CHECK(abut_step(contact, 1.0, packed(y), packed(y), ABUT_MEAN, nothing, NULL, &error) == ABUT_BAD_INPUT);
    CHECK(strstr(error.message, "own_coefficient is -0.25") != NULL);
    abut_destroy(contact);
}

static void friction_goes_on_after_a_restore_with_the_same_bits(void) {
    abut_options options;
    abut_options_init(&options);
    options.friction = 0.02;
    abut_contact *contact = rubbing(&options), *again = rubbing(&options);
    double x[2 * n_nodes], y[2 * n_nodes], z[2 * n_nodes], force[2 * n_nodes] = {0.0}, other[2 * n_nodes] = {0.0};
    aside(0.0, 0.15, x);
    aside(0.01, 0.15, y);
    aside(0.012, 0.155, z);
    CHECK(abut_step(contact, 0.1, packed(x), packed(y), ABUT_MEAN, nothing, NULL, NULL) == ABUT_OK);
    char state[4096];
    int64_t n = 0;
    CHECK(abut_save(contact, state, sizeof(state), &n, NULL) == ABUT_OK && n <= (int64_t)sizeof(state));
    CHECK(abut_restore(again, state, n, NULL) == ABUT_OK);
    abut_step_result result = ABUT_STEP_RESULT_INIT, other_result = ABUT_STEP_RESULT_INIT;
    CHECK(abut_step(contact, 0.1, packed(y), packed(z), ABUT_MEAN, packed(force), &result, NULL) == ABUT_OK);
    CHECK(abut_step(again, 0.1, packed(y), packed(z), ABUT_MEAN, packed(other), &other_result, NULL) == ABUT_OK);
    CHECK(memcmp(force, other, sizeof(force)) == 0 && memcmp(&result, &other_result, sizeof(result)) == 0);
    CHECK(result.dissipated > 0.0);
    abut_destroy(contact);
    abut_destroy(again);
}

typedef struct {
    int wanted, cancelled, told;
    char text[512];
} Host;
static int never(int32_t face_1, int32_t face_2, void* user) {
    (void)face_1, (void)face_2;
    ++((Host*)user)->wanted;
    return 0;
}
static int cancels(void* user) { return ++((Host*)user)->cancelled > 1; }
static void listens(int severity, const char* text, void* user) {
    Host* host = user;
    host->told += severity == ABUT_WARNING;
    strncpy(host->text, text, sizeof(host->text) - 1);
}

static void callbacks_are_called(void) {
    Host host = {0, 0, 0, {0}};
    abut_error error = ABUT_ERROR_INIT;
    abut_options options;
    abut_options_init(&options);
    CHECK(options.struct_size == sizeof(options) && options.facing_none == -0.2 && options.events == 1);
    options.wanted = never, options.cancel = cancels, options.user = &host;
    abut_contact* contact = made(&options);
    double x[2 * n_nodes], y[2 * n_nodes];
    lowered(0.0, x);
    lowered(0.15, y);
    abut_step_result result = ABUT_STEP_RESULT_INIT;
    CHECK(abut_step(contact, 1.0, packed(x), packed(y), ABUT_MEAN, nothing, &result, &error) == ABUT_OK);
    CHECK(host.wanted > 0 && result.active_pairs == 0);
    CHECK(abut_step(contact, 1.0, packed(x), packed(y), ABUT_MEAN, nothing, &result, &error) == ABUT_CANCELLED);
    CHECK(strstr(error.message, "cancelled") != NULL);
    abut_destroy(contact);

    abut_options_init(&options);
    options.log = listens, options.user = &host;
    contact = made(&options);
    CHECK(host.told == 0);
    CHECK(abut_step(contact, 1.0, packed(x), packed(x), ABUT_MEAN, nothing, NULL, &error) == ABUT_OK);
    lowered(0.19, y); /* 0.09 of D = 0.2: above the warning of 0.3 */
    CHECK(abut_step(contact, 1.0, packed(x), packed(y), ABUT_MEAN, nothing, NULL, &error) == ABUT_OK);
    CHECK(host.told == 1 && strstr(host.text, "pressed") != NULL);
    abut_destroy(contact);

    int32_t inward[2 * n_faces];
    for (int i = 0; i < n_faces; ++i) inward[2 * i] = corners[2 * i + 1], inward[2 * i + 1] = corners[2 * i];
    const abut_faces faces = faces_from(0, inward, body);
    CHECK(abut_create(2, packed(x), &faces, &options, &contact, &error) == ABUT_OK);
    CHECK(host.told == 3 && strstr(host.text, "body 1") != NULL);
    abut_destroy(contact);
}

/* A callback that calls the contact that called it. */
typedef struct Looped {
    abut_contact* contact;
    int status;
} Looped;
static int calls_back(int32_t face_1, int32_t face_2, void* user) {
    Looped* looped = user;
    double x[2 * n_nodes];
    (void)face_1, (void)face_2;
    lowered(0.0, x);
    looped->status = abut_step(looped->contact, 1.0, packed(x), packed(x), ABUT_MEAN, nothing, NULL, NULL);
    return 1;
}

static void a_contact_in_use_is_left_alone(void) {
    Looped looped = {NULL, ABUT_OK};
    abut_options options;
    abut_options_init(&options);
    options.wanted = calls_back;
    options.user = &looped;
    looped.contact = made(&options);
    double x_0[2 * n_nodes], x_1[2 * n_nodes];
    abut_step_result result = ABUT_STEP_RESULT_INIT;
    lowered(0.0, x_0);
    lowered(0.15, x_1);
    CHECK(abut_step(looped.contact, 1.0, packed(x_0), packed(x_1), ABUT_MEAN, nothing, &result, NULL) == ABUT_OK);
    CHECK(looped.status == ABUT_MISUSE && result.active_pairs == 1);
    CHECK(abut_step(looped.contact, 1.0, packed(x_1), packed(x_1), ABUT_MEAN, nothing, &result, NULL) == ABUT_OK); /* free again */
    abut_destroy(looped.contact);
}

/* A force that is too short would be lost: the step does not happen. */
static void a_force_that_ends_too_early_is_refused_before_the_step(void) {
    abut_contact* contact = made(NULL);
    abut_error error = ABUT_ERROR_INIT;
    double x_0[2 * n_nodes], x_1[2 * n_nodes], force[2 * n_nodes] = {0.0};
    lowered(0.0, x_0);
    lowered(0.15, x_1);
    int64_t n = 7;
    char before[4096], after[4096];
    int64_t n_before = 0, n_after = 0;
    CHECK(abut_step(contact, 1.0, packed(x_0), packed(x_0), ABUT_MEAN, packed(force), NULL, &error) == ABUT_OK);
    CHECK(abut_save(contact, before, sizeof(before), &n_before, &error) == ABUT_OK);
    for (int64_t count = -1; count < n_nodes; ++count) {
        const abut_array too_short = {force, count, 2, 1};
        CHECK(abut_step(contact, 1.0, packed(x_0), packed(x_1), ABUT_MEAN, too_short, NULL, &error) == ABUT_BAD_INPUT);
    }
    CHECK(error.value == 7.0 && error.allowed == 8.0);
    CHECK(abut_save(contact, after, sizeof(after), &n_after, &error) == ABUT_OK);
    CHECK(n_before == n_after && n_before < (int64_t)sizeof(before) && memcmp(before, after, (size_t)n_before) == 0);
    CHECK(abut_pairs(contact, NULL, sizeof(abut_pair), 0, &n, &error) == ABUT_OK && n == 0);
    abut_destroy(contact);
}

static void what_is_wrong_is_refused_by_name(void) {
    abut_error error = ABUT_ERROR_INIT;
    abut_contact* contact = NULL;
    double x[2 * n_nodes], y[2 * n_nodes];
    lowered(0.0, x);
    abut_faces faces = faces_from(0, corners, body);
    CHECK(abut_create(4, packed(x), &faces, NULL, &contact, &error) == ABUT_BAD_INPUT && strstr(error.message, "dim is 4"));
    CHECK(abut_create(2, packed(x), NULL, NULL, &contact, &error) == ABUT_MISUSE && strstr(error.message, "NULL"));
    faces.struct_size = 4;
    CHECK(abut_create(2, packed(x), &faces, NULL, &contact, &error) == ABUT_MISUSE && strstr(error.message, "struct_size"));
    faces = faces_from(0, NULL, body);
    CHECK(abut_create(2, packed(x), &faces, NULL, &contact, &error) == ABUT_MISUSE && strstr(error.message, "nodes is NULL"));
    faces = faces_from(1, corners, body); /* node 0 does not exist then */
    CHECK(abut_create(2, packed(x), &faces, NULL, &contact, &error) == ABUT_BAD_INPUT && error.face_1 == 1);
    faces = faces_from(7, corners, body);
    CHECK(abut_create(2, packed(x), &faces, NULL, &contact, &error) == ABUT_BAD_INPUT && strstr(error.message, "index_base is 7"));
    faces = faces_from(0, corners, body);
    abut_options options;
    abut_options_init(&options);
    options.max_pairs = -5;
    CHECK(abut_create(2, packed(x), &faces, &options, &contact, &error) == ABUT_BAD_INPUT &&
          strstr(error.message, "max_pairs is -5; 0 or more"));
    abut_options_init(&options);
    options.skin = -1.0;
    CHECK(abut_create(2, packed(x), &faces, &options, &contact, &error) == ABUT_BAD_INPUT && strstr(error.message, "skin is -1"));
    abut_options_init(&options);
    options.friction = -0.5;
    CHECK(abut_create(2, packed(x), &faces, &options, &contact, &error) == ABUT_BAD_INPUT && strstr(error.message, "friction is -0.5"));
    options.friction = 0.5;
    CHECK(abut_create(2, packed(x), &faces, &options, &contact, &error) == ABUT_BAD_INPUT && strstr(error.message, "shear_stiffness"));
    CHECK(contact == NULL);
    CHECK(abut_step(NULL, 1.0, packed(x), packed(x), ABUT_MEAN, nothing, NULL, &error) == ABUT_MISUSE);
    CHECK(abut_step(NULL, 1.0, packed(x), packed(x), ABUT_MEAN, nothing, NULL, NULL) == ABUT_MISUSE); /* nobody asks why */

    contact = made(NULL);
    CHECK(abut_step(contact, 0.0, packed(x), packed(x), ABUT_MEAN, nothing, NULL, &error) == ABUT_BAD_INPUT &&
          strstr(error.message, "dt = 0 s"));
    CHECK(abut_step(contact, 1.0, packed(x), packed(x), 7, nothing, NULL, &error) == ABUT_BAD_INPUT);
    CHECK(abut_step(contact, 1.0, packed(x), packed(x), ABUT_MEAN, nothing, NULL, &error) == ABUT_OK);
    lowered(0.0, y);
    y[11] = (double)NAN;
    CHECK(abut_step(contact, 1.0, packed(x), packed(y), ABUT_MEAN, nothing, NULL, &error) == ABUT_DIVERGED && error.face_1 >= 4);
    lowered(0.8, y);
    CHECK(abut_step(contact, 1.0, packed(x), packed(y), ABUT_MEAN, nothing, NULL, &error) == ABUT_TOO_DEEP);
    CHECK(error.value > 2.0 && error.allowed == 2.0);
    abut_array fewer = packed(x);
    fewer.count = 5;
    CHECK(abut_step(contact, 1.0, fewer, fewer, ABUT_MEAN, nothing, NULL, &error) == ABUT_BAD_INPUT);
    fewer.count = -1;
    CHECK(abut_step(contact, 1.0, fewer, fewer, ABUT_MEAN, nothing, NULL, &error) == ABUT_BAD_INPUT);
    abut_error of_another_version = ABUT_ERROR_INIT;
    of_another_version.struct_size = 8;
    CHECK(abut_step(contact, 1.0, packed(x), packed(x), ABUT_MEAN, nothing, NULL, &of_another_version) == ABUT_MISUSE);
    CHECK(abut_step(contact, 1.0, packed(x), packed(x), ABUT_MEAN, nothing, NULL, &error) == ABUT_OK); /* and goes on */
    abut_destroy(contact);
    abut_destroy(NULL);
}

static void a_force_that_is_not_finite_is_an_error(void) {
    /* The second corner of face 0 passes over its third one: the face turns over within the step. */
    static double nodes[18] = {0, 0, 3, 1, 1, 3, 0, 1, 3, 0, 0, 0, 1, 1, 0, 0, 1, 0};
    static const int32_t triangles[6] = {0, 1, 2, 3, 5, 4}, of_body[2] = {0, 1};
    const double depths[2] = {1e9, 0.0}, stiff[2] = {1e12, INFINITY};
    double turned[18], force[18] = {0.0};
    abut_error error = ABUT_ERROR_INIT;
    abut_contact* contact = NULL;
    abut_faces faces = ABUT_FACES_INIT;
    faces.n_faces = 2;
    faces.nodes = triangles;
    faces.n_nodes = 6;
    faces.body = of_body;
    faces.depth = depths;
    faces.stiffness = stiff;
    faces.n_bodies = 2;
    const abut_array from = {nodes, 6, 3, 1}, to = {turned, 6, 3, 1}, forces = {force, 6, 3, 1};
    memcpy(turned, nodes, sizeof(nodes));
    turned[3] = -1.0;
    CHECK(abut_create(3, from, &faces, NULL, &contact, &error) == ABUT_OK);
    CHECK(abut_step(contact, 1.0, from, to, ABUT_MEAN, forces, NULL, &error) == ABUT_DIVERGED);
    CHECK(error.face_1 == 0 && error.face_2 == 1 && strstr(error.message, "not finite") != NULL);
    for (int i = 0; i < 18; ++i) CHECK(force[i] == 0.0);
    CHECK(abut_step(contact, 1.0, from, from, ABUT_MEAN, forces, NULL, &error) == ABUT_OK); /* and goes on */
    abut_destroy(contact);
}

static void overlaps_alone(void) {
    abut_error error = ABUT_ERROR_INIT;
    const abut_faces faces = faces_from(0, corners, body);
    double x[2 * n_nodes];
    abut_overlap overlap;
    int64_t n = -1;
    lowered(0.0, x);
    CHECK(abut_find_overlaps(2, packed(x), &faces, 0.05, &overlap, sizeof(overlap), 1, &n, &error) == ABUT_OK && n == 0);
    CHECK(abut_find_overlaps(2, packed(x), &faces, 0.2, &overlap, sizeof(overlap), 1, &n, &error) == ABUT_OK && n == 1);
    CHECK(overlap.face_1 == 2 && overlap.face_2 == 4 && fabs(overlap.area - 0.8) < 1e-15 && fabs(overlap.gap - 0.1) < 1e-15);
    CHECK(fabs(overlap.distance - 0.1) < 1e-6);
    /* Bodies may have any numbers, and nobody looks at depths. */
    const int32_t far[n_faces] = {7, 7, 7, 7, 2000000000, 2000000000, 2000000000, 2000000000};
    abut_faces bare = faces_from(0, corners, far);
    bare.depth = bare.stiffness = NULL;
    bare.n_bodies = 0;
    CHECK(abut_find_overlaps(2, packed(x), &bare, 0.2, &overlap, sizeof(overlap), 1, &n, &error) == ABUT_OK && n == 1);
    CHECK(overlap.face_1 == 2 && overlap.face_2 == 4);
    for (int i = 0; i < 2 * n_nodes; ++i) x[i] *= 1e-3; /* in another unit of length */
    CHECK(abut_find_overlaps(2, packed(x), &faces, 0.05e-3, &overlap, sizeof(overlap), 1, &n, &error) == ABUT_OK && n == 0);
    CHECK(abut_find_overlaps(2, packed(x), &faces, 0.2e-3, &overlap, sizeof(overlap), 1, &n, &error) == ABUT_OK && n == 1);
    CHECK(fabs(overlap.area - 0.8e-3) < 1e-18 && fabs(overlap.gap - 0.1e-3) < 1e-18);
    CHECK(abut_find_overlaps(5, packed(x), &faces, 0.2, &overlap, sizeof(overlap), 1, &n, &error) == ABUT_BAD_INPUT);
}

/* A square of two triangles, the second in the other sense: half the height is 0.5 behind its sides. */
static void a_surface_is_found_of_cells(void) {
    abut_error error = ABUT_ERROR_INIT;
    double x[2 * n_nodes];
    lowered(0.0, x);
    const int32_t nodes[6] = {1, 2, 3, 1, 4, 3}, of_body[2] = {2, 2};
    abut_cells cells = ABUT_CELLS_INIT;
    cells.n_cells = 2;
    cells.nodes = nodes;
    cells.n_nodes = 6;
    cells.body = of_body;
    cells.index_base = 1;
    abut_surface* surface = NULL;
    CHECK(abut_surface_of(2, packed(x), &cells, &surface, &error) == ABUT_OK && surface != NULL);
    abut_faces faces = ABUT_FACES_INIT;
    const int32_t* cell = NULL;
    CHECK(abut_surface_faces(surface, &faces, &cell, &error) == ABUT_OK && faces.n_faces == 4 && faces.n_nodes == 8);
    const int32_t expected[8] = {1, 2, 2, 3, 4, 1, 3, 4}, behind[4] = {1, 1, 2, 2};
    CHECK(faces.index_base == 1 && memcmp(faces.nodes, expected, sizeof(expected)) == 0);
    CHECK(cell != NULL && memcmp(cell, behind, sizeof(behind)) == 0);
    for (int i = 0; i < 4; ++i)
        CHECK(faces.body[i] == 2 && faces.offsets[i] == 2 * i + 1 && fabs(faces.depth[i] - 0.5) < 1e-15);
    abut_surface_destroy(surface);
    abut_surface_destroy(NULL);

    cells.n_nodes = 5;
    CHECK(abut_surface_of(2, packed(x), &cells, &surface, &error) == ABUT_BAD_INPUT && strstr(error.message, "give offsets"));
    const int32_t offsets[3] = {1, 4, 7};
    cells.n_nodes = 6;
    cells.offsets = offsets;
    CHECK(abut_surface_of(2, packed(x), &cells, &surface, &error) == ABUT_OK);
    CHECK(abut_surface_faces(surface, &faces, NULL, &error) == ABUT_OK && faces.n_faces == 4);
    CHECK(abut_surface_faces(NULL, &faces, NULL, &error) == ABUT_MISUSE);
    abut_surface_destroy(surface);
    cells.nodes = NULL;
    CHECK(abut_surface_of(2, packed(x), &cells, &surface, &error) == ABUT_MISUSE);
}

static void small_things(void) {
    abut_error error = ABUT_ERROR_INIT;
    double k = 0.0;
    const double depths[2] = {1.0, 2.0};
    CHECK(abut_skin_stiffness(6.0, depths, 2, &k, &error) == ABUT_OK && fabs(k - 4.0) < 1e-15);
    CHECK(abut_skin_stiffness(-1.0, depths, 2, &k, &error) == ABUT_BAD_INPUT);
    CHECK(abut_limit_threads(1, &error) == ABUT_OK && abut_limit_threads(0, &error) == ABUT_OK);
    CHECK(abut_limit_threads(-1, &error) == ABUT_BAD_INPUT);
    CHECK(strcmp(abut_version(), ABUT_VERSION) == 0);
}

int main(void) {
    an_overlap_on_purpose_comes_to_act();
    presses_by_the_spring_in_series();
    mean_force_is_exact_for_energy();
    any_strides_and_bases();
    state_goes_on_with_the_same_bits();
    friction_sticks_by_the_shear_in_series_and_slides_at_its_limit();
    laws_of_friction_are_told_by_pair();
    friction_goes_on_after_a_restore_with_the_same_bits();
    callbacks_are_called();
    a_contact_in_use_is_left_alone();
    a_force_that_ends_too_early_is_refused_before_the_step();
    what_is_wrong_is_refused_by_name();
    a_force_that_is_not_finite_is_an_error();
    overlaps_alone();
    a_surface_is_found_of_cells();
    small_things();
    printf("%d failures\n", failures);
    return failures == 0 ? 0 : 1;
}
