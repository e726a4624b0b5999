#include "abut/contact/law/face_friction.hpp"

#include <algorithm>

#include "abut/base/ids.hpp"
#include "abut/contact/nodal_surface.hpp"
#include "abut/geometry/plane_frame.hpp"

namespace abut::contact {

template <int Dim>
geometry::Tangents<Dim> FaceFrictionLaw<Dim>::tangents(const SurfaceView<Dim>& surface, const Pair& pair, std::size_t side) {
    const Vector<Dim>& own = surface.normal[static_cast<std::size_t>(pair.face[side])];
    return geometry::turned<Dim>(geometry::PlaneFrame<Dim>(own).tangents(), own,
                                 side == 0 ? pair.normal : Vector<Dim>(-pair.normal));
}

template <int Dim>
void FaceFrictionLaw<Dim>::apply(const SurfaceView<Dim>& surface, const PairList<Dim>& list, const ActivePairs<Dim>& active,
                                 double dt, std::span<const Vector<Dim>> u_0, std::span<const Vector<Dim>> u_1,
                                 TakenForce take, FacetStore& facets, ContactStep<Dim>& step) {
    halves_.clear();
    last_.clear();
    for (std::int32_t a = 0; a < active.size(); ++a) {
        const ContactPair<Dim>& pair = list[active.pairs[static_cast<std::size_t>(a)]];
        PairStep<Dim>& of_step = step.pairs[static_cast<std::size_t>(a)];
        if (pair.friction < 0 || !(of_step.normal_force > 0.0 && of_step.area > 0.0 && of_step.active_share > 0.0)) continue;
        last_.push_back({.face = {pair.face_1, pair.face_2}, .normal = of_step.normal, .in_step = a});
        Pair& sliding = last_.back();
        const auto motion_of = [&](std::int32_t listed) -> Vector<Dim> { return u_1[listed] - u_0[listed]; };
        const Vector<Dim> relative = motion_of(pair.listed_2) - motion_of(pair.listed_1);
        of_step.point = 0.5 * (surface.centroid[pair.face_1] + surface.centroid[pair.face_2]) +
                        0.25 * (u_0[pair.listed_1] + u_1[pair.listed_1] + u_0[pair.listed_2] + u_1[pair.listed_2]);
        of_step.slip = relative - of_step.normal * of_step.normal.dot(relative);
        for (std::size_t side = 0; side < 2; ++side) {
            const std::int32_t face = sliding.face[side], partner = sliding.face[1 - side];
            if (surface.is_rigid(face)) continue;
            const double share = surface.is_rigid(partner) ? 1.0 : 0.5;
            sliding.half[side] = static_cast<std::int32_t>(halves_.size());
            halves_.push_back(
                {.facet = Facet{face},
                 .normal_force = share * of_step.normal_force,
                 .active_share = of_step.active_share,
                 .area = share * of_step.area,
                 .pair_area = of_step.area,
                 .facet_area = surface.area[face],
                 .stiffness = series_stiffness(surface.shear_stiffness[face], surface.shear_stiffness[partner]),
                 .law = &options_.laws[static_cast<std::size_t>(pair.friction)],
                 .motion = geometry::components<Dim>(tangents(surface, sliding, side),
                                                     Vector<Dim>(sign_of(side) * of_step.slip))});
        }
    }
    pass_.apply(dt, take, halves_, facets, step.report.friction, step.friction);
    for (Pair& pair : last_) {
        Vector<Dim> force = Vector<Dim>::Zero();
        for (std::size_t side = 0; side < 2; ++side) {
            if (pair.half[side] < 0) continue;
            const Half& half = halves_[static_cast<std::size_t>(pair.half[side])];
            pair.weight[side] = half.weight;
            force -= sign_of(side) * geometry::in_space<Dim>(tangents(surface, pair, side), half.force);
        }
        add_force(pair, force, step);
    }
}

template <int Dim>
void FaceFrictionLaw<Dim>::evaluate(const SurfaceView<Dim>& surface, const FacetStore& facets,
                                    ContactStep<Dim>& step) const {
    step.report.friction.energy = stick_energy<n_tangents>(facets);
    for (const Pair& pair : last_) {
        Vector<Dim> force = Vector<Dim>::Zero();
        for (std::size_t side = 0; side < 2; ++side) {
            if (pair.weight[side] == 0.0) continue;
            const auto state = stick_state<n_tangents>(facets[Facet{pair.face[side]}]);
            force -= (sign_of(side) * pair.weight[side]) *
                     geometry::in_space<Dim>(tangents(surface, pair, side), state.stiffness * state.stretch);
        }
        Pair in_step = pair;
        const auto key = [](const PairStep<Dim>& of) { return std::pair(of.face_1, of.face_2); };
        const std::pair wanted(Face{pair.face[0]}, Face{pair.face[1]});
        const auto at = std::ranges::lower_bound(step.pairs, wanted, {}, key);
        in_step.in_step =
            at != step.pairs.end() && key(*at) == wanted ? static_cast<std::int32_t>(at - step.pairs.begin()) : -1;
        add_force(in_step, force, step);
    }
}

template <int Dim>
void FaceFrictionLaw<Dim>::add_force(const Pair& pair, const Vector<Dim>& force, ContactStep<Dim>& step) {
    for (std::size_t side = 0; side < 2; ++side) {
        const Face face{pair.face[side]};
        const auto at = std::ranges::lower_bound(step.faces, face);
        if (at == step.faces.end() || *at != face) continue;
        step.mean_gradient[ListedFace{static_cast<std::int32_t>(at - step.faces.begin())}] -= sign_of(side) * force;
    }
    if (pair.in_step < 0) return;
    PairStep<Dim>& of_step = step.pairs[static_cast<std::size_t>(pair.in_step)];
    of_step.force += force;
    of_step.friction += force;
}

template class FaceFrictionLaw<2>;
template class FaceFrictionLaw<3>;

}  // namespace abut::contact
