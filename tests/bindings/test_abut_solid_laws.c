/* What bodies of abut_solid.h are made of, from C99: metal that is pulled and pressed along its exact curve, bodies that get warm, and
   what is refused. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "abut_solid.h"

static int failures = 0;
#define CHECK(condition)                                                     \
    do {                                                                     \
        if (!(condition)) {                                                  \
            printf("%s:%d: failed: %s\n", __FILE__, __LINE__, #condition);   \
            ++failures;                                                      \
        }                                                                    \
    } while (0)

/* Of many numbers the largest error counts. */
static double worst(double so_far, double value, double exact) { return fmax(so_far, fabs(value - exact)); }

static const abut_material material = {1.0, 0.3, 1.0};

/* A bar of 1 x 0.5 x 0.5 on three planes. */
static abut_solid* bar_on_planes(void) {
    abut_error error = ABUT_ERROR_INIT;
    abut_solid* solid = NULL;
    const double lower[3] = {0.0, 0.0, 0.0}, upper[3] = {1.0, 0.5, 0.5};
    const int32_t counts[3] = {4, 2, 2};
    const char* const planes[] = {"xmin", "ymin", "zmin"};
    CHECK(abut_solid_create(3, &solid, &error) == ABUT_OK);
    CHECK(abut_solid_add_box(solid, "bar", lower, upper, counts, material, NULL, &error) == ABUT_OK);
    for (int i = 0; i < 3; ++i) CHECK(abut_solid_roller(solid, planes[i], &error) == ABUT_OK);
    return solid;
}

static abut_array array_of(double* data, int64_t n, int64_t item) {
    abut_array array = {NULL, 0, 0, 1};
    array.data = data, array.count = n, array.item = item;
    return array;
}

/* Held at one end, and flying away from it: behind an elastic front at c, with sigma_y, comes a slower one at sqrt(E_t/rho), E_t being the
   slope of the curve beyond sigma_y; behind it the bar stands. The bar is slender, as the inertia of its sides is not in this. */
static void a_bar_of_metal_that_is_pulled_has_the_two_fronts_of_its_bilinear_curve(void) {
    const double yield = 1e-4, slope = 0.1, speed = 5.0 * yield, time = 0.8, slow = sqrt(slope);
    const double plateau = yield + slow * (speed - yield), alpha = (plateau - yield) * (1.0 / slope - 1.0); /* rho, E, c are 1 */
    for (int moves = 0; moves < 2; ++moves) {
        enum { n = 200, n_cells = 4 * n };
        abut_error error = ABUT_ERROR_INIT;
        abut_solid* solid = NULL;
        const double lower[3] = {0.0, 0.0, 0.0}, upper[3] = {1.0, 0.005, 0.005}, velocity[3] = {speed, 0.0, 0.0};
        const int32_t counts[3] = {n, 2, 2};
        CHECK(abut_solid_create(3, &solid, &error) == ABUT_OK);
        CHECK(abut_solid_add_box(solid, "bar", lower, upper, counts, material, velocity, &error) == ABUT_OK);
        CHECK(abut_solid_roller(solid, "xmin", &error) == ABUT_OK);
        CHECK(abut_solid_set_text(solid, "bar", "law", "j2", &error) == ABUT_OK);
        CHECK(abut_solid_set_text(solid, "bar", "yield_stress", "0.1 mPa", &error) == ABUT_OK);
        CHECK(abut_solid_set_number(solid, "bar", moves ? "kinematic_hardening" : "hardening", slope / (1.0 - slope), &error) ==
              ABUT_OK);
        abut_solid_options options = ABUT_SOLID_OPTIONS_INIT;
        options.cfl = 0.5;
        CHECK(abut_solid_begin(solid, &options, &error) == ABUT_OK);
        if (error.status != ABUT_OK) printf("%s\n", error.message);
        abut_solid_state start = ABUT_SOLID_STATE_INIT, state = ABUT_SOLID_STATE_INIT;
        CHECK(abut_solid_get_state(solid, &start, &error) == ABUT_OK);
        for (int64_t i = 0; (double)i * start.dt < time; ++i) CHECK(abut_solid_step(solid, &error) == ABUT_OK);
        CHECK(abut_solid_get_state(solid, &state, &error) == ABUT_OK);

        static double position[n_cells][3], stress[n_cells][9], flowed[n_cells];
        abut_solid_cell_arrays cells = ABUT_SOLID_CELL_ARRAYS_INIT;
        cells.n_cells = n_cells, cells.plastic_strain = flowed;
        cells.position = array_of(&position[0][0], n_cells, 3), cells.stress = array_of(&stress[0][0], n_cells, 9);
        CHECK(abut_solid_cells(solid, "bar", &cells, &error) == ABUT_OK);
        double sum = 0.0, sum_alpha = 0.0, front = 0.0;
        int count = 0;
        for (int c = 0; c < n_cells; ++c) {
            const double x = position[c][0];
            if (x > 0.05 && x < 0.2) sum += stress[c][0], sum_alpha += flowed[c], ++count;
            if (stress[c][0] > 0.5 * (plateau + yield)) front = fmax(front, x);
        }
        CHECK(fabs(sum / count / plateau - 1.0) < 0.005 && fabs(sum_alpha / count / alpha - 1.0) < 0.005);
        CHECK(fabs(front / (slow * state.time) - 1.0) < 0.01);
        double in_cells = 0.0;
        CHECK(abut_solid_get_number(solid, "dissipated_in_cells", &in_cells, &error) == ABUT_OK);
        CHECK(in_cells > 0.1 * start.kinetic && fabs(state.dissipated / in_cells - 1.0) < 0.005); /* faces give or take little */
        CHECK(fabs(state.pseudo_energy + state.dissipated - start.pseudo_energy) < 1e-13 * start.kinetic);
        abut_solid_destroy(solid);
    }
}

