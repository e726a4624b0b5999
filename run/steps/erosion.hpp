#pragma once
// Private to the layer.
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "abut/run/steps/start.hpp"
#include "abut/solid/change.hpp"
#include "abut/solid/erosion.hpp"

namespace abut::run {

/// Cells that leave a run: it says which, and puts what is left into the place of what was there (Start::take_rest).
/// The mesh that is left is always made from that of the scene, so that a run that goes on from a checkpoint has the same.
template <int Dim>
class Erosion {
public:
    /// `start` must outlive it.
    explicit Erosion(Start<Dim>& start);

    /// Whether any cell may leave.
    [[nodiscard]] bool acts() const { return acts_; }
    /// Cells that leave after a step, numbered as in the present mesh, increasing; remnants among them. To be asked right
    /// after the step. Throws BadInput where a function of the scene names a cell that is not there.
    [[nodiscard]] std::vector<solid::LeavingCell> leaving(const dynamics::RunView<Dim>& run);
    /// Takes them out and books what they take along. Returns the state from which the run goes on. Throws LimitExceeded,
    /// and nothing has changed, where a body would lose its last cells, or where the step is not stable for what is left.
    [[nodiscard]] solid::RunState take_out(std::span<const solid::LeavingCell> leaving,
                                           const dynamics::IntegratorState& motion);
    /// Goes on without the cells that RunResult::erosion lists, at displacements and momenta of a checkpoint.
    void resume(const dynamics::IntegratorState& motion);
    /// By cell of the present mesh its number in that of the scene.
    [[nodiscard]] std::span<const std::int32_t> first_cells() const { return first_cells_; }

private:
    struct Rest {
        std::unique_ptr<Scene<Dim>> scene;
        std::unique_ptr<solid::Solid<Dim>> solid;
        std::vector<std::int32_t> first_cells;
    };
    /// Without the cells that have left before, and without these of the present mesh.
    [[nodiscard]] Rest rest_without(std::span<const std::int32_t> cells) const;
    void require_cells(const std::vector<char>& is_gone) const;
    void require_stable(solid::Solid<Dim>& solid);

    Start<Dim>& start_;
    bool acts_;
    std::vector<std::int32_t> first_cells_;
    double worst_weight_;  // of the stencils so far, the most negative one
};

}  // namespace abut::run
