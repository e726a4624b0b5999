#include "abut/run/watch/fine_motion.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "abut/geometry/box.hpp"
#include "abut/mesh/mesh.hpp"

namespace abut::run {
namespace {

constexpr double least_cells_across = 6.0 - 0.5;  // whole cells, rounded
constexpr double least_seen_part = 0.25;          // of the mass of a body, and of its energy to stand for the rest
constexpr double opposite_cosine = -0.9;

/// The neighbours of each cell, one list behind the other.
template <int Dim>
class Neighbours {
public:
    explicit Neighbours(const mesh::Mesh<Dim>& mesh)
        : mesh_(mesh), first_(mesh.cell_measure.size() + 1, 0), is_inner_(mesh.cell_measure.size(), 1) {
        for (const auto& cells : mesh.face_cells) {
            if (cells[1] < 0) is_inner_[static_cast<std::size_t>(cells[0])] = 0;
            if (cells[1] >= 0)
                for (const std::int32_t cell : cells) ++first_[static_cast<std::size_t>(cell) + 1];
        }
        for (std::size_t c = 1; c < first_.size(); ++c) first_[c] += first_[c - 1];
        of_cells_.resize(first_.back());
        std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
        for (const auto& cells : mesh.face_cells) {
            if (cells[1] < 0) continue;
            of_cells_[next[static_cast<std::size_t>(cells[0])]++] = cells[1];
            of_cells_[next[static_cast<std::size_t>(cells[1])]++] = cells[0];
        }
    }

    /// Neighbours that have another one on the opposite side of the cell, as in rows of bricks; where there are none, all
    /// of a cell inside of its body.
    void append_around(std::size_t cell, std::vector<std::int32_t>& list) const {
        const std::span<const std::int32_t> others = of(cell);
        std::vector<Vector<Dim>> directions;
        for (const std::int32_t other : others)
            directions.push_back(
                (mesh_.cell_centroid[static_cast<std::size_t>(other)] - mesh_.cell_centroid[cell]).normalized());
        const std::size_t before = list.size();
        for (std::size_t i = 0; i < others.size(); ++i)
            if (std::ranges::any_of(directions,
                                    [&](const Vector<Dim>& one) { return one.dot(directions[i]) < opposite_cosine; }))
                list.push_back(others[i]);
        if (list.size() == before && is_inner_[cell] != 0) list.insert(list.end(), others.begin(), others.end());
    }

private:
    [[nodiscard]] std::span<const std::int32_t> of(std::size_t cell) const {
        return std::span(of_cells_).subspan(first_[cell], first_[cell + 1] - first_[cell]);
    }

    const mesh::Mesh<Dim>& mesh_;
    std::vector<std::size_t> first_;
    std::vector<std::int32_t> of_cells_;
    std::vector<char> is_inner_;
};

/// Cells along each axis of a body: its extent over the mean distance of neighbours along the axis, and one.
template <int Dim>
struct BodyRows {
    geometry::Box<Dim> centroids;
    Vector<Dim> distance = Vector<Dim>::Zero(), neighbours = Vector<Dim>::Zero();

