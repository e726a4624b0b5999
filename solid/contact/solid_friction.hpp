#pragma once
// Private to the sources of this layer.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "abut/base/ids.hpp"
#include "abut/contact/friction.hpp"
#include "abut/contact/step.hpp"
#include "abut/mesh/mesh.hpp"
#include "abut/solid/boundary/boundary_face.hpp"
#include "abut/solid/contact/contact_results.hpp"
#include "abut/solid/contact/face_sides.hpp"
#include "abut/solid/options/options.hpp"

namespace abut::solid {

/// Laws of friction as contact asks for them, by face. `body_of` as FaceSides, `faces_of(g)` as there.
template <int Dim, class FacesOf>
[[nodiscard]] contact::FrictionOptions friction_between(const SolidOptions<Dim>& options, std::int32_t n_bodies,
                                                        std::vector<std::int32_t> body_of, const FacesOf& faces_of) {
    if (!options.has_friction()) return {};
    struct OfSides {
        std::array<std::int32_t, 2> sides;
        std::int32_t law;
        int n_groups;
    };
    contact::FrictionOptions friction;
    const bool is_for_all = options.friction.acts();
    if (is_for_all) friction.laws.push_back(options.friction);
    FaceSides sides(std::move(body_of), n_bodies + static_cast<std::int32_t>(options.obstacles.size()));
    std::vector<OfSides> of_sides;
    for (const auto& [pair, law] : options.body_friction) {
        of_sides.push_back(
            {.sides = pair, .law = law.acts() ? static_cast<std::int32_t>(friction.laws.size()) : -1, .n_groups = 0});
        if (law.acts()) friction.laws.push_back(law);
        for (const std::int32_t side : pair) {
            sides.add(side, faces_of);
            of_sides.back().n_groups += sides.is_group(side) ? 1 : 0;
        }
    }
    std::ranges::stable_sort(of_sides, std::ranges::greater{}, &OfSides::n_groups);
    friction.law_of = [sides = std::move(sides), of_sides = std::move(of_sides), is_for_all](contact::Face face_1,
                                                                                             contact::Face face_2) {
        for (const OfSides& one : of_sides)
            if ((sides.has(one.sides[0], face_1) && sides.has(one.sides[1], face_2)) ||
                (sides.has(one.sides[0], face_2) && sides.has(one.sides[1], face_1)))
                return one.law;
        return is_for_all ? 0 : -1;
    };
    return friction;
}

/// Fields of friction: `pairs` and `faces` of the state that was evaluated last. `boundary_of`: the boundary face
/// of a face of contact, `no_face` if there is none here.
template <int Dim, class BoundaryOf>
void add_friction(std::span<const contact::PairStep<Dim>> pairs, std::span<const contact::FaceFriction> faces,
                  const BoundaryOf& boundary_of, const mesh::Mesh<Dim>& mesh, ContactField& field) {
    const std::size_t n = field.pressure.size();
    std::vector<Vector<Dim>> force(n, Vector<Dim>::Zero());
    for (const contact::PairStep<Dim>& pair : pairs) {
        if (const BoundaryFace b = boundary_of(pair.face_1); b != no_face) force[number_of(b)] -= pair.friction;
        if (const BoundaryFace b = boundary_of(pair.face_2); b != no_face) force[number_of(b)] += pair.friction;
    }
    for (std::size_t b = 0; b < n; ++b)
        field.friction.push_back(force[b].norm() / mesh.face_measure[mesh_face(mesh, BoundaryFace(b))]);
    field.slip.assign(n, 0.0);
    field.sliding.assign(n, 0.0);
    for (const contact::FaceFriction& face : faces)
        if (const BoundaryFace b = boundary_of(face.face); b != no_face) {
            field.slip[number_of(b)] = std::max(field.slip[number_of(b)], face.slip);
            field.sliding[number_of(b)] = std::max(field.sliding[number_of(b)], face.slip > 0.0 ? 2.0 : 1.0);
        }
}

}  // namespace abut::solid
