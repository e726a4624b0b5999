// What a step costs on several ranks: cells twice, messages, bytes and processor time of each, in the bulk and in contact.
//
//     mpirun -n 4 --oversubscribe --bind-to none build/release/benchmarks/benchmark_ranks --size 0.05
//     mpirun -n 4 --oversubscribe --bind-to none build/release/benchmarks/benchmark_ranks --plates 40
//
// Cylinders from Gmsh, or two plates that are pressed together all over, by MEMM. Each rank is one thread. The bits of q on
// all ranks are compared with those of the whole solid on rank 0 first. A rank that waits in MPI uses its processor, too, so
// that times are taken without messages, on one rank after the other: of the operator, and of the whole run, which each rank
// goes through once more by itself with the answers that it got from the others (recorded_ranks.hpp). Waiting for a processor
// is left out. Expected: own cells n/P each, work twice as in docs/ranks.md, one message per neighbour and step without
// contact.
#include <fmt/core.h>
#include <mpi.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>
#include <thread>

#include "abut/dynamics/memm.hpp"
#include "abut/dynamics/stable_step.hpp"
#include "abut/mesh/part.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "abut/ranks/partition.hpp"
#include "abut/solid/body_motion.hpp"
#include "abut/solid/contact_view.hpp"
#include "abut/solid/solid.hpp"
#include "recorded_ranks.hpp"
#include "support/measure.hpp"
#include "support/options.hpp"

namespace {

using namespace abut;

struct Choices {
    double size = 0.1;
    int bodies = 1;
    int plates = 0;
    int layers = 2;
    bool hexahedra = false;
    int steps = 100;
    int repetitions = 20;
    int runs = 3;
    std::string json;
};

/// Two plates, a little apart, of n by n cells and of one more each way: their faces do not match.
mesh::Mesh<3> make_plates(const Choices& choices) {
    const auto shape = choices.hexahedra ? mesh::CellShape::hexahedron : mesh::CellShape::tetrahedron;
    const double thickness = static_cast<double>(choices.layers) / choices.plates, gap = 1e-3 / choices.plates;
    const int n = choices.plates, finer = n + 1;
    const std::vector<mesh::Mesh<3>> bodies{
        mesh::structured_box<3>({0.0, 0.0, -thickness}, {1.0, 1.0, 0.0}, {n, n, choices.layers}, shape),
        mesh::structured_box<3>({0.0, 0.0, gap}, {1.0, 1.0, gap + thickness}, {finer, finer, choices.layers}, shape)};
    return mesh::combine<3>(bodies);
}

mesh::Mesh<3> make_mesh(const Choices& choices) {
    if (choices.plates > 0) return make_plates(choices);
    std::vector<mesh::Mesh<3>> bodies;
    for (int i = 0; i < choices.bodies; ++i)
        bodies.push_back(mesh::cylinder({.centre = Vector<3>(i == 0 ? -1.005 : 1.005, i == 0 ? 0.0 : 0.5, 0.0),
                                         .size = choices.size,
                                         .variant = i,
                                         .name = i == 0 ? "left" : "right"}));
    return mesh::combine<3>(bodies);
}

bool has_contact(const Choices& choices) { return choices.plates > 0 || choices.bodies > 1; }

solid::SolidOptions<3> options_of(const Choices& choices) {
    solid::SolidOptions<3> options;
    options.materials.assign(choices.plates > 0 ? 2 : static_cast<std::size_t>(choices.bodies),
                             {.young = 1.0, .poisson = 0.3, .density = 1.0});
    if (has_contact(choices)) options.contact = contact::ContactOptions{};
    return options;
}

std::vector<double> momentum_of(const solid::Solid<3>& solid, const Choices& choices) {
    const Vector<3> direction = choices.plates > 0 ? Vector<3>::UnitZ() : Vector<3>::UnitX();
    std::vector<Vector<3>> velocity(options_of(choices).materials.size(), 0.05 * direction);
    if (velocity.size() > 1) velocity[1] *= -1.0;
    std::vector<double> momentum = solid::uniform_momentum<3>(solid, velocity);
    for (std::size_t i = 0; i < momentum.size(); ++i)
        momentum[i] += 1e-3 * solid.masses()[i / 3] * std::sin(5.0 * solid.rest_positions()[i / 3].sum());
    return momentum;
}

/// A solid and its run.
struct Run {
    solid::Solid<3> solid;
    dynamics::Memm<solid::Solid<3>> scheme;

