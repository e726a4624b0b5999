// Forces and energies of bodies that turn and touch: one is the gradient of the other, and neither knows where the scene is.
#include <catch2/catch.hpp>
#include <cmath>

#include "abut/solid/cell_view.hpp"
#include "abut/solid/contact_view.hpp"
#include "solid/turning_scenes.hpp"

using namespace abut;
using namespace abut::test;
using solid::Kinematics;

namespace {

/// Two boxes that overlap by a little, by kinds of bodies.
template <int Dim>
struct Touching {
    mesh::Mesh<Dim> mesh;
    solid::Solid<Dim> solid;

    Touching(std::vector<Kinematics> kinematics, double unit = 1.0, const Vector<Dim>& origin = Vector<Dim>::Zero())
        : mesh(made(unit, origin)), solid(mesh, options(std::move(kinematics), unit)) {}
    Touching(const Touching&) = delete;

    static mesh::Mesh<Dim> made(double unit, const Vector<Dim>& origin) {
        if constexpr (Dim == 2)
            return together(
                mesh::structured_box<2>(origin + unit * Vector<2>(-1.0, -1.0), origin + unit * Vector<2>(1.0, 0.0), {5, 3},
                                        CellShape::triangle, "lower"),
                mesh::structured_box<2>(origin + unit * Vector<2>(-0.5, 0.01), origin + unit * Vector<2>(0.7, 1.0), {4, 3},
                                        CellShape::quadrangle, "upper"));
        else
            return together(mesh::structured_box<3>(origin + unit * Vector<3>(-1.0, -1.0, -1.0),
                                                    origin + unit * Vector<3>(1.0, 1.0, 0.0), {4, 3, 2},
                                                    CellShape::tetrahedron, "lower"),
                            mesh::structured_box<3>(origin + unit * Vector<3>(-0.5, -0.6, 0.01),
                                                    origin + unit * Vector<3>(0.7, 0.65, 1.0), {3, 2, 2},
                                                    CellShape::hexahedron, "upper"));
    }
    static solid::SolidOptions<Dim> options(std::vector<Kinematics> kinematics, double unit) {
        auto options = bodies<Dim>(2);
        options.kinematics = std::move(kinematics);
        options.law = solid::ContactLaw::pair_potential;
        options.acceleration.assign(2, Vector<Dim>::Constant(0.003 / unit));
        return options;
    }
};

/// Points of a body at rest, turned about a place and shifted.
template <int Dim>
void move_rigidly(const solid::Solid<Dim>& solid, std::int32_t body, const Matrix<Dim>& turn, const Vector<Dim>& about,
                  const Vector<Dim>& shift, std::vector<double>& q) {
    for (std::size_t i = 0; i < solid.masses().size(); ++i) {
        if (body >= 0 && solid.body_of_points()[i] != body) continue;
        const Vector<Dim> x = solid.rest_positions()[i] + vectors<Dim>(q)[i];
        const Vector<Dim> moved = about + turn * (x - about) + shift - solid.rest_positions()[i];
        vectors<Dim>(q)[i] = moved;
    }
}

/// The upper body presses into the lower one and is turned a little; those that are not rigid are deformed.
template <int Dim>
std::vector<double> touching_state(const Touching<Dim>& scene, double unit, const std::vector<Kinematics>& kinematics) {
    std::vector<double> q(scene.solid.size(), 0.0);
    Vector<Dim> shift = Vector<Dim>::Zero();
    shift[Dim - 1] = -0.04 * unit;
    Vector<Dim> about = scene.mesh.cell_centroid.back();
    move_rigidly<Dim>(scene.solid, 1, turned_by<Dim>(0.02), about, shift, q);
    const auto noise = random_state(q.size(), 5, 2e-3 * unit);
    for (std::size_t i = 0; i < q.size(); ++i)
        if (kinematics[static_cast<std::size_t>(scene.solid.body_of_points()[i / Dim])] != Kinematics::rigid)
            q[i] += noise[i];
    return q;
}

/// A direction that rigid bodies can go: a velocity of the points at their places.
template <int Dim>
std::vector<double> allowed_direction(const Touching<Dim>& scene, const std::vector<double>& q, unsigned seed, double unit,
                                      const std::vector<Kinematics>& kinematics) {
    std::vector<double> d = random_state(q.size(), seed, unit);
    for (std::int32_t body = 0; body < 2; ++body) {
        if (kinematics[static_cast<std::size_t>(body)] != Kinematics::rigid) continue;
        const auto r = random_state(6, seed + 17);
        for (std::size_t i = 0; i < scene.solid.masses().size(); ++i) {
            if (scene.solid.body_of_points()[i] != body) continue;
            AxialVector<Dim> spin = AxialVector<Dim>::Constant(r[3]);
            Vector<Dim> velocity;
            for (int k = 0; k < Dim; ++k) velocity[k] = r[static_cast<std::size_t>(k)] * unit;
            if constexpr (Dim == 3) spin = {r[3], r[4], r[5]};
            const Vector<Dim> arm = scene.solid.rest_positions()[i] + vectors<Dim>(q)[i] - scene.mesh.cell_centroid.back();
            vectors<Dim>(d)[i] = velocity + dynamics::turning_velocity<Dim>(spin, arm);
        }
    }
    return d;
}

const std::vector<std::vector<Kinematics>> kinds{
    {Kinematics::finite, Kinematics::finite},   {Kinematics::rigid, Kinematics::finite},
    {Kinematics::finite, Kinematics::floating}, {Kinematics::floating, Kinematics::floating},
    {Kinematics::rigid, Kinematics::floating},  {Kinematics::rigid, Kinematics::rigid},
    {Kinematics::small, Kinematics::rigid},     {Kinematics::small, Kinematics::floating},
    {Kinematics::small, Kinematics::finite}};

}  // namespace