/* K: to `user` in 20 s, and at once for time 0 alone */
static double smooth_rise(double time, const double* position, void* user) {
    (void)position;
    return *(const double*)user * (time < 20.0 ? 0.5 - 0.5 * cos(0.05 * 3.14159265358979 * time) : 1.0);
}
static double sudden_rise(double time, const double* position, void* user) {
    (void)position;
    return time == 0.0 ? *(const double*)user : NAN;
}

static void bodies_that_get_warm_expand_or_press(void) {
    enum { n_cells = 16 };
    for (int which = 0; which < 4; ++which) {
        const int wall = which % 2, varies = which / 2;
        abut_error error = ABUT_ERROR_INIT;
        abut_solid* solid = bar_on_planes();
        if (wall) CHECK(abut_solid_roller(solid, "xmax", &error) == ABUT_OK);
        /* so that it comes to rest */
        CHECK(abut_solid_set_number(solid, "bar", "mass_damping", 1.5, &error) == ABUT_OK);
        double rise = 80.0;
        const double expansion = 1e-5, thermal = expansion * rise;
        CHECK(abut_solid_set_number(solid, "bar", "thermal_expansion", expansion, &error) == ABUT_OK);
        CHECK(abut_solid_set_temperature(solid, "bar", varies ? smooth_rise : sudden_rise, varies, &rise, &error) == ABUT_OK);
        CHECK(abut_solid_begin(solid, NULL, &error) == ABUT_OK);
        if (error.status != ABUT_OK) printf("%s\n", error.message);
        int64_t n = 0;
        CHECK(abut_solid_n_cells(solid, "bar", &n, &error) == ABUT_OK && n == n_cells);
        double position[n_cells][3], cold[n_cells][3], stress[n_cells][9];
        abut_solid_cell_arrays cells = ABUT_SOLID_CELL_ARRAYS_INIT;
        cells.n_cells = n_cells, cells.position = array_of(&cold[0][0], n_cells, 3);
        CHECK(abut_solid_cells(solid, "bar", &cells, &error) == ABUT_OK);
        abut_solid_state start = ABUT_SOLID_STATE_INIT, state = ABUT_SOLID_STATE_INIT;
        CHECK(abut_solid_get_state(solid, &start, &error) == ABUT_OK);
        for (state = start; state.time < 60.0;) {
            CHECK(abut_solid_step(solid, &error) == ABUT_OK);
            CHECK(abut_solid_get_state(solid, &state, &error) == ABUT_OK);
        }
        double work = 0.0;
        CHECK(abut_solid_get_number(solid, "work", &work, &error) == ABUT_OK);
        CHECK((work != 0.0) == varies);
        CHECK(fabs(state.pseudo_energy + state.dissipated - start.pseudo_energy - work) < 1e-12 * 0.25 * thermal * thermal);
        cells.position = array_of(&position[0][0], n_cells, 3), cells.stress = array_of(&stress[0][0], n_cells, 9);
        CHECK(abut_solid_cells(solid, "bar", &cells, &error) == ABUT_OK);
        /* free: alpha T all round; held along x: -E alpha T, and (1 + nu) alpha T across */
        const double along = wall ? 0.0 : thermal, across = (wall ? 1.0 + material.poisson : 1.0) * thermal;
        double in_position = 0.0, in_stress = 0.0;
        for (int c = 0; c < n_cells; ++c) {
            for (int i = 0; i < 3; ++i)
                in_position = worst(in_position, position[c][i], cold[c][i] * (1.0 + (i == 0 ? along : across)));
            for (int i = 0; i < 9; ++i) in_stress = worst(in_stress, stress[c][i], wall && i == 0 ? -thermal : 0.0);
        }
        /* steps of the temperature leave some of the alternating mode, which no damping takes */
        CHECK(in_position < (varies ? 1e-5 : 1e-10) * thermal && in_stress < (varies ? 1e-5 : 1e-10) * thermal);
        abut_solid_destroy(solid);
    }
}