    void add_neighbours(const Vector<Dim>& apart) {
        int axis = 0;
        for (int i = 1; i < Dim; ++i)
            if (std::abs(apart[i]) > std::abs(apart[axis])) axis = i;
        distance[axis] += std::abs(apart[axis]);
        neighbours[axis] += 1.0;
    }
    [[nodiscard]] double longest() const {
        double cells = 1.0;
        for (int axis = 0; axis < Dim; ++axis)
            if (neighbours[axis] > 0.0)
                cells = std::max(cells,
                                 1.0 + (centroids.upper[axis] - centroids.lower[axis]) * neighbours[axis] / distance[axis]);
        return cells;
    }
};

/// The longest row of cells in each body (n_bodies).
template <int Dim>
std::vector<double> cells_across(const mesh::Mesh<Dim>& mesh) {
    std::vector<BodyRows<Dim>> bodies(static_cast<std::size_t>(mesh.n_bodies()));
    const auto of = [&](std::size_t cell) -> BodyRows<Dim>& {
        return bodies[static_cast<std::size_t>(mesh.cell_body[cell])];
    };
    for (std::size_t c = 0; c < mesh.cell_centroid.size(); ++c) of(c).centroids.extend(mesh.cell_centroid[c]);
    for (const auto& [one, other] : mesh.face_cells) {
        if (other < 0) continue;
        const auto a = static_cast<std::size_t>(one), b = static_cast<std::size_t>(other);
        of(a).add_neighbours(mesh.cell_centroid[b] - mesh.cell_centroid[a]);
    }
    std::vector<double> across;
    for (const BodyRows<Dim>& body : bodies) across.push_back(body.longest());
    return across;
}

/// Cells of each body with something to compare them with, as a part of its volume, which is that of its mass (n_bodies).
template <int Dim>
std::vector<double> seen_parts(const mesh::Mesh<Dim>& mesh, std::span<const std::size_t> first) {
    std::vector<double> all(static_cast<std::size_t>(mesh.n_bodies()), 0.0), seen(all);
    for (std::size_t c = 0; c < mesh.cell_measure.size(); ++c) {
        const auto body = static_cast<std::size_t>(mesh.cell_body[c]);
        all[body] += mesh.cell_measure[c];
        if (first[c + 1] > first[c]) seen[body] += mesh.cell_measure[c];
    }
    for (std::size_t body = 0; body < all.size(); ++body) seen[body] /= all[body];
    return seen;
}

/// Kinetic energies of a body [J].
struct OfBody {
    double all = 0.0, seen = 0.0, fine = 0.0;  // of all cells, of those that are compared, of their fine motion

    [[nodiscard]] double fine_of_all() const {
        if (!(fine > 0.0)) return 0.0;
        return std::min(all, fine * all / std::max(seen, least_seen_part * all));
    }
};

}  // namespace

template <int Dim>
FineMotion<Dim>::FineMotion(const mesh::Mesh<Dim>& mesh) : first_(1, 0) {
    const Neighbours<Dim> neighbours(mesh);
    const std::vector<double> across = cells_across(mesh);
    for (std::size_t c = 0; c < mesh.cell_measure.size(); ++c) {
        if (across[static_cast<std::size_t>(mesh.cell_body[c])] > least_cells_across) neighbours.append_around(c, around_);
        first_.push_back(around_.size());
    }
    for (const double part : seen_parts<Dim>(mesh, first_)) is_told_.push_back(part >= least_seen_part);
}

/// The mean of a field over the cells that this one is compared with.
template <int Dim>
Vector<Dim> FineMotion<Dim>::mean_around(std::size_t cell, std::span<const Vector<Dim>> field) const {
    Vector<Dim> sum = Vector<Dim>::Zero();
    for (std::size_t i = first_[cell]; i < first_[cell + 1]; ++i) sum += field[static_cast<std::size_t>(around_[i])];
    return sum / static_cast<double>(first_[cell + 1] - first_[cell]);
}

template <int Dim>
double FineMotion<Dim>::energy(const mesh::Mesh<Dim>& mesh, std::span<const solid::Material> materials,
                               std::span<const Vector<Dim>> velocity) const {
    std::vector<OfBody> bodies(is_told_.size());
    for (std::size_t c = 0; c < velocity.size(); ++c) {
        const auto body = static_cast<std::size_t>(mesh.cell_body[c]);
        if (is_told_[body] == 0) continue;
        const double half_mass = 0.5 * materials[body].density * mesh.cell_measure[c];
        const double kinetic = half_mass * velocity[c].squaredNorm();
        bodies[body].all += kinetic;
        if (first_[c + 1] == first_[c]) continue;
        bodies[body].seen += kinetic;
        bodies[body].fine += half_mass * (0.5 * (velocity[c] - mean_around(c, velocity))).squaredNorm();
    }
    double sum = 0.0;
    for (const OfBody& body : bodies) sum += body.fine_of_all();
    return sum;
}

template class FineMotion<2>;
template class FineMotion<3>;

}  // namespace abut::run