TEMPLATE_TEST_CASE_SIG("forces are minus the gradient of the energy, along all that rigid bodies can do",
                       "[solid][kinematics]", ((int Dim), Dim), 2, 3) {
    const auto kinematics = GENERATE(from_range(kinds));
    const double unit = GENERATE(1.0, 1e-9, 1e9);
    CAPTURE(int(kinematics[0]), int(kinematics[1]), unit);
    Touching<Dim> scene(kinematics, unit);
    static_cast<void>(scene.solid.potential(std::vector<double>(scene.solid.size(), 0.0)));  // the run begins apart
    const auto q = touching_state<Dim>(scene, unit, kinematics);
    std::vector<double> force(q.size());
    const double energy = scene.solid.potential(q);
    scene.solid.force(q, force);
    REQUIRE(scene.solid.contact().compression() > 0.0);
    for (const unsigned seed : {1u, 2u, 3u}) {
        const auto d = allowed_direction<Dim>(scene, q, seed, unit, kinematics);
        const double h = 1e-6;
        double power = 0.0;
        for (std::size_t i = 0; i < q.size(); ++i) power -= force[i] * d[i];
        // Points of rigid bodies leave their distances at order h^2 only, and V is affine in them.
        const auto at = [&](double s) {
            std::vector<double> x(q);
            for (std::size_t i = 0; i < q.size(); ++i) x[i] += s * d[i];
            return scene.solid.potential(x);
        };
        const double slope = (at(h) - at(-h)) / (2.0 * h);
        CHECK(std::abs(slope - power) <= 1e-5 * (std::abs(power) + std::abs(energy)));
    }
}

TEMPLATE_TEST_CASE_SIG("the energy of bodies that turn does not know how the whole scene lies", "[solid][kinematics]",
                       ((int Dim), Dim), 2, 3) {
    const auto kinematics = GENERATE(from_range(std::vector<std::vector<Kinematics>>(kinds.begin(), kinds.begin() + 6)));
    auto options = Touching<Dim>::options(kinematics, 1.0);
    options.acceleration.clear();
    const auto mesh = Touching<Dim>::made(1.0, Vector<Dim>::Zero());
    solid::Solid<Dim> solid(mesh, options);
    Touching<Dim> like(kinematics);
    const auto q = touching_state<Dim>(like, 1.0, kinematics);
    static_cast<void>(solid.potential(std::vector<double>(solid.size(), 0.0)));
    const double energy = solid.potential(q);
    REQUIRE(solid.contact().compression() > 0.0);
    for (const double angle : {0.3, 1.5, 3.0}) {
        auto moved = q;
        move_rigidly<Dim>(solid, -1, turned_by<Dim>(angle), Vector<Dim>::Constant(0.4), Vector<Dim>::Constant(3.0), moved);
        CHECK(std::abs(solid.potential(moved) - energy) <= 1e-11 * energy);
    }
}

TEMPLATE_TEST_CASE_SIG("bodies that turn collide the same in any unit of length, and far from the origin",
                       "[solid][kinematics]", ((int Dim), Dim), 2, 3) {
    const auto run = [](double unit, double far) {
        const std::vector<Kinematics> kinematics{Kinematics::rigid, Kinematics::floating};
        auto options = bodies<Dim>(2);
        std::vector<Motion<Dim>> motion(2);
        motion[0].velocity[Dim - 1] = 0.05;
        motion[0].spin = some_spin<Dim>(0.02 / unit);
        motion[1].velocity[Dim - 1] = -0.05;
        motion[1].spin = some_spin<Dim>(-0.03 / unit);
        TurningScene<Dim> scene(Touching<Dim>::made(unit, Vector<Dim>::Constant(far)), options, motion, 0.5, kinematics);
        scene.run(120, 5);
        CHECK(scene.solid.contact().report().active_pairs_max > 0);
        CHECK(scene.solid.contact().report().missed_contacts == 0);
        return std::tuple(scene.drifts(), scene.solid.cells().displacement(scene.memm.q()));
    };
    const auto [drifts, q] = run(1.0, 0.0);
    CHECK(drifts.pseudo_energy <= 1e-12);
    for (const auto& [unit, far, tolerance] : {std::tuple(1e-9, 0.0, 1e-9), {1e9, 0.0, 1e-9}, {1.0, 1e6, 1e-5}}) {
        CAPTURE(unit, far);
        const auto [of_drifts, of_q] = run(unit, far);
        CHECK(of_drifts.pseudo_energy <= (far == 0.0 ? 1e-12 : 1e-8));
        CHECK(of_drifts.momentum <= (far == 0.0 ? 1e-13 : 1e-8));
        double difference = 0.0;
        for (std::size_t i = 0; i < q.size(); ++i) raise(difference, (of_q[i] / unit - q[i]).norm());
        CHECK(difference <= tolerance);
    }
}
