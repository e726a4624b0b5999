// MaterialLaw::orthotropic against closed forms: Hooke's law by compliances, Christoffel's equation, a bar off its axes.
#include <catch2/catch.hpp>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <numbers>

#include "abut/base/decompositions.hpp"
#include "abut/base/eigen.hpp"
#include "abut/base/error.hpp"
#include "abut/base/rotation.hpp"
#include "abut/solid/ccg/ccg.hpp"
#include "abut/solid/cell_view.hpp"
#include "abut/solid/contact_view.hpp"
#include "solid/dense_stiffness.hpp"
#include "solid/finite_scenes.hpp"

using namespace abut;
using namespace abut::test;
using Catch::Contains;
using Eigen::MatrixXd;
using solid::Kinematics;
using solid::Material;
using solid::MaterialLaw;

namespace {

constexpr double pi = std::numbers::pi;

/// About carbon fibres in epoxy, in units of E_2.
Material ply() {
    Material material{.young = 14.0, .poisson = 0.3, .density = 1.6, .law = MaterialLaw::orthotropic};
    material.orthotropic.young_2 = 1.0;
    material.orthotropic.young_3 = 1.2;
    material.orthotropic.poisson_13 = 0.25;
    material.orthotropic.poisson_23 = 0.45;
    material.orthotropic.shear_12 = 0.5;
    material.orthotropic.shear_13 = 0.6;
    material.orthotropic.shear_23 = 0.35;
    return material;
}

template <int Dim>
Material turned_ply(double angle) {
    Material material = ply();
    if constexpr (Dim == 2) {
        material.orthotropic.axis_angle = angle;
    } else {
        const Matrix<3> axes = turned_by<3>(angle);
        for (int i = 0; i < 3; ++i) {
            material.orthotropic.axis_1[static_cast<std::size_t>(i)] = 2.0 * axes(i, 0);  // of any length
            material.orthotropic.axis_2[static_cast<std::size_t>(i)] = axes(i, 1);
        }
    }
    return material;
}

/// Its axes in space, in columns.
template <int Dim>
Matrix<3> axes_at(double angle) {
    if constexpr (Dim == 2)
        return rotation_about(Vector<3>::UnitZ(), angle);
    else
        return turned_by<3>(angle);
}

Material isotropic_as(const Material& isotropic) {
    Material material = isotropic;
    material.law = MaterialLaw::orthotropic;
    material.orthotropic.young_2 = material.orthotropic.young_3 = isotropic.young;
    material.orthotropic.poisson_13 = material.orthotropic.poisson_23 = isotropic.poisson;
    material.orthotropic.shear_12 = material.orthotropic.shear_13 = material.orthotropic.shear_23 = isotropic.mu();
    return material;
}

/// eps of sigma, component by component in the axes of the material.
Matrix<3> strain_of(const Material& m, const Matrix<3>& axes, const Matrix<3>& stress) {
    const Matrix<3> s = axes.transpose() * stress * axes;
    Matrix<3> e = Matrix<3>::Zero();
    e(0, 0) = (s(0, 0) - m.poisson * s(1, 1) - m.orthotropic.poisson_13 * s(2, 2)) / m.young;
    e(1, 1) = s(1, 1) / m.orthotropic.young_2 - m.poisson / m.young * s(0, 0) -
              m.orthotropic.poisson_23 / m.orthotropic.young_2 * s(2, 2);
    e(2, 2) = s(2, 2) / m.orthotropic.young_3 - m.orthotropic.poisson_13 / m.young * s(0, 0) -
              m.orthotropic.poisson_23 / m.orthotropic.young_2 * s(1, 1);
    e(0, 1) = e(1, 0) = 0.5 * s(0, 1) / m.orthotropic.shear_12;
    e(0, 2) = e(2, 0) = 0.5 * s(0, 2) / m.orthotropic.shear_13;
    e(1, 2) = e(2, 1) = 0.5 * s(1, 2) / m.orthotropic.shear_23;
    return axes * e * axes.transpose();
}

/// sigma of eps: the inverse, by solving for six components.
Matrix<3> stress_of(const Material& m, const Matrix<3>& axes, const Matrix<3>& strain) {
    const std::array<std::pair<int, int>, 6> components{{{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}};
    SmallMatrix<6, 6> compliance;
    SmallMatrix<6, 1> of_strain;
    const auto unit = [&](int k) {
        const auto [i, j] = components[static_cast<std::size_t>(k)];
        Matrix<3> tensor = Matrix<3>::Zero();
        tensor(i, j) = tensor(j, i) = 1.0;
        return tensor;
    };
    for (int k = 0; k < 6; ++k) {
        const auto [i, j] = components[static_cast<std::size_t>(k)];
        of_strain[k] = strain(i, j);
        for (int l = 0; l < 6; ++l) compliance(k, l) = strain_of(m, axes, unit(l))(i, j);
    }
    const SmallMatrix<6, 1> of_stress = as_eigen(compliance).fullPivLu().solve(as_eigen(of_strain));
    Matrix<3> stress = Matrix<3>::Zero();
    for (int k = 0; k < 6; ++k) stress += of_stress[k] * unit(k);
    return stress;
}

/// The stress in space of a strain in the plane or in space.
template <int Dim>
Matrix<3> stress_of(const Material& material, const Matrix<3>& axes, const Matrix<Dim>& g) {
    return stress_of(material, axes, in_3d<Dim>(0.5 * (g + g.transpose())));
}

/// Largest difference over the largest number.
double off(std::span<const double> a, std::span<const double> b) {
    double difference = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) raise(difference, std::abs(a[i] - b[i]));
    return difference / largest(a);
}

template <int Dim>
solid::SolidOptions<Dim> alone_as(const Material& material, Kinematics kinematics) {
    auto options = alone<Dim>(material);
    options.kinematics = {kinematics};
    options.finite.mean_force = solid::MeanForce::closed_trapezoid;
    return options;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("an orthotropic body of isotropic constants has the forces and energies of the isotropic one",
                       "[solid][material]", ((int Dim), Dim), 2, 3) {
    const Material isotropic{.young = 2.0, .poisson = 0.3, .density = 1.5};
    for (const auto& [name, mesh] : boxes<Dim>())
        for (const Kinematics kinematics : {Kinematics::small, Kinematics::finite}) {
            CAPTURE(name, static_cast<int>(kinematics));
            solid::Solid<Dim> plain(mesh, alone_as<Dim>(isotropic, kinematics));
            Material directed = isotropic_as(isotropic);
            if constexpr (Dim == 2)
                directed.orthotropic.axis_angle = 0.7;
            else
                directed.orthotropic.axis_1 = {1.0, 2.0, 2.0}, directed.orthotropic.axis_2 = {2.0, 1.0, -2.0};
            solid::Solid<Dim> other(mesh, alone_as<Dim>(directed, kinematics));
            const auto q = random_state(plain.size(), 4, 1e-3);
            std::vector<double> expected(q.size()), force(q.size());
            plain.force(q, expected);
            other.force(q, force);
            CHECK(off(expected, force) <= 1e-11);
            CHECK(other.potential(q) == Approx(plain.potential(q)).epsilon(1e-12));
            double most = 0.0;
            for (std::int32_t c = 0; c < mesh.n_cells(); ++c) raise(most, plain.cells().stress(c).norm());
            // The isotropic finite body shows nu tr sigma, and at edges F of affine faces: strains of some 0.005 make these wrong by as much.
            const double allowed = kinematics == Kinematics::finite ? 0.01 * most : 1e-11 * most;
            for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
                CHECK((other.cells().stress(c) - plain.cells().stress(c)).norm() <= allowed);
                CHECK(std::abs(other.cells().out_of_plane_stress(c) - plain.cells().out_of_plane_stress(c)) <= allowed);
            }
            CHECK(dynamics::stable_step(other).dt == Approx(dynamics::stable_step(plain).dt).epsilon(1e-4));
        }
}

TEMPLATE_TEST_CASE_SIG("affine fields have the stress of Hooke's law of orthotropic materials, held and with free faces",
                       "[solid][material]", ((int Dim), Dim), 2, 3) {
    const Matrix<Dim> g = some_gradient<Dim>(5, 1e-3);
    for (const double angle : {0.0, 0.6}) {
        const Matrix<3> exact = stress_of<Dim>(ply(), axes_at<Dim>(angle), g);
        const Matrix<Dim> in_plane = exact.topLeftCorner<Dim, Dim>();
        for (const auto& [name, mesh] : boxes<Dim>())
            for (const bool held : {true, false}) {
                CAPTURE(name, angle, held);
                auto options = alone_as<Dim>(turned_ply<Dim>(angle), Kinematics::small);
                for (const auto& group : mesh.groups) {
                    const std::int32_t face = group.faces.front();
                    if (held)
                        options.boundary.dirichlet.push_back(
                            {.group = group.name,
                             .history = [g](double, const Vector<Dim>& x) -> Vector<Dim> { return g * x; }});
                    else
                        options.boundary.traction.push_back(
                            {.group = group.name, .value = in_plane * mesh.face_normal[static_cast<std::size_t>(face)]});
                }
                solid::Solid<Dim> solid(mesh, options);
                const auto q = sampled<Dim>(mesh, [&](const Vector<Dim>& x) -> Vector<Dim> { return g * x; });
                std::vector<double> force(q.size());
                solid.force(q, force);
                CHECK(largest(force) <= 1e-12 * exact.norm());
                for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
                    CHECK((solid.cells().stress(c) - in_plane).norm() <= 1e-12 * exact.norm());
                    if (Dim == 2)
                        CHECK(std::abs(solid.cells().out_of_plane_stress(c) - exact(2, 2)) <= 1e-12 * exact.norm());
                }
                double volume = 0.0, work = 0.0;
                for (const double measure : mesh.cell_measure) volume += measure;
                for (const auto& traction : options.boundary.traction)
                    for (const std::int32_t face : mesh.group(traction.group).faces)
                        work += mesh.face_measure[static_cast<std::size_t>(face)] *
                                traction.value.dot(g * mesh.face_centroid[static_cast<std::size_t>(face)]);
                const double energy = 0.5 * volume * in_plane.cwiseProduct(0.5 * (g + g.transpose())).sum();
                CHECK(solid.potential(q) + work == Approx(energy).epsilon(1e-10));
            }
    }
}

