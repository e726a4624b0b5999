#include "apps/support/rank_session.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <string>

#include "abut/base/error.hpp"

namespace abut::apps {
namespace {

const ranks::Session* the_session = nullptr;

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
    if (session->all().rank() != 0)
        for (std::FILE* stream : {stdout, stderr})
            if (!std::freopen("/dev/null", "w", stream)) throw Misuse("/dev/null cannot be opened.");
    return session;
}

void start_ranks(int n_ranks) {
    if (the_session) {
        if (const int size = the_session->all().size(); n_ranks > 0 && n_ranks != size)
            throw BadInput(
                fmt::format("--ranks: {} are asked for, but mpirun has started {}. Leave --ranks out.", n_ranks, size));
    } else if (n_ranks > 1) {
        ranks::start_on(n_ranks);
    }
}

void refuse_ranks(const char* what) {
    if (the_session && the_session->all().size() > 1)
        throw BadInput(fmt::format("{}: not made for several ranks. Start the program without mpirun and --ranks.", what));
}

template <int Dim>
SceneShare<Dim>::SceneShare(const mesh::Mesh<Dim>& mesh) {
    if (!the_session || the_session->all().size() == 1) return;
    const ranks::Communicator& all = the_session->all();
    const double print = fingerprint(mesh), largest = all.largest(print), least = -all.largest(-print);
    on_all([&] {
        if (least != largest)
            throw BadInput(mesh.name +
                           ": the ranks have made different meshes of it. Save the mesh to a file, and read that.");
    });
    const std::vector<int> owner = ranks::partition<Dim>(all, mesh.cell_centroid);
    on_all([&] { part_ = mesh::part_of<Dim>(mesh, owner, all.rank()); });
    points_.emplace(all, ranks::shared_cells(all, Dim, part_.n_cells, part_.cell_number, part_.cell_owner));
    share_.emplace(part_.mesh, *points_);
}

template class SceneShare<2>;
template class SceneShare<3>;

}  // namespace abut::apps
