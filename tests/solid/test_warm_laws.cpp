// Bodies of Kinematics::finite whose temperature is given: laws behind a thermal stretch, and states of equal strain.
#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <functional>

#include "abut/base/error.hpp"
#include "abut/solid/cell_view.hpp"
#include "abut/solid/material/orthotropic.hpp"
#include "abut/solid/material/warm_laws.hpp"
#include "solid/finite_scenes.hpp"

using namespace abut;
using namespace abut::test;
using Catch::Contains;
using solid::Material;
using solid::MaterialLaw;

namespace {

constexpr double per_kelvin = 1e-3;

/// Of the law, elastic at all stresses of the tests.
Material elastic_of(MaterialLaw law, double kinematic_hardening = 0.0) {
    Material material{.young = 2.0, .poisson = 0.3, .density = 1.5, .law = law};
    material.expansion.along_1 = per_kelvin;
    if (law == MaterialLaw::mooney_rivlin) material.second_share = 0.4;
    if (law == MaterialLaw::j2) material.flow.yield_stress = 1e3;
    material.flow.kinematic_hardening = kinematic_hardening;
    return material;
}

const std::array<Material, 5> elastic_materials{elastic_of(MaterialLaw::st_venant_kirchhoff),
                                                elastic_of(MaterialLaw::neo_hookean), elastic_of(MaterialLaw::mooney_rivlin),
                                                elastic_of(MaterialLaw::j2), elastic_of(MaterialLaw::j2, 1e-3)};

using PrincipalStretches = Vector<3>;

/// W along principal axes.
double law_energy(const Material& material, const PrincipalStretches& x) {
    const double lambda = material.lambda(), mu = material.mu(), log = std::log(x.prod()), s = material.second_share;
    const Vector<3> squares = x.cwiseProduct(x);
    if (material.law == MaterialLaw::st_venant_kirchhoff) {
        const Vector<3> e = 0.5 * (squares - Vector<3>::Ones());
        return 0.5 * lambda * e.sum() * e.sum() + mu * e.squaredNorm();
    }
    if (material.law == MaterialLaw::j2) {
        const Vector<3> logarithms = x.unaryExpr([](double stretch) { return std::log(stretch); });
        return 0.5 * lambda * log * log + mu * logarithms.squaredNorm();
    }
    const double first = squares.sum(), second = 0.5 * (first * first - squares.squaredNorm());
    return 0.5 * mu * (1.0 - s) * (first - 3.0 - 2.0 * log) + 0.5 * mu * s * (second - 3.0 - 4.0 * log) +
           0.5 * (lambda - 2.0 * mu * s) * log * log;
}

/// Cauchy's stress along them: x_i dW/dx_i/J.
Vector<3> law_stress(const Material& material, const PrincipalStretches& x) {
    const double lambda = material.lambda(), mu = material.mu(), volume = x.prod(), log = std::log(volume);
    const double s = material.second_share, first = x.squaredNorm();
    Vector<3> stress;
    for (int i = 0; i < 3; ++i) {
        const double square = x[i] * x[i];
        if (material.law == MaterialLaw::st_venant_kirchhoff)
            stress[i] = square * (0.5 * lambda * (first - 3.0) + mu * (square - 1.0));
        else if (material.law == MaterialLaw::j2)
            stress[i] = lambda * log + 2.0 * mu * std::log(x[i]);
        else
            stress[i] =
                mu * (1.0 - s) * (square - 1.0) + mu * s * (square * (first - square) - 2.0) + (lambda - 2.0 * mu * s) * log;
    }
    return stress / volume;
}

/// Where a function that grows is 0.
double root_where(const std::function<double(double)>& grows, double low, double high) {
    for (int i = 0; i < 100; ++i) (grows(0.5 * (low + high)) < 0.0 ? low : high) = 0.5 * (low + high);
    return 0.5 * (low + high);
}

template <int Dim>
solid::SolidOptions<Dim> warm_alone(const Material& material, double rise) {
    auto options = alone<Dim>(material);
    options.temperature_rise = {{.value = [rise](double, const Vector<Dim>&) { return rise; }, .varies = false}};
    return options;
}

template <int Dim>
std::vector<double> stretched_state(const mesh::Mesh<Dim>& mesh, const Matrix<Dim>& g) {
    return sampled<Dim>(mesh, [&](const Vector<Dim>& x) -> Vector<Dim> { return g * x; });
}

template <int Dim>
double volume_at_rest(const mesh::Mesh<Dim>& mesh) {
    double volume = 0.0;
    for (const double measure : mesh.cell_measure) volume += measure;
    return volume;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("a warm finite body that nothing holds expands without stress, by any amount and under any law",
                       "[solid][finite][thermal]", ((int Dim), Dim), 2, 3) {
    // In plane strain the length out of the plane is held: det A W(x, x, 1/a) is least where the stress in the plane is 0.
    const double rise = GENERATE(300.0, -200.0, 1e-2);
    const double a = 1.0 + per_kelvin * rise;
    for (const auto& [name, mesh] : boxes<Dim>())
        for (const Material& material : elastic_materials) {
            CAPTURE(name, static_cast<int>(material.law), material.flow.kinematic_hardening, rise);
            const auto elastic = [&](double x) {
                return Dim == 3 ? PrincipalStretches(x, x, x) : PrincipalStretches(x, x, 1.0 / a);
            };
            const double x = root_where([&](double at) { return law_stress(material, elastic(at))[0]; }, 0.7, 1.4);
            solid::Solid<Dim> solid(mesh, warm_alone<Dim>(material, rise));
            const auto q = stretched_state<Dim>(mesh, (a * x - 1.0) * Matrix<Dim>::Identity());
            std::vector<double> force(q.size());
            solid.force(q, force);
            CHECK(largest(force) <= 1e-12);
            const double stored = solid.potential(q);
            for (std::int32_t c = 0; c < mesh.n_cells(); ++c) CHECK(solid.cells().stress(c).norm() <= 1e-12);
            if (Dim == 3) {
                CHECK(std::abs(x - 1.0) <= 1e-14);
                CHECK(std::abs(stored) <= 1e-24);
                continue;
            }
            const Vector<3> stress = law_stress(material, elastic(x));
            double off = 0.0, at_corners = 0.0;  // cells of which all faces are free store nothing
            for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
                const double out = solid.cells().out_of_plane_stress(c);
                if (out == 0.0)
                    at_corners += mesh.cell_measure[static_cast<std::size_t>(c)];
                else
                    raise(off, std::abs(out - stress[2]));
            }
            CHECK(off <= 1e-12);
            const double expected = a * a * a * law_energy(material, elastic(x)) * (volume_at_rest<Dim>(mesh) - at_corners);
            CHECK(std::abs(stored - expected) <= 1e-12);
            CHECK(at_corners < 0.5 * volume_at_rest<Dim>(mesh));
        }
}

TEMPLATE_TEST_CASE_SIG("a warm finite body that is held all round has the stress of its law at the stretch 1/a",
                       "[solid][finite][thermal]", ((int Dim), Dim), 2, 3) {
    const double rise = GENERATE(300.0, -200.0), a = 1.0 + per_kelvin * rise;
    for (const auto& [name, mesh] : boxes<Dim>())
        for (const Material& material : elastic_materials) {
            CAPTURE(name, static_cast<int>(material.law), material.flow.kinematic_hardening, rise);
            auto options = warm_alone<Dim>(material, rise);
            for (const auto& group : mesh.groups) options.boundary.dirichlet.push_back({.group = group.name});
            solid::Solid<Dim> solid(mesh, options);
            const std::vector<double> q(solid.size(), 0.0);
            std::vector<double> force(q.size());
            solid.force(q, force);
            CHECK(largest(force) <= 1e-12);
            const PrincipalStretches elastic = PrincipalStretches::Constant(1.0 / a);
            const double density = a * a * a * law_energy(material, elastic);
            CHECK(std::abs(solid.potential(q) - density * volume_at_rest<Dim>(mesh)) <= 1e-12);
            const double pressure = law_stress(material, elastic)[0];
            for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
                CHECK((solid.cells().stress(c) - pressure * Matrix<Dim>::Identity()).norm() <= 1e-12);
                if (Dim == 2) CHECK(std::abs(solid.cells().out_of_plane_stress(c) - pressure) <= 1e-12);
            }
        }
}

