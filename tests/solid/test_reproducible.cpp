#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>
#include <catch2/catch.hpp>

#include <cstring>

#include "abut/dynamics/filter.hpp"
#include "abut/dynamics/neutral_restart.hpp"
#include "abut/solid/contact_view.hpp"
#include "solid/scenes.hpp"

using namespace abut;
using namespace abut::test;
using geometry::BroadPhase;

namespace {

struct State {
    std::vector<double> q, p_before, p_after;
    double pseudo_energy;
    std::int64_t events;

    friend bool operator==(const State& a, const State& b) {
        const auto same = [](const std::vector<double>& x, const std::vector<double>& y) {
            return x.size() == y.size() && std::memcmp(x.data(), y.data(), x.size() * sizeof(double)) == 0;
        };
        return same(a.q, b.q) && same(a.p_before, b.p_before) && same(a.p_after, b.p_after) &&
               std::memcmp(&a.pseudo_energy, &b.pseudo_energy, sizeof(double)) == 0 && a.events == b.events;
    }
};

/// Enough cells for the sweeps to run in four parts (8 chunks of 512 cells each), already close to each other.
template <int Dim>
mesh::Mesh<Dim> large_bodies() {
    if constexpr (Dim == 2)
        return two_discs(0.3, 0.027, 0.002);
    else
        return two_boxes(13, 0.002);
}

template <int Dim>
State after_impact(const mesh::Mesh<Dim>& mesh, const std::vector<Vector<Dim>>& velocity, BroadPhase broad_phase,
                   int steps) {
    contact::ContactOptions options;
    options.search.broad_phase = broad_phase;
    Scene<Dim> scene(mesh, reconstructed_bodies<Dim>(2, options), velocity);
    dynamics::NeutralFilter filter(scene.solid);
    scene.memm.set_after_step([&](auto q, double dt, auto p_before, auto p_after) { filter(q, dt, p_before, p_after); });
    dynamics::NeutralRestart restart(scene.solid, {.period = 25});
    scene.memm.set_node_restart([&](auto q, double dt, auto p_before, auto p_after) { restart(q, dt, p_before, p_after); });
    scene.run(steps, steps);
    const auto copy = [](std::span<const double> x) { return std::vector<double>(x.begin(), x.end()); };
    return {copy(scene.memm.q()), copy(scene.memm.p_before()), copy(scene.memm.p_after()),
            scene.ledger.entries().back().pseudo_energy, scene.solid.contact().report().events};
}

/// The same on a given number of threads, more than the machine has if need be.
template <class Run>
State on_threads(int threads, const Run& run) {
    const oneapi::tbb::global_control control(oneapi::tbb::global_control::max_allowed_parallelism,
                                              static_cast<std::size_t>(threads));
    oneapi::tbb::task_arena arena(threads);
    return arena.execute(run);
}

template <int Dim>
std::vector<Vector<Dim>> velocities() {
    if constexpr (Dim == 2)
        return disc_velocities;
    else
        return box_velocities;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("every broad phase gives the same bits", "[solid][reproducible]", ((int Dim), Dim), 2, 3) {
    mesh::Mesh<Dim> mesh;
    if constexpr (Dim == 2)
        mesh = two_discs(0.8);
    else
        mesh = two_boxes(4);
    const int steps = Dim == 2 ? 400 : 150;
    const State brute = after_impact<Dim>(mesh, velocities<Dim>(), BroadPhase::brute_force, steps);
    CHECK(brute.events > 10);
    for (const BroadPhase method : geometry::broad_phases()) {
        CAPTURE(std::string(geometry::name(method)));
        CHECK(after_impact<Dim>(mesh, velocities<Dim>(), method, steps) == brute);
    }
}

TEMPLATE_TEST_CASE_SIG("any number of threads gives the same bits", "[solid][reproducible]", ((int Dim), Dim), 2, 3) {
    const auto mesh = large_bodies<Dim>();
    REQUIRE(mesh.n_cells() > 4 * 8 * 512);
    const int steps = 60;
    const auto run = [&] { return after_impact<Dim>(mesh, velocities<Dim>(), BroadPhase::automatic, steps); };
    const State one = on_threads(1, run);
    CHECK(one.events > 10);
    for (const int threads : {2, 4}) CHECK(on_threads(threads, run) == one);
}
