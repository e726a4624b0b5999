// What thousands of ranks would cost, from what one of them is measured to do and a model of the network.
//
//     build/release/benchmarks/benchmark_weak_scaling --cells 100000 --repetitions 20
//
// A cube of 3x3x3 equal cubes of tetrahedra, a rank each. The one in the middle has other ranks on all sides, as nearly all
// have in a large run; the one at a corner has three. Each is made as a rank makes it, from its part of the mesh, and its
// operator is timed beside that of such a cube alone, on one thread, without any message: how much is done twice. Copies and
// neighbours are counted. The rest is arithmetic: messages, bytes and reductions of a bulk step without contact
// (docs/ranks.md) on nodes that hold ranks in cubes. Expected: less than alone by what copies cost, the less the more cells.
#include <fmt/core.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "abut/mesh/part.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "abut/solid/ccg/ccg.hpp"
#include "support/measure.hpp"
#include "support/options.hpp"

namespace {

using namespace abut;

constexpr int parts_per_edge = 3;
constexpr int tetrahedra_per_brick = 6;

struct Choices {
    double cells = 1e5;
    int repetitions = 20;
    double latency = 2e-6;
    double node_bandwidth = 12.5e9;
    double copy_bandwidth = 5e9;
    int edge_of_node = 4;
};

/// A rank: its operator on its part, and what it has of others.
struct Rank {
    mesh::MeshPart<3> part;
    std::vector<std::int32_t> own;
    std::size_t copies, filled, neighbours;  // all copies, those that a step needs, and the ranks that these are of
    std::unique_ptr<solid::Ccg<3>> ccg;
    std::vector<Vector<3>> u, gradient;

