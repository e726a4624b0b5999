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
#include "abut/solid/cells/cell_pool.hpp"
#include "abut/solid/kinematics/kinematics.hpp"
#include "abut/solid/material/flow_stress.hpp"
#include "abut/solid/material/material.hpp"
#include "abut/solid/operator/arrays.hpp"
#include "abut/solid/operator/free_face_of_cell.hpp"

namespace abut::solid {

/// Cells of MaterialLaw::j2 whose strains are linear: they flow by von Mises's rule, with isotropic and kinematic
/// hardening. Per volume a cell stores, eps being the strain of its displacement gradient and p its plastic strain,
/// both in space,
///
///     1/2 eps : C : eps - eps : C : p + 1/2 p : C_e : p + H/3 p : p
///
/// with C_e, what faces that are free or bear a traction t leave of C. These stand where they would without p: C : eps
/// is C_e : eps' and a part of t, eps' being of the other faces, and the second term is also what t does as p moves
/// them. docs/method.md, Metal that yields.
///
/// Only a step that has ended is remembered. Functions of different cells may be called from several threads at once.
template <int Dim>
class PlasticCells {
public:
    /// One material and kinematics per body, the latter empty where all are small. Bodies of Kinematics::finite have
    /// none of them.
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
    [[nodiscard]] bool has_flowed(std::ptrdiff_t cell) const { return surfaces_[number(cell)].has_flowed; }
    /// Whether its flow moves boundary faces that contact may push. For itself, and for jumps, the cell has them where
    /// they would be without flow.
    [[nodiscard]] bool moves_faces(std::ptrdiff_t cell) const { return contains(cell) && surfaces_[number(cell)].push >= 0; }
    /// How far p moves such a face [m].
    [[nodiscard]] Vector<Dim> moved(std::ptrdiff_t cell, BoundaryFace face) const;
    /// Change of the displacement gradient of a cell as p moves its free faces [-]; 0 where it has none.
    [[nodiscard]] Matrix<Dim> tilted(std::ptrdiff_t cell) const { return tilt_of(at(cell), at(cell).memory.plastic); }
    /// Whether `tilted` changes in the step, and by how much [-].
    [[nodiscard]] bool tilts(std::ptrdiff_t cell) const { return contains(cell) && flows(cell) && at(cell).tilt >= 0; }
    [[nodiscard]] Matrix<Dim> tilt_change(std::ptrdiff_t cell) const {
        return tilt_of(at(cell), at(cell).next.plastic - at(cell).memory.plastic);
    }
    /// Sets what contact does in the step to a cell that moves faces: dV/dû of a face of it by gradient(face) [N], and dV/dG
    /// over the measure [Pa].
    template <class Gradient>
    void set_push(std::ptrdiff_t cell, const Gradient& gradient, const Matrix<Dim>& moment) {
        Push& push = pushes_[static_cast<std::size_t>(surfaces_[number(cell)].push)];
        Strain sum = Strain::Zero();
        for (std::int32_t i = push.first_shift; i < push.end_shift; ++i)
            sum -= shifts_[static_cast<std::size_t>(i)].moved.transpose() *
                   (gradient(shifts_[static_cast<std::size_t>(i)].face) / at(cell).measure);
        push.stress =
            sum - tilts_[static_cast<std::size_t>(at(cell).tilt)].transpose() * SmallMatrix<Dim * Dim, 1>(moment.data());
        make_deviator(push.stress);
    }
    /// Work of contact in the step by what flow has moved, had that moved along [J]: a part of `loss`.
    [[nodiscard]] double work_of_push(std::ptrdiff_t cell) const {
        return moves_faces(cell) ? pushes_[static_cast<std::size_t>(surfaces_[number(cell)].push)].work : 0.0;
    }
    /// Whether a cell that moves faces flows in the step.
    [[nodiscard]] bool any_face_moves() const {
        return std::ranges::any_of(pushes_, [&](const Push& push) { return flows_[push.number] != 0; });
    }
    /// Whether the cell surely does not flow in a step that begins where the last one ended, and in whose middle C :
    /// eps is `mean` [Pa]: then the step is made. Else, by rounding or since nobody knows where the last one ended,
    /// `advance` must say.
    [[nodiscard]] bool stays_elastic(std::ptrdiff_t cell, const Matrix<Dim>& mean);
    /// Flows in a step of length `dt` in whose middle C : eps is `mean` [Pa], and in which the displacement gradient
    /// changes by `change`.
    void advance(std::ptrdiff_t cell, const Matrix<Dim>& mean, const Matrix<Dim>& change, double dt);
    /// Whether a cell flows in the step, and the mean of `stress` at both ends of it [Pa].
    [[nodiscard]] bool flows(std::ptrdiff_t cell) const { return flows_[number(cell)] != 0; }
    [[nodiscard]] Matrix<Dim> mean_stress(std::ptrdiff_t cell) const {
        return 0.5 * (at(cell).memory.stress + at(cell).next.stress);
    }
    /// The terms of the energy that p is in [J/m^3].
    [[nodiscard]] double energy(std::ptrdiff_t cell, const Matrix<Dim>& g) const;
    /// In the plane: the stress out of it [Pa].
    [[nodiscard]] double out_of_plane_stress(std::ptrdiff_t cell, const Matrix<Dim>& g) const;
    /// The equivalent plastic strain [-]; 0 elsewhere.
    [[nodiscard]] double plastic_strain(std::ptrdiff_t cell) const {
        return contains(cell) ? at(cell).memory.equivalent : 0.0;
    }
    /// As `plastic_strain`, at the end of the step, which may not have ended yet.
    [[nodiscard]] double end_plastic_strain(std::ptrdiff_t cell) const {
        return (flows_[number(cell)] != 0 ? at(cell).next : at(cell).memory).equivalent;
    }
    /// Whether a cell has flowed in the step, or in one before that has not ended.
    [[nodiscard]] bool any_flowed() const { return any_flowed_.load(std::memory_order_relaxed); }
    /// Energy that a cell has dissipated in the step [J].
    [[nodiscard]] double loss(std::ptrdiff_t cell) const { return contains(cell) ? loss_[number(cell)] : 0.0; }
    /// The next step begins where this one ends.
    void end_step();

