// The candidate list of bodies that turn holds all that can touch: runs do not depend on how often it is rebuilt, by what
// broad phase, or on how many threads.
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>

#include "abut/base/rotation.hpp"
#include "abut/contact/surface/obstacle.hpp"
#include "abut/dynamics/filter.hpp"
#include "abut/solid/contact_view.hpp"
#include "solid/turning_scenes.hpp"

using namespace abut;
using namespace abut::test;
using geometry::BroadPhase;
using solid::Kinematics;

namespace {

struct State {
    std::vector<double> q, p_before, p_after;
    std::int64_t rebuilds, active, missed;

    friend bool operator==(const State& a, const State& b) {
        const auto same = [](const std::vector<double>& x, const std::vector<double>& y) {
            return x.size() == y.size() && std::memcmp(x.data(), y.data(), x.size() * sizeof(double)) == 0;
        };
        return same(a.q, b.q) && same(a.p_before, b.p_before) && same(a.p_after, b.p_after);
    }
};

template <int Dim>
Matrix<Dim> turned_about_z(double angle) {
    if constexpr (Dim == 2)
        return rotation_in_plane(angle);
    else
        return rotation_about(Vector<3>::UnitZ(), angle);
}

/// A row of bodies between walls that a long thin body and a bar that turns as an obstacle reach with their tips: floating and
/// rigid ones by turns, the last one small.
template <int Dim>
struct Crowd {
    mesh::Mesh<Dim> mesh;
    solid::SolidOptions<Dim> options;
    std::vector<Motion<Dim>> motion;
    std::vector<Kinematics> kinematics;

    explicit Crowd(int refinement = 1, double speed = 1.0) {
        std::vector<mesh::Mesh<Dim>> meshes;
        const auto add = [&](const Vector<2>& centre, const Vector<2>& half, std::array<int, 2> cells, Kinematics kind,
                             const Vector<2>& velocity, double spin) {
            Vector<Dim> lower, upper, v = Vector<Dim>::Zero();
            std::array<int, Dim> counts;
            for (int k = 0; k < 2; ++k) {
                lower[k] = centre[k] - half[k], upper[k] = centre[k] + half[k], v[k] = speed * velocity[k];
                counts[static_cast<std::size_t>(k)] = cells[static_cast<std::size_t>(k)] * refinement;
            }
            if constexpr (Dim == 3) {
                lower[2] = -0.2 - 0.01 * static_cast<double>(meshes.size());
                upper[2] = 0.25;
                counts[2] = refinement;
            }
            meshes.push_back(mesh::structured_box<Dim>(lower, upper, counts,
                                                       Dim == 2 ? CellShape::triangle : CellShape::tetrahedron,
                                                       "body" + std::to_string(meshes.size())));
            AxialVector<Dim> turning = AxialVector<Dim>::Zero();
            turning[turning.size() - 1] = speed * spin;
            motion.push_back({v, turning});
            kinematics.push_back(kind);
        };
        add({0.0, 0.0}, {2.0, 0.1}, {16, 2}, Kinematics::floating, {0.0, 0.0}, 0.05);  // sweeps the others with its tips
        add({1.7, 0.9}, {0.3, 0.2}, {3, 2}, Kinematics::rigid, {-0.02, -0.05}, -0.1);
        add({-1.7, -0.8}, {0.25, 0.25}, {2, 3}, Kinematics::floating, {0.03, 0.02}, 0.2);
        add({0.6, 1.3}, {0.3, 0.3}, {3, 3}, Kinematics::rigid, {0.0, -0.08}, 0.15);
        add({-0.7, -1.3}, {0.2, 0.35}, {2, 3}, Kinematics::rigid, {0.05, 0.06}, -0.1);
        add({-1.0, 1.2}, {0.3, 0.2}, {3, 2}, Kinematics::floating, {0.03, -0.06}, 0.1);
        add({1.5, -1.2}, {0.3, 0.3}, {3, 3}, Kinematics::small, {-0.05, 0.03}, 0.0);
        mesh = mesh::combine<Dim>(meshes);
        options = bodies<Dim>(static_cast<int>(meshes.size()));
        for (int axis = 0; axis < 2; ++axis)
            for (const double side : {-1.0, 1.0}) {
                Vector<Dim> at = Vector<Dim>::Zero(), normal = Vector<Dim>::Zero();
                at[axis] = 2.3 * side, normal[axis] = -side;
                options.obstacles.push_back(contact::plane_obstacle<Dim>(at, normal, 2.3));
            }
        options.obstacles[0].path = [speed](double t) -> Vector<Dim> { return 0.01 * speed * t * Vector<Dim>::Unit(0); };
        // A slab that turns about one of its ends, from outside the walls.
        Vector<Dim> at = Vector<Dim>::Zero();
        at[1] = -1.9;
        contact::RigidObstacle<Dim> bar = contact::plane_obstacle<Dim>(at, Vector<Dim>::Unit(1), 0.5);
        Vector<Dim> pivot = at;
        pivot[0] = -0.5;
        bar.placement = [pivot, speed](double t) -> contact::Placement<Dim> {
            const Matrix<Dim> turn = turned_about_z<Dim>(0.06 * speed * t);
            return {.turn = turn, .offset = pivot - turn * pivot};
        };
        options.obstacles.push_back(bar);
    }