TEST_CASE("a bar pulled off its axes has the modulus of Lekhnitskii's formula and shears as it is pulled",
          "[solid][material]") {
    // 1/E(theta) = c^4/E_1 + s^4/E_2 + (1/G_12 - 2 nu_12/E_1) s^2 c^2, of a bar in uniaxial stress.
    const Material m = ply();
    for (const double angle : {0.0, pi / 12.0, pi / 4.0, pi / 2.0}) {
        CAPTURE(angle);
        const double c = std::cos(angle), s = std::sin(angle);
        const double compliance = std::pow(c, 4) / m.young + std::pow(s, 4) / m.orthotropic.young_2 +
                                  (1.0 / m.orthotropic.shear_12 - 2.0 * m.poisson / m.young) * s * s * c * c;
        Material material = m;
        material.orthotropic.axis_1 = {c, s, 0.0};
        material.orthotropic.axis_2 = {-s, c, 0.0};
        const auto mesh = mesh::structured_box<3>({0.0, 0.0, 0.0}, {3.0, 1.0, 1.0}, {6, 2, 2}, CellShape::hexahedron);
        auto options = alone_as<3>(material, Kinematics::small);
        const double t = 1e-3;
        options.boundary.traction = {{.group = "xmin", .value = {-t, 0.0, 0.0}}, {.group = "xmax", .value = {t, 0.0, 0.0}}};
        solid::Solid<3> solid(mesh, options);
        // K q = f, f being the force of the tractions at rest: rigid motions are left out.
        std::vector<double> zero(solid.size(), 0.0), force(solid.size());
        solid.force(zero, force);
        const Eigen::MatrixXd k = dense_stiffness(solid);
        const Eigen::VectorXd f = Eigen::Map<const Eigen::VectorXd>(force.data(), std::ssize(force));
        const Eigen::VectorXd solution = k.completeOrthogonalDecomposition().solve(f);
        const std::vector<double> q(solution.begin(), solution.end());
        CHECK((k * solution - f).norm() <= 1e-10 * f.norm());
        solid.force(q, force);
        for (std::int32_t cell = 0; cell < mesh.n_cells(); ++cell)
            CHECK(solid.cells().stress(cell)(0, 0) == Approx(t).epsilon(1e-9));
        const auto moved_at = [&](double x) -> Vector<3> {
            for (std::int32_t cell = 0; cell < mesh.n_cells(); ++cell)
                if ((mesh.cell_centroid[static_cast<std::size_t>(cell)] - Vector<3>(x, 0.25, 0.25)).norm() < 1e-9)
                    return vectors<3>(q)[cell];
            FAIL("no cell is there");
            return Vector<3>::Zero();
        };
        CHECK((moved_at(2.75) - moved_at(0.25)).x() / (2.5 * t) == Approx(compliance).epsilon(1e-9));
    }
}

