#include "abut/mesh/grains.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <queue>
#include <random>
#include <span>
#include <string>
#include <utility>

#include "abut/base/decompositions.hpp"
#include "abut/base/disjoint_sets.hpp"
#include "abut/base/error.hpp"
#include "abut/base/given_value.hpp"
#include "abut/base/messages.hpp"

namespace abut::mesh {
namespace {

constexpr int n_recentred = 3;       // times that centres move to the middle of their grains
constexpr int n_smoothed = 4;        // sweeps over cells that move to the grain that they border on most
constexpr double flat_share = 1e-9;  // of the largest sum of squares along an axis: rounding, not a second layer
constexpr std::int32_t none = -1;

template <int Dim>
class Grains {
public:
    Grains(const Mesh<Dim>& mesh, const GrainOptions& options)
        : mesh_(mesh), options_(options), random_(options.seed), grain_(static_cast<std::size_t>(mesh.n_cells()), none) {}

    std::vector<std::int32_t> make() {
        std::vector<std::int32_t> centres = first_centres();
        grow(centres);
        for (int i = 0; i < n_recentred; ++i) {
            recentre(centres);
            grow(centres);
        }
        for (int i = 0; i < n_smoothed; ++i) smooth();
        number_connected();
        join_small();
        number_connected();
        return std::move(grain_);
    }

private:
    [[nodiscard]] static std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

    /// Calls visit(face, neighbour) for the cells of the same body behind the faces of a cell.
    template <class Visit>
    void for_each_neighbour(std::int32_t cell, const Visit& visit) const {
        for (const std::int32_t face : mesh_.cell_faces[cell]) {
            if (mesh_.is_boundary(face)) continue;
            const auto [first, second] = mesh_.face_cells[at(face)];
            visit(face, first == cell ? second : first);
        }
    }

    /// Cells spread over each body, whose cells are in an order that keeps neighbours together, evenly by measure.
    std::vector<std::int32_t> first_centres() {
        std::vector<std::int32_t> centres;
        const auto& body_of = mesh_.cell_body;
        for (auto begin = body_of.begin(); begin != body_of.end();) {
            const auto end = std::upper_bound(begin, body_of.end(), *begin);
            append_centres(static_cast<std::int32_t>(begin - body_of.begin()),
                           static_cast<std::int32_t>(end - body_of.begin()), centres);
            begin = end;
        }
        return centres;
    }
    void append_centres(std::int32_t first, std::int32_t last, std::vector<std::int32_t>& centres) {
        const double all = std::accumulate(mesh_.cell_measure.begin() + first, mesh_.cell_measure.begin() + last, 0.0);
        const double wanted = std::round(all / std::pow(options_.size, Dim));
        const auto n = static_cast<std::int32_t>(std::clamp(wanted, 1.0, static_cast<double>(last - first)));
        double so_far = 0.0;
        std::int32_t cell = first;
        for (std::int32_t i = 0; i < n; ++i) {
            const double target = (i + random_share()) * all / n;
            while (cell + 1 < last && so_far + mesh_.cell_measure[at(cell)] < target)
                so_far += mesh_.cell_measure[at(cell++)];
            if (centres.empty() || centres.back() < cell) centres.push_back(cell);
        }
    }
    /// In [0, 1); the distributions of the standard library differ from one to another.
    double random_share() { return static_cast<double>(random_() >> 11) * 0x1p-53; }

    /// Each cell to the centre that is nearest along a path through cells.
    void grow(const std::vector<std::int32_t>& centres) {
        using Reached = std::pair<double, std::int32_t>;
        std::vector<double> distance(grain_.size(), std::numeric_limits<double>::infinity());
        std::priority_queue<Reached, std::vector<Reached>, std::greater<>> open;
        for (std::size_t i = 0; i < centres.size(); ++i) {
            grain_[at(centres[i])] = static_cast<std::int32_t>(i);
            distance[at(centres[i])] = 0.0;
            open.emplace(0.0, centres[i]);
        }
        while (!open.empty()) {
            const auto [so_far, cell] = open.top();
            open.pop();
            if (so_far > distance[at(cell)]) continue;
            for_each_neighbour(cell, [&](std::int32_t, std::int32_t other) {
                const double farther =
                    distance[at(cell)] + (mesh_.cell_centroid[at(other)] - mesh_.cell_centroid[at(cell)]).norm();
                if (farther >= distance[at(other)]) return;
                distance[at(other)] = farther;
                grain_[at(other)] = grain_[at(cell)];
                open.emplace(farther, other);
            });
        }
    }

    /// The cell nearest to the centroid of each grain.
    void recentre(std::vector<std::int32_t>& centres) const {
        std::vector<double> measure(centres.size(), 0.0);
        std::vector<Vector<Dim>> centroid(centres.size(), Vector<Dim>::Zero());
        for (std::int32_t cell = 0; cell < mesh_.n_cells(); ++cell) {
            if (grain_[at(cell)] == none) continue;
            measure[at(grain_[at(cell)])] += mesh_.cell_measure[at(cell)];
            centroid[at(grain_[at(cell)])] += mesh_.cell_measure[at(cell)] * mesh_.cell_centroid[at(cell)];
        }
        std::vector<double> nearest(centres.size(), std::numeric_limits<double>::infinity());
        for (std::int32_t cell = 0; cell < mesh_.n_cells(); ++cell) {
            if (grain_[at(cell)] == none) continue;
            const std::size_t grain = at(grain_[at(cell)]);
            const double distance = (mesh_.cell_centroid[at(cell)] - centroid[grain] / measure[grain]).squaredNorm();
            if (distance >= nearest[grain]) continue;
            nearest[grain] = distance;
            centres[grain] = cell;
        }
    }

