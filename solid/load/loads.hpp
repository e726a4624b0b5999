#pragma once
// Private to the sources of this layer.
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "abut/base/state_bytes.hpp"
#include "abut/mesh/mesh.hpp"
#include "abut/solid/ccg/ccg.hpp"
#include "abut/solid/options/options.hpp"
#include "abut/solid/part/rank_part.hpp"

namespace abut::solid {

/// Loads on the bodies from outside, contact with obstacles left out: body forces, prescribed displacements and tractions,
/// at both ends of a step. Displacements are linear within a step, tractions and
/// temperatures are constant and change where it begins.
template <int Dim>
class Loads {
public:
    /// `masses` are those of the cells. Mesh, operators and part must outlive the loads. Throws
    /// BadInput for a body force that is not finite, and where a boundary condition gives such a value.
    Loads(const mesh::Mesh<Dim>& mesh, const SolidOptions<Dim>& options, std::span<const double> masses, const Ccg<Dim>& ccg,
          const RankPart<Dim>& part);

    /// Whether a boundary condition has a history.
    [[nodiscard]] bool vary() const { return ccg_.load_varies(); }
    /// At the start of the step that is being made, or of the last one.
    [[nodiscard]] const BoundaryLoad<Dim>& start() const { return start_; }
    /// At its end.
    [[nodiscard]] const BoundaryLoad<Dim>& end() const { return end_; }
    /// With the mean of the displacements of both.
    [[nodiscard]] BoundaryLoad<Dim> mean() const;

    /// Quantity that jumps where a step begins.
    enum class Jump { temperatures, tractions };
    /// For loads that vary: a step begins, and both ends are set. Where temperatures or tractions jump at its start,
    /// `follow_jump` is called with the loads from before the jump in `start()` and those after it in `end()`, and then
    /// `book` with the jump of `potential`, which is evaluated with the loads `end()` [J]. Where both jump it is one
    /// jump, of tractions; `apart`: two, first of temperatures. Returns whether they jumped.
    bool begin_step(double time, double dt, bool apart, const std::function<double()>& potential,
                    const std::function<void(Jump)>& follow_jump, const std::function<void(Jump, double)>& book);
    void end_step() { is_half_done_ = false; }
    /// Whether a step with loads that vary has begun and not ended.
    [[nodiscard]] bool is_half_done() const { return is_half_done_; }
    /// Adds the work of prescribed displacements and tractions over the step, were the gradients of the boundary faces
    /// as they are now: `share` of it [J].
    void add_work(double share, double& work) const;

    /// By cell [N]; empty: none.
    [[nodiscard]] std::span<const Vector<Dim>> body_force() const { return body_force_; }
    /// Work of body forces in the displacements u [J].
    [[nodiscard]] double body_work(std::span<const Vector<Dim>> u) const;
    /// Body force less dV/du_c of one cell [N].
    [[nodiscard]] Vector<Dim> force_on(std::int32_t cell, const Vector<Dim>& gradient) const {
        return body_force_.empty() ? Vector<Dim>(-gradient) : Vector<Dim>(body_force_[cell] - gradient);
    }
    /// As `force_on`, for all cells and in place.
    void to_force(std::span<Vector<Dim>> gradient) const;
    /// Adds dt times body force less gradient, given for some cells, to the impulses of all [N s].
    void add_impulse(std::span<const std::int32_t> cells, std::span<const Vector<Dim>> gradient, double dt,
                     std::span<Vector<Dim>> impulse) const;

    void save(StateWriter& state) const;  ///< between two steps
    void restore(StateReader& state);
    /// As `before` ended at `time`: of each boundary face its old index is given, -1 for one that was not there, which
    /// has what its conditions give then.
    void take_over(const Loads& before, std::span<const std::int32_t> old_boundary, double time);

private:
    [[nodiscard]] BoundaryLoad<Dim> with_old_tractions(const BoundaryLoad<Dim>& changed) const;

    const mesh::Mesh<Dim>& mesh_;
    const Ccg<Dim>& ccg_;
    const RankPart<Dim>& part_;
    bool has_conditions_;                  // on the boundary, of all ranks
    double traction_time_ = 0.0;           // of tractions and temperatures now
    bool has_body_force_;                  // of all ranks
    std::vector<Vector<Dim>> body_force_;  // by cell; empty: none
    BoundaryLoad<Dim> start_;
    BoundaryLoad<Dim> end_;
    bool is_half_done_ = false;
};

}  // namespace abut::solid