    /// How many numbers a cell remembers.
    [[nodiscard]] std::int32_t memory_size(std::ptrdiff_t cell) const { return contains(cell) ? n_strains + 1 : 0; }
    /// Writes them behind `values`.
    void put_memory(std::ptrdiff_t cell, std::vector<double>& values) const;
    void set_memory(std::ptrdiff_t cell, std::span<const double> values);
    /// Whether a cell remembers the same things as one of another mesh.
    [[nodiscard]] bool remembers_as(std::ptrdiff_t cell, const PlasticCells& other, std::ptrdiff_t other_cell) const {
        return contains(cell) == other.contains(other_cell);
    }

private:
    /// Components of a symmetric tensor in space; in the plane, of one without shear out of it. Products of vectors are
    /// those of tensors.
    static constexpr int n_strains = Dim == 2 ? 4 : 6;
    using Strain = SmallMatrix<n_strains, 1>;
    using Stiffness = SmallMatrix<n_strains, n_strains>;
    [[nodiscard]] static Strain packed(const Matrix<Dim>& tensor);
    [[nodiscard]] static Matrix<Dim> unpacked(const Strain& strain);

    /// C_e, and the directions in which its deviator answers.
    struct Response {
        Stiffness stiffness;
        Stiffness axes;  // of dev C_e dev, by column
        Strain values;   // the eigenvalues
    };
    [[nodiscard]] static Response response_of(const Material& material, std::span<const FreeFaceOfCell<Dim>> free);
    /// Yield surface of a cell, which follows from what it remembers: all that a step which stays elastic looks at
    /// beside xi.
    struct Surface {
        Strain shift = Strain::Zero();  // dev C_e : p + 2/3 H p
        double radius = 0.0;            // sqrt(2/3) sigma(alpha)
        double poisson = 0.0;
        std::int32_t push = -1;  // of `pushes_`; -1: it moves no faces
        bool has_flowed = false;
    };
    struct Memory {
        Strain plastic = Strain::Zero();
        double equivalent = 0.0;
        Matrix<Dim> stress = Matrix<Dim>::Zero();  // C_e : p
    };
    struct Cell {
        const Material* material;
        std::int32_t response;
        double measure;
        Memory memory{}, next{};  // the latter where it flows
        std::int32_t tilt = -1;   // of `tilts_`; -1: it has no free faces
    };
    using Tilt = SmallMatrix<Dim * Dim, n_strains>;  // what p makes of G
    /// How p moves a boundary face: by moved p.
    struct Shift {
        BoundaryFace face;
        SmallMatrix<Dim, n_strains> moved;
    };
    /// Push of contact on a cell that moves faces.
    struct Push {
        std::size_t number;                   // of the cell
        std::int32_t first_shift, end_shift;  // of its faces
        Strain stress = Strain::Zero();       // of contact in the step, on p
        double work = 0.0;                    // of it in the step
    };
    [[nodiscard]] std::vector<Shift> shifts_of(const CcgArrays<Dim>& arrays, std::int32_t cell,
                                               const FaceConditions<Dim>& conditions) const;
    void set_tilt(const CcgArrays<Dim>& arrays, std::int32_t cell, std::span<const Shift> shifts);
    void make_push(std::int32_t cell, std::span<const Shift> shifts);
    [[nodiscard]] Matrix<Dim> tilt_of(const Cell& cell, const Strain& plastic) const {
        if (cell.tilt < 0) return Matrix<Dim>::Zero();
        const SmallMatrix<Dim * Dim, 1> tilt = tilts_[static_cast<std::size_t>(cell.tilt)] * plastic;
        return Matrix<Dim>(tilt.data());
    }
    static void make_deviator(Strain& strain);
    [[nodiscard]] static Strain unknown() { return Strain::Constant(std::numeric_limits<double>::quiet_NaN()); }
    [[nodiscard]] bool is_inside(const Cell& cell) const { return &response(cell) == &response_inside(cell); }
    [[nodiscard]] Memory memory_of(const Cell& cell, const Strain& plastic, double equivalent) const;
    [[nodiscard]] Strain shift_of(const Cell& cell, const Memory& memory) const;
    void set_surface(std::size_t number);
    [[nodiscard]] static Strain elastic_deviator(const Surface& surface, const Matrix<Dim>& elastic);
    void end_elastic(std::size_t number);
    [[nodiscard]] Strain push_on(std::size_t number) const;
    [[nodiscard]] double flow(std::size_t number, const FlowStress& stress, const Strain& trial, Strain& normal) const;
    [[nodiscard]] Strain beyond_surface(const Cell& cell, const Strain& normal, double g) const;
    [[nodiscard]] double flow_inside(const Cell& cell, const FlowStress& stress, double trial) const;
    [[nodiscard]] std::size_t number(std::ptrdiff_t cell) const {
        return static_cast<std::size_t>(index_[static_cast<std::size_t>(cell)]);
    }
    [[nodiscard]] Cell& at(std::ptrdiff_t cell) { return cells_[number(cell)]; }
    [[nodiscard]] const Cell& at(std::ptrdiff_t cell) const { return cells_[number(cell)]; }
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
    std::vector<std::int32_t> index_;  // the number of each cell in what follows; empty where no body is of them
    std::vector<Surface> surfaces_;
    std::vector<Strain> driving_, next_driving_;  // xi at the start and at the end of the step
    std::vector<char> flows_;                     // in the step: it ends with Cell::next
    std::vector<double> loss_;                    // in the step [J]
    std::vector<Cell> cells_;
    std::vector<Tilt> tilts_;
    std::vector<Push> pushes_;
    std::vector<Shift> shifts_;  // push by push
};

static_assert(RememberingCells<PlasticCells<2>> && RememberingCells<PlasticCells<3>>);

}  // namespace abut::solid
