#pragma once
// Private to the sources of this layer.
#include <atomic>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "abut/mesh/mesh.hpp"
#include "abut/solid/boundary/boundary_conditions.hpp"
#include "abut/solid/cells/cell_pool.hpp"
#include "abut/solid/kinematics/kinematics.hpp"
#include "abut/solid/material/material.hpp"
#include "abut/solid/operator/arrays.hpp"

namespace abut::solid {

/// Faces between cells of MaterialLaw::j2, whose stabilisation yields: its traction k ([u] - J)/|f| stays below
/// MetalFlow::jump_cap times the yield stress, and J, the part of the jump that lasts, follows where it would not. Where
/// nothing else holds a cell it stays elastic: at edges, and under contact, of finite bodies along the normals of faces
/// alone. docs/method.md, Metal that yields.
///
/// J of cells whose strains are linear also goes with the free faces of both: they flow, and the traces do not know it.
///
/// Each half-face remembers J as its cell sees it: of a finite body as a vector of the material, which F turns. That of
/// the twin is its negative, bit by bit, since both come from the same sums. Only a step that has ended is remembered.
/// Functions of different cells may be called from several threads at once.
template <int Dim>
class CappedJumps {
public:
    /// One material and kinematics per body, the latter empty where all are small. `arrays` must outlive it.
    CappedJumps(const mesh::Mesh<Dim>& mesh, std::span<const Material> materials, std::span<const Kinematics> kinematics,
                const FaceConditions<Dim>& conditions, FreeFaces free_faces, const CcgArrays<Dim>& arrays);
    CappedJumps(const CappedJumps&) = delete;
    CappedJumps& operator=(const CappedJumps&) = delete;

    /// Whether a body has them, on any rank.
    [[nodiscard]] bool any() const { return any_; }
    [[nodiscard]] bool contains(std::ptrdiff_t cell) const { return any() && capped_[static_cast<std::size_t>(cell)] != 0; }
    /// J of a half-face at the start of the step, or where no step is made [m].
    [[nodiscard]] const Vector<Dim>& lasting(std::ptrdiff_t half_face) const {
        return memory_[static_cast<std::size_t>(half_face)];
    }

    /// Nothing is dissipated in this step so far.
    void begin(std::ptrdiff_t cell) {
        loss_[static_cast<std::size_t>(cell)] = 0.0;
        loss_by_flow_[static_cast<std::size_t>(cell)] = 0.0;
    }
    /// Whether a half-face can have a jump that lasts, now or before cells beside it have left.
    [[nodiscard]] bool may_last(std::ptrdiff_t half_face) const {
        return largest_[static_cast<std::size_t>(half_face)] < std::numeric_limits<double>::infinity();
    }
    /// Whether a half-face can yield.
    [[nodiscard]] bool has_cap(std::ptrdiff_t half_face) const {
        return largest_[static_cast<std::size_t>(half_face)] < never_reached;
    }
    /// J, which stays as it is in the step.
    [[nodiscard]] const Vector<Dim>& keep(std::ptrdiff_t half_face) {
        const auto i = static_cast<std::size_t>(half_face);
        return next_[i] = memory_[i];
    }
    /// Whether a half-face that has a cap, of a body whose strains are linear, surely stays below it in a step that
    /// begins where the last one ended, and in whose middle its jump is `mean`: then the step is made. Else `advance`
    /// must say.
    [[nodiscard]] bool stays_elastic(std::ptrdiff_t half_face, const Vector<Dim>& mean) {
        const auto i = static_cast<std::size_t>(half_face);
        next_elastic_[i] =
            2.0 * (mean - memory_[i]) - elastic_[i];  // at the end, by what it was in the middle and at the start
        const double largest = (1.0 - rounding) * largest_[i];
        if (!(next_elastic_[i].squaredNorm() <= largest * largest)) return false;  // or not a number
        next_[i] = memory_[i];
        return true;
    }
    /// Lets a half-face of a body whose strains are linear yield in a step in which [u] changes by `change` about
    /// `mean`, and J by `of_flow` as free faces of its cells flow along. Returns the mean of J [m].
    [[nodiscard]] Vector<Dim> advance(std::ptrdiff_t cell, std::ptrdiff_t half_face, const Vector<Dim>& mean,
                                      const Vector<Dim>& change, const Vector<Dim>& of_flow);

