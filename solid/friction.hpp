#pragma once
// Private to the sources of this layer.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "abut/base/ids.hpp"
#include "abut/contact/friction.hpp"
#include "abut/contact/step.hpp"
#include "abut/mesh/mesh.hpp"
#include "abut/solid/boundary_face.hpp"
#include "abut/solid/contact_results.hpp"
#include "abut/solid/options.hpp"

namespace abut::solid {

/// Laws of friction as contact asks for them, by face. `body_of`: of each face of the surface of contact, the body in the mesh,
/// n_bodies + i of a face of obstacle i.
template <int Dim>
[[nodiscard]] contact::FrictionOptions friction_between(const SolidOptions<Dim>& options,
                                                        std::vector<std::int32_t> body_of) {
    if (!options.has_friction()) return {};
    contact::FrictionOptions friction;
    const bool is_for_all = options.friction.acts();
    if (is_for_all) friction.laws.push_back(options.friction);
    std::vector<std::array<std::int32_t, 3>> of_bodies;  // lower body, higher body, law
    for (const auto& [bodies, law] : options.body_friction) {
        of_bodies.push_back({std::min(bodies[0], bodies[1]), std::max(bodies[0], bodies[1]),
                             law.acts() ? static_cast<std::int32_t>(friction.laws.size()) : -1});
        if (law.acts()) friction.laws.push_back(law);
    }
    friction.law_of = [body_of = std::move(body_of), of_bodies = std::move(of_bodies), is_for_all](contact::Face face_1,
                                                                                                   contact::Face face_2) {
        const std::int32_t a = body_of[static_cast<std::size_t>(face_1)], b = body_of[static_cast<std::size_t>(face_2)];
        for (const auto& [lower, higher, law] : of_bodies)
            if (lower == std::min(a, b) && higher == std::max(a, b)) return law;
        return is_for_all ? 0 : -1;
    };
    return friction;
}

/// Fields of friction: `pairs` of the state that was evaluated last, `faces` of the last step. `boundary_of`: the boundary face
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
