#include "studies/nodal/statics.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

#include "abut/base/error.hpp"
#include "abut/dynamics/mass.hpp"
#include "abut/geometry/pair_potential/pair_potential.hpp"

namespace abut::studies::nodal {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

Sparse assembled(std::size_t n, std::span<const dynamics::MatrixEntry> entries) {
    std::vector<Eigen::Triplet<double>> triplets;
    for (const auto& [row, column, value] : entries) triplets.emplace_back(row, column, value);
    Sparse matrix(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(n));
    matrix.setFromTriplets(triplets.begin(), triplets.end());
    return matrix;
}

template <int Dim>
constexpr int most_iterations = Dim == 2 ? 400 : 100;

template <int Dim>
using PairMatrix = Eigen::Matrix<double, 2 * Dim * Dim, 2 * Dim * Dim>;

/// Second derivatives by central differences of the gradient, symmetric and without negative eigenvalues.
template <int Dim>
PairMatrix<Dim> pair_hessian(const geometry::PairCorners<Dim>& corners, const geometry::PairLaw<Dim>& law) {
    constexpr int n = 2 * Dim * Dim;
    const double size = std::min((corners[1] - corners[0]).norm(), (corners[Dim + 1] - corners[Dim]).norm());
    const double step = 1e-7 * size;
    PairMatrix<Dim> matrix;
    for (int column = 0; column < n; ++column) {
        auto moved = corners;
        const auto gradient_at = [&](double by) {
            moved[static_cast<std::size_t>(column / Dim)] = corners[static_cast<std::size_t>(column / Dim)];
            moved[static_cast<std::size_t>(column / Dim)][column % Dim] += by;
            return geometry::pair_gradient<Dim>(moved, law).gradient;
        };
        const auto above = gradient_at(step), below = gradient_at(-step);
        for (int row = 0; row < n; ++row) {
            const auto corner = static_cast<std::size_t>(row / Dim);
            matrix(row, column) = (above[corner][row % Dim] - below[corner][row % Dim]) / (2.0 * step);
        }
    }
    const Eigen::SelfAdjointEigenSolver<PairMatrix<Dim>> eigen(0.5 * (matrix + matrix.transpose()));
    // Across the common edge of matching faces the gradient jumps; no pair is stiffer than its spring.
    const double largest = 4.0 * law.stiffness * std::pow(size, Dim - 1);
    const auto values = eigen.eigenvalues().cwiseMax(0.0).cwiseMin(largest);
    return eigen.eigenvectors() * values.asDiagonal() * eigen.eigenvectors().transpose();
}

/// Corners of the two faces of a pair, triangles in 3D: their nodes, and where these are.
template <int Dim>
struct PairNodes {
    std::array<std::int32_t, 2 * Dim> node;
    geometry::PairCorners<Dim> corner;
    geometry::PairLaw<Dim> law;
};
template <int Dim>
PairNodes<Dim> nodes_of(const P1Bodies<Dim>& bodies, const contact::PairStep<Dim>& pair, std::span<const double> q) {
    const contact::SurfaceView<Dim> faces = bodies.contact().surface().facets().view();
    PairNodes<Dim> result{};
    std::size_t i = 0;
    for (const auto face : {static_cast<std::int32_t>(pair.face_1), static_cast<std::int32_t>(pair.face_2)})
        for (const std::int32_t node : faces.vertices_of(face)) {
            result.node[i] = node;
            const bool is_free = static_cast<std::size_t>(node) < q.size() / Dim;  // not of an obstacle, which is at rest
            result.corner[i++] =
                is_free ? Vector<Dim>(faces.vertices[node] + as_vectors<Dim>(q)[node]) : faces.vertices[node];
        }
    const auto face_1 = static_cast<std::int32_t>(pair.face_1), face_2 = static_cast<std::int32_t>(pair.face_2);
    result.law = {.stiffness = pair_stiffness(bodies, faces.body[face_1], faces.body[face_2]),
                  .length = {faces.area[face_1], faces.area[face_2]}};
    return result;
}

template <int Dim>
void append_contact_stiffness(const P1Bodies<Dim>& bodies, std::span<const double> q,
                              std::vector<dynamics::MatrixEntry>& entries) {
    for (const auto& pair : bodies.contact().last().pairs) {
        const PairNodes<Dim> nodes = nodes_of<Dim>(bodies, pair, q);
        const auto matrix = pair_hessian<Dim>(nodes.corner, nodes.law);
        for (int row = 0; row < matrix.rows(); ++row)
            for (int column = 0; column < matrix.cols(); ++column)
                entries.push_back({nodes.node[static_cast<std::size_t>(row / Dim)] * Dim + row % Dim,
                                   nodes.node[static_cast<std::size_t>(column / Dim)] * Dim + column % Dim,
                                   matrix(row, column)});
    }
}

/// Held degrees of freedom keep a diagonal of 1 alone; those of obstacles, which come last, are no unknowns.
void hold(std::vector<dynamics::MatrixEntry>& entries, const std::vector<char>& held) {
    const auto n = static_cast<std::int32_t>(held.size());
    std::erase_if(entries, [&](const auto& entry) {
        return entry.row >= n || entry.column >= n || held[entry.row] != 0 || held[entry.column] != 0;
    });
    for (std::int32_t i = 0; i < n; ++i)
        if (held[i] != 0) entries.push_back({i, i, 1.0});
}

template <int Dim>
class Newton {
public:
    Newton(P1Bodies<Dim>& bodies, const StaticLoad& load) : bodies_(bodies), load_(load), force_(bodies.size()) {
        bodies.append_stiffness(force_, 1.0, bulk_);
        for (const double force : load.force) largest_load_ = std::max(largest_load_, std::abs(force));
    }

