#pragma once
// Private to the sources of this layer.
#include <cstddef>
#include <span>
#include <vector>

#include "abut/base/vector.hpp"

namespace abut::solid {

template <int Dim>
class Bodies;
template <int Dim>
class Ccg;
template <int Dim>
class RankPart;

/// The correction of MeanForce::closed_trapezoid: per body a smooth force M (omega x r + a v') that does the work which
/// the mean of the forces at both ends lacks, and takes away its moment. v' is the motion of a step less the rigid part
/// of it; of a body that is held somewhere it is the whole motion, and omega is 0. docs/method.md, Bodies that bend.
template <int Dim>
class TrapezoidClosure {
public:
    /// All must outlive it. A call of all ranks.
    TrapezoidClosure(const Bodies<Dim>& bodies, const RankPart<Dim>& part, const Ccg<Dim>& ccg);

    /// Adds it to the force on the cells in the step that `ccg` made last, from q_0 to q_1, by point of the part (n_points)
    /// [N]. A call of all ranks.
    void add(std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1, std::span<Vector<Dim>> force) const;

private:
    struct ClosedBody {
        std::size_t number;  // among those that deform
        bool is_held;
    };
    void add_to_body(const ClosedBody& body, const Vector<Dim>& origin_0, const Vector<Dim>& origin_1,
                     std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1, std::span<Vector<Dim>> force) const;

    const Bodies<Dim>& bodies_;
    const RankPart<Dim>& part_;
    const Ccg<Dim>& ccg_;
    std::vector<ClosedBody> closed_;
};

}  // namespace abut::solid