    Rank(mesh::MeshPart<3> from, int rank) : part(std::move(from)) {
        for (std::size_t c = 0; c < part.cell_owner.size(); ++c)
            if (part.cell_owner[c] == rank) own.push_back(static_cast<std::int32_t>(c));
        copies = part.cell_owner.size() - own.size();
        const solid::Material material{.young = 1.0, .poisson = 0.3, .density = 1.0};
        ccg = std::make_unique<solid::Ccg<3>>(part.mesh, std::vector{material}, solid::BoundaryConditions<3>{});
        std::vector<int> others;
        for (const std::int32_t c : ccg->compute_only(own))
            if (const int owner = part.cell_owner[static_cast<std::size_t>(c)]; owner != rank) others.push_back(owner);
        filled = others.size();
        std::ranges::sort(others);
        const auto rest = std::ranges::unique(others);
        neighbours = others.size() - rest.size();
        for (const Vector<3>& x : part.mesh.cell_centroid)
            u.push_back(1e-3 * x.unaryExpr([](double value) { return std::sin(value); }));
        gradient.resize(u.size());
    }
    void evaluate() { ccg->gradient(u, {}, {}, gradient); }
    [[nodiscard]] double bytes() const { return static_cast<double>(filled * 3 * sizeof(double)); }
};

std::vector<int> owners(const mesh::Mesh<3>& whole) {
    std::vector<int> owner;
    for (const Vector<3>& x : whole.cell_centroid) {
        int rank = 0;
        for (int k = 2; k >= 0; --k) rank = parts_per_edge * rank + static_cast<int>(x[k]);
        owner.push_back(rank);
    }
    return owner;
}

mesh::Mesh<3> cube(double edge, int bricks) {
    return mesh::structured_box<3>(Vector<3>::Zero(), Vector<3>::Constant(edge), {bricks, bricks, bricks},
                                   mesh::CellShape::tetrahedron);
}

/// What a step of `rank` waits for, among so many of its kind [s].
double exchange(const Choices& choices, const Rank& rank, int n_ranks) {
    if (n_ranks == 1) return 0.0;
    const int per_node = choices.edge_of_node * choices.edge_of_node * choices.edge_of_node;
    const double to_other_nodes = n_ranks > per_node ? 1.0 / choices.edge_of_node : 0.0;  // of the bytes of a node
    return choices.latency * (static_cast<double>(rank.neighbours) + 2.0 * std::log2(n_ranks)) +
           rank.bytes() / choices.copy_bandwidth + per_node * to_other_nodes * rank.bytes() / choices.node_bandwidth;
}

void print_scaling(const Choices& choices, double alone, const Rank& corner, double at_corner, const Rank& middle,
                   double in_middle) {
    fmt::print("\nranks  operator, ms  exchange, ms  efficiency of a step\n");
    for (const int edge : {1, 2, 4, 8, 16}) {
        const int n = edge * edge * edge;
        const Rank& busiest = edge > 2 ? middle : corner;
        const double work = edge == 1 ? alone : edge == 2 ? at_corner : in_middle;
        const double waits = exchange(choices, busiest, n);
        fmt::print("{:5}  {:12.2f}  {:12.3f}  {:.3f}\n", n, 1e3 * work, 1e3 * waits, alone / (work + waits));
    }
}

int run(int argc, char** argv) {
    Choices choices;
    benchmark::Options options("what thousands of ranks would cost");
    options.add("--cells", choices.cells, "of a rank");
    options.add("--repetitions", choices.repetitions).positive();
    options.add("--latency", choices.latency, "of a message [s]");
    options.add("--node-bandwidth", choices.node_bandwidth, "of all ranks of a node to others [B/s]");
    options.add("--copy-bandwidth", choices.copy_bandwidth, "of one rank, out of and into its arrays [B/s]");
    options.add("--node", choices.edge_of_node, "ranks along the edge of a node");
    if (const auto status = options.parse(argc, argv)) return *status;
    const oneapi::tbb::global_control one(oneapi::tbb::global_control::max_allowed_parallelism, 1);

    const int bricks = std::max(1, static_cast<int>(std::lround(std::cbrt(choices.cells / tetrahedra_per_brick))));
    constexpr int middle_rank = 13;  // of 3x3x3
    mesh::MeshPart<3> of_corner, of_middle, of_one;
    {
        const mesh::Mesh<3> whole = cube(parts_per_edge, parts_per_edge * bricks);
        const std::vector<int> owner = owners(whole);
        of_corner = mesh::part_of<3>(whole, owner, 0);
        of_middle = mesh::part_of<3>(whole, owner, middle_rank);
        const mesh::Mesh<3> single = cube(1.0, bricks);
        of_one = mesh::part_of<3>(single, std::vector<int>(static_cast<std::size_t>(single.n_cells()), 0), 0);
    }
    Rank one_alone(std::move(of_one), 0), corner(std::move(of_corner), 0), middle(std::move(of_middle), middle_rank);
    const auto times =
        benchmark::time_in_turn(choices.repetitions, benchmark::Clock::processor,
                                {[&] { one_alone.evaluate(); }, [&] { corner.evaluate(); }, [&] { middle.evaluate(); }});
    fmt::print("{} tetrahedra a rank, one thread, least of {}\n", one_alone.own.size(), choices.repetitions);
    const Rank* const ranks[] = {&one_alone, &corner, &middle};
    const char* const names[] = {"alone", "corner", "middle"};
    for (std::size_t i = 0; i < 3; ++i)
        fmt::print(
            "{:6}  copies {:6} ({:4.1f} %)  filled {:6} ({:4.1f} %)  of ranks {:2}  sent {:7.0f} B  "
            "operator {:6.2f} ms  {:.3f} of alone\n",
            names[i], ranks[i]->copies, 100.0 * ranks[i]->copies / ranks[i]->own.size(), ranks[i]->filled,
            100.0 * ranks[i]->filled / ranks[i]->own.size(), ranks[i]->neighbours, ranks[i]->bytes(), 1e3 * times[i].least(),
            times[i].least() / times[0].least());
    print_scaling(choices, times[0].least(), corner, times[1].least(), middle, times[2].least());
    return 0;
}

}  // namespace

int main(int argc, char** argv) { return benchmark::main(argc, argv, run); }
