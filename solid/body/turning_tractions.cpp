#include "abut/solid/body/turning_tractions.hpp"

#include <array>

#include "abut/base/error.hpp"
#include "abut/solid/kinematics/properties.hpp"

namespace abut::solid {
namespace {

/// Kinds of bodies of which faces of a group are; 1: there are such.
struct BodiesOfGroup {
    double stay = 0.0, turn = 0.0, have_frames = 0.0, have_finite_strains = 0.0;
};
constexpr std::array all_of_group{&BodiesOfGroup::stay, &BodiesOfGroup::turn, &BodiesOfGroup::have_frames,
                                  &BodiesOfGroup::have_finite_strains};

template <int Dim>
BodiesOfGroup bodies_of_group(const mesh::Mesh<Dim>& mesh, const SolidOptions<Dim>& options, const std::string& group) {
    BodiesOfGroup bodies;
    for (const std::int32_t face : mesh.group(group).faces) {
        const auto body = static_cast<std::size_t>(mesh.cell_body[mesh.face_cells[face][0]]);
        const KinematicsProperties& is =
            properties_of(body < options.kinematics.size() ? options.kinematics[body] : Kinematics{});
        (is.turns ? bodies.turn : bodies.stay) = 1.0;
        if (is.has_frame) bodies.have_frames = 1.0;
        if (is.finite_strains) bodies.have_finite_strains = 1.0;
    }
    return bodies;
}

}  // namespace

template <int Dim>
std::vector<TractionHold> traction_holds(const mesh::Mesh<Dim>& mesh, const SolidOptions<Dim>& options,
                                         const dynamics::Ranks& ranks) {
    std::vector<BodiesOfGroup> of_conditions = dynamics::agreed(ranks, [&] {
        std::vector<BodiesOfGroup> here;
        for (const auto& condition : options.boundary.traction)
            here.push_back(bodies_of_group(mesh, options, condition.group));
        return here;
    });
    std::vector<TractionHold> holds;
    for (std::size_t i = 0; i < of_conditions.size(); ++i) {
        const TractionCondition<Dim>& condition = options.boundary.traction[i];
        BodiesOfGroup& bodies = of_conditions[i];
        for (double BodiesOfGroup::*of : all_of_group) bodies.*of = ranks.largest(bodies.*of);
        const bool turns = bodies.turn > 0.0;
        if (turns && bodies.stay > 0.0)
            throw BadInput(mesh.name + ": the traction on '" + condition.group +
                           "' acts on bodies of Kinematics::small and on others. Give each kind a group of its own.");
        const bool in_frames =
            condition.follows && !condition.from_outside && bodies.have_frames > 0.0 && bodies.have_finite_strains == 0.0;
        holds.push_back(!turns ? TractionHold::cells : in_frames ? TractionHold::frames : TractionHold::points);
    }
    return holds;
}

template std::vector<TractionHold> traction_holds(const mesh::Mesh<2>&, const SolidOptions<2>&, const dynamics::Ranks&);
template std::vector<TractionHold> traction_holds(const mesh::Mesh<3>&, const SolidOptions<3>&, const dynamics::Ranks&);

}  // namespace abut::solid