TEMPLATE_TEST_CASE_SIG("plane waves run along the axes and across them with the speeds of Christoffel's equation",
                       "[solid][material]", ((int Dim), Dim), 2, 3) {
    // omega^2 of a wave a sin(k n.x), by the power of the operator on it in cells that see no boundary: rho c^2 is an eigenvalue of
    // C : (a (x) n) . n, up to dispersion of second order.
    const double angle = 0.6;
    const Material material = turned_ply<Dim>(angle);
    Vector<Dim> along = Vector<Dim>::Unit(0), across = Vector<Dim>::Unit(1),
                slanted = Vector<Dim>::Constant(1.0).normalized();
    slanted = (slanted + 0.3 * along).normalized();
    const Matrix<Dim> axes = axes_at<Dim>(angle).template topLeftCorner<Dim, Dim>();
    for (const Vector<Dim>& n : {Vector<Dim>(axes * along), Vector<Dim>(axes * across), slanted}) {
        Matrix<Dim> christoffel;
        for (int j = 0; j < Dim; ++j)
            christoffel.col(j) =
                stress_of<Dim>(ply(), axes_at<Dim>(angle), Matrix<Dim>(Vector<Dim>::Unit(j) * n.transpose()))
                    .template topLeftCorner<Dim, Dim>() *
                n;
        const SymmetricEigen<Dim> modes = symmetric_eigen(Matrix<Dim>(0.5 * (christoffel + christoffel.transpose())));
        for (int mode = 0; mode < Dim; ++mode) {
            const Vector<Dim> a = modes.vectors.col(mode);
            const double exact = std::sqrt(modes.values[mode] / material.density);
            std::array<double, 2> speed;
            for (const int level : {0, 1}) {
                const int cells = (Dim == 2 ? 12 : 8) << level;
                const double k = 1.5;
                mesh::Mesh<Dim> mesh;
                if constexpr (Dim == 2)
                    mesh = mesh::structured_box<2>({0.0, 0.0}, {1.0, 1.0}, {cells, cells}, CellShape::quadrangle);
                else
                    mesh = mesh::structured_box<3>({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, {cells, cells, cells},
                                                   CellShape::hexahedron);
                solid::Solid<Dim> solid(mesh, alone_as<Dim>(material, Kinematics::small));
                const auto q = sampled<Dim>(
                    mesh, [&](const Vector<Dim>& x) -> Vector<Dim> { return std::sin(k * n.dot(x) + 0.5) * a; });
                std::vector<double> force(q.size());
                solid.force(q, force);
                double power = 0.0, inertia = 0.0;
                const double border = 3.4 / cells;  // stencils of two rings
                for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
                    const Vector<Dim>& x = mesh.cell_centroid[static_cast<std::size_t>(c)];
                    if (x.minCoeff() < border || x.maxCoeff() > 1.0 - border) continue;
                    power -= vectors<Dim>(force)[c].dot(vectors<Dim>(q)[c]);
                    inertia += solid.masses()[c] * vectors<Dim>(q)[c].squaredNorm();
                }
                speed[static_cast<std::size_t>(level)] = std::sqrt(power / inertia) / k;
            }
            CAPTURE(n.transpose(), mode, exact, speed[0], speed[1]);
            CHECK(speed[1] == Approx(exact).epsilon(3e-3));
            CHECK(std::abs(speed[1] / exact - 1.0) <= 0.3 * std::abs(speed[0] / exact - 1.0) + 1e-9);
        }
    }
}

