// Bodies of abut_solid.h are those of C++, whatever they are made of.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "abut/dynamics/ledger.hpp"
#include "abut/dynamics/stable_step.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "abut/solid/body_motion.hpp"
#include "abut/solid/cell_view.hpp"
#include "abut/solid/material/known_materials.hpp"
#include "abut/solid/material/material_numbers.hpp"
#include "abut/solid/stepped_run.hpp"
#include "abut_solid.h"

using namespace abut;
using solid::Kinematics;
using solid::Material;
using solid::MaterialLaw;

namespace {

struct Given {
    const char* name;
    Material material;
    Kinematics kinematics;
    std::vector<std::pair<const char*, const char*>> texts;
    std::vector<std::pair<const char*, double>> numbers;
    std::vector<std::pair<const char*, std::vector<double>>> lists{};
    double warm = 0.0;
};

Material with(Material material, const std::vector<std::pair<const char*, double>>& numbers) {
    for (const auto& [name, value] : numbers)
        std::ranges::find(solid::material_numbers, std::string(name), &solid::MaterialNumber::name)->at.in(material) = value;
    return material;
}

const Material plain{.young = 1.0, .poisson = 0.3, .density = 1.0};
Material of(MaterialLaw law) {
    Material material = plain;
    material.law = law;
    return material;
}

std::vector<Given> all_given() {
    const std::vector<std::pair<const char*, double>> moving{
        {"yield_stress", 1e-3}, {"hardening", 0.04}, {"kinematic_hardening", 0.03}},
        johnson{{"yield_stress", 1e-3},
                {"power_hardening", 0.02},
                {"power_exponent", 0.5},
                {"johnson_cook_rate", 1e-4},
                {"johnson_cook_factor", 0.02}},
        voce{{"yield_stress", 1e-3},
             {"saturation", 1e-3},
             {"saturation_rate", 100.0},
             {"cowper_symonds_rate", 0.1},
             {"cowper_symonds_exponent", 3.0}},
        wood{{"young", 10.0},      {"poisson", 0.4},     {"density", 0.7},  {"young_2", 0.8},  {"young_3", 0.5},
             {"poisson_13", 0.45}, {"poisson_23", 0.35}, {"shear_12", 0.7}, {"shear_13", 0.6}, {"shear_23", 0.1}},
        damped{{"mass_damping", 0.1}, {"stiffness_damping", 0.02}, {"linear_viscosity", 0.1}, {"quadratic_viscosity", 1.0}},
        rubber{{"young", 1.0}, {"poisson", 0.45}, {"second_share", 0.3}};
    Material turned = with(of(MaterialLaw::orthotropic), wood);
    turned.orthotropic.axis_1 = {1.0, 2.0, 0.0};
    turned.orthotropic.axis_2 = {-2.0, 1.0, 0.0};
    Material table = of(MaterialLaw::j2);
    table.flow.yield_stress = 1e-3;
    table.flow.table = {{0.0, 1e-3}, {0.01, 2e-3}};
    Material copper = solid::known_material("copper OFHC")->material;
    copper.law = MaterialLaw::j2;
    solid::take_flow(copper, *solid::known_material("copper OFHC"));
    Material steel = solid::known_material("steel S235")->material;
    steel.law = MaterialLaw::j2;
    steel.flow.yield_stress = 250e6;
    return {
        {"moving", with(of(MaterialLaw::j2), moving), Kinematics::small, {{"law", "j2"}}, moving},
        {"Johnson and Cook",
         with(of(MaterialLaw::j2), johnson),
         Kinematics::finite,
         {{"law", "j2"}, {"kinematics", "finite"}},
         johnson},
        {"Voce", with(of(MaterialLaw::j2), voce), Kinematics::floating, {{"law", "j2"}, {"kinematics", "floating"}}, voce},
        {"table", table, Kinematics::small, {{"law", "j2"}}, {}, {{"hardening_table", {0.0, 1e-3, 0.01, 2e-3}}}},
        {"wood",
         turned,
         Kinematics::small,
         {{"law", "orthotropic"}},
         wood,
         {{"axis_1", {1.0, 2.0, 0.0}}, {"axis_2", {-2.0, 1.0, 0.0}}}},
        {"damped", with(plain, damped), Kinematics::floating, {{"kinematics", "floating"}}, damped},
        {"rubber",
         with(of(MaterialLaw::mooney_rivlin), rubber),
         Kinematics::finite,
         {{"law", "mooney_rivlin"}, {"kinematics", "finite"}},
         rubber},
        {"softer rubber",
         with(of(MaterialLaw::neo_hookean), {{"young", 0.5}}),
         Kinematics::finite,
         {{"law", "neo_hookean"}, {"kinematics", "finite"}, {"young", "0.5 Pa"}},
         {}},
        {"copper", copper, Kinematics::small, {{"material", "copper OFHC"}, {"law", "j2"}}, {}},
        {"steel", steel, Kinematics::small, {{"material", "steel S235"}, {"law", "j2"}, {"yield_stress", "250 MPa"}}, {}},
        {"warm",
         with(plain, {{"thermal_expansion", 1e-5}}),
         Kinematics::small,
         {},
         {{"thermal_expansion", 1e-5}},
         {},
         100.0},
        {"hot rubber",
         with(of(MaterialLaw::neo_hookean), {{"thermal_expansion", 1e-3}}),
         Kinematics::finite,
         {{"law", "neo_hookean"}, {"kinematics", "finite"}},
         {{"thermal_expansion", 1e-3}},
         {},
         100.0}};
}

double rise(double time, const double* position, void* user) {
    return *static_cast<const double*>(user) * (std::sin(time) + 0.5 * position[0]);
}

constexpr double dt_of_stable = 0.9;
const Vector<3> lower = Vector<3>::Zero(), upper{1.0, 0.8, 0.6};
const Vector<3> pull{0.02, 0.01, 0.0};  // of floating bodies [Pa]
constexpr int n_steps = 60;             // finite bodies have restarted

/// Positions and stresses of all cells after some steps of a body held at one end.
struct Results {
    std::vector<double> position, velocity, stress, plastic_strain;
    double pseudo_energy = 0.0, dissipated = 0.0;
    bool operator==(const Results&) const = default;
};

Results in_cxx(const Given& given, const Vector<3>& velocity) {
    const auto mesh = mesh::structured_box<3>(lower, upper, {4, 3, 3}, mesh::CellShape::hexahedron, "block");
    solid::SolidOptions<3> options;
    options.materials = {given.material};
    options.kinematics = {given.kinematics};
    if (given.kinematics == Kinematics::floating)
        options.boundary.traction = {{.group = "xmax", .value = pull, .from_outside = true}};
    else
        options.boundary.dirichlet = {{.group = "xmin", .constraint = solid::Constraint::full}};
    options.contact = contact::ContactOptions{};
    if (given.warm > 0.0)
        options.temperature_rise = {{.value =
                                         [&given](double t, const Vector<3>& x) {
                                             double warm = given.warm;
                                             return rise(t, x.data(), &warm);
                                         },
                                     .varies = true}};
    auto made = std::make_unique<solid::Solid<3>>(mesh, options);
    const double dt = dt_of_stable * dynamics::stable_step(*made).dt;
    const auto p = solid::uniform_momentum<3>(*made, std::vector<Vector<3>>{velocity});
    solid::SteppedRun<3> run(std::move(made), std::vector<double>(std::size_t{3 * 36}, 0.0), p, dt,
                             {.restart = given.kinematics == Kinematics::finite ? 50 : 0});
    for (int i = 0; i < n_steps; ++i) run.step();
    Results results;
    const auto entry = dynamics::measure(run.memm(), run.solid());
    results.pseudo_energy = entry.pseudo_energy;
    results.dissipated = entry.dissipated;
    std::vector<double> momentum(run.memm().p_before().begin(), run.memm().p_before().end());
    for (std::size_t i = 0; i < momentum.size(); ++i) momentum[i] = 0.5 * (momentum[i] + run.memm().p_after()[i]);
    for (const Vector<3>& v : run.solid().cells().velocity(momentum))
        results.velocity.insert(results.velocity.end(), v.data(), v.data() + 3);
    const auto moved = run.solid().cells().displacement(run.memm().q());
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
        const Vector<3> at = mesh.cell_centroid[static_cast<std::size_t>(c)] + moved[static_cast<std::size_t>(c)];
        const Matrix<3> sigma = run.solid().cells().stress(c);
        results.position.insert(results.position.end(), at.data(), at.data() + 3);
        results.stress.insert(results.stress.end(), sigma.data(), sigma.data() + 9);
        results.plastic_strain.push_back(run.solid().cells().plastic_strain(c));
    }
    return results;
}

