#include "abut/mesh/part.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/mesh/mesh_of_cells.hpp"

namespace abut::mesh {
namespace {

template <int Dim>
void check(const Mesh<Dim>& mesh, std::span<const int> owner, int layers, std::span<const std::int32_t> whole_bodies) {
    if (std::ssize(owner) != mesh.n_cells())
        throw BadInput(mesh.name + ": owners of " + std::to_string(owner.size()) + " cells are given for " +
                           std::to_string(mesh.n_cells()) + " cells. Give one per cell.",
                       {.value = static_cast<double>(owner.size()), .allowed = static_cast<double>(mesh.n_cells())});
    if (layers < 1)
        throw BadInput(
            mesh.name + ": a part with " + std::to_string(layers) + " layers of copies is asked for, 1 at least is needed.",
            {.value = static_cast<double>(layers), .allowed = 1.0});
    for (const std::int32_t body : whole_bodies)
        if (body < 0 || body >= mesh.n_bodies())
            throw BadInput(mesh.name + ": the whole of body " + std::to_string(body) +
                               " is asked for; bodies are counted from 0 to " + std::to_string(mesh.n_bodies() - 1) + ".",
                           {.value = static_cast<double>(body), .allowed = static_cast<double>(mesh.n_bodies() - 1)});
    for (std::int32_t c = 1; c < mesh.n_cells(); ++c)
        if (mesh.cell_body[c] == mesh.cell_body[c - 1] && mesh.cell_faces[c].size() != mesh.cell_faces[c - 1].size() &&
            std::ranges::find(whole_bodies, mesh.cell_body[c]) == whole_bodies.end())
            throw BadInput(mesh.name + ": body '" + mesh.body_names[static_cast<std::size_t>(mesh.cell_body[c])] +
                               "' has cells of " + std::to_string(mesh.cell_faces[c - 1].size()) + " and of " +
                               std::to_string(mesh.cell_faces[c].size()) +
                               " faces. Ranks cannot share such a body out: mesh it with cells of one kind.",
                           {.cell = c});
}

/// Appends the cells that are not taken and share a vertex with one of these: only where bodies are pinched are they not
/// neighbours across few faces.
template <int Dim>
void append_around(const Mesh<Dim>& mesh, std::span<const std::int32_t> own, const std::vector<bool>& taken,
                   std::vector<std::int32_t>& cells) {
    std::vector<bool> is_own(mesh.vertices.size(), false);
    for (const std::int32_t c : own)
        for (const std::int32_t v : mesh.cell_vertices[c]) is_own[static_cast<std::size_t>(v)] = true;
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c)
        if (!taken[static_cast<std::size_t>(c)] &&
            std::ranges::any_of(mesh.cell_vertices[c], [&](std::int32_t v) { return is_own[static_cast<std::size_t>(v)]; }))
            cells.push_back(c);
}

/// Own cells and copies, increasing.
template <int Dim>
std::vector<std::int32_t> cells_of_part(const Mesh<Dim>& mesh, std::span<const int> owner, int rank, int layers,
                                        std::span<const std::int32_t> whole_bodies) {
    std::vector<std::int32_t> cells, outermost, next;
    std::vector<bool> taken(owner.size(), false), is_whole(static_cast<std::size_t>(mesh.n_bodies()), false);
    for (const std::int32_t body : whole_bodies) is_whole[static_cast<std::size_t>(body)] = true;
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
        const bool of_whole = is_whole[static_cast<std::size_t>(mesh.cell_body[c])];
        if (!of_whole && owner[static_cast<std::size_t>(c)] != rank) continue;
        taken[static_cast<std::size_t>(c)] = true;
        cells.push_back(c);
        if (!of_whole) outermost.push_back(c);
    }
    const std::vector<std::int32_t> own = outermost;
    for (int layer = 0; layer < layers; ++layer) {
        next.clear();
        for (const std::int32_t c : outermost)
            for (const std::int32_t f : mesh.cell_faces[c])
                for (const std::int32_t neighbour : mesh.face_cells[f])
                    if (neighbour >= 0 && !taken[static_cast<std::size_t>(neighbour)]) {
                        taken[static_cast<std::size_t>(neighbour)] = true;
                        next.push_back(neighbour);
                    }
        std::swap(outermost, next);
        cells.insert(cells.end(), outermost.begin(), outermost.end());
    }
    append_around(mesh, own, taken, cells);
    std::ranges::sort(cells);
    return cells;
}

}  // namespace

template <int Dim>
MeshPart<Dim> part_of(const Mesh<Dim>& mesh, std::span<const int> owner, int rank, int layers,
                      std::span<const std::int32_t> whole_bodies) {
    check(mesh, owner, layers, whole_bodies);
    MeshPart<Dim> result;
    result.n_cells = mesh.n_cells();
    result.cell_number = cells_of_part(mesh, owner, rank, layers, whole_bodies);
    for (const std::int32_t c : result.cell_number) result.cell_owner.push_back(owner[static_cast<std::size_t>(c)]);
    result.mesh = mesh_of_cells(mesh, result.cell_number);
    return result;
}

template MeshPart<2> part_of(const Mesh<2>&, std::span<const int>, int, int, std::span<const std::int32_t>);
template MeshPart<3> part_of(const Mesh<3>&, std::span<const int>, int, int, std::span<const std::int32_t>);

}  // namespace abut::mesh