TEMPLATE_TEST_CASE_SIG("a warm finite bar between walls has the stress of its law under a uniaxial stretch of 1/a",
                       "[solid][finite][thermal]", ((int Dim), Dim), 2, 3) {
    // Its sides are free, in plane strain but for that out of the plane. Away from the ends, which are free in the mesh.
    const double rise = GENERATE(150.0, -150.0), a = 1.0 + per_kelvin * rise;
    for (const Material& material : elastic_materials) {
        CAPTURE(static_cast<int>(material.law), material.flow.kinematic_hardening, rise);
        std::array<int, Dim> counts;
        counts.fill(3);
        counts[0] = 9;
        Vector<Dim> upper = Vector<Dim>::Ones();
        upper[0] = 3.0;
        const auto mesh = mesh::structured_box<Dim>(Vector<Dim>::Zero(), upper, counts,
                                                    Dim == 2 ? CellShape::quadrangle : CellShape::hexahedron);
        const auto elastic = [&](double x) { return PrincipalStretches(1.0 / a, x, Dim == 3 ? x : 1.0 / a); };
        const double x = root_where([&](double at) { return law_stress(material, elastic(at))[1]; }, 0.7, 1.4);
        const Vector<3> stress = law_stress(material, elastic(x));
        Matrix<Dim> g = (a * x - 1.0) * Matrix<Dim>::Identity();
        g(0, 0) = 0.0;
        solid::Solid<Dim> solid(mesh, warm_alone<Dim>(material, rise));
        const auto q = stretched_state<Dim>(mesh, g);
        std::vector<double> force(q.size());
        solid.force(q, force);
        CHECK(std::abs(stress[0]) > 0.1);
        for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
            if (std::abs(mesh.cell_centroid[static_cast<std::size_t>(c)][0] - 1.5) > 0.6) continue;
            Matrix<Dim> expected = Matrix<Dim>::Zero();
            expected(0, 0) = stress[0];
            const Vector<Dim> along = solid.cells().stress(c).col(0);
            CHECK(vectors<Dim>(force)[static_cast<std::size_t>(c)].norm() <= 1e-12);
            CHECK((along - expected.col(0)).norm() <= (Dim == 3 ? 1e-9 : 1e-12));  // around edges a bar, in space
            CHECK((solid.cells().stress(c) - expected).norm() <= 1e-9);
            if (Dim == 2) CHECK(std::abs(solid.cells().out_of_plane_stress(c) - stress[2]) <= 1e-12);
        }
    }
}

