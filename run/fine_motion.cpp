#include "abut/run/fine_motion.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "abut/dynamics/ledger.hpp"
#include "abut/mesh/mesh.hpp"
#include "abut/solid/cell_view.hpp"
#include "abut/solid/solid.hpp"

namespace abut::run {
namespace {

/// The neighbours of each cell of a body, one list behind the other.
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
            of_cells_[next[static_cast<std::size_t>(cells[0])]++] = static_cast<std::size_t>(cells[1]);
            of_cells_[next[static_cast<std::size_t>(cells[1])]++] = static_cast<std::size_t>(cells[0]);
        }
    }

    /// The mean of a field over those that lie on both sides of a cell, which is the cell's own value of a linear field;
    /// nothing where there are none.
    [[nodiscard]] std::optional<Vector<Dim>> mean(std::size_t cell, const std::vector<Vector<Dim>>& field) const {
        Vector<Dim> sum = Vector<Dim>::Zero(), sum_of_all = Vector<Dim>::Zero();
        int count = 0;
        for (const std::size_t other : of(cell)) {
            sum_of_all += field[other];
            if (!is_opposed(cell, other)) continue;
            sum += field[other];
            ++count;
        }
        if (count > 0) return Vector<Dim>(sum / count);
        if (is_inner_[cell] == 0) return std::nullopt;
        return Vector<Dim>(sum_of_all / static_cast<double>(of(cell).size()));
    }

private:
    [[nodiscard]] std::span<const std::size_t> of(std::size_t cell) const {
        return std::span(of_cells_).subspan(first_[cell], first_[cell + 1] - first_[cell]);
    }
    [[nodiscard]] Vector<Dim> direction(std::size_t cell, std::size_t other) const {
        return (mesh_.cell_centroid[other] - mesh_.cell_centroid[cell]).normalized();
    }
    /// Whether another neighbour lies on the opposite side, as in rows of bricks.
    [[nodiscard]] bool is_opposed(std::size_t cell, std::size_t other) const {
        constexpr double opposite = -0.9;  // cosine
        const Vector<Dim> there = direction(cell, other);
        return std::ranges::any_of(of(cell), [&](std::size_t one) { return there.dot(direction(cell, one)) < opposite; });
    }

    const mesh::Mesh<Dim>& mesh_;
    std::vector<std::size_t> first_, of_cells_;
    std::vector<char> is_inner_;
};

struct OfBody {
    double all = 0.0, seen = 0.0,
           fine = 0.0;  // kinetic energies [J]: of all cells, of those that count, of their fine motion
};

}  // namespace

template <int Dim>
double fine_kinetic_energy(const dynamics::RunView<Dim>& run, const solid::Solid<Dim>& solid) {
    const mesh::Mesh<Dim>& mesh = solid.mesh();
    const std::vector<Vector<Dim>> velocity = solid.cells().velocity(run.p_after);
    const Neighbours<Dim> neighbours(mesh);
    std::vector<OfBody> bodies(static_cast<std::size_t>(mesh.n_bodies()));
    for (std::size_t c = 0; c < velocity.size(); ++c) {
        const auto body = static_cast<std::size_t>(mesh.cell_body[c]);
        const double half_mass = 0.5 * solid.options().materials[body].density * mesh.cell_measure[c];
        const double kinetic = half_mass * velocity[c].squaredNorm();
        bodies[body].all += kinetic;
        const std::optional<Vector<Dim>> around = neighbours.mean(c, velocity);
        if (!around) continue;
        bodies[body].seen += kinetic;
        bodies[body].fine += half_mass * (0.5 * (velocity[c] - *around)).squaredNorm();
    }
    double sum = 0.0;
    for (const OfBody& body : bodies)
        if (body.seen > 0.0) sum += body.all * body.fine / body.seen;
    return sum;
}

template double fine_kinetic_energy<2>(const dynamics::RunView<2>&, const solid::Solid<2>&);
template double fine_kinetic_energy<3>(const dynamics::RunView<3>&, const solid::Solid<3>&);

}  // namespace abut::run