    /// A finite body in one state: [x] - F J, with what its jump was made of.
    struct Elastic {
        Vector<Dim> jump = Vector<Dim>::Zero();
        Matrix<Dim> gradient = Matrix<Dim>::Zero();  // F - I, the mean of both cells
        Vector<Dim> lasting = Vector<Dim>::Zero();
    };
    /// Elastic part of a state with this [x] as it is remembered.
    [[nodiscard]] Elastic at(std::ptrdiff_t half_face, const Vector<Dim>& jump, const Matrix<Dim>& gradient) const;
    /// As `at`, kept as the start of the next step.
    [[nodiscard]] Elastic start(std::ptrdiff_t half_face, const Vector<Dim>& jump, const Matrix<Dim>& gradient);
    /// Lets a half-face yield in the step from the start to a state with this [x]. What the mean force of both ends
    /// does beyond the change of energy is booked as lost, or where it is negative, as it may be by what the step is
    /// too long, added to `defect` [J].
    [[nodiscard]] Elastic advance(std::ptrdiff_t cell, std::ptrdiff_t half_face, const Vector<Dim>& jump,
                                  const Matrix<Dim>& gradient, double& defect);

    /// Whether a half-face of a body of linear strains has yielded in the step, or in one before that has not ended.
    [[nodiscard]] bool any_yielded() const { return any_yielded_.load(std::memory_order_relaxed); }
    /// Energy that a cell's half of its faces has dissipated in the step [J].
    [[nodiscard]] double loss(std::ptrdiff_t cell) const {
        return contains(cell) ? loss_[static_cast<std::size_t>(cell)] : 0.0;
    }
    /// Energy that they have lost in the step as J went with free faces that flowed, without a sign [J].
    [[nodiscard]] double loss_by_flow(std::ptrdiff_t cell) const {
        return contains(cell) ? loss_by_flow_[static_cast<std::size_t>(cell)] : 0.0;
    }
    /// The next step begins where this one ends.
    void end_step();

    /// How many numbers a cell remembers.
    [[nodiscard]] std::int32_t memory_size(std::ptrdiff_t cell) const;
    /// Writes them behind `values`.
    void put_memory(std::ptrdiff_t cell, std::vector<double>& values) const;
    void set_memory(std::ptrdiff_t cell, std::span<const double> values);
    /// Whether a cell remembers the same things as one of another mesh.
    [[nodiscard]] bool remembers_as(std::ptrdiff_t cell, const CappedJumps& other, std::ptrdiff_t other_cell) const {
        return contains(cell) == other.contains(other_cell);
    }

private:
    static constexpr double never_reached = std::numeric_limits<double>::max();  // for want of a cap
    static constexpr double rounding = 1e-9;  // more than what sums of very many steps make of a jump, over the cap
    [[nodiscard]] static Elastic of(const Vector<Dim>& lasting, const Vector<Dim>& jump, const Matrix<Dim>& gradient);
    /// The part of a jump in space whose traction the cap limits: all of it, or that along the face, whose normal is
    /// `normal`, of any length.
    [[nodiscard]] Vector<Dim> limited(std::ptrdiff_t half_face, const Vector<Dim>& jump, const Vector<Dim>& normal) const;
    /// Change of J, in space, so that `trial` comes back to the cap [m].
    [[nodiscard]] Vector<Dim> excess(std::ptrdiff_t half_face, const Vector<Dim>& trial) const;

    const CcgArrays<Dim>& arrays_;
    bool any_ = false;                        // known from materials alone: this rank may have no cell of them
    std::vector<char> capped_;                // of each cell; empty, as all below, where no body has them
    std::vector<double> largest_;             // |[u] - J| at the cap, by half-face [m]
    std::vector<char> only_slides_;           // whether J stays in the face, by half-face; of finite bodies
    std::vector<Vector<Dim>> memory_, next_;  // J by half-face
    // [u] - J at the start and at the end of the step, by half-face; of bodies whose strains are linear
    std::vector<Vector<Dim>> elastic_, next_elastic_;
    std::vector<Elastic> start_, end_;         // by half-face, of finite bodies
    std::vector<double> loss_, loss_by_flow_;  // by cell
    std::atomic<bool> any_yielded_ = false;
};

static_assert(RememberingCells<CappedJumps<2>> && RememberingCells<CappedJumps<3>>);

}  // namespace abut::solid
