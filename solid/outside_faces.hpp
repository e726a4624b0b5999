#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "abut/base/vector.hpp"

namespace abut::dynamics {
template <int Dim>
class RunView;
}

namespace abut::solid {

template <int Dim>
class Solid;

/// The faces of a group that is loaded from outside (TractionCondition::from_outside) as that program needs them: all in the
/// order of BoundaryGroup::faces, on several ranks those of this one (OutsideView). Where contact moves a face, or a free
/// one beside it, that is not in it.
template <int Dim>
struct OutsideFaces {
    std::vector<std::int32_t> number;   ///< among those of all ranks, in the order of one, increasing (n_faces)
    std::vector<Vector<Dim>> position;  ///< of the centroids, under the tractions of the last step (n_faces) [m]
    std::vector<Vector<Dim>> velocity;  ///< of the same, while tractions and supports stay, from p = (p^- + p^+)/2 [m/s]
    std::vector<Vector<Dim>> normal;    ///< out of the body, unit length: at rest where it is `small` or `finite` (n_faces)
    std::vector<double> area;           ///< |f| at rest: times a traction it is a force (n_faces) [m^(Dim-1)]
    /// Share of `area` that bonds hold to another body: less than before where a body broke in the last step (n_faces) [-]
    std::vector<double> bonded;
    std::vector<Vector<Dim>> traction;  ///< the one that acts in the next step (n_faces) [Pa]
};

/// At the node of `run`; `solid` is that of the run. A call of all ranks. Throws BadInput for a group that is not loaded
/// from outside.
template <int Dim>
[[nodiscard]] OutsideFaces<Dim> outside_faces(const dynamics::RunView<Dim>& run, const Solid<Dim>& solid,
                                              const std::string& group);

}  // namespace abut::solid