/* Loaded at its end by a program outside, from which heat is told apart: along p/E + alpha T, across alpha T - nu p/E. */
static void a_bar_that_gets_warm_under_a_load_from_outside_keeps_both_accounts(void) {
    enum { n_cells = 16, n_faces = 4 };
    abut_error error = ABUT_ERROR_INIT;
    abut_solid* solid = bar_on_planes();
    double rise = 80.0, traction[n_faces][3] = {{0.0}};
    const double expansion = 1e-5, thermal = expansion * rise, p = -3e-4;
    CHECK(abut_solid_set_number(solid, "bar", "mass_damping", 1.5, &error) == ABUT_OK);
    CHECK(abut_solid_set_number(solid, "bar", "thermal_expansion", expansion, &error) == ABUT_OK);
    CHECK(abut_solid_set_temperature(solid, "bar", smooth_rise, 1, &rise, &error) == ABUT_OK);
    CHECK(abut_solid_load(solid, "xmax", NULL, &error) == ABUT_OK);
    CHECK(abut_solid_begin(solid, NULL, &error) == ABUT_OK);
    if (error.status != ABUT_OK) printf("%s\n", error.message);
    double position[n_cells][3], cold[n_cells][3], stress[n_cells][9];
    abut_solid_cell_arrays cells = ABUT_SOLID_CELL_ARRAYS_INIT;
    cells.n_cells = n_cells, cells.position = array_of(&cold[0][0], n_cells, 3);
    CHECK(abut_solid_cells(solid, "bar", &cells, &error) == ABUT_OK);
    abut_solid_state start = ABUT_SOLID_STATE_INIT, state = ABUT_SOLID_STATE_INIT;
    CHECK(abut_solid_get_state(solid, &start, &error) == ABUT_OK);
    double off = 0.0, off_all = 0.0, work = 0.0;
    for (state = start; state.time < 60.0;) {
        for (int i = 0; i < n_faces; ++i) traction[i][0] = p * fmin(1.0, 0.05 * state.time);
        CHECK(abut_solid_set_traction(solid, "xmax", array_of(&traction[0][0], n_faces, 3), &error) == ABUT_OK);
        CHECK(abut_solid_step(solid, &error) == ABUT_OK);
        CHECK(abut_solid_get_state(solid, &state, &error) == ABUT_OK);
        CHECK(abut_solid_get_number(solid, "work", &work, &error) == ABUT_OK);
        off = fmax(off, fabs(state.pseudo_energy + state.work_held + state.dissipated - start.pseudo_energy - state.work_steps -
                             state.work_changes - state.work_heat));
        off_all = fmax(off_all, fabs(state.pseudo_energy + state.dissipated - start.pseudo_energy - work));
    }
    const double scale = 0.25 * thermal * thermal;
    CHECK(off < 1e-12 * scale && off_all < 1e-12 * scale);
    CHECK(fabs(state.work_heat) > 1e-2 * scale && fabs(state.work_steps) > 1e-2 * scale);
    cells.position = array_of(&position[0][0], n_cells, 3), cells.stress = array_of(&stress[0][0], n_cells, 9);
    CHECK(abut_solid_cells(solid, "bar", &cells, &error) == ABUT_OK);
    const double along = p + thermal, across = thermal - material.poisson * p;
    double in_position = 0.0, in_stress = 0.0;
    for (int c = 0; c < n_cells; ++c) {
        for (int i = 0; i < 3; ++i)
            in_position = worst(in_position, position[c][i], cold[c][i] * (1.0 + (i == 0 ? along : across)));
        for (int i = 0; i < 9; ++i) in_stress = worst(in_stress, stress[c][i], i == 0 ? p : 0.0);
    }
    CHECK(in_position < 1e-4 * thermal && in_stress < 1e-4 * thermal);
    abut_solid_destroy(solid);
}

static double no_number(double time, const double* position, void* user) {
    (void)time, (void)position, (void)user;
    return NAN;
}

#define REFUSED(call, text)                                                             \
    do {                                                                                \
        CHECK((call) == ABUT_BAD_INPUT);                                                \
        if (strstr(error.message, text) == NULL) CHECK(!printf("  %s\n", error.message)); \
    } while (0)