TEST_CASE("a warm orthotropic body of finite strains expands along its axes, and presses by all of its stiffness",
          "[solid][finite][thermal][material]") {
    Material wood{.young = 10.0, .poisson = 0.4, .density = 0.7, .law = MaterialLaw::orthotropic};
    wood.orthotropic.young_2 = 0.8;
    wood.orthotropic.young_3 = 0.5;
    wood.orthotropic.poisson_13 = 0.45;
    wood.orthotropic.poisson_23 = 0.35;
    wood.orthotropic.shear_12 = 0.7;
    wood.orthotropic.shear_13 = 0.6;
    wood.orthotropic.shear_23 = 0.1;
    wood.expansion.along_1 = 0.2 * per_kelvin;
    wood.expansion.along_2 = -0.5 * per_kelvin;
    wood.expansion.along_3 = per_kelvin;
    constexpr double rise = 300.0;
    const Vector<3> a = Vector<3>::Ones() + rise * per_kelvin * Vector<3>(0.2, -0.5, 1.0);
    {
        Material turned = wood;
        const Matrix<3> axes = turned_by<3>(0.8);
        for (int i = 0; i < 3; ++i) {
            turned.orthotropic.axis_1[static_cast<std::size_t>(i)] = axes(i, 0);
            turned.orthotropic.axis_2[static_cast<std::size_t>(i)] = axes(i, 1);
        }
        for (const auto& [name, mesh] : boxes<3>()) {
            CAPTURE(name);
            solid::Solid<3> solid(mesh, warm_alone<3>(turned, rise));
            const auto q = stretched_state<3>(mesh, axes * a.asDiagonal() * axes.transpose() - Matrix<3>::Identity());
            std::vector<double> force(q.size());
            solid.force(q, force);
            CHECK(largest(force) <= 1e-12);
            for (std::int32_t c = 0; c < mesh.n_cells(); ++c) CHECK(solid.cells().stress(c).norm() <= 1e-12);
        }
    }
    // Held in the plane, at an angle: S = C : E of 1/a_i along the axes, sigma = F_e S F_e^T/det F_e.
    const Matrix<3> compliance{{1.0 / 10.0, -0.4 / 10.0, -0.45 / 10.0},
                               {-0.4 / 10.0, 1.0 / 0.8, -0.35 / 0.8},
                               {-0.45 / 10.0, -0.35 / 0.8, 1.0 / 0.5}};
    const Vector<3> elastic = Vector<3>::Ones().cwiseQuotient(a), squares = elastic.cwiseProduct(elastic);
    const Vector<3> strain = 0.5 * (squares - Vector<3>::Ones());
    const Vector<3> second = compliance.inverse() * strain;
    const Vector<3> stress = second.cwiseProduct(squares) / elastic.prod();
    wood.orthotropic.axis_angle = 0.6;
    const Matrix<2> turn = turned_by<2>(0.6);
    const Matrix<2> expected = turn * Vector<2>(stress[0], stress[1]).asDiagonal() * turn.transpose();
    for (const auto& [name, mesh] : boxes<2>()) {
        CAPTURE(name);
        auto options = warm_alone<2>(wood, rise);
        for (const auto& group : mesh.groups) options.boundary.dirichlet.push_back({.group = group.name});
        solid::Solid<2> solid(mesh, options);
        const std::vector<double> q(solid.size(), 0.0);
        const double density = 0.5 * a.prod() * strain.dot(second);
        CHECK(std::abs(solid.potential(q) - density * volume_at_rest<2>(mesh)) <= 1e-12);
        for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
            CHECK((solid.cells().stress(c) - expected).norm() <= 1e-12);
            CHECK(std::abs(solid.cells().out_of_plane_stress(c) - stress[2]) <= 1e-12);
        }
    }
}

