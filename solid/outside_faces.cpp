#include "abut/solid/outside_faces.hpp"

#include "abut/dynamics/ledger.hpp"
#include "abut/solid/outside_view.hpp"
#include "abut/solid/solid.hpp"

namespace abut::solid {

template <int Dim>
OutsideFaces<Dim> outside_faces(const dynamics::RunView<Dim>& run, const Solid<Dim>& solid, const std::string& group) {
    std::vector<double> momentum(run.p_before.begin(), run.p_before.end());
    for (std::size_t i = 0; i < momentum.size(); ++i) momentum[i] = 0.5 * (momentum[i] + run.p_after[i]);
    OutsideFaces<Dim> faces;
    const auto numbers = solid.outside(group).numbers();
    faces.number.assign(numbers.begin(), numbers.end());
    faces.position = solid.outside(group).position(run.q);
    faces.velocity = solid.outside(group).velocity(momentum);
    faces.normal = solid.outside(group).normal(run.q);
    for (const std::int32_t face : solid.outside(group).faces())
        faces.area.push_back(solid.mesh().face_measure[static_cast<std::size_t>(face)]);
    faces.bonded = solid.outside(group).bonded();
    const auto traction = solid.outside(group).traction();
    faces.traction.assign(traction.begin(), traction.end());
    return faces;
}

template OutsideFaces<2> outside_faces<2>(const dynamics::RunView<2>&, const Solid<2>&, const std::string&);
template OutsideFaces<3> outside_faces<3>(const dynamics::RunView<3>&, const Solid<3>&, const std::string&);

}  // namespace abut::solid