#define DO(call)                    \
    do {                            \
        const int status = call;    \
        INFO(error.message);        \
        REQUIRE(status == ABUT_OK); \
    } while (false)

Results in_c(Given given, const Vector<3>& velocity) {
    abut_error error = ABUT_ERROR_INIT;
    abut_solid* solid = nullptr;
    const std::int32_t counts[3] = {4, 3, 3};
    DO(abut_solid_create(3, &solid, &error));
    DO(abut_solid_add_box(solid, "block", lower.data(), upper.data(), counts, {1.0, 0.3, 1.0}, velocity.data(), &error));
    if (given.kinematics == Kinematics::floating)
        DO(abut_solid_load(solid, "xmax", pull.data(), &error));
    else
        DO(abut_solid_clamp(solid, "xmin", &error));
    for (const auto& [key, text] : given.texts) DO(abut_solid_set_text(solid, "block", key, text, &error));
    for (const auto& [key, value] : given.numbers) DO(abut_solid_set_number(solid, "block", key, value, &error));
    for (const auto& [key, values] : given.lists)
        DO(abut_solid_set_numbers(solid, "block", key, values.data(), std::ssize(values), &error));
    if (given.warm > 0.0) DO(abut_solid_set_temperature(solid, "block", rise, 1, &given.warm, &error));
    DO(abut_solid_begin(solid, nullptr, &error));
    for (int i = 0; i < n_steps; ++i) DO(abut_solid_step(solid, &error));
    std::int64_t n = 0;
    DO(abut_solid_n_cells(solid, "block", &n, &error));
    REQUIRE(n == 36);
    Results results;
    results.position.resize(3 * 36);
    results.velocity.resize(3 * 36);
    results.stress.resize(9 * 36);
    results.plastic_strain.resize(36);
    abut_solid_state state = ABUT_SOLID_STATE_INIT;
    DO(abut_solid_get_state(solid, &state, &error));
    results.pseudo_energy = state.pseudo_energy;
    results.dissipated = state.dissipated;
    abut_solid_cell_arrays cells = ABUT_SOLID_CELL_ARRAYS_INIT;
    cells.n_cells = n;
    cells.position = {results.position.data(), n, 3, 1};
    cells.velocity = {results.velocity.data(), n, 3, 1};
    cells.stress = {results.stress.data(), n, 9, 1};
    cells.plastic_strain = results.plastic_strain.data();
    DO(abut_solid_cells(solid, "block", &cells, &error));
    abut_solid_destroy(solid);
    return results;
}

}  // namespace

TEST_CASE("bodies of all laws, and warm ones, have the bits of C++ where C makes them by names", "[bindings][solid]") {
    for (const Given& given : all_given()) {
        CAPTURE(given.name);
        const double c = std::sqrt(given.material.wave_modulus() / given.material.density);
        const Vector<3> velocity = c * Vector<3>(0.02, 0.01, 0.005);
        const Results cxx = in_cxx(given, velocity);
        CHECK(in_c(given, velocity) == cxx);
        // that it is this law at all
        Given elastic = given;
        elastic.material = with(
            plain,
            {{"young", given.material.young}, {"poisson", given.material.poisson}, {"density", given.material.density}});
        elastic.warm = 0.0;
        CHECK(in_cxx(elastic, velocity).position != cxx.position);
        if (given.material.law == MaterialLaw::j2) CHECK(*std::ranges::max_element(cxx.plastic_strain) > 1e-4);
    }
}
