// What a step costs on several ranks: cells twice, messages, bytes and processor time of each, in the bulk and in contact.
//
//     mpirun -n 4 --oversubscribe --bind-to none build/release/benchmarks/benchmark_ranks --size 0.05
//
// Two cylinders from Gmsh that collide, by MEMM. Each rank is one thread. The bits of q on all ranks are compared with those
// of the whole solid on rank 0 first. Processor times are those of one rank while the others work as well; a rank that waits in
// MPI uses its processor, too, so that they are taken without messages: of the operators alone, on one rank after the other.
// Expected: own cells n/P each, work twice as in docs/ranks.md, one message per neighbour and step without contact.
#include <mpi.h>
#include <fmt/core.h>
#include <oneapi/tbb/global_control.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstring>

#include "abut/dynamics/memm.hpp"
#include "abut/dynamics/stable_step.hpp"
#include "abut/mesh/part.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "abut/ranks/partition.hpp"
#include "abut/solid/body_motion.hpp"
#include "abut/solid/solid.hpp"
#include "support/measure.hpp"

namespace {

using namespace abut;

struct Choices {
    double size = 0.1;
    int bodies = 1;
    int steps = 100;
    int repetitions = 20;
    std::string json;
};

mesh::Mesh<3> make_mesh(const Choices& choices) {
    std::vector<mesh::Mesh<3>> bodies;
    for (int i = 0; i < choices.bodies; ++i)
        bodies.push_back(mesh::cylinder({.centre = Vector<3>(i == 0 ? -1.005 : 1.005, i == 0 ? 0.0 : 0.5, 0.0),
                                         .size = choices.size,
                                         .variant = i,
                                         .name = i == 0 ? "left" : "right"}));
    return mesh::combine<3>(bodies);
}

solid::SolidOptions<3> options_of(const Choices& choices) {
    solid::SolidOptions<3> options;
    options.materials.assign(static_cast<std::size_t>(choices.bodies), {.young = 1.0, .poisson = 0.3, .density = 1.0});
    if (choices.bodies > 1) options.contact = contact::ContactOptions{};
    return options;
}

std::vector<double> momentum_of(const solid::Solid<3>& solid, int bodies) {
    std::vector<Vector<3>> velocity(static_cast<std::size_t>(bodies), 0.05 * Vector<3>::UnitX());
    if (bodies > 1) velocity[1] *= -1.0;
    std::vector<double> momentum = solid::uniform_momentum<3>(solid, velocity);
    for (std::size_t i = 0; i < momentum.size(); ++i)
        momentum[i] += 1e-3 * solid.masses()[i / 3] * std::sin(5.0 * solid.rest_positions()[i / 3].sum());
    return momentum;
}

/// One value of each rank, on all.
std::vector<double> of_ranks(const ranks::PointRanks& points, double value) { return points.gather(std::span(&value, 1)); }

double sum(const std::vector<double>& values) {
    double total = 0.0;
    for (const double value : values) total += value;
    return total;
}

int run(int argc, char** argv) {
    CLI::App app("What a step costs on several ranks.");
    Choices choices;
    app.add_option("--size", choices.size, "of the cells [m]")->capture_default_str();
    app.add_option("--bodies", choices.bodies, "1, or 2 that collide")->check(CLI::Range(1, 2))->capture_default_str();
    app.add_option("--steps", choices.steps)->capture_default_str();
    app.add_option("--repetitions", choices.repetitions, "of a product, for its time")->capture_default_str();
    app.add_option("--json", choices.json);
    CLI11_PARSE(app, argc, argv);
    const oneapi::tbb::global_control one_thread(oneapi::tbb::global_control::max_allowed_parallelism, 1);

    const ranks::Communicator all(MPI_Comm_c2f(MPI_COMM_WORLD));
    const mesh::Mesh<3> whole = make_mesh(choices);
    const std::vector<int> owner = ranks::partition<3>(all, whole.cell_centroid);
    const mesh::MeshPart<3> part = mesh::part_of<3>(whole, owner, all.rank());
    const ranks::PointRanks points(all, ranks::shared_cells(all, 3, part.n_cells, part.cell_number, part.cell_owner));
    solid::Solid<3> solid(part.mesh, options_of(choices), &points);
    const double dt = 0.9 * dynamics::stable_step(solid).dt;
    dynamics::Memm run(solid, std::vector<double>(solid.size(), 0.0), momentum_of(solid, choices.bodies), dt);

    // The whole, on rank 0: the answer, and the time of a product.
    std::optional<solid::Solid<3>> alone;
    std::optional<dynamics::Memm<solid::Solid<3>>> run_alone;
    if (all.rank() == 0) {
        alone.emplace(whole, options_of(choices));
        run_alone.emplace(*alone, std::vector<double>(alone->size(), 0.0), momentum_of(*alone, choices.bodies), dt);
    }
    const ranks::Traffic before = points.traffic();
    for (int step = 0; step < choices.steps; ++step) run.step();
    const ranks::Traffic after = points.traffic();
    const std::vector<double> q = points.collect(run.q(), 3);
    dynamics::agreed(&points, [&] {
        if (!run_alone) return;
        for (int step = 0; step < choices.steps; ++step) run_alone->step();
        const auto expected = run_alone->q();
        if (q.size() != expected.size() || std::memcmp(q.data(), expected.data(), q.size() * sizeof(double)) != 0)
            throw std::runtime_error("q has other bits than on one rank: the figures are worth nothing");
    });

    // Products of each rank, one rank after the other: exchanges are left out, copies stay as they are.
    std::vector<Vector<3>> u(static_cast<std::size_t>(part.mesh.n_cells())), result(u.size());
    for (std::size_t c = 0; c < u.size(); ++c) u[c] = Vector<3>::Constant(std::sin(static_cast<double>(c)));
    double seconds = 0.0, seconds_alone = 0.0;
    for (int rank = 0; rank < all.size(); ++rank) {
        MPI_Barrier(MPI_COMM_WORLD);
        if (rank != all.rank()) continue;
        seconds = benchmark::time_in_turn(choices.repetitions, benchmark::Clock::processor,
                                          {[&] { solid.ccg().gradient(u, {}, {}, result); }})[0]
                      .least();
        if (!alone) continue;
        std::vector<Vector<3>> u_alone(static_cast<std::size_t>(whole.n_cells()), Vector<3>::Constant(0.3)),
            r(u_alone.size());
        seconds_alone = benchmark::time_in_turn(choices.repetitions, benchmark::Clock::processor,
                                                {[&] { alone->ccg().gradient(u_alone, {}, {}, r); }})[0]
                            .least();
    }
    MPI_Barrier(MPI_COMM_WORLD);

    const auto own = of_ranks(points, static_cast<double>(points.numbers().size())),
               here = of_ranks(points, static_cast<double>(part.mesh.n_cells())),
               neighbours = of_ranks(points, static_cast<double>(points.counts().neighbours_to)),
               sent = of_ranks(points, static_cast<double>(points.counts().sent)), times = of_ranks(points, seconds),
               gathered =
                   of_ranks(points, static_cast<double>(after.gathered_bytes - before.gathered_bytes) / choices.steps);
    if (all.rank() != 0) return 0;
    const auto per_step = [&](std::int64_t n) { return static_cast<double>(n) / choices.steps; };
    const double n = whole.n_cells();
    fmt::print("{} cells on {} ranks, {} steps: q has the bits of one rank\n", whole.n_cells(), all.size(), choices.steps);
    fmt::print("{:>5} {:>10} {:>10} {:>8} {:>11} {:>13} {:>12} {:>13}\n", "rank", "own", "copies", "copies/", "neighbours",
               "sent, B", "gathered, B", "operator, ms");
    for (std::size_t r = 0; r < own.size(); ++r)
        fmt::print("{:>5} {:>10.0f} {:>10.0f} {:>7.1f}% {:>11.0f} {:>13.0f} {:>12.0f} {:>13.2f}\n", r, own[r],
                   here[r] - own[r], 100.0 * (here[r] - own[r]) / own[r], neighbours[r], 24.0 * sent[r], gathered[r],
                   1e3 * times[r]);
    fmt::print("per step of rank 0: {:.2f} exchanges, {:.2f} gathers, {:.2f} reductions, {:.2f} sums\n",
               per_step(after.fills - before.fills), per_step(after.gathers - before.gathers),
               per_step(after.reductions - before.reductions), per_step(after.sums - before.sums));
    fmt::print(
        "operator: {:.1f} ns per cell alone; on all ranks together {:.2f} times that, the slowest {:.2f} times its share\n",
        1e9 * seconds_alone / n, sum(times) / seconds_alone,
        *std::ranges::max_element(times) * static_cast<double>(all.size()) / seconds_alone);
    if (choices.bodies > 1) {
        const auto report = solid.contact_report();
        fmt::print(
            "contact: {} candidates, {} events, {} lists; contact {:.1f} ms, search {:.1f} ms, bulk {:.1f} ms of rank 0\n",
            report.candidates, report.events, report.rebuilds, 1e3 * solid.times().contact, 1e3 * solid.times().search,
            1e3 * solid.times().bulk);
    }
    nlohmann::json json = benchmark::circumstances(argc, argv);
    json["own"] = own, json["here"] = here, json["neighbours"] = neighbours, json["sent"] = sent, json["operator"] = times;
    json["operator_alone"] = seconds_alone;
    benchmark::write(json, choices.json);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    int provided = 0;
    MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
    const int result = benchmark::main(argc, argv, run);
    MPI_Finalize();
    return result;
}
