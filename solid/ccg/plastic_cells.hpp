#pragma once
// Private to the sources of this layer.
#include <algorithm>
#include <atomic>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "abut/mesh/mesh.hpp"
#include "abut/solid/boundary/boundary_conditions.hpp"
#include "abut/solid/ccg/arrays.hpp"
#include "abut/solid/ccg/ccg.hpp"
#include "abut/solid/kinematics/kinematics.hpp"
#include "abut/solid/material/flow_stress.hpp"
#include "abut/solid/material/material.hpp"

namespace abut::solid {

/// Cells of MaterialLaw::j2 whose strains are linear: they flow by von Mises's rule, with isotropic and kinematic hardening. Per
/// volume a cell stores, eps being the strain of its displacement gradient and p its plastic strain, both in space,
///
///     1/2 eps : C : eps - eps : C : p + 1/2 p : C_e : p + H/3 p : p
///
/// with C_e, what faces that are free or bear a traction t leave of C. These stand where they would without p: C : eps is C_e : eps' and a
/// part of t, eps' being of the other faces, and the second term is also what t does as p moves them. docs/method.md, Metal that yields.
///
/// Only a step that has ended is remembered. Functions of different cells may be called from several threads at once.
template <int Dim>
class PlasticCells {
public:
    /// One material and kinematics per body, the latter empty where all are small. Bodies of Kinematics::finite have none of them.
    PlasticCells(const mesh::Mesh<Dim>& mesh, std::span<const Material> materials, std::span<const Kinematics> kinematics,
                 const FaceConditions<Dim>& conditions, FreeFaceRule rule, FreeFaces free_faces,
                 const CcgArrays<Dim>& arrays);
    PlasticCells(const PlasticCells&) = delete;
    PlasticCells& operator=(const PlasticCells&) = delete;

    /// Whether a body is of them, on any rank.
    [[nodiscard]] bool any() const { return any_; }
    [[nodiscard]] bool contains(std::ptrdiff_t cell) const { return any() && index_[static_cast<std::size_t>(cell)] >= 0; }
    /// C_e : p, which stress is less by [Pa]; 0 before it has flowed.
    [[nodiscard]] const Matrix<Dim>& stress(std::ptrdiff_t cell) const { return at(cell).memory.stress; }
    [[nodiscard]] bool has_flowed(std::ptrdiff_t cell) const { return at(cell).memory.equivalent > 0.0; }
    /// Whether its flow moves boundary faces that contact may push. For itself, and for jumps, the cell has them where they would be
    /// without flow.
    [[nodiscard]] bool moves_faces(std::ptrdiff_t cell) const {
        return contains(cell) && at(cell).end_shift > at(cell).first_shift;
    }
    /// How far p moves such a face [m], and by how much it changes what tilts all of them [-].
    [[nodiscard]] Vector<Dim> moved(std::ptrdiff_t cell, BoundaryFace face) const;
    [[nodiscard]] Matrix<Dim> tilted(std::ptrdiff_t cell) const;
    /// What contact does in the step to a cell that moves faces: dV/dû of a face of it by gradient(face) [N], and dV/dG over the measure [Pa].
    template <class Gradient>
    void set_push(std::ptrdiff_t cell, const Gradient& gradient, const Matrix<Dim>& moment) {
        Cell& of = at(cell);
        Strain sum = Strain::Zero();
        for (std::int32_t i = of.first_shift; i < of.end_shift; ++i)
            sum -= shifts_[static_cast<std::size_t>(i)].moved.transpose() *
                   (gradient(shifts_[static_cast<std::size_t>(i)].face) / of.measure);
        of.push = sum - tilts_[static_cast<std::size_t>(of.tilt)].transpose() *
                            Eigen::Map<const Eigen::Matrix<double, Dim * Dim, 1>>(moment.data());
        make_deviator(of.push);
    }
    /// What contact has done in the step by what flow has moved, had that moved along [J]: a part of `loss`.
    [[nodiscard]] double work_of_push(std::ptrdiff_t cell) const { return contains(cell) ? at(cell).work_of_push : 0.0; }
    /// Whether a cell that moves faces flows in the step.
    [[nodiscard]] bool any_face_moves() const {
        return std::ranges::any_of(cells_, [](const Cell& cell) { return cell.flows && cell.end_shift > cell.first_shift; });
    }
    /// Whether the cell surely does not flow in a step that begins where the last one ended, and in whose middle C : eps is `mean` [Pa]:
    /// then the step is made. Else, by rounding or since nobody knows where the last one ended, `advance` must say.
    [[nodiscard]] bool stays_elastic(std::ptrdiff_t cell, const Matrix<Dim>& mean);
    /// Flows in a step of length `dt` from the displacement gradient g_0 to g_1; returns the mean of `stress` at both ends [Pa].
    [[nodiscard]] Matrix<Dim> advance(std::ptrdiff_t cell, const Matrix<Dim>& g_0, const Matrix<Dim>& g_1, double dt);
    /// The terms of the energy that p is in [J/m^3].
    [[nodiscard]] double energy(std::ptrdiff_t cell, const Matrix<Dim>& g) const;
    /// In the plane: the stress out of it [Pa].
    [[nodiscard]] double out_of_plane_stress(std::ptrdiff_t cell, const Matrix<Dim>& g) const;
    /// The equivalent plastic strain [-]; 0 elsewhere.
    [[nodiscard]] double plastic_strain(std::ptrdiff_t cell) const {
        return contains(cell) ? at(cell).memory.equivalent : 0.0;
    }
    /// The same at the end of the step, which may not have ended yet.
    [[nodiscard]] double end_plastic_strain(std::ptrdiff_t cell) const { return at(cell).end().equivalent; }
    /// Whether a cell has flowed in the step, or in one before that has not ended.
    [[nodiscard]] bool any_flowed() const { return any_flowed_.load(std::memory_order_relaxed); }
    /// Energy that a cell has dissipated in the step [J].
    [[nodiscard]] double loss(std::ptrdiff_t cell) const { return contains(cell) ? at(cell).loss : 0.0; }
    /// The next step begins where this one ends.
    void end_step();

