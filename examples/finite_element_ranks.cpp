// Contact in a finite element code on several ranks: two elastic discs run into each other off centre, spin and part.
//
// Triangles of St. Venant and Kirchhoff's material, R = E = rho = 1, nu = 0.3, at +-0.05 along x, centres 0.8 apart along y;
// the left disc spins at 0.05 rad/s. Finite strain codes find that it leaves at (-0.0276, -0.0406). The mesh is cut into four parts, each disc along the line through both centres, so that
// they touch at a border of parts: 1, 2 or 4 ranks have 4, 2 or 1 of them, with copies of the nodes at their borders. MPI and
// the sums of forces over parts are the host's own. It adds them up in the order of the parts, so that every digit printed
// but those of the last line is that of one rank. MEMM keeps H~, momentum and J~ to round-off.
//
//   mpirun -n 4 finite_element_ranks
#include <mpi.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <span>
#include <vector>

#include "abut/contact/surface/nodal_faces.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "abut/ranks/shared_nodal_contact.hpp"

using namespace abut;

constexpr int n_parts = 4;
constexpr double lambda = 0.3 / (1.3 * 0.4), mu = 0.5 / 1.3;  // [Pa]
using V = Vector<2>;
using M = Matrix<2>;

struct Cell {
    int part = 0;
    double area = 0.0;
    std::array<std::int32_t, 3> node = {};  // of this rank
    SmallMatrix<2, 3> slopes;               // of the shape functions

    M gradient(std::span<const V> x) const {
        return x[node[0]] * slopes.col(0).transpose() + x[node[1]] * slopes.col(1).transpose() +
               x[node[2]] * slopes.col(2).transpose();
    }
    static M strain(const M& f) { return 0.5 * (f.transpose() * f - M::Identity()); }
    static M stress(const M& f) { return lambda * strain(f).trace() * M::Identity() + 2.0 * mu * strain(f); }
};

class Host {  // what one rank has
public:
    /// `part`: of each cell of the whole mesh. A host that reads parts of a mesh needs none of it, but numbers in common.
    Host(const ranks::Communicator& all, const mesh::Mesh<2>& whole, std::span<const int> part) {
        const auto is_here = [&](int p) { return p * all.size() / n_parts == all.rank(); };
        std::vector<unsigned> parts_of(whole.vertices.size(), 0);  // a bit each
        for (std::int32_t c = 0; c < whole.n_cells(); ++c)
            for (const std::int32_t v : whole.cell_vertices[c]) parts_of[v] |= 1u << part[c];
        unsigned here = 0;
        for (int p = 0; p < n_parts; ++p) here |= is_here(p) ? 1u << p : 0u;
        std::vector<std::int32_t> own(whole.vertices.size(), -1);
        for (std::size_t v = 0; v < own.size(); ++v) {
            const int first = std::countr_zero(parts_of[v]);
            const std::int32_t at_border = std::popcount(parts_of[v]) > 1 ? n_border++ : -1;
            if ((parts_of[v] & here) == 0) continue;
            own[v] = static_cast<std::int32_t>(number.size());
            number.push_back(static_cast<std::int32_t>(v));
            rest.push_back(whole.vertices[v]);
            border_.push_back(at_border);
            counted_in.push_back(is_here(first) ? first : -1);
        }
        at_border_.resize(static_cast<std::size_t>(n_parts * n_border));
        for (std::int32_t c = 0; c < whole.n_cells(); ++c) {
            if (!is_here(part[c])) continue;
            Cell& cell = cells.emplace_back();
            cell.part = part[c];
            cell.area = whole.cell_measure[c];
            for (int i = 0; i < 3; ++i) cell.node[i] = own[whole.cell_vertices[c][i]];
            const V first = rest[cell.node[0]];
            // The rows of the inverse are the slopes of the shape functions of the other two nodes.
            const M of_others = M::from_columns(rest[cell.node[1]] - first, rest[cell.node[2]] - first).inverse();
            cell.slopes = SmallMatrix<2, 3>::from_columns(-(of_others.transpose() * V::Ones()), of_others.row(0).transpose(),
                                                          of_others.row(1).transpose());
        }
        std::vector<double> depths;  // of all faces: half the height of the triangle behind each
        for (std::int32_t f = 0; f < std::ssize(whole.boundary_faces); ++f) {
            const std::int32_t face = whole.boundary_faces[f], cell = whole.face_cells[face][0];
            depths.push_back(whole.cell_measure[cell] / whole.face_measure[face]);
            if (!is_here(part[cell])) continue;
            const auto ends = whole.face_vertices[face];
            faces_.append_face(std::array{own[ends[0]], own[ends[1]]}, depths.back(), whole.cell_body[cell]);
            face_number_.push_back(f);
        }
        faces_.stiffness.assign(2, contact::skin_stiffness(lambda + 2.0 * mu, depths));
        std::vector<V> m(number.size());
        sum_over_cells(m, [](const Cell& cell, int) -> V { return V::Constant(cell.area / 3); });
        for (const V& of_node : m) mass.push_back(of_node[0]);
    }

