// Bodies whose temperature is given: closed forms of thermal stress, and the work that heat does.
#include <catch2/catch.hpp>

#include <Eigen/Dense>
#include <array>
#include <cmath>

#include "abut/base/error.hpp"
#include "abut/solid/cell_view.hpp"
#include "abut/solid/contact_view.hpp"
#include "abut/solid/statics.hpp"
#include "solid/finite_scenes.hpp"

using namespace abut;
using namespace abut::test;
using Catch::Contains;
using solid::Kinematics;
using solid::Material;
using solid::MaterialLaw;

namespace {

constexpr double expansion = 1e-5, rise = 80.0;

Material steel() {
    Material material{.young = 2.0, .poisson = 0.3, .density = 1.5};
    material.expansion.along_1 = expansion;
    return material;
}

Material wood() {
    Material material{.young = 10.0, .poisson = 0.4, .density = 0.7, .law = MaterialLaw::orthotropic};
    material.orthotropic.young_2 = 0.8;
    material.orthotropic.young_3 = 0.5;
    material.orthotropic.poisson_13 = 0.45;
    material.orthotropic.poisson_23 = 0.35;
    material.orthotropic.shear_12 = 0.7;
    material.orthotropic.shear_13 = 0.6;
    material.orthotropic.shear_23 = 0.1;
    material.expansion.along_1 = 0.4 * expansion;
    material.expansion.along_2 = 3.0 * expansion;
    material.expansion.along_3 = 4.0 * expansion;
    return material;
}

template <int Dim>
solid::TemperatureRise<Dim> constant(double value) {
    return {.value = [value](double, const Vector<Dim>&) { return value; }, .varies = false};
}

template <int Dim>
solid::SolidOptions<Dim> warm(const Material& material, Kinematics kinematics = Kinematics::small, double value = rise) {
    auto options = alone<Dim>(material);
    options.kinematics = {kinematics};
    options.temperature_rise = {constant<Dim>(value)};
    return options;
}

double volume_of(const auto& mesh) {
    double volume = 0.0;
    for (const double measure : mesh.cell_measure) volume += measure;
    return volume;
}

/// Where the strain is eps everywhere: the largest force, over that of a stress of `scale`.
template <int Dim>
double out_of_balance(solid::Solid<Dim>& solid, const mesh::Mesh<Dim>& mesh, const Matrix<Dim>& strain, double scale) {
    const auto q = sampled<Dim>(mesh, [&](const Vector<Dim>& x) -> Vector<Dim> { return strain * x; });
    std::vector<double> force(q.size());
    solid.force(q, force);
    (void)solid.potential(q);
    return largest(force) / scale;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("a warm body that nothing holds expands without stress, along the axes of its material",
                       "[solid][material]", ((int Dim), Dim), 2, 3) {
    // In plane strain the length out of the plane is held: (1 + nu) alpha T in the plane, and -E alpha T out of it.
    for (const auto& [name, mesh] : boxes<Dim>()) {
        CAPTURE(name);
        const Material material = steel();
        const double scale = material.young * expansion * rise;
        solid::Solid<Dim> solid(mesh, warm<Dim>(material));
        const double free = expansion * rise * (Dim == 2 ? 1.0 + material.poisson : 1.0);
        CHECK(out_of_balance<Dim>(solid, mesh, free * Matrix<Dim>::Identity(), scale) <= 1e-12);
        for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
            CHECK(solid.cells().stress(c).norm() <= 1e-12 * scale);
            CHECK(std::abs(solid.cells().out_of_plane_stress(c) + (Dim == 2 ? scale : 0.0)) <= 1e-12 * scale);
        }
        const auto q = sampled<Dim>(mesh, [&](const Vector<Dim>& x) -> Vector<Dim> { return free * x; });
        const double stored = Dim == 2 ? 0.5 * scale * expansion * rise * volume_of(mesh) : 0.0;
        CHECK(std::abs(solid.potential(q) - stored) <= 1e-12 * scale * expansion * rise);
        if constexpr (Dim == 3) {
            Material turned = wood();
            const Matrix<3> axes = turned_by<3>(0.8);
            for (int i = 0; i < 3; ++i) {
                turned.orthotropic.axis_1[static_cast<std::size_t>(i)] = axes(i, 0);
                turned.orthotropic.axis_2[static_cast<std::size_t>(i)] = axes(i, 1);
            }
            solid::Solid<3> of_wood(mesh, warm<3>(turned));
            const Vector<3> along =
                rise * Vector<3>(turned.expansion.along_1, turned.expansion.along_2, turned.expansion.along_3);
            CHECK(out_of_balance<3>(of_wood, mesh, axes * along.asDiagonal() * axes.transpose(), scale) <= 1e-12);
            for (std::int32_t c = 0; c < mesh.n_cells(); ++c) CHECK(of_wood.cells().stress(c).norm() <= 1e-12 * scale);
        }
    }
}

TEMPLATE_TEST_CASE_SIG("warm bodies that are held have the thermal stresses of closed forms", "[solid][material]",
                       ((int Dim), Dim), 2, 3) {
    // Held all round -E alpha T/(1 - 2 nu); a bar between two walls -E alpha T, in plane strain -E alpha T/(1 - nu).
    const Material material = steel();
    const double nu = material.poisson, scale = material.young * expansion * rise;
    for (const auto& [name, mesh] : boxes<Dim>())
        for (const bool all_round : {true, false}) {
            CAPTURE(name, all_round);
            auto options = warm<Dim>(material);
            for (const auto& group : mesh.groups)
                if (all_round)
                    options.boundary.dirichlet.push_back({.group = group.name});
                else if (group.name == "xmin" || group.name == "xmax")
                    options.boundary.dirichlet.push_back({.group = group.name, .constraint = solid::Constraint::normal});
            solid::Solid<Dim> solid(mesh, options);
            Matrix<Dim> strain = Matrix<Dim>::Zero(), stress = Matrix<Dim>::Zero();
            if (all_round) {
                stress = -scale / (1.0 - 2.0 * nu) * Matrix<Dim>::Identity();
            } else {
                stress(0, 0) = -scale * (Dim == 2 ? 1.0 / (1.0 - nu) : 1.0);
                for (int i = 1; i < Dim; ++i)
                    strain(i, i) = expansion * rise * (Dim == 2 ? (1.0 + nu) / (1.0 - nu) : 1.0 + nu);
            }
            CHECK(out_of_balance<Dim>(solid, mesh, strain, scale) <= 1e-12);
            for (std::int32_t c = 0; c < mesh.n_cells(); ++c)
                CHECK((solid.cells().stress(c) - stress).norm() <= 1e-12 * scale);
        }
}

TEST_CASE("a strip of two bonded pieces bends with Timoshenko's curvature as it gets warm", "[solid][material][bonds]") {
    // S. Timoshenko, J. Opt. Soc. Am. 11 (1925) 233: with m = t_1/t_2 and n = E_1/E_2, nu = 0,
    // kappa = 6 (alpha_2 - alpha_1) T (1 + m)^2/(h (3 (1 + m)^2 + (1 + m n) (m^2 + 1/(m n)))).
    // Finite strains are that small here, too.
    const auto kinematics = GENERATE(Kinematics::small, Kinematics::finite);
    constexpr double t_1 = 0.4, t_2 = 0.6, length = 6.0;
    Material lower{.young = 1.0, .poisson = 0.0, .density = 1.0}, upper{.young = 2.5, .poisson = 0.0, .density = 1.0};
    lower.expansion.along_1 = 2.3e-5;
    upper.expansion.along_1 = 1.2e-5;
    const double m = t_1 / t_2, n = lower.young / upper.young, h = t_1 + t_2;
    const double exact = 6.0 * (upper.expansion.along_1 - lower.expansion.along_1) * rise * std::pow(1.0 + m, 2) /
                         (h * (3.0 * std::pow(1.0 + m, 2) + (1.0 + m * n) * (m * m + 1.0 / (m * n))));
    std::vector<double> errors;
    for (const int layers : {3, 6}) {
        const auto mesh = together(
            mesh::structured_box<2>({0.0, -t_1}, {length, 0.0}, {12 * layers, layers}, CellShape::quadrangle, "lower"),
            mesh::structured_box<2>({0.0, 0.0}, {length, t_2}, {10 * layers, layers}, CellShape::quadrangle, "upper"));
        auto options = bodies<2>(2);
        options.contact.reset();
        options.materials = {lower, upper};
        options.kinematics.assign(2, kinematics);
        options.bonds = {{.sides = {0, 1}}};
        options.temperature_rise.assign(2, constant<2>(rise));
        for (const char* side : {"lower.xmin", "upper.xmin"}) options.boundary.dirichlet.push_back({.group = side});
        solid::Solid<2> solid(mesh, options);
        const auto solution = solid::solve_statics<2>(solid, std::vector<double>(solid.size(), 0.0), {.tolerance = 1e-7});
        CHECK(solution.report.converged);
        // A parabola through the lowest cells of the upper piece, away from the ends.
        std::vector<Vector<2>> points;
        std::vector<double> moved;
        for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
            const Vector<2>& x = mesh.cell_centroid[static_cast<std::size_t>(c)];
            if (x[0] < 2.0 || x[0] > 4.5 || x[1] < 0.0 || x[1] > t_2 / layers) continue;
            points.push_back(x);
            moved.push_back(vectors<2>(solution.q)[c].y());
        }
        Eigen::MatrixXd of(std::ssize(points), 3);
        for (std::size_t i = 0; i < points.size(); ++i)
            of.row(static_cast<Eigen::Index>(i)) << 1.0, points[i][0], 0.5 * points[i][0] * points[i][0];
        const Eigen::VectorXd fit =
            of.colPivHouseholderQr().solve(Eigen::Map<Eigen::VectorXd>(moved.data(), std::ssize(moved)));
        errors.push_back(fit[2] / -exact - 1.0);  // the lower piece gets longer, and pushes the ends up
    }
    CAPTURE(errors);
    CHECK(std::abs(errors[1]) <= 0.015);
    CHECK(std::abs(errors[1]) <= 0.35 * std::abs(errors[0]));  // second order
}