    /// How many numbers a cell remembers.
    [[nodiscard]] std::int32_t memory_size(std::ptrdiff_t cell) const { return contains(cell) ? n_strains + 1 : 0; }
    /// Writes them behind `values`.
    void put_memory(std::ptrdiff_t cell, std::vector<double>& values) const;
    void set_memory(std::ptrdiff_t cell, std::span<const double> values);

private:
    /// Of a symmetric tensor in space; in the plane of one without shear out of it. Products of vectors are those of tensors.
    static constexpr int n_strains = Dim == 2 ? 4 : 6;
    using Strain = Eigen::Matrix<double, n_strains, 1, Eigen::DontAlign>;
    using Stiffness = Eigen::Matrix<double, n_strains, n_strains, Eigen::DontAlign>;
    [[nodiscard]] static Strain packed(const Matrix<Dim>& tensor);
    [[nodiscard]] static Matrix<Dim> unpacked(const Strain& strain);

    /// C_e, and the directions in which its deviator answers.
    struct Response {
        Stiffness stiffness;
        Stiffness axes;  // of dev C_e dev, by column
        Strain values;   // the eigenvalues
    };
    [[nodiscard]] static Response response_of(const Material& material, const std::vector<Strain>& free);
    struct Memory {
        // What follows from the two below
        double radius = 0.0;            // sqrt(2/3) sigma(alpha)
        Strain shift = Strain::Zero();  // dev C_e : p + 2/3 H p
        Matrix<Dim> stress = Matrix<Dim>::Zero();
        double equivalent = 0.0;
        Strain plastic = Strain::Zero();
    };
    /// What a step that stays elastic looks at comes first.
    struct Cell {
        const Material* material;
        std::int32_t response;
        double measure;
        bool flows = false;  // in the step: it ends with `next`
        std::int32_t first_shift = 0, end_shift = 0, tilt = 0;
        double loss = 0.0, work_of_push = 0.0;
        Strain driving = unknown(), next_driving = unknown();  // xi at the start and at the end of the step
        Strain push = Strain::Zero();                          // of contact in the step, on p: a stress
        Memory memory{}, next{};

        [[nodiscard]] const Memory& end() const { return flows ? next : memory; }
    };
    /// How p moves a boundary face: by moved p.
    struct Shift {
        BoundaryFace face;
        Eigen::Matrix<double, Dim, n_strains, Eigen::DontAlign> moved;
    };
    using Tilt = Eigen::Matrix<double, Dim * Dim, n_strains, Eigen::DontAlign>;
    void set_shifts(const CcgArrays<Dim>& arrays, std::int32_t cell, const FaceConditions<Dim>& conditions);
    static void make_deviator(Strain& strain);
    [[nodiscard]] static Strain unknown() { return Strain::Constant(std::numeric_limits<double>::quiet_NaN()); }
    [[nodiscard]] Memory memory_of(const Cell& cell, const Strain& plastic, double equivalent) const;
    [[nodiscard]] double flow(const Cell& cell, const FlowStress& stress, const Strain& trial, Strain& normal) const;
    [[nodiscard]] Strain beyond_surface(const Cell& cell, const Strain& normal, double g) const;
    [[nodiscard]] double flow_inside(const Cell& cell, const FlowStress& stress, double trial) const;
    [[nodiscard]] Cell& at(std::ptrdiff_t cell) {
        return cells_[static_cast<std::size_t>(index_[static_cast<std::size_t>(cell)])];
    }
    [[nodiscard]] const Cell& at(std::ptrdiff_t cell) const {
        return cells_[static_cast<std::size_t>(index_[static_cast<std::size_t>(cell)])];
    }
    [[nodiscard]] const Response& response(const Cell& cell) const {
        return responses_[static_cast<std::size_t>(cell.response)];
    }

    /// Without free faces.
    [[nodiscard]] const Response& response_inside(const Cell& cell) const {
        return responses_[static_cast<std::size_t>(cell.material - materials_.data())];
    }

    std::vector<Material> materials_;
    std::vector<Response> responses_;  // of each body inside, then of cells with free faces
    std::atomic<bool> any_flowed_ = false;
    bool any_ = false;                 // known from materials alone: this rank may have no cell of them
    std::vector<std::int32_t> index_;  // of each cell; empty where no body is of them
    std::vector<Cell> cells_;
    std::vector<Shift> shifts_;  // cell by cell
    std::vector<Tilt> tilts_;    // of cells with shifts: what they make of G
};

}  // namespace abut::solid
