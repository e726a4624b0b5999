#include "abut/solid/body/thick_parts.hpp"

#include <algorithm>
#include <cstddef>
#include <span>

namespace abut::solid {
namespace {

constexpr int depth_of_thick = 4;  // cells from free faces: parts of seven cells across have one that deep
constexpr int near_thick = 6;      // cells: from such a one to corners of simplices on the skew

/// Cells that are marked, on all ranks alike.
template <int Dim>
class MarkedCells {
public:
    MarkedCells(const Bodies<Dim>& bodies, const RankPart<Dim>& part)
        : mesh_(bodies.deformable()), part_(part), marks_(bodies.body_of_points().size(), 0.0) {}

    /// Marks the cells with a vertex of a face that is neither held nor bonded.
    void mark_free_faces(const BoundaryConditions<Dim>& conditions) {
        const FaceConditions<Dim> sorted = dynamics::agreed(part_.ranks(), [&] { return sort_to_faces(mesh_, conditions); });
        std::vector<char> vertices(mesh_.vertices.size(), 0);
        for (const BoundaryFace b : boundary_faces(mesh_))
            if (sorted.prescribed[b].isZero(0.0) && sorted.joined[b] == 0)
                mark(mesh_.face_vertices[mesh_face(mesh_, b)], vertices);
        mark_cells_at(vertices);
    }
    /// And those that have a vertex in common with one.
    void spread() {
        std::vector<char> vertices(mesh_.vertices.size(), 0);
        for (std::int32_t cell = 0; cell < mesh_.n_cells(); ++cell)
            if (is_marked(cell)) mark(mesh_.cell_vertices[cell], vertices);
        mark_cells_at(vertices);
    }
    /// The others.
    void turn_over() {
        for (double& mark : marks_) mark = 1.0 - mark;
    }
    [[nodiscard]] std::vector<std::int32_t> cells() const {
        std::vector<std::int32_t> marked;
        for (std::int32_t cell = 0; cell < mesh_.n_cells(); ++cell)
            if (is_marked(cell)) marked.push_back(cell);
        return marked;
    }

private:
    [[nodiscard]] bool is_marked(std::int32_t cell) const { return marks_[static_cast<std::size_t>(cell)] != 0.0; }
    static void mark(std::span<const std::int32_t> of, std::vector<char>& vertices) {
        for (const std::int32_t vertex : of) vertices[static_cast<std::size_t>(vertex)] = 1;
    }
    /// Copies of other ranks' cells are marked by these ranks: around them the part ends.
    void mark_cells_at(const std::vector<char>& vertices) {
        const auto is_at = [&](std::int32_t vertex) { return vertices[static_cast<std::size_t>(vertex)] != 0; };
        for (std::int32_t cell = 0; cell < mesh_.n_cells(); ++cell)
            if (std::ranges::any_of(mesh_.cell_vertices[cell], is_at)) marks_[static_cast<std::size_t>(cell)] = 1.0;
        part_.ranks().fill(marks_, 1, dynamics::CopySet::all);
    }

    const mesh::Mesh<Dim>& mesh_;
    const RankPart<Dim>& part_;
    std::vector<double> marks_;  // by point
};

}  // namespace

template <int Dim>
std::vector<std::int32_t> thick_cells(const Bodies<Dim>& bodies, const RankPart<Dim>& part) {
    MarkedCells<Dim> marked(bodies, part);
    marked.mark_free_faces(bodies.deformable_options().boundary);
    for (int depth = 2; depth < depth_of_thick; ++depth) marked.spread();
    marked.turn_over();
    for (int away = 0; away < near_thick; ++away) marked.spread();
    return marked.cells();
}

template std::vector<std::int32_t> thick_cells(const Bodies<2>&, const RankPart<2>&);
template std::vector<std::int32_t> thick_cells(const Bodies<3>&, const RankPart<3>&);

}  // namespace abut::solid
