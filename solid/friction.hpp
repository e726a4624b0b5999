#pragma once
// Private to the sources of this layer.
#include <cstdint>
#include <utility>
#include <vector>

#include "abut/contact/friction.hpp"
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

}  // namespace abut::solid