static void what_a_material_cannot_be_is_refused_by_name(void) {
    abut_error error = ABUT_ERROR_INIT;
    abut_solid* solid = bar_on_planes();
    const double numbers[4] = {0.0, 2e-3, 0.1, 1e-3};
    REFUSED(abut_solid_set_number(solid, "bar", "yung", 1.0, &error), "'yung', which is none of 'young'");
    REFUSED(abut_solid_set_number(solid, "bar", "yield_stress", -1.0, &error), "yield_stress is -1 Pa; 0 Pa or above");
    REFUSED(abut_solid_set_number(solid, "bar", "poisson", NAN, &error), "poisson is nan; above -1, below 0.5");
    REFUSED(abut_solid_set_text(solid, "bar", "young", "210 GPs", &error), "GPs");
    REFUSED(abut_solid_set_text(solid, "bar", "young", "2 kg", &error), "kg");
    REFUSED(abut_solid_set_text(solid, "bar", "young", "stiff", &error), "young is 'stiff', which is no number with a unit");
    REFUSED(abut_solid_set_text(solid, "bar", "law", "j3", &error), "law is 'j3', which is none of 'st_venant_kirchhoff'");
    REFUSED(abut_solid_set_text(solid, "bar", "kinematics", "free", &error), "kinematics is 'free', which is none of 'small'");
    REFUSED(abut_solid_set_text(solid, "bar", "material", "mithril", &error), "material is 'mithril', which is none of");
    REFUSED(abut_solid_set_numbers(solid, "bar", "axis_1", numbers, 2, &error), "axis_1 has 2 numbers; it takes 3");
    REFUSED(abut_solid_set_numbers(solid, "bar", "hardening_table", numbers, 3, &error), "rows of two");
    REFUSED(abut_solid_set_numbers(solid, "bar", "axis_3", numbers, 3, &error), "no list 'axis_3'");
    CHECK(abut_solid_set_text(solid, "bar", NULL, "j2", &error) == ABUT_MISUSE);

    CHECK(abut_solid_set_number(solid, "bra", "young", 1.0, &error) == ABUT_OK); /* told where the solid is made */
    REFUSED(abut_solid_begin(solid, NULL, &error), "no body 'bra'");
    abut_solid_destroy(solid);

    solid = bar_on_planes();
    CHECK(abut_solid_set_text(solid, "bar", "law", "j2", &error) == ABUT_OK);
    REFUSED(abut_solid_begin(solid, NULL, &error), "body 'bar': ");
    CHECK(strstr(error.message, "yield_stress is 0; j2 needs it") != NULL);
    CHECK(abut_solid_set_numbers(solid, "bar", "hardening_table", numbers, 4, &error) == ABUT_OK);
    REFUSED(abut_solid_begin(solid, NULL, &error), "stresses must not fall");
    CHECK(abut_solid_set_numbers(solid, "bar", "hardening_table", numbers, 2, &error) == ABUT_OK);
    CHECK(abut_solid_set_temperature(solid, "bar", no_number, 0, NULL, &error) == ABUT_OK);
    REFUSED(abut_solid_begin(solid, NULL, &error), "thermal_expansion of 0");
    CHECK(abut_solid_set_number(solid, "bar", "thermal_expansion", 1e-5, &error) == ABUT_OK);
    REFUSED(abut_solid_begin(solid, NULL, &error), "is not finite");
    CHECK(abut_solid_set_text(solid, "bar", "law", "neo_hookean", &error) == ABUT_OK);
    REFUSED(abut_solid_begin(solid, NULL, &error), "hardening_table is");
    abut_solid_destroy(solid);

    solid = bar_on_planes();
    double value = 0.0;
    int64_t n = 0;
    CHECK(abut_solid_get_number(solid, "work", &value, &error) == ABUT_MISUSE);
    CHECK(abut_solid_begin(solid, NULL, &error) == ABUT_OK);
    CHECK(abut_solid_set_number(solid, "bar", "young", 1.0, &error) == ABUT_MISUSE);
    REFUSED(abut_solid_get_number(solid, "wrok", &value, &error), "no column 'wrok'. There are 'step'");
    REFUSED(abut_solid_n_cells(solid, "bra", &n, &error), "no body 'bra'");
    abut_solid_cell_arrays cells = ABUT_SOLID_CELL_ARRAYS_INIT;
    cells.n_cells = 3;
    REFUSED(abut_solid_cells(solid, "bar", &cells, &error), "has place for 3 cells of the body, there are 16");
    abut_solid_destroy(solid);
}

int main(void) {
    a_bar_of_metal_that_is_pulled_has_the_two_fronts_of_its_bilinear_curve();
    bodies_that_get_warm_expand_or_press();
    a_bar_that_gets_warm_under_a_load_from_outside_keeps_both_accounts();
    what_a_material_cannot_be_is_refused_by_name();
    return failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