TEMPLATE_TEST_CASE_SIG(
    "the work of a temperature that varies is booked: H~ + D - W and momentum are kept, also of what turns, yields and "
    "touches",
    "[solid][material]", ((int Dim), Dim), 2, 3) {
    const auto field = [](double amplitude) {
        return solid::TemperatureRise<Dim>{.value =
                                               [amplitude](double t, const Vector<Dim>& x) {
                                                   return amplitude *
                                                          (std::sin(1.3 * t) + 0.5 * x[0] * std::min(1.0, 0.2 * t));
                                               },
                                           .varies = true};
    };
    for (const bool yields : {false, true})
        for (const Kinematics kinematics : {Kinematics::small, Kinematics::floating, Kinematics::finite}) {
            CAPTURE(yields, static_cast<int>(kinematics));
            Material material = steel();
            if (yields) {
                material.law = MaterialLaw::j2;
                material.flow.yield_stress = 2e-3;
                material.flow.hardening = 0.1;
            }
            auto options = bodies<Dim>(2);
            options.law = solid::ContactLaw::pair_potential;
            options.materials.assign(2, material);
            options.temperature_rise = {field(300.0), field(-200.0)};
            mesh::Mesh<Dim> mesh;
            std::vector<Motion<Dim>> motion(2);
            if constexpr (Dim == 2) {
                mesh = two_discs(0.5, 0.5);
                for (int body = 0; body < 2; ++body) motion[body].velocity = disc_velocities[body];
            } else {
                mesh = two_boxes(3);
                for (int body = 0; body < 2; ++body) motion[body].velocity = box_velocities[body];
            }
            TurningScene<Dim> scene(mesh, options, motion, 0.6, kinematics);
            scene.run(steps_of_collision<Dim>);
            const Drifts drifts = scene.drifts();
            CHECK(scene.solid.contact().report().active_pairs_max > 0);
            CHECK(std::abs(scene.solid.work()) > 1e-3 * scene.ledger.largest_energy());
            CHECK((scene.solid.dissipated().in_cells > 0.0) == yields);
            CHECK(drifts.pseudo_energy <= 1e-12);
            CHECK(drifts.momentum <= 1e-13);
            if (kinematics != Kinematics::small) CHECK(drifts.pseudo_moment <= 1e-13);
        }
}

