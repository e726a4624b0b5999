#include "apps/support/rank_session.hpp"

#include <fmt/format.h>

#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/mesh/part.hpp"
#include "abut/ranks/partition.hpp"
#include "abut/solid/part/share_out.hpp"

namespace abut::apps {
namespace {

const ranks::Session* the_session = nullptr;
int last_resort = -1;  // standard error of a rank that nobody sees

std::chrono::milliseconds patience() {
    constexpr double by_default = 10.0;
    const char* said = std::getenv("ABUT_RANKS_PATIENCE");
    const double seconds = said ? std::strtod(said, nullptr) : by_default;
    return std::chrono::milliseconds(static_cast<std::int64_t>(1e3 * (seconds > 0.0 ? seconds : by_default)));
}

/// A number that tells meshes apart: of coordinates, cells, bodies and groups, each value with another weight.
template <int Dim>
double fingerprint(const mesh::Mesh<Dim>& mesh) {
    double sum = 0.0;
    std::int64_t n = 0;
    const auto add = [&](double value) { sum += static_cast<double>(1 + n++ % 1009) * value; };
    for (const Vector<Dim>& vertex : mesh.vertices) add(vertex.sum());
    for (const std::int32_t vertex : mesh.cell_vertices.values) add(vertex);
    for (const std::int32_t body : mesh.cell_body) add(body);
    for (const mesh::BoundaryGroup& group : mesh.groups)
        for (const std::int32_t face : group.faces) add(face);
    return sum;
}

}  // namespace

const ranks::Session* rank_session() { return the_session; }

std::unique_ptr<ranks::Session> join_ranks() {
    if (!ranks::is_launched()) return nullptr;
    auto session = std::make_unique<ranks::Session>();
    the_session = session.get();
    if (session->all().rank() != 0) {
        last_resort = dup(STDERR_FILENO);
        for (std::FILE* stream : {stdout, stderr})
            if (!std::freopen("/dev/null", "w", stream)) throw Misuse("/dev/null cannot be opened.");
    }
    return session;
}

void leave_ranks(const std::string& error) {
    if (!the_session) return;
    the_session->leave_with_error(patience(), [&] {
        if (last_resort < 0) return;
        const std::string text = fmt::format("on rank {}: {}\n", the_session->all().rank(), error);
        static_cast<void>(!write(last_resort, text.data(), text.size()));
    });
}

void start_ranks(int n_ranks) {
    if (the_session) {
        if (const int size = the_session->all().size(); n_ranks > 0 && n_ranks != size)
            throw BadInput(
                fmt::format("--ranks: {} are asked for, but mpirun has started {}. Leave --ranks out.", n_ranks, size));
    } else if (n_ranks > ranks::most_ranks_here()) {
        throw BadInput(fmt::format("--ranks: {} are asked for, at most {} are allowed on this machine, which has {} "
                                   "processors. Take fewer, or start more on several machines with mpirun.",
                                   n_ranks, ranks::most_ranks_here(), std::thread::hardware_concurrency()),
                       {.value = static_cast<double>(n_ranks), .allowed = static_cast<double>(ranks::most_ranks_here())});
    } else if (n_ranks > 1) {
        ranks::start_on(n_ranks);
    }
}

void refuse_ranks(const char* what) {
    if (the_session && the_session->all().size() > 1)
        throw BadInput(fmt::format("{}: not made for several ranks. Start the program without mpirun and --ranks.", what));
}

template <int Dim>
struct SceneShare<Dim>::Part {
    Part(const mesh::Mesh<Dim>& mesh, std::span<const solid::Kinematics> kinematics, std::span<const double> weights);
    mesh::MeshPart<Dim> part;
    std::optional<ranks::PointRanks> points;
};

template <int Dim>
SceneShare<Dim>::Part::Part(const mesh::Mesh<Dim>& mesh, std::span<const solid::Kinematics> kinematics,
                            std::span<const double> weights) {
    const ranks::Communicator& all = the_session->all();
    std::vector<double> of_cells;
    on_all([&] { of_cells = solid::cell_weights(mesh, kinematics, weights); });
    const std::vector<int> owner = ranks::partition<Dim>(all, mesh.cell_centroid, of_cells);
    on_all([&] { part = solid::part_of<Dim>(mesh, owner, all.rank(), kinematics); });
    const solid::PartPoints of_part = solid::points_of<Dim>(part, kinematics);
    points.emplace(all, ranks::shared_points(all, Dim, of_part.n_points, of_part.number, of_part.owner));
}

template <int Dim>
SceneShare<Dim>::SceneShare(const mesh::Mesh<Dim>& mesh, std::vector<solid::Kinematics> kinematics)
    : mesh_(mesh), kinematics_(std::move(kinematics)) {
    if (!the_session || the_session->all().size() == 1) return;
    const ranks::Communicator& all = the_session->all();
    const double print = fingerprint(mesh), largest = all.largest(print), least = -all.largest(-print);
    on_all([&] {
        if (least != largest)
            throw BadInput(mesh.name +
                           ": the ranks have made different meshes of it. Save the mesh to a file, and read that.");
    });
    share_.emplace(share_out({}));
    share_->again = [this](std::span<const double> weights) { return share_out(weights); };
}

template <int Dim>
SceneShare<Dim>::~SceneShare() = default;

template <int Dim>
run::Share<Dim> SceneShare<Dim>::share_out(std::span<const double> weights) {
    part_before_ = std::move(part_);
    part_ = std::make_unique<Part>(mesh_, kinematics_, weights);
    return {part_->part.mesh, *part_->points};
}

template class SceneShare<2>;
template class SceneShare<3>;

}  // namespace abut::apps