    /// Goes to q along the path from q_0 and leaves what is not in balance there; its size over the largest load.
    double go(const std::vector<double>& q_0, const std::vector<double>& q) {
        bodies_.end_force(q_0, q, 0.0, 1.0, force_);
        double largest = 0.0;
        for (std::size_t i = 0; i < q.size(); ++i) {
            force_[i] = load_.held[i] != 0 ? 0.0 : force_[i] + load_.force[i];
            largest = std::max(largest, std::abs(force_[i]));
        }
        return largest / largest_load_;
    }
    double energy(const std::vector<double>& q) {
        double work = 0.0;
        for (std::size_t i = 0; i < q.size(); ++i) work += load_.force[i] * q[i];
        return bodies_.potential(q) - work;
    }
    Eigen::VectorXd direction(const std::vector<double>& q) {
        std::vector<dynamics::MatrixEntry> entries = bulk_;
        append_contact_stiffness<Dim>(bodies_, q, entries);
        hold(entries, load_.held);
        Eigen::SimplicialLDLT<Sparse> solver(assembled(q.size(), entries));
        return solver.solve(Eigen::Map<const Eigen::VectorXd>(force_.data(), static_cast<Eigen::Index>(force_.size())));
    }

private:
    P1Bodies<Dim>& bodies_;
    const StaticLoad& load_;
    std::vector<double> force_;
    std::vector<dynamics::MatrixEntry> bulk_;
    double largest_load_ = 0.0;
};

/// Goes along the direction until residual or energy fall, half as far each time that they do not; false if they never do.
template <int Dim>
bool search_line(Newton<Dim>& newton, const Eigen::VectorXd& direction, StaticState& state, double& energy) {
    std::vector<double> next = state.q;
    double share = 1.0;
    for (int halvings = 0; halvings < 12; ++halvings, share *= 0.5) {
        for (std::size_t i = 0; i < next.size(); ++i) next[i] = state.q[i] + share * direction[static_cast<Eigen::Index>(i)];
        try {
            const double residual = newton.go(state.q, next), next_energy = newton.energy(next);
            if (residual >= state.residual && next_energy >= energy) continue;
            state.residual = residual;
            energy = next_energy;
            state.q = next;
            return true;
        } catch (const TooDeep&) {  // much too far
        }
    }
    return false;
}

}  // namespace

template <int Dim>
double pair_stiffness(const P1Bodies<Dim>& bodies, std::int32_t body_1, std::int32_t body_2) {
    const auto& surface = bodies.contact().surface();
    return contact::series_stiffness(surface.stiffness(body_1), surface.stiffness(body_2));
}

template <int Dim>
StaticState solve_at_rest(P1Bodies<Dim>& bodies, const StaticLoad& load, std::vector<double> q, double tolerance) {
    Newton<Dim> newton(bodies, load);
    StaticState state{.q = std::move(q)};
    state.residual = newton.go(state.q, state.q);
    double energy = newton.energy(state.q);
    StaticState best = state;  // a fall of energy may be bought with a worse balance
    bool goes_on = true;
    for (; goes_on && state.iterations < most_iterations<Dim> && state.residual > tolerance; ++state.iterations) {
        newton.go(state.q, state.q);
        goes_on = search_line(newton, newton.direction(state.q), state, energy);
        if (state.residual < best.residual) best = state;
    }
    best.iterations = state.iterations;
    best.converged = best.residual <= tolerance;
    return best;
}

#define ABUT_INSTANTIATE(Dim)                                                                                \
    template StaticState solve_at_rest<Dim>(P1Bodies<Dim>&, const StaticLoad&, std::vector<double>, double); \
    template double pair_stiffness<Dim>(const P1Bodies<Dim>&, std::int32_t, std::int32_t);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::studies::nodal