TEMPLATE_TEST_CASE_SIG("an orthotropic body knows no rigid motion, and one that spins and rings keeps H~, momentum and J~",
                       "[solid][material]", ((int Dim), Dim), 2, 3) {
    for (const Kinematics kinematics : {Kinematics::small, Kinematics::floating, Kinematics::finite})
        for (const auto& [name, mesh] : boxes<Dim>()) {
            CAPTURE(name, static_cast<int>(kinematics));
            const double spin = kinematics == Kinematics::small ? 0.0 : 0.3;
            const Motion<Dim> spinning{Vector<Dim>::Constant(0.01), some_spin<Dim>(spin)};
            TurningScene<Dim> scene(mesh, alone_as<Dim>(turned_ply<Dim>(0.4), kinematics), {spinning}, 0.6, kinematics,
                                    0.01);
            if (kinematics == Kinematics::finite) {
                const auto q = turned_state<Dim>(mesh, 2.0, 1, 0.0);
                std::vector<double> force(q.size());
                scene.solid.force(q, force);
                CHECK(largest(force) <= 1e-13 * ply().young);
                CHECK(std::abs(scene.solid.potential(q)) <= 1e-13);
                CHECK(slope_error<Dim>(scene.solid, turned_state<Dim>(mesh, 1.0, 2, 0.02)) <= 1e-7);
            }
            scene.run(300);
            const Drifts drifts = scene.drifts();
            CHECK(drifts.pseudo_energy <= 1e-12);
            CHECK(drifts.momentum <= 1e-13);
            if (kinematics != Kinematics::small) CHECK(drifts.pseudo_moment <= 1e-13);
            CHECK(drifts.energy_excess <= 0.6);  // it has not been lost
        }
}