TEMPLATE_TEST_CASE_SIG("metal that is warm yields at the strain at which it does cold, and flows as far",
                       "[solid][finite][thermal][plasticity]", ((int Dim), Dim), 2, 3) {
    // F = diag(f, 1, 1): the deviator of ln F_e does not know T. |tau_1 - tau_2| = sigma_y + H alpha, alpha =
    // (2 mu ln f - sigma_y)/(3 mu + H), and tr tau = (3 lambda + 2 mu) ln(f/a^3).
    const bool is_kinematic = GENERATE(false, true);
    constexpr double f = 1.02, rise = 250.0, a = 1.0 + per_kelvin * rise, yield = 0.01, hardening = 0.3;
    Material metal = elastic_of(MaterialLaw::j2);
    metal.flow.yield_stress = yield;
    (is_kinematic ? metal.flow.kinematic_hardening : metal.flow.hardening) = hardening;
    const double mu = metal.mu(), lambda = metal.lambda();
    const solid::WarmInelastic<Dim> body(solid::inelastic_law<3>(metal),
                                         solid::ThermalStretch(solid::thermal_strain(metal)));
    const auto law = body.copy();
    law->stretch().set_rise(rise);
    Matrix<Dim> g = Matrix<Dim>::Zero();
    g(0, 0) = f - 1.0;
    std::vector<double> memory = law->initial_memory();
    const solid::Advance<Dim> advance = law->advance(g, 1.0, memory);
    const double alpha = (2.0 * mu * std::log(f) - yield) / (3.0 * mu + hardening);
    CHECK(advance.dissipates);
    CHECK(law->plastic_strain(memory) == Approx(alpha).epsilon(1e-10));
    const double apart = yield + hardening * alpha, mean = (lambda + 2.0 / 3.0 * mu) * std::log(f / (a * a * a));
    const Vector<3> tau(mean + 2.0 / 3.0 * apart, mean - apart / 3.0, mean - apart / 3.0);
    const double volume = f / (a * a * a);  // of F_e
    const Matrix<Dim> at_end = law->at(g, memory).stress, f_of = Matrix<Dim>::Identity() + g;
    const Matrix<Dim> sigma = at_end * f_of.transpose() / f_of.determinant();
    CHECK((at_end - advance.response.stress).norm() <= 1e-12);
    for (int i = 0; i < Dim; ++i) CHECK(sigma(i, i) == Approx(tau[i] / volume).epsilon(1e-10));
    if (Dim == 2) CHECK(*law->out_of_plane_stress(g, memory) == Approx(tau[2] / volume).epsilon(1e-10));
    // The tangents against differences of the stress.
    const auto change = some_gradient<Dim>(4, 1.0);
    const auto stress_at = [&](double step, bool advances) -> Matrix<Dim> {
        std::vector<double> of_step = advances ? law->initial_memory() : memory;
        const Matrix<Dim> moved = g + step * change;
        return advances ? law->advance(moved, 1.0, of_step).response.stress : law->at(moved, of_step).stress;
    };
    for (const bool advances : {false, true}) {
        const Matrix<Dim> difference = (stress_at(1e-6, advances) - stress_at(-1e-6, advances)) / 2e-6;
        Matrix<Dim> result;
        const auto changes = std::span(&change, 1);
        if (advances)
            CHECK(law->advanced_changes(g, 1.0, law->initial_memory(), changes, std::span(&result, 1)));
        else
            CHECK(law->stress_changes(g, memory, changes, std::span(&result, 1)));
        CHECK((result - difference).norm() <= 1e-7 * difference.norm());
    }
}