    Run(const mesh::Mesh<3>& mesh, const Choices& choices, double dt, const dynamics::Ranks& ranks)
        : solid(mesh, options_of(choices), ranks),
          scheme(solid, std::vector<double>(solid.size(), 0.0), momentum_of(solid, choices), dt) {}

    void go(int steps) {
        for (int step = 0; step < steps; ++step) scheme.step();
    }
};

/// What all ranks are given.
struct Shared {
    const ranks::Communicator& all;
    mesh::Mesh<3> whole;
    mesh::MeshPart<3> part;
    ranks::PointRanks points;

    Shared(const ranks::Communicator& communicator, const Choices& choices)
        : all(communicator),
          whole(make_mesh(choices)),
          part(mesh::part_of<3>(whole, ranks::partition<3>(all, whole.cell_centroid), all.rank())),
          points(all, ranks::shared_points(all, 3, part.n_cells, part.cell_number, part.cell_owner)) {}
};

/// One value of each rank, on all.
std::vector<double> of_ranks(const ranks::PointRanks& points, double value) { return points.gather(std::span(&value, 1)); }

double sum(const std::vector<double>& values) {
    double total = 0.0;
    for (const double value : values) total += value;
    return total;
}

double most(const std::vector<double>& values) { return *std::ranges::max_element(values); }

/// Calls work() on one rank after the other; those that wait leave the processor to others.
template <class Work>
void in_turn(const ranks::Communicator& all, const Work& work) {
    for (int rank = 0; rank < all.size(); ++rank) {
        if (rank == all.rank()) work();
        MPI_Request request = MPI_REQUEST_NULL;
        MPI_Ibarrier(MPI_COMM_WORLD, &request);
        for (int is_done = 0; is_done == 0;) {
            MPI_Test(&request, &is_done, MPI_STATUS_IGNORE);
            if (is_done == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    }
}

/// On rank 0, the same run without other ranks: it must have the same bits.
void check_bits(const Shared& shared, const Choices& choices, double dt, const Run& run) {
    const std::vector<double> q = shared.points.collect(run.scheme.q(), 3);
    dynamics::agreed(shared.points, [&] {
        if (shared.all.rank() != 0) return;
        Run alone(shared.whole, choices, dt, dynamics::one_rank());
        alone.go(choices.steps);
        const auto expected = alone.scheme.q();
        if (q.size() != expected.size() || std::memcmp(q.data(), expected.data(), q.size() * sizeof(double)) != 0)
            throw std::runtime_error("q has other bits than on one rank: the figures are worth nothing");
    });
}

/// Seconds of processor, of this rank; for all steps but `list`.
struct Seconds {
    double all = std::numeric_limits<double>::infinity(), bulk = all, contact = all, list = all;
    std::int64_t lists = 0;

    void take_least(const Seconds& other) {
        all = std::min(all, other.all);
        bulk = std::min(bulk, other.bulk);
        contact = std::min(contact, other.contact);
        list = std::min(list, other.list);
        lists = other.lists;
    }
};

/// Of the steps of a run, which make() makes each time. What the solid says of its parts is by the clock on the wall: it gets the
/// share of it in which this rank had a processor.
template <class Make>
Seconds time_steps(const Choices& choices, const Make& make) {
    Seconds least;
    for (int i = 0; i < choices.runs; ++i) {
        const std::unique_ptr<Run> run = make();
        const solid::SolidTimes before = run->solid.times();
        const double wall = benchmark::now(benchmark::Clock::wall);
        const double all = benchmark::seconds_of([&] { run->go(choices.steps); }, benchmark::Clock::processor);
        const double share = all / (benchmark::now(benchmark::Clock::wall) - wall);
        const solid::SolidTimes after = run->solid.times();
        const std::int64_t lists = has_contact(choices) ? run->solid.contact().report().rebuilds : 0;
        least.take_least({.all = all,
                          .bulk = share * (after.bulk - before.bulk),
                          .contact = share * (after.contact - before.contact),
                          .list = share * after.search / static_cast<double>(std::max<std::int64_t>(1, lists)),
                          .lists = lists});
    }
    return least;
}

/// Of a product with the operator.
double time_operator(solid::Solid<3>& solid, std::int32_t n_cells, int repetitions) {
    std::vector<Vector<3>> u(static_cast<std::size_t>(n_cells)), result(u.size());
    for (std::size_t c = 0; c < u.size(); ++c) u[c] = Vector<3>::Constant(std::sin(static_cast<double>(c)));
    return benchmark::time_in_turn(repetitions, benchmark::Clock::processor,
                                   {[&] { solid.ccg().gradient(u, {}, {}, result); }})[0]
        .least();
}

struct Times {
    double product = 0.0, product_alone = 0.0;
    Seconds steps, steps_alone;  // `alone`: on rank 0, of the whole
};

Times measure(const Shared& shared, const Choices& choices, double dt, Run& run, benchmark::RecordedRanks& recorded) {
    Times times;
    in_turn(shared.all, [&] {
        times.product = time_operator(run.solid, shared.part.mesh.n_cells(), choices.repetitions);
        times.steps = time_steps(choices, [&] {
            recorded.replay();
            return std::make_unique<Run>(shared.part.mesh, choices, dt, recorded);
        });
        if (shared.all.rank() != 0) return;
        solid::Solid<3> alone(shared.whole, options_of(choices));
        times.product_alone = time_operator(alone, shared.whole.n_cells(), choices.repetitions);
        times.steps_alone =
            time_steps(choices, [&] { return std::make_unique<Run>(shared.whole, choices, dt, dynamics::one_rank()); });
    });
    return times;
}

/// What the ranks have, and what they sent in the steps.
nlohmann::json print_ranks(const Shared& shared, const Choices& choices, const Times& times, const ranks::Traffic& before,
                           const ranks::Traffic& after) {
    const ranks::PointRanks& points = shared.points;
    const double n_steps = choices.steps;
    const auto own = of_ranks(points, static_cast<double>(points.numbers().size())),
               here = of_ranks(points, static_cast<double>(shared.part.mesh.n_cells())),
               neighbours = of_ranks(points, static_cast<double>(points.counts().neighbours_to)),
               sent = of_ranks(points, static_cast<double>(points.counts().sent)), product = of_ranks(points, times.product),
               gathered = of_ranks(points, static_cast<double>(after.gathered_bytes - before.gathered_bytes) / n_steps);
    if (shared.all.rank() != 0) return {};
    fmt::print("{} cells on {} ranks, {} steps: q has the bits of one rank\n", shared.whole.n_cells(), shared.all.size(),
               choices.steps);
    fmt::print("{:>5} {:>10} {:>10} {:>8} {:>11} {:>13} {:>12} {:>13}\n", "rank", "own", "copies", "copies/", "neighbours",
               "sent, B", "gathered, B", "operator, ms");
    for (std::size_t r = 0; r < own.size(); ++r)
        fmt::print("{:>5} {:>10.0f} {:>10.0f} {:>7.1f}% {:>11.0f} {:>13.0f} {:>12.0f} {:>13.2f}\n", r, own[r],
                   here[r] - own[r], 100.0 * (here[r] - own[r]) / own[r], neighbours[r], 24.0 * sent[r], gathered[r],
                   1e3 * product[r]);
    const auto per_step = [&](std::int64_t n) { return static_cast<double>(n) / n_steps; };
    fmt::print("per step of rank 0: {:.2f} exchanges, {:.2f} gathers, {:.2f} reductions, {:.2f} sums\n",
               per_step(after.fills - before.fills), per_step(after.gathers - before.gathers),
               per_step(after.reductions - before.reductions), per_step(after.sums - before.sums));
    fmt::print(
        "operator: {:.1f} ns per cell alone; on all ranks together {:.2f} times that, the slowest {:.2f} times its share\n",
        1e9 * times.product_alone / shared.whole.n_cells(), sum(product) / times.product_alone,
        most(product) * static_cast<double>(product.size()) / times.product_alone);
    return {{"own", own},          {"here", here},        {"neighbours", neighbours},
            {"sent", sent},        {"operator", product}, {"operator_alone", times.product_alone},
            {"gathered", gathered}};
}

/// Processor times of the steps, of each rank and of one rank that has all.
nlohmann::json print_steps(const Shared& shared, const Choices& choices, const Times& times, const Run& run) {
    const double per_step = 1e3 / choices.steps;
    const auto row = [&](const Seconds& of) {
        return std::array{per_step * of.all, per_step * of.bulk, per_step * of.contact, 1e3 * of.list};
    };
    std::array<std::vector<double>, 4> of_rank;
    for (std::size_t i = 0; i < of_rank.size(); ++i) of_rank[i] = of_ranks(shared.points, row(times.steps)[i]);
    if (shared.all.rank() != 0) return {};
    const auto alone = row(times.steps_alone);
    const auto print = [](const std::string& name, const std::array<double, 4>& ms) {
        fmt::print("{:>8} {:>10.3f} {:>10.3f} {:>12.3f} {:>10.3f}\n", name, ms[0], ms[1], ms[2], ms[3]);
    };
    fmt::print("{:>8} {:>10} {:>10} {:>12} {:>10}\n", "rank", "step, ms", "bulk, ms", "contact, ms", "list, ms");
    std::array<double, 4> busiest{};
    for (std::size_t r = 0; r < of_rank[0].size(); ++r) {
        std::array<double, 4> ms{};
        for (std::size_t i = 0; i < ms.size(); ++i) busiest[i] = std::max(busiest[i], ms[i] = of_rank[i][r]);
        print(std::to_string(r), ms);
    }
    print("alone", alone);
    if (has_contact(choices)) {
        const auto report = run.solid.contact().report();
        fmt::print("contact: {} faces, {} candidates, {} active pairs, {} events, {} lists\n",
                   shared.whole.boundary_faces.size(), report.candidates, report.active_pairs_max, report.events,
                   report.rebuilds);
        fmt::print(
            "busiest rank / alone: step {:.3f}, bulk {:.3f}, contact {:.3f}, list {:.3f}; a list is {:.2f} bulk steps\n",
            busiest[0] / alone[0], busiest[1] / alone[1], busiest[2] / alone[2], busiest[3] / alone[3],
            busiest[3] / busiest[1]);
    }
    return {{"step", of_rank[0]}, {"bulk", of_rank[1]}, {"contact", of_rank[2]}, {"list", of_rank[3]}, {"alone", alone}};
}

int run(int argc, char** argv) {
    benchmark::Options options("What a step costs on several ranks.");
    Choices choices;
    options.add("--size", choices.size, "of the cells of cylinders [m]");
    options.add("--bodies", choices.bodies, "1 cylinder, or 2 that collide").between(1, 2);
    options.add("--plates", choices.plates, "two plates of so many cells along each side, instead of cylinders");
    options.add("--layers", choices.layers, "cells across a plate").positive();
    options.flag("--hexahedra", choices.hexahedra, "plates of hexahedra, not tetrahedra");
    options.add("--steps", choices.steps);
    options.add("--repetitions", choices.repetitions, "of a product, for its time");
    options.add("--runs", choices.runs, "of each rank by itself, for the times of its steps");
    options.add("--json", choices.json);
    if (const auto status = options.parse(argc, argv)) return *status;
    const oneapi::tbb::global_control one_thread(oneapi::tbb::global_control::max_allowed_parallelism, 1);

    const ranks::Communicator all(MPI_Comm_c2f(MPI_COMM_WORLD));
    const Shared shared(all, choices);
    double dt = 0.0;
    {
        solid::Solid<3> of_part(shared.part.mesh, options_of(choices), shared.points);
        dt = 0.9 * dynamics::stable_step(of_part).dt;
    }
    benchmark::RecordedRanks recorded(shared.points, static_cast<std::size_t>(shared.part.mesh.n_cells()));
    Run shared_run(shared.part.mesh, choices, dt, recorded);
    const ranks::Traffic before = shared.points.traffic();
    shared_run.go(choices.steps);
    const ranks::Traffic after = shared.points.traffic();
    check_bits(shared, choices, dt, shared_run);
    const Times times = measure(shared, choices, dt, shared_run, recorded);

    nlohmann::json json = print_ranks(shared, choices, times, before, after);
    json["steps"] = print_steps(shared, choices, times, shared_run);
    if (all.rank() != 0) return 0;
    json.update(benchmark::circumstances(argc, argv));
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
