#pragma once
// How far forces and stresses in single precision may be from those in double, from the formulas of the operators.
#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "abut/solid/ccg/ccg.hpp"

namespace abut::test {

/// Each number that the sweeps make is off by at most 2^-24 of its magnitude for every rounding behind it. The longest chain of
/// them, through a condensed face and back: a displacement relative to its cell 12 (difference, weight, product and sum of a
/// face, difference and sum of the cell), gradient 9, stress 9, free face 47 (t less its part along the normal: each rounding
/// counts twice), gradient and stress with it 14, y of the free face 9, the answer of the stress to it 56, y of an inner face 8,
/// and its weight and product 7: 171.
inline constexpr double roundings = 171.0 * 0x1p-24;

/// The formulas of docs/method.md, Space, with absolute values everywhere: no difference makes a number smaller, so that a
/// rounding of any number on the way is a part of 2^-24 of what is here. A vector counts by its norm.
template <int Dim>
class Magnitudes {
public:
    Magnitudes(const mesh::Mesh<Dim>& mesh, const solid::Material& material, const solid::Ccg<Dim>& ccg,
               solid::FreeFaceRule rule, solid::CellForm form)
        : mesh_(mesh), material_(material), ccg_(ccg), rule_(rule), form_(form) {
        for (std::size_t b = 0; b < mesh.boundary_faces.size(); ++b) {
            index_[mesh.boundary_faces[b]] = static_cast<std::int32_t>(b);
            ++n_boundary_[mesh.face_cells[mesh.boundary_faces[b]][0]];
        }
    }

    void set(std::span<const Vector<Dim>> u, const solid::BoundaryLoad<Dim>& load,
             const solid::FaceCorrections<Dim>& corrections) {
        u_ = u;
        place(load, corrections);
        set_faces();
        for (std::int32_t c = 0; c < mesh_.n_cells(); ++c) set_cell(c);
        for (std::int32_t c = 0; c < mesh_.n_cells(); ++c) set_jumps(c);
        set_forces();
    }

    /// How far a force in single precision may be from that in double, by cell.
    [[nodiscard]] std::vector<double> bounds() const {
        std::vector<double> bounds = force_;
        for (double& bound : bounds) bound *= roundings;
        return bounds;
    }
    /// The same of the stress of a cell.
    [[nodiscard]] double stress_bound(std::int32_t c) const { return roundings * modulus() * gradient_[c]; }

private:
    [[nodiscard]] double distance(std::int32_t a, std::int32_t b) const { return (u_[a] - u_[b]).norm(); }
    [[nodiscard]] bool simplices() const { return form_ == solid::CellForm::automatic; }
    [[nodiscard]] double modulus() const { return 2.0 * material_.mu() + Dim * material_.lambda(); }
    [[nodiscard]] double stiffness(std::int32_t f) const {
        if (mesh_.is_boundary(f)) return 0.0;
        return material_.stabilisation() * (Dim == 2 ? 1.0 : std::sqrt(mesh_.face_measure[f]));
    }
    [[nodiscard]] double arm(std::int32_t c, std::int32_t f) const {
        return (mesh_.face_centroid[f] - mesh_.cell_centroid[c]).norm();
    }
    [[nodiscard]] std::int32_t first(std::int32_t f) const { return mesh_.face_cells[f][0]; }
    [[nodiscard]] std::int32_t neighbour(std::int32_t c, std::int32_t f) const {
        return mesh_.is_boundary(f) ? c : mesh_.face_cells[f][mesh_.face_cells[f][0] == c ? 1 : 0];
    }
    [[nodiscard]] bool is_condensed(std::int32_t f) const {
        return simplices() && mesh_.is_boundary(f) && rule_ == solid::FreeFaceRule::local_equilibrium &&
               n_boundary_[first(f)] == 1 && ccg_.prescribed()[solid::BoundaryFace{index_[f]}].isZero(0.0);
    }

    void place(const solid::BoundaryLoad<Dim>& load, const solid::FaceCorrections<Dim>& corrections) {
        added_.assign(mesh_.boundary_faces.size(), 0.0);
        pushed_ = added_;
        moment_.assign(u_.size(), 0.0);
        for (std::size_t b = 0; b < load.displacement.size(); ++b) {
            added_[b] =
                load.displacement[b].norm() + ccg_.boundary().deficit[b].norm() * u_[first(mesh_.boundary_faces[b])].norm();
            pushed_[b] = load.traction[b].norm();
        }
        for (std::size_t i = 0; i < corrections.faces.size(); ++i) {
            const auto b = static_cast<std::size_t>(corrections.faces[i]);
            if (!corrections.energy_gradient.empty()) pushed_[b] += corrections.energy_gradient[i].norm();
            if (!corrections.moment.empty()) {
                const std::int32_t c = first(mesh_.boundary_faces[b]);
                moment_[c] += corrections.moment[i].norm() / mesh_.cell_measure[c];
            }
            if (corrections.displacement.empty()) continue;
            added_[b] += corrections.displacement[i].norm();
            ccg_.boundary().for_each_answer(corrections.faces[i], [&](solid::BoundaryFace face, const Matrix<Dim>& answer) {
                added_[static_cast<std::size_t>(face)] += answer.norm() * corrections.displacement[i].norm();
            });
        }
    }