TEST_CASE("a temperature that a finite body cannot have is refused by name", "[solid][finite][thermal][errors]") {
    const auto mesh = mesh::structured_box<2>({0.0, 0.0}, {1.0, 1.0}, {3, 3}, CellShape::quadrangle);
    const auto refused = [&](const solid::SolidOptions<2>& options, const char* why) {
        CHECK_THROWS_WITH(solid::Solid<2>(mesh, options), Contains("temperature") && Contains(why));
    };
    const Material rubber = elastic_of(MaterialLaw::neo_hookean);
    auto options = warm_alone<2>(elastic_of(MaterialLaw::st_venant_kirchhoff), 100.0);
    options.finite.mean_force = solid::MeanForce::discrete_gradient;
    refused(options, "closed_trapezoid");
    options = warm_alone<2>(rubber, 100.0);
    options.finite.stored_energy = {solid::stored_energy<2>(rubber)};
    refused(options, "a law of its own");
    options = warm_alone<2>(elastic_of(MaterialLaw::j2), 100.0);
    options.finite.inelastic = {solid::inelastic_law<2>(options.materials[0])};
    refused(options, "a law of its own");
    CHECK_THROWS_WITH(solid::Solid<2>(mesh, warm_alone<2>(rubber, 600.0)),
                      Contains("a thermal strain of 0.6; 0.5 is allowed"));
    CHECK_THROWS_WITH(solid::Solid<2>(mesh, warm_alone<2>(rubber, std::nan(""))), Contains("is not finite"));
}
