// Rigid bodies: tops against closed forms, impacts and bounces that keep energy, momentum and angular momentum.
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <numbers>

#include "abut/base/rotation.hpp"
#include "abut/contact/surface/obstacle.hpp"
#include "abut/dynamics/filter.hpp"
#include "abut/dynamics/leapfrog.hpp"
#include "abut/solid/cell_view.hpp"
#include "abut/solid/contact_view.hpp"
#include "solid/turning_scenes.hpp"

using namespace abut;
using namespace abut::test;
using solid::Kinematics;

namespace {

using std::numbers::pi;

/// A box of these sides about the origin, and its moments of inertia for density 1.
struct Box {
    Vector<3> sides;

    [[nodiscard]] mesh::Mesh<3> mesh() const {
        return mesh::structured_box<3>(-0.5 * sides, 0.5 * sides, {2, 3, 2}, CellShape::hexahedron);
    }
    [[nodiscard]] Vector<3> inertia() const {
        const Vector<3> squares = sides.cwiseProduct(sides);
        return sides.prod() / 12.0 * (squares.sum() * Vector<3>::Ones() - squares);
    }
};

/// A free rigid body that starts with this spin.
template <class Scheme>
struct Top {
    mesh::Mesh<3> mesh;
    solid::Solid<3> solid;
    Scheme scheme;

    Top(const Box& box, const Vector<3>& spin, double dt)
        : mesh(box.mesh()),
          solid(mesh, options()),
          scheme(solid, std::vector<double>(solid.size(), 0.0), momentum_of<3>(solid, {{.spin = spin}}), dt) {}
    Top(const Top&) = delete;

    static solid::SolidOptions<3> options() {
        auto made = bodies<3>(1);
        made.contact.reset();
        made.kinematics = {Kinematics::rigid};
        return made;
    }
    /// The rotation from the positions at rest, of three cells.
    [[nodiscard]] Matrix<3> turn() const {
        const auto q = solid.cells().displacement(scheme.q());
        Matrix<3> rest, now;
        const std::array<std::int32_t, 4> cells{0, 1, 2, 6};
        for (int k = 0; k < 3; ++k) {
            const std::int32_t a = cells[0], b = cells[static_cast<std::size_t>(k) + 1];
            rest.col(k) = mesh.cell_centroid[b] - mesh.cell_centroid[a];
            now.col(k) = rest.col(k) + q[b] - q[a];
        }
        return now * rest.inverse();
    }
};
using FreeTop = Top<dynamics::Memm<solid::Solid<3>>>;

Matrix<3> turned(const Vector<3>& rotation) {
    const double angle = rotation.norm();
    return rotation_about(Vector<3>(rotation / angle), angle);
}

/// Of a body with I_1 = I_2 that starts unturned: it precesses about L and spins about its own axis.
Matrix<3> symmetric_top(const Vector<3>& inertia, const Vector<3>& spin, double time) {
    const Vector<3> l = inertia.cwiseProduct(spin);
    return turned(time / inertia[0] * l) * turned({0.0, 0.0, time * l[2] * (1.0 / inertia[2] - 1.0 / inertia[0])});
}

double angle_between(const Matrix<3>& a, const Matrix<3>& b) {
    return std::asin(std::min(1.0, (a - b).norm() / std::sqrt(8.0))) * 2.0;
}

}  // namespace

TEST_CASE("a free symmetric top precesses as in its closed form, with order 2", "[solid][rigid]") {
    const Box box{{1.0, 1.0, 0.5}};
    const Vector<3> spin(0.6, 0.0, 0.8);
    const auto error_after = [&](int steps_per_turn, double turns) {
        FreeTop top(box, spin, 2.0 * pi / steps_per_turn);
        for (int i = 0; i < turns * steps_per_turn; ++i) top.scheme.step();
        return angle_between(top.turn(), symmetric_top(box.inertia(), spin, top.scheme.time()));
    };
    const double coarse = error_after(100, 5.0), fine = error_after(200, 5.0);
    CHECK(fine < 0.05);
    CHECK(std::log2(coarse / fine) == Approx(2.0).margin(0.05));
    CHECK(error_after(10000, 1.0) < 1e-5);
}