    /// Weights of a stencil are rounded to parts of the largest of them.
    static double largest_weight(const solid::FaceStencil<Dim>& stencil) {
        double largest = 0.0;
        for (const double weight : stencil.weights) largest = std::max(largest, std::abs(weight));
        return largest;
    }

    void set_faces() {
        of_face_.assign(mesh_.face_cells.size(), 0.0);
        for (std::int32_t f = 0; f < mesh_.n_faces(); ++f) {
            if (is_condensed(f)) continue;
            if (!mesh_.is_boundary(f)) {
                const auto& stencil = ccg_.stencils()[f];
                of_face_[f] = distance(stencil.cells[0], first(f));
                for (std::size_t j = 1; j <= Dim; ++j)
                    of_face_[f] += largest_weight(stencil) * distance(stencil.cells[j], stencil.cells[0]);
                continue;
            }
            const auto& boundary = ccg_.boundary();
            const auto b = static_cast<std::size_t>(index_[f]);
            of_face_[f] = added_[b];
            for (std::int32_t i = boundary.offsets[b]; i < boundary.offsets[b + 1]; ++i)
                of_face_[f] += boundary.weights[i].norm() * distance(boundary.cells[i], first(f));
        }
    }

    [[nodiscard]] double at(std::int32_t c, std::int32_t f) const { return of_face_[f] + distance(first(f), c); }

    void set_cell(std::int32_t c) {
        double sum = 0.0;
        for (const std::int32_t f : mesh_.cell_faces[c])
            sum += mesh_.face_measure[f] * (at(c, f) + (simplices() ? at(c, mesh_.cell_faces[c][0]) : 0.0));
        gradient_[c] = sum / mesh_.cell_measure[c];
        for (const std::int32_t f : mesh_.cell_faces[c])
            if (is_condensed(f)) {  // |A_bb^-1 t| <= |t| |c|/(mu |b|^2)
                const double area = mesh_.face_measure[f];
                of_face_[f] = mesh_.cell_measure[c] / (material_.mu() * area) * modulus() * gradient_[c] + added_[index_[f]];
                gradient_[c] += of_face_[f] * area / mesh_.cell_measure[c];
            }
        deviation_[c] = 0.0;
        for (const std::int32_t f : mesh_.cell_faces[c]) deviation_[c] += at(c, f) / (Dim + 1);
    }

    [[nodiscard]] double trace(std::int32_t c, std::int32_t f) const {
        return gradient_[c] * arm(c, f) + distance(first(f), c);
    }

    void set_jumps(std::int32_t c) {
        stress_[c] = modulus() * gradient_[c] + moment_[c];
        direct_[c] = 0.0;
        for (const std::int32_t f : mesh_.cell_faces[c]) {
            const std::int32_t other = neighbour(c, f);
            const double jump =
                stiffness(f) * (simplices() ? deviation_[c] + deviation_[other] : trace(c, f) + trace(other, f));
            direct_[c] += jump;
            if (!simplices()) stress_[c] += jump * arm(c, f) / mesh_.cell_measure[c];
        }
        for (const std::int32_t f : mesh_.cell_faces[c])
            if (is_condensed(f)) stress_[c] += modulus() * of_boundary(f) / (material_.mu() * mesh_.face_measure[f]);
    }

    /// y of a boundary face.
    [[nodiscard]] double of_boundary(std::int32_t f) const {
        const std::int32_t c = first(f);
        return stress_[c] * mesh_.face_measure[f] + (simplices() ? direct_[c] / (Dim + 1) : 0.0) + pushed_[index_[f]];
    }

    void set_forces() {
        force_ = direct_;
        for (std::int32_t f = 0; f < mesh_.n_faces(); ++f) {
            if (is_condensed(f)) continue;
            if (mesh_.is_boundary(f)) {
                const auto& boundary = ccg_.boundary();
                for (std::int32_t i = boundary.offsets[index_[f]]; i < boundary.offsets[index_[f] + 1]; ++i)
                    force_[boundary.cells[i]] += boundary.weights[i].norm() * of_boundary(f);
                continue;
            }
            const auto [a, b] = mesh_.face_cells[f];
            const double y = (stress_[a] + stress_[b]) * mesh_.face_measure[f] +
                             (simplices() ? (direct_[a] + direct_[b]) / (Dim + 1) : 0.0);
            for (const std::int32_t c : ccg_.stencils()[f].cells) force_[c] += largest_weight(ccg_.stencils()[f]) * y;
        }
    }

    const mesh::Mesh<Dim>& mesh_;
    solid::Material material_;
    const solid::Ccg<Dim>& ccg_;
    solid::FreeFaceRule rule_;
    solid::CellForm form_;
    std::span<const Vector<Dim>> u_;
    std::vector<std::int32_t> index_ = std::vector<std::int32_t>(mesh_.face_cells.size(), -1);
    std::vector<int> n_boundary_ = std::vector<int>(mesh_.cell_measure.size(), 0);
    std::vector<double> added_, pushed_, moment_, of_face_;
    // By cell
    std::vector<double> gradient_ = std::vector<double>(mesh_.cell_measure.size());
    std::vector<double> deviation_ = gradient_, direct_ = gradient_, stress_ = gradient_, force_ = gradient_;
};

}  // namespace abut::test