TEST_CASE("the stable step of an orthotropic body is that of its highest mode, however its axes lie", "[solid][material]") {
    for (const double angle : {0.0, 0.4, 1.2})
        for (const auto& [name, mesh] : boxes<2>()) {
            CAPTURE(name, angle);
            solid::Solid<2> solid(mesh, alone_as<2>(turned_ply<2>(angle), Kinematics::small));
            CHECK(dynamics::stable_step(solid).dt / solid.step_margin() ==
                  Approx(2.0 / highest_frequency(solid)).epsilon(0.02));
        }
}

TEMPLATE_TEST_CASE_SIG("orthotropic bodies collide under both laws of contact and keep H~ and momentum", "[solid][material]",
                       ((int Dim), Dim), 2, 3) {
    for (const auto law : {solid::ContactLaw::reconstruction, solid::ContactLaw::pair_potential}) {
        auto options = bodies<Dim>(2);
        options.law = law;
        options.materials = {turned_ply<Dim>(0.5), turned_ply<Dim>(-0.2)};
        mesh::Mesh<Dim> mesh;
        std::vector<Motion<Dim>> motion(2);
        if constexpr (Dim == 2) {
            mesh = two_discs(0.5, 0.5);
            for (int body = 0; body < 2; ++body) motion[body].velocity = disc_velocities[body];
        } else {
            mesh = two_boxes(3);
            for (int body = 0; body < 2; ++body) motion[body].velocity = box_velocities[body];
        }
        CAPTURE(static_cast<int>(law));
        TurningScene<Dim> scene(mesh, options, motion, 0.6, Kinematics::small);
        scene.run(2 * steps_of_collision<Dim>);
        CHECK(scene.solid.contact().report().active_pairs_max > 0);
        CHECK(scene.solid.contact().report().missed_contacts == 0);
        CHECK(scene.drifts().pseudo_energy <= 1e-12);
        CHECK(scene.drifts().momentum <= 1e-13);
    }
}

