#include "abut/solid/body/turning_tractions.hpp"

#include <array>

#include "abut/base/error.hpp"

namespace abut::solid {
namespace {

/// Which bodies the faces of a group are of, by Kinematics; 1: there are such.
struct KinematicsOfFaces {
    std::array<double, 4> of{};

    double& operator[](Kinematics kinematics) { return of[static_cast<std::size_t>(kinematics)]; }
};

template <int Dim>
KinematicsOfFaces sides_of(const mesh::Mesh<Dim>& mesh, const SolidOptions<Dim>& options,
                           const TractionCondition<Dim>& condition) {
    KinematicsOfFaces sides;
    for (const std::int32_t face : mesh.group(condition.group).faces) {
        const auto body = static_cast<std::size_t>(mesh.cell_body[mesh.face_cells[face][0]]);
        sides[body < options.kinematics.size() ? options.kinematics[body] : Kinematics::small] = 1.0;
    }
    return sides;
}

}  // namespace

template <int Dim>
std::vector<TractionHold> traction_holds(const mesh::Mesh<Dim>& mesh, const SolidOptions<Dim>& options,
                                         const dynamics::Ranks& ranks) {
    std::vector<KinematicsOfFaces> of_conditions = dynamics::agreed(ranks, [&] {
        std::vector<KinematicsOfFaces> here;
        for (const auto& condition : options.boundary.traction) here.push_back(sides_of(mesh, options, condition));
        return here;
    });
    std::vector<TractionHold> holds;
    for (std::size_t i = 0; i < of_conditions.size(); ++i) {
        const TractionCondition<Dim>& condition = options.boundary.traction[i];
        KinematicsOfFaces& sides = of_conditions[i];
        for (double& side : sides.of) side = ranks.largest(side);
        const bool turns = sides[Kinematics::floating] + sides[Kinematics::finite] + sides[Kinematics::rigid] > 0.0;
        if (turns && sides[Kinematics::small] > 0.0)
            throw BadInput(mesh.name + ": the traction on '" + condition.group +
                           "' acts on bodies of Kinematics::small and on others. Give each kind a group of its own.");
        const bool in_frames = condition.follows && !condition.from_outside && sides[Kinematics::floating] > 0.0 &&
                               sides[Kinematics::finite] == 0.0;
        holds.push_back(!turns ? TractionHold::cells : in_frames ? TractionHold::frames : TractionHold::points);
    }
    return holds;
}

template std::vector<TractionHold> traction_holds(const mesh::Mesh<2>&, const SolidOptions<2>&, const dynamics::Ranks&);
template std::vector<TractionHold> traction_holds(const mesh::Mesh<3>&, const SolidOptions<3>&, const dynamics::Ranks&);

}  // namespace abut::solid
