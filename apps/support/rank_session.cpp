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
#include "abut/mesh/mesh_bytes.hpp"
#include "abut/ranks/bytes.hpp"
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

std::vector<std::byte> of_first_rank(std::vector<std::byte> bytes) {
    return the_session ? ranks::of_first(the_session->all(), std::move(bytes)) : std::move(bytes);
}

namespace {

/// Calls body() on rank 0; throws on all ranks what it throws.
template <class Body>
void on_first_rank(const Body& body) {
    on_all([&] {
        if (the_session->all().rank() == 0) body();
    });
}

/// The part of this rank, which rank 0 makes of the whole mesh: one after the other, its own at the end, so that it never
/// has two.
template <int Dim>
mesh::MeshPart<Dim> part_of_first(const mesh::Mesh<Dim>& whole, std::span<const int> owner,
                                  std::span<const solid::Kinematics> kinematics) {
    const ranks::Communicator& all = the_session->all();
    mesh::MeshPart<Dim> part;
    for (int rank = all.size() - 1; rank >= 0; --rank) {
        std::vector<std::byte> bytes;
        on_first_rank([&] {
            part = solid::part_of<Dim>(whole, owner, rank, kinematics);
            if (rank > 0) bytes = mesh::bytes_of(std::exchange(part, {}));
        });
        if (rank == 0 || (all.rank() != 0 && all.rank() != rank)) continue;
        bytes = ranks::from_first(all, std::move(bytes), rank);
        if (all.rank() == rank) part = mesh::part_in<Dim>(bytes);
    }
    return part;
}

}  // namespace

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
    on_first_rank([&] { of_cells = solid::cell_weights(mesh, kinematics, weights); });
    const std::vector<int> owner = ranks::partition_of_first<Dim>(all, mesh.cell_centroid, of_cells);
    part = part_of_first(mesh, owner, kinematics);
    const solid::PartPoints of_part = solid::points_of<Dim>(part, kinematics);
    points.emplace(all, ranks::shared_points(all, Dim, of_part.n_points, of_part.number, of_part.owner));
}

template <int Dim>
SceneShare<Dim>::SceneShare(const mesh::Mesh<Dim>& mesh, std::vector<solid::Kinematics> kinematics)
    : mesh_(mesh), kinematics_(std::move(kinematics)) {
    if (!the_session || the_session->all().size() == 1) return;
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