TEST_CASE("bonded pieces whose temperatures vary keep H~ - W, small ones, those that turn and those that bend",
          "[solid][material][bonds]") {
    const auto mesh = together(mesh::structured_box<2>({0.0, -0.4}, {2.0, 0.0}, {8, 3}, CellShape::quadrangle, "lower"),
                               mesh::structured_box<2>({0.0, 0.0}, {2.0, 0.6}, {6, 3}, CellShape::triangle, "upper"));
    for (const Kinematics kinematics : {Kinematics::small, Kinematics::floating, Kinematics::finite}) {
        CAPTURE(static_cast<int>(kinematics));
        auto options = bodies<2>(2);
        options.contact.reset();
        options.materials.assign(2, steel());
        options.bonds = {{.sides = {0, 1}}};
        for (const double amplitude : {200.0, -100.0})
            options.temperature_rise.push_back(
                {.value = [amplitude](double t, const Vector<2>& x) { return amplitude * (std::sin(2.0 * t) + 0.3 * x[1]); },
                 .varies = true});
        TurningScene<2> scene(mesh, options, std::vector<Motion<2>>(2), 0.6, kinematics);
        scene.run(400);
        CHECK(std::abs(scene.solid.work()) > 1e-3 * scene.ledger.largest_energy());
        CHECK(scene.drifts().pseudo_energy <= 1e-12);
    }
}