    [[nodiscard]] State after(double time, double skin, BroadPhase broad_phase = BroadPhase::automatic) const {
        auto chosen = options;
        chosen.contact->search.skin = skin;
        chosen.contact->search.broad_phase = broad_phase;
        TurningScene<Dim> scene(mesh, chosen, motion, 0.5, kinematics);
        dynamics::NeutralFilter filter(scene.solid);
        scene.memm.set_after_step([&](auto q, double dt, auto before, auto after) { filter(q, dt, before, after); });
        scene.run_until(time);
        const auto copy = [](std::span<const double> x) { return std::vector<double>(x.begin(), x.end()); };
        const auto report = scene.solid.contact().report();
        CHECK(scene.drifts().pseudo_energy <= 1e-11);
        return {copy(scene.memm.q()), copy(scene.memm.p_before()), copy(scene.memm.p_after()),
                report.rebuilds,      report.active_pairs_max,     report.missed_contacts};
    }
};

template <class Run>
State on_threads(int threads, const Run& run) {
    const oneapi::tbb::global_control control(oneapi::tbb::global_control::max_allowed_parallelism,
                                              static_cast<std::size_t>(threads));
    oneapi::tbb::task_arena arena(threads);
    return arena.execute(run);
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("runs of a crowd do not depend on when candidates are searched",
                       "[solid][kinematics][candidates][long]", ((int Dim), Dim), 2, 3) {
    const double speed = GENERATE(Dim == 2 ? 1.0 : 0.8, 2.0);
    const Crowd<Dim> crowd(1, speed);
    const double time = (Dim == 2 ? 40.0 : 15.0) / speed;
    const State every_step = crowd.after(time, 1e-12);
    CAPTURE(every_step.rebuilds, every_step.active);
    CHECK(every_step.active > 0);
    CHECK(every_step.missed == 0);
    for (const double skin : {0.0, 0.003, 0.05, 0.4}) {
        const State state = crowd.after(time, skin);
        CAPTURE(skin, state.rebuilds, state.active);
        CHECK(state.missed == 0);
        CHECK(state.rebuilds <= every_step.rebuilds);
        CHECK(state == every_step);
    }
}

TEMPLATE_TEST_CASE_SIG(
    "a small body that flies in from far away and spins is met as if candidates were searched at every step",
    "[solid][kinematics][candidates]", ((int Dim), Dim), 2, 3) {
    const auto box = [](Vector<2> lower, Vector<2> upper, std::array<int, 2> cells, const std::string& name) {
        Vector<Dim> low = Vector<Dim>::Constant(0.4 * lower[1]), high = Vector<Dim>::Constant(0.5 * upper[0]);
        std::array<int, Dim> counts;
        counts.fill(2);
        for (std::size_t k = 0; k < 2; ++k) {
            const auto axis = static_cast<std::ptrdiff_t>(k);
            low[axis] = lower[axis], high[axis] = upper[axis], counts[k] = cells[k];
        }
        if (Dim == 3) low[Dim - 1] = -high[Dim - 1];
        return mesh::structured_box<Dim>(low, high, counts, Dim == 2 ? CellShape::triangle : CellShape::tetrahedron, name);
    };
    const auto mesh =
        together<Dim>(box({-1.0, -1.0}, {1.0, 0.0}, {6, 3}, "target"), box({0.1, 2.0}, {0.3, 2.2}, {2, 2}, "bullet"));
    std::int64_t steps = 0;
    const auto run = [&](double skin) {
        auto options = bodies<Dim>(2);
        options.contact->search.skin = skin;
        std::vector<Motion<Dim>> motion(2);
        motion[1].velocity[1] = -0.25;
        motion[1].spin = some_spin<Dim>(0.5);
        TurningScene<Dim> scene(mesh, options, motion, 0.5, std::vector{Kinematics::floating, Kinematics::floating});
        scene.run_until(12.0);
        steps = scene.memm.steps();
        const auto copy = [](std::span<const double> x) { return std::vector<double>(x.begin(), x.end()); };
        const auto report = scene.solid.contact().report();
        return State{copy(scene.memm.q()), copy(scene.memm.p_before()), copy(scene.memm.p_after()),
                     report.rebuilds,      report.active_pairs_max,     report.missed_contacts};
    };
    const State every_step = run(1e-12);
    CHECK(every_step.active > 0);
    for (const double skin : {0.0, 0.02, 0.3}) {
        const State state = run(skin);
        CAPTURE(skin, state.rebuilds, steps);
        CHECK(state == every_step);
        CHECK(state.rebuilds < every_step.rebuilds);
    }
}

TEST_CASE("candidates of a floating body are kept while a prescribed face moves", "[solid][kinematics][candidates]") {
    const auto mesh = together(mesh::structured_box<2>({-1.0, -1.0}, {1.0, 0.0}, {5, 3}, CellShape::triangle, "lower"),
                               mesh::structured_box<2>({-0.5, 0.01}, {0.7, 1.0}, {4, 3}, CellShape::quadrangle, "upper"));
    std::int64_t steps = 0;
    const auto run = [&](double skin) {
        auto options = bodies<2>(2);
        options.contact->search.skin = skin;
        options.boundary.dirichlet.push_back({.group = "lower.ymin", .history = [](double t, const Vector<2>&) {
                                                  return Vector<2>(0.0, 0.03 * std::sin(t));
                                              }});
        std::vector<Motion<2>> motion(2);
        motion[1].velocity = {0.0, -0.02};
        motion[1].spin = some_spin<2>(0.05);
        TurningScene<2> scene(mesh, options, motion, 0.5, std::vector{Kinematics::small, Kinematics::floating});
        scene.run_until(15.0);
        steps = scene.memm.steps();
        CHECK(scene.drifts().pseudo_energy <= 1e-12);
        CHECK(std::abs(scene.solid.work()) > 1e-6);
        const auto copy = [](std::span<const double> x) { return std::vector<double>(x.begin(), x.end()); };
        const auto report = scene.solid.contact().report();
        return State{copy(scene.memm.q()), copy(scene.memm.p_before()), copy(scene.memm.p_after()),
                     report.rebuilds,      report.active_pairs_max,     report.missed_contacts};
    };
    const State every_step = run(1e-12), state = run(0.0);
    CAPTURE(state.rebuilds, steps);
    CHECK(every_step.active > 0);
    CHECK(state == every_step);
    CHECK(state.rebuilds < steps / 4);
}

TEMPLATE_TEST_CASE_SIG("broad phases and threads do not change the bits of a crowd", "[solid][kinematics][candidates]",
                       ((int Dim), Dim), 2, 3) {
    const Crowd<Dim> crowd(Dim == 2 ? 8 : 2, 2.0);
    const double time = 2.0;
    const auto run = [&] { return crowd.after(time, 0.0); };
    const State one = on_threads(1, run);
    CHECK(one.active > 0);
    for (const int threads : {2, 4}) CHECK(on_threads(threads, run) == one);
    for (const BroadPhase method : geometry::broad_phases()) {
        if (method == BroadPhase::brute_force && Dim == 2) continue;
        CAPTURE(std::string(geometry::name(method)));
        CHECK(crowd.after(time, 0.0, method) == one);
    }
}
