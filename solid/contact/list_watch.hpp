#pragma once
// Private to the sources of this layer.
#include <optional>
#include <span>
#include <vector>

#include "abut/dynamics/ranks.hpp"
#include "abut/solid/ccg/ccg.hpp"

namespace abut::solid {

/// Watches how far the faces of the bodies have moved since candidates were last searched: a list is valid as long as that
/// is little enough.
template <int Dim>
class ListWatch {
public:
    /// Both must outlive the watch. `set_searched`, `measure` and the like are calls of all ranks, and say the same on each.
    ListWatch(Ccg<Dim>& ccg, const dynamics::Ranks& ranks)
        : ccg_(ccg), ranks_(ranks), amplification_(ranks.largest(ccg.motion_amplification())) {}

    /// Candidates have been searched at `time` for a step from q_0 to q_1, with the loads of both ends.
    void set_searched(std::span<const Vector<Dim>> q_0, const BoundaryLoad<Dim>& load_0, double time,
                      std::span<const Vector<Dim>> q_1, const BoundaryLoad<Dim>& load_1);
    /// When candidates were searched [s].
    [[nodiscard]] double time() const { return time_; }
    /// Whether q is the end of the step that candidates were searched for: the list is valid there, too.
    [[nodiscard]] bool is_end_of_search(std::span<const Vector<Dim>> q) const;

    /// How far any face has moved at most until q [m]; infinite before the first search. Reads all faces.
    [[nodiscard]] double motion_until(std::span<const Vector<Dim>> q, const BoundaryLoad<Dim>& load);
    /// As `motion_until`, and remembers it as that of the end of the current step.
    [[nodiscard]] double measure(std::span<const Vector<Dim>> q, const BoundaryLoad<Dim>& load);
    /// A larger bound that costs nothing, at the end of a step in which no cell moves farther than `cell_motion` [m]: from
    /// the sum of these since `measure`. Nothing where it is not known: if loads vary, in the first step, and in one that is
    /// tried again.
    [[nodiscard]] std::optional<double> add_step(double cell_motion);
    /// The current step has been made.
    void end_step() { is_at_last_end_ = true; }

private:
    Ccg<Dim>& ccg_;
    const dynamics::Ranks& ranks_;
    double amplification_;  // of all ranks
    bool has_searched_ = false;
    std::vector<Vector<Dim>> u_;          // at the last search,
    BoundaryLoad<Dim> load_;              // with its loads,
    double time_ = 0.0;                   // and its time
    std::vector<Vector<Dim>> swept_end_;  // of the step that it was for
    double measured_ = 0.0;               // motion of any face, from the last search to the state that was measured last [m]
    double travelled_ = 0.0;              // since then: sum over the steps of the motion of the cell that moved farthest [m]
    bool is_at_last_end_ = false;         // these two are of the state that the last step ended in
};

}  // namespace abut::solid