    /// The neighbour grain that has most face area in common with these cells, and that area; `none`, 0 without any.
    std::pair<std::int32_t, double> most_common(std::span<const std::int32_t> cells) const {
        std::map<std::int32_t, double> area;
        for (const std::int32_t cell : cells)
            for_each_neighbour(cell, [&](std::int32_t face, std::int32_t other) {
                if (grain_[at(other)] != grain_[at(cell)]) area[grain_[at(other)]] += mesh_.face_measure[at(face)];
            });
        std::pair<std::int32_t, double> most{none, 0.0};
        for (const auto& [grain, common] : area)
            if (common > most.second) most = {grain, common};
        return most;
    }

    void smooth() {
        for (std::int32_t cell = 0; cell < mesh_.n_cells(); ++cell) {
            double own = 0.0;
            for_each_neighbour(cell, [&](std::int32_t face, std::int32_t other) {
                if (grain_[at(other)] == grain_[at(cell)]) own += mesh_.face_measure[at(face)];
            });
            const auto [grain, common] = most_common(std::span(&cell, 1));
            if (common > own) grain_[at(cell)] = grain;
        }
    }

    /// A grain for each connected part of a grain, in the order of their first cells.
    void number_connected() {
        DisjointSets connected(grain_.size());
        for (const auto& [first, second] : mesh_.face_cells)
            if (second >= 0 && grain_[at(first)] == grain_[at(second)]) connected.join(first, second);
        std::vector<std::int32_t> number(grain_.size(), none);
        std::int32_t n = 0;
        for (std::int32_t cell = 0; cell < mesh_.n_cells(); ++cell) {
            std::int32_t& of_first = number[at(connected.find(cell))];
            if (of_first == none) of_first = n++;
            grain_[at(cell)] = of_first;
        }
    }

    /// Whether the centroids of these cells lie in one plane (2D: on one line), so that no gradient can be had from them.
    [[nodiscard]] bool is_flat(const std::vector<std::int32_t>& cells) const {
        Vector<Dim> middle = Vector<Dim>::Zero();
        for (const std::int32_t cell : cells) middle += mesh_.cell_centroid[at(cell)] / static_cast<double>(cells.size());
        Matrix<Dim> scatter = Matrix<Dim>::Zero();
        for (const std::int32_t cell : cells) {
            const Vector<Dim> arm = mesh_.cell_centroid[at(cell)] - middle;
            scatter += arm * arm.transpose();
        }
        const Vector<Dim> squares = symmetric_eigenvalues(scatter);
        return squares[0] <= flat_share * squares[Dim - 1];
    }
    [[nodiscard]] bool is_too_small(const std::vector<std::int32_t>& cells) const {
        return cells.size() < at(least_cells_of_grain<Dim>) || is_flat(cells);
    }

    /// Smallest first, each to the neighbour that has most in common with it, until all have cells enough, not in one layer.
    void join_small() {
        const std::int32_t n = *std::ranges::max_element(grain_) + 1;
        std::vector<std::vector<std::int32_t>> cells(at(n));
        for (std::int32_t cell = 0; cell < mesh_.n_cells(); ++cell) cells[at(grain_[at(cell)])].push_back(cell);
        std::priority_queue<std::pair<std::size_t, std::int32_t>, std::vector<std::pair<std::size_t, std::int32_t>>,
                            std::greater<>>
            small;
        const auto queue_if_small = [&](std::int32_t grain) {
            if (is_too_small(cells[at(grain)])) small.emplace(cells[at(grain)].size(), grain);
        };
        for (std::int32_t grain = 0; grain < n; ++grain) queue_if_small(grain);
        while (!small.empty()) {
            const auto [size, grain] = small.top();
            small.pop();
            if (size != cells[at(grain)].size()) continue;  // it has grown since
            const std::int32_t larger = most_common(cells[at(grain)]).first;
            if (larger == none) continue;  // a body of its own
            for (const std::int32_t cell : cells[at(grain)]) grain_[at(cell)] = larger;
            cells[at(larger)].insert(cells[at(larger)].end(), cells[at(grain)].begin(), cells[at(grain)].end());
            cells[at(grain)].clear();
            queue_if_small(larger);
        }
    }

    const Mesh<Dim>& mesh_;
    const GrainOptions& options_;
    std::mt19937_64 random_;
    std::vector<std::int32_t> grain_;
};

}  // namespace

template <int Dim>
std::vector<std::int32_t> grains_of(const Mesh<Dim>& mesh, const GrainOptions& options) {
    require_allowed(mesh.name + ": the size of grains", grain_size, options.size);
    std::vector<std::int32_t> grains = Grains<Dim>(mesh, options).make();
    if (*std::ranges::max_element(grains) + 1 > mesh.n_bodies()) return grains;
    const double smallest = std::pow(least_cells_of_grain<Dim> * *std::ranges::max_element(mesh.cell_measure), 1.0 / Dim);
    throw BadInput(mesh.name + ": grains of size " + number(options.size) +
                       " m leave each body whole. Ask for smaller ones; they have " +
                       std::to_string(least_cells_of_grain<Dim>) + " cells at least, which here is a size of " +
                       number(smallest) + " m.",
                   {.value = options.size, .allowed = smallest});
}

template std::vector<std::int32_t> grains_of<2>(const Mesh<2>&, const GrainOptions&);
template std::vector<std::int32_t> grains_of<3>(const Mesh<3>&, const GrainOptions&);

}  // namespace abut::mesh