TEST_CASE("a body that turns about its middle axis flips with the period of the elliptic integral", "[solid][rigid]") {
    const Box box{{1.0, 0.7, 0.35}};
    const Vector<3> inertia = box.inertia();  // rising: the longest side is first
    const double disturbance = 1e-3;
    const Vector<3> spin(disturbance, 1.0, 0.0);
    // Twice the quarter period of sn, from the energy and |L|: Landau and Lifshitz, Mechanics, paragraph 37.
    const Vector<3> l = inertia.cwiseProduct(spin);
    const double square = l.squaredNorm(), twice = l.dot(spin);
    const auto [i1, i2, i3] = std::array{inertia[0], inertia[1], inertia[2]};
    const double above = square - twice * i2;  // > 0: nearer to the axis of the largest moment
    const double rate = std::sqrt(above > 0.0 ? (i3 - i2) * (square - twice * i1) / (i1 * i2 * i3)
                                              : (i2 - i1) * (twice * i3 - square) / (i1 * i2 * i3));
    const double complement = above > 0.0 ? (i3 - i1) * above / ((i3 - i2) * (square - twice * i1))
                                          : (i3 - i1) * -above / ((i2 - i1) * (twice * i3 - square));  // 1 - k^2
    double a = 1.0, b = std::sqrt(complement);
    for (int i = 0; i < 20; ++i) std::tie(a, b) = std::pair(0.5 * (a + b), std::sqrt(a * b));
    const double flip = pi / (a * rate);

    const auto flips_after = [&](int steps_per_turn, int flips) {
        FreeTop top(box, spin, 2.0 * pi / steps_per_turn);
        const Vector<3> axis = l.normalized();
        double before = 1.0, first = 0.0, last = 0.0;
        for (int n = 0; n < flips + 1;) {
            top.scheme.step();
            const double along = axis.dot(top.turn().col(1));
            if (along * before < 0.0) {
                last = top.scheme.time() - top.scheme.dt() * std::abs(along) / (std::abs(along) + std::abs(before));
                if (n++ == 0) first = last;
            }
            before = along;
        }
        return (last - first) / flips;
    };
    const double coarse = std::abs(flips_after(200, 4) / flip - 1.0), fine = std::abs(flips_after(400, 4) / flip - 1.0);
    CHECK(fine < 3e-4);
    CHECK(std::log2(coarse / fine) == Approx(2.0).margin(0.1));
}

TEMPLATE_TEST_CASE("a free rigid body keeps H~, J~ and its shape for many turns", "[solid][rigid]",
                   dynamics::Memm<solid::Solid<3>>) {
    Top<TestType> top({{1.0, 0.7, 0.4}}, {0.3, 1.0, 0.2}, 2.0 * pi / 40);
    const auto moment_now = [&] {
        return dynamics::pseudo_angular_momentum<3>(top.scheme, top.scheme.dt(), top.solid.rest_positions(),
                                                    top.solid.masses());
    };
    const Vector<3> moment_start = moment_now();
    const double energy = top.scheme.pseudo_energy();
    double energy_drift = 0.0, moment_drift = 0.0, deformation = 0.0;
    for (int i = 0; i < 20000; ++i) {
        top.scheme.step();
        raise(energy_drift, std::abs(top.scheme.pseudo_energy() - energy));
        raise(moment_drift, (moment_now() - moment_start).norm());
        raise(deformation, (top.turn().transpose() * top.turn() - Matrix<3>::Identity()).norm());
    }
    CHECK(energy_drift <= 1e-12 * energy);
    CHECK(moment_drift <= 1e-12 * moment_start.norm());
    CHECK(deformation <= 1e-11);
}

TEST_CASE("a rigid box that falls on a plane bounces and tumbles with its energy", "[solid][rigid]") {
    auto options = bodies<3>(1);
    options.acceleration = {{0.0, 0.0, -0.01}};
    options.obstacles = {contact::plane_obstacle<3>({0.0, 0.0, -1.0}, {0.0, 0.0, 1.0}, 10.0)};
    options.contact->compression_limit = 2.5;  // rounding decides how it lands, after some bounces: 2.03 at most in 20 runs
    TurningScene<3> scene(Box{{1.0, 0.7, 0.4}}.mesh(), options, {{.spin = {0.03, 0.05, 0.02}}}, 0.9, Kinematics::rigid);
    dynamics::NeutralFilter filter(scene.solid);
    scene.memm.set_after_step([&](auto q, double dt, auto before, auto after) { filter(q, dt, before, after); });
    scene.run(20000);
    const Drifts drifts = scene.drifts();
    const auto report = scene.solid.contact().report();
    CHECK(report.active_pairs_max > 0);
    CHECK(report.missed_contacts == 0);
    CHECK(drifts.pseudo_energy <= 1e-12);
    CHECK(drifts.energy_excess <= 2e-2);
}

TEMPLATE_TEST_CASE_SIG("rigid and floating bodies collide with all that they must keep", "[solid][rigid]", ((int Dim), Dim),
                       2, 3) {
    for (const Kinematics other : {Kinematics::rigid, Kinematics::floating}) {
        auto scene = [&] {
            if constexpr (Dim == 2)
                return std::make_unique<TurningScene<2>>(
                    two_discs(0.8), bodies<2>(2),
                    std::vector<Motion<2>>{{{0.05, 0.0}, some_spin<2>(0.1)}, {.velocity = {-0.05, 0.0}}}, 0.6,
                    std::vector{Kinematics::rigid, other});
            else
                return std::make_unique<TurningScene<3>>(
                    two_boxes(4), bodies<3>(2),
                    std::vector<Motion<3>>{{.velocity = {0.02, 0.01, 0.05}}, {{-0.02, 0.0, -0.05}, some_spin<3>(0.1)}}, 0.6,
                    std::vector{Kinematics::rigid, other});
        }();
        dynamics::NeutralFilter filter(scene->solid);
        scene->memm.set_after_step([&](auto q, double dt, auto before, auto after) { filter(q, dt, before, after); });
        scene->run_until(30.0);
        check_collision(*scene);
    }
}