TEST_CASE("an orthotropic body that is damped by its stiffness keeps H~ + D, and loses nothing as a rigid one",
          "[solid][material]") {
    for (const Kinematics kinematics : {Kinematics::small, Kinematics::floating}) {
        Material material = turned_ply<2>(0.4);
        material.damping.stiffness = 0.01;
        const auto mesh = unit_disc(0.4);
        const Motion<2> spinning{Vector<2>::Constant(0.01), some_spin<2>(kinematics == Kinematics::small ? 0.0 : 0.02)};
        TurningScene<2> scene(mesh, alone_as<2>(material, kinematics), {spinning}, 0.6, kinematics, 0.01);
        const double fall = fall_of_dissipation<2>(scene, 300, &dynamics::Losses::by_damping);
        CHECK(fall <= 0.0);
        CHECK(scene.solid.dissipated().by_damping > 0.1 * scene.ledger.largest_energy());
        CHECK(scene.drifts().pseudo_energy <= 1e-12);
    }
}

TEST_CASE("what an orthotropic material must not be is refused by name, value and limit", "[solid][material][errors]") {
    const auto refused = [](const Material& material, const char* name, const char* why) {
        CHECK_THROWS_WITH(solid::check(material, 3), Contains("body 3") && Contains(name) && Contains(why));
    };
    Material material = ply();
    CHECK_NOTHROW(solid::check(material, 3));
    material.orthotropic.shear_13 = 0.0;
    refused(material, "shear_13", "above 0 Pa");
    material = ply();
    material.orthotropic.poisson_13 = 3.5;  // sqrt(14/1.2) = 3.42
    refused(material, "poisson_13", "3.41565");
    material = ply();
    material.orthotropic.poisson_13 = 3.3;
    material.orthotropic.poisson_23 = -0.9;
    refused(material, "nu_21 nu_32 nu_13", "cost no energy");
    material = ply();
    material.orthotropic.axis_2 = {1.0, 1.0, 0.0};
    refused(material, "axis_1 and axis_2", "0.707107");
    material.orthotropic.axis_2 = {0.0, 0.0, 0.0};
    refused(material, "axis_2", "above 0");
    material = Material{};
    material.orthotropic.axis_1 = {0.0, 1.0, 0.0};
    refused(material, "axis_1", "orthotropic");

    const auto of = [](const auto& mesh, const auto& options) { return solid::Solid(mesh, options); };
    const auto plane = mesh::structured_box<2>({0.0, 0.0}, {1.0, 1.0}, {3, 3}, CellShape::quadrangle);
    const auto space = mesh::structured_box<3>({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, {3, 3, 3}, CellShape::hexahedron);
    CHECK_THROWS_WITH(of(plane, alone_as<2>(turned_ply<3>(0.4), Kinematics::small)), Contains("axis_angle"));
    CHECK_THROWS_WITH(of(space, alone_as<3>(turned_ply<2>(0.4), Kinematics::small)), Contains("axis_1 and axis_2"));
    auto options = alone_as<2>(ply(), Kinematics::small);
    options.precision = solid::Precision::single_precision;
    CHECK_THROWS_WITH(of(plane, options), Contains("orthotropic") && Contains("Precision::double_precision"));
    options = alone_as<2>(ply(), Kinematics::finite);
    options.materials[0].damping.stiffness = 0.1;
    CHECK_THROWS_WITH(of(plane, options), Contains("orthotropic") && Contains("mass_damping"));
}
