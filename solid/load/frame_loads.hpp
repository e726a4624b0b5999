#pragma once
// Private to the sources of this layer.
#include <span>
#include <vector>

#include "abut/solid/body/bodies.hpp"
#include "abut/solid/body/body_frames.hpp"
#include "abut/solid/ccg/ccg.hpp"
#include "abut/solid/part/rank_part.hpp"

namespace abut::solid {

/// Tractions that turn with floating bodies (TractionHold::frames). In the frame of its body such a load is that of a
/// body that does not turn: it is part of V, where force and moment on the whole body have no place. These are here: at
/// the arms at rest, so that what is in balance on the body at rest stays so when it deforms. Their work is booked.
template <int Dim>
class FrameLoads {
public:
    /// All must outlive it.
    FrameLoads(const Bodies<Dim>& bodies, const BodyFrames<Dim>& frames, const RankPart<Dim>& part);

    [[nodiscard]] bool any() const { return any_; }
    /// Takes the tractions of the boundary faces. A call of all ranks.
    void take(const BoundaryLoad<Dim>& load);
    /// Pushes of these loads on each body, added to those of others (n_bodies that deform), where the frames are.
    [[nodiscard]] std::span<const BodyPush<Dim>> pushes(std::span<const BodyPush<Dim>> others);
    /// The frames are along a step now.
    void follow();
    /// The work on the whole bodies in that step [J].
    [[nodiscard]] double work() const { return work_; }

private:
    struct Load {
        Vector<Dim> force = Vector<Dim>::Zero();             // [N], in the frame
        AxialVector<Dim> moment = AxialVector<Dim>::Zero();  // about the centre at rest [N m]
    };
    /// In space, as the mean over the step.
    [[nodiscard]] Load turned(std::size_t body) const;

    const Bodies<Dim>& bodies_;
    const BodyFrames<Dim>& frames_;
    const RankPart<Dim>& part_;
    bool any_ = false;                              // on any rank
    std::vector<std::vector<BoundaryFace>> faces_;  // here that such a traction acts on, by body
    std::vector<Load> loads_;                       // by body
    std::vector<BodyPush<Dim>> pushes_;
    double work_ = 0.0;
};

}  // namespace abut::solid
