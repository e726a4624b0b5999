#include "abut/solid/turning_tractions.hpp"

#include "abut/base/error.hpp"

namespace abut::solid {
namespace {

/// Which bodies the faces of a group are of; 1: there are such.
struct Sides {
    double turning = 0.0, others = 0.0;
};

template <int Dim>
Sides sides_of(const mesh::Mesh<Dim>& mesh, const SolidOptions<Dim>& options, const TractionCondition<Dim>& condition) {
    Sides sides;
    for (const std::int32_t face : mesh.group(condition.group).faces) {
        const auto body = static_cast<std::size_t>(mesh.cell_body[mesh.face_cells[face][0]]);
        const bool turns = body < options.kinematics.size() && options.kinematics[body] != Kinematics::small;
        (turns ? sides.turning : sides.others) = 1.0;
    }
    return sides;
}

}  // namespace

template <int Dim>
std::vector<bool> turning_tractions(const mesh::Mesh<Dim>& mesh, const SolidOptions<Dim>& options,
                                    const dynamics::Ranks* ranks) {
    std::vector<Sides> of_conditions = dynamics::agreed(ranks, [&] {
        std::vector<Sides> here;
        for (const auto& condition : options.boundary.traction) here.push_back(sides_of(mesh, options, condition));
        return here;
    });
    std::vector<bool> turning;
    for (std::size_t i = 0; i < of_conditions.size(); ++i) {
        Sides& sides = of_conditions[i];
        if (ranks) sides = {ranks->largest(sides.turning), ranks->largest(sides.others)};
        if (sides.turning > 0.0 && sides.others > 0.0)
            throw BadInput(mesh.name + ": the traction on '" + options.boundary.traction[i].group +
                           "' acts on bodies of Kinematics::small and on others. Give each kind a group of its own.");
        turning.push_back(sides.turning > 0.0);
    }
    return turning;
}

template std::vector<bool> turning_tractions(const mesh::Mesh<2>&, const SolidOptions<2>&, const dynamics::Ranks*);
template std::vector<bool> turning_tractions(const mesh::Mesh<3>&, const SolidOptions<3>&, const dynamics::Ranks*);

}  // namespace abut::solid