    ranks::NodalPart<2> surface() const {
        return {.rest = rest, .node_number = number, .faces = faces_.view(), .face_number = face_number_};
    }

    /// What add(cell, i) gives corner i of each cell. Entries of `at_border_` are of one part each, zero on all ranks but
    /// one: MPI sums them exactly, and every copy of a node gets the same bits, part after part.
    template <class Add>
    void sum_over_cells(std::span<V> total, const Add& add) {
        std::ranges::fill(total, V::Zero());
        std::ranges::fill(at_border_, V::Zero());
        for (const Cell& cell : cells)
            for (int i = 0; i < 3; ++i) {
                const std::int32_t n = cell.node[i], b = border_[n];
                (b < 0 ? total[n] : at_border_[cell.part * n_border + b]) += add(cell, i);
            }
        MPI_Allreduce(MPI_IN_PLACE, at_border_.data(), 2 * n_parts * n_border, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
        for (std::size_t n = 0; n < border_.size(); ++n)
            for (int p = 0; p < n_parts && border_[n] >= 0; ++p) total[n] += at_border_[p * n_border + border_[n]];
    }
    /// F_mid S_mean over a step, which is exact for energy.
    void mean_force(std::span<const V> x_0, std::span<const V> x_1, std::span<V> force) {
        sum_over_cells(force, [&](const Cell& cell, int i) -> V {
            const M f_0 = cell.gradient(x_0), f_1 = cell.gradient(x_1);
            return -0.25 * cell.area * (f_0 + f_1) * (Cell::stress(f_0) + Cell::stress(f_1)) * cell.slopes.col(i);
        });
    }

    std::vector<Cell> cells;
    std::vector<V> rest;
    std::vector<std::int32_t> number;  // of each node among all
    std::vector<int> counted_in;       // the part that counts a node in sums over nodes; -1: one of another rank
    std::vector<double> mass;
    std::int32_t n_border = 0;  // nodes at borders of parts

private:
    contact::NodalFaceArrays<2> faces_;
    std::vector<std::int32_t> face_number_;
    std::vector<std::int32_t> border_;  // of each node, which one of those at borders it is; -1: it is not
    std::vector<V> at_border_;          // (n_parts, n_border)
};

enum Sum { staggered, excess_of_h, potential, momentum_x, momentum_y, angular, left_x, left_y, left_mass, n_sums };
using Sums = SmallMatrix<n_sums, 1>;

/// Sums over all nodes and cells at x^n, between p^{n-1/2} and p^{n+1/2}: part by part, then the parts in their order.
Sums measure(const Host& host, std::span<const V> x, std::span<const V> p_0, std::span<const V> p_1, double dt) {
    SmallMatrix<n_sums, n_parts> of_part;
    of_part.setZero();
    for (std::size_t n = 0; n < x.size(); ++n) {
        if (host.counted_in[n] < 0) continue;
        const double m = host.mass[n];
        const V p = 0.5 * (p_0[n] + p_1[n]);
        Sums& sum = of_part.col(host.counted_in[n]);
        sum[staggered] += 0.5 * p_0[n].dot(p_1[n]) / m;
        sum[excess_of_h] += 0.125 * (p_1[n] - p_0[n]).squaredNorm() / m;
        for (int k = 0; k < 2; ++k) sum[momentum_x + k] += p[k];
        sum[angular] += moment<2>(x[n], p)[0] - 0.25 * dt / m * moment<2>(p_0[n], p_1[n])[0];  // J~
        if (host.counted_in[n] >= n_parts / 2) continue;
        for (int k = 0; k < 2; ++k) sum[left_x + k] += p[k];
        sum[left_mass] += m;
    }
    for (const Cell& cell : host.cells) {
        const M f = cell.gradient(x);
        of_part(potential, cell.part) += 0.5 * cell.area * Cell::stress(f).cwiseProduct(Cell::strain(f)).sum();
    }
    MPI_Allreduce(MPI_IN_PLACE, of_part.data(), n_sums * n_parts, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    Sums total = of_part.col(0);
    for (int part = 1; part < n_parts; ++part) total += of_part.col(part);
    return total;
}

struct Figures {
    int steps = 0;
    double dt = 0.0, kinetic = 0.0;  // at the start
    double excess = 0.0, drift = 0.0, momentum_drift = 0.0, angular_drift = 0.0;
    V left = V::Zero();  // velocity of the left body at the end

    void add(const Sums& now, const Sums& start, double contact_energy) {
        const Sums change = now - start;
        drift = std::max(drift, std::abs(change[staggered] + change[potential] + contact_energy));
        excess = std::max(excess, now[excess_of_h]);
        momentum_drift = std::max(momentum_drift, change.segment<2>(momentum_x).norm());
        angular_drift = std::max(angular_drift, std::abs(change[angular]));
        left = now.segment<2>(left_x) / now[left_mass];
    }
};

Figures run(Host& host, ranks::SharedNodalContact<2>& contact) {
    double omega_squared = 0.0;  // no frequency of a mesh is above those of its cells: 6 (lambda + mu) sum |slope|^2 / rho
    for (const Cell& cell : host.cells)
        omega_squared = std::max(omega_squared, 6.0 * (lambda + mu) * cell.slopes.squaredNorm());
    const double dt = contact.stable_step(host.mass, std::sqrt(omega_squared)).dt;

    std::vector<V> x_0 = host.rest, x_1 = x_0, force(x_0.size()), p_before(x_0.size());
    for (std::size_t n = 0; n < x_0.size(); ++n) {
        const bool is_left = x_0[n].norm() < 1.001;
        p_before[n] = host.mass[n] * (is_left ? V(0.05 - 0.05 * x_0[n][1], 0.05 * x_0[n][0]) : V(-0.05, 0.0));
    }
    std::vector<V> p_after = p_before;  // there are no forces at the start
    const Sums start = measure(host, x_0, p_before, p_after, dt);
    Figures figures{.dt = dt, .kinetic = start[staggered]};
    for (; figures.steps * dt < 15.0; ++figures.steps) {
        for (std::size_t n = 0; n < x_0.size(); ++n) x_1[n] = x_0[n] + dt / host.mass[n] * p_after[n];
        host.mean_force(x_0, x_1, force);
        const contact::NodalStep<2>& step = contact.step(dt, x_0, x_1);
        step.add_force_to(force);
        for (std::size_t n = 0; n < x_0.size(); ++n) p_before[n] += 2.0 * dt * force[n];
        std::swap(p_before, p_after);
        std::swap(x_0, x_1);
        figures.add(measure(host, x_0, p_before, p_after, dt), start, step.energy);
    }
    return figures;
}

bool run(const ranks::Communicator& all) {
    const V centre(std::sqrt(2.02 * 2.02 - 0.8 * 0.8), 0.8);  // of the right disc
    const mesh::Mesh<2> whole = mesh::combine<2>(
        std::vector{mesh::disc({.size = 0.08}), mesh::disc({.centre = centre, .size = 0.08, .variant = 1})});
    std::vector<int> part;  // two of each disc, above and below the line through both centres
    for (std::int32_t c = 0; c < whole.n_cells(); ++c)
        part.push_back(2 * whole.cell_body[c] + (moment<2>(centre, whole.cell_centroid[c])[0] > 0.0 ? 1 : 0));
    Host host(all, whole, part);
    ranks::SharedNodalContact<2> contact(all, host.surface());
    const Figures f = run(host, contact);
    const contact::ContactReport& report = contact.report();
    if (all.rank() == 0) {
        const double n = f.steps;
        std::printf("%d steps of %.17g s, left body leaves at (%.17g, %.17g)\n", f.steps, f.dt, f.left[0], f.left[1]);
        std::printf("H - H~ up to %.17g K0, H~ drifts by %.17g K0\n", f.excess / f.kinetic, f.drift / f.kinetic);
        std::printf("momentum drifts by %.17g kg m/s, J~ by %.17g kg m^2/s\n", f.momentum_drift, f.angular_drift);
        std::printf("%lld events, %lld missed contacts, %lld lists\n", static_cast<long long>(report.events),
                    static_cast<long long>(report.missed_contacts), static_cast<long long>(report.rebuilds));
        const ranks::Traffic& sent = contact.traffic();
        std::printf(
            "per step: contact %.2f reductions, %.2f gathers, %.0f bytes received; the host sums %d bytes at borders\n",
            sent.reductions / n, sent.gathers / n, sent.gathered_bytes / n,
            static_cast<int>(sizeof(V)) * n_parts * host.n_border);
    }
    return f.drift < 1e-12 * f.kinetic && f.momentum_drift < 1e-13 && f.angular_drift < 1e-13 &&
           (f.left - V(-0.0276, -0.0406)).norm() < 1e-3 && report.missed_contacts == 0;
}

int main(int argc, char** argv) {
    int provided = 0;
    MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
    bool holds = false;
    {
        const ranks::Communicator all(MPI_Comm_c2f(MPI_COMM_WORLD));
        if (n_parts % all.size() == 0)
            holds = run(all);
        else
            std::puts("give 1, 2 or 4 ranks");
    }
    MPI_Finalize();
    return holds ? 0 : 1;
}