TEST_CASE("a run with a temperature goes on from its state with the same bits", "[solid][material]") {
    const auto mesh = unit_disc(0.5);
    auto options = warm<2>(steel());
    options.temperature_rise[0] = {.value = [](double t, const Vector<2>& x) { return 100.0 * t + 30.0 * x[0]; },
                                   .varies = true};
    check_that_it_goes_on(mesh, options, 20);
}

TEST_CASE("a temperature that a body cannot have is refused by name", "[solid][material][errors]") {
    const auto mesh = mesh::structured_box<2>({0.0, 0.0}, {1.0, 1.0}, {3, 3}, CellShape::quadrangle);
    const auto refused = [&](const solid::SolidOptions<2>& options, const char* why) {
        CHECK_THROWS_WITH(solid::Solid<2>(mesh, options), Contains("temperature") && Contains(why));
    };
    refused(warm<2>(steel(), Kinematics::rigid), "is rigid");
    auto options = warm<2>(steel());
    options.materials[0].expansion.along_1 = 0.0;
    refused(options, "thermal_expansion of 0");
    options = warm<2>(steel());
    options.precision = solid::Precision::single_precision;
    refused(options, "Precision::double_precision");
    options = warm<2>(steel(), Kinematics::small, std::nan(""));
    refused(options, "is not finite");
    options = warm<2>(steel());
    options.materials[0].expansion.along_1 = 12.0;  // of a million
    refused(options, "a thermal strain of");
    options = warm<2>(steel());
    options.temperature_rise.push_back(constant<2>(1.0));
    refused(options, "temperatures: 2 given");
}
