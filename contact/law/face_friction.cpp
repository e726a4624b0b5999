#include "abut/contact/law/face_friction.hpp"

#include "abut/base/ids.hpp"
#include "abut/contact/surface/nodal_surface.hpp"
#include "abut/geometry/plane_frame.hpp"

namespace abut::contact {
template <int Dim>
geometry::Tangents<Dim> FaceFrictionLaw<Dim>::tangents(const SurfaceView<Dim>& surface, const Pair& pair, std::size_t side) {
    const Vector<Dim> normal = side == 0 ? pair.normal : Vector<Dim>(-pair.normal);
    if constexpr (Dim == 2)
        return geometry::PlaneFrame<2>(normal).tangents();  // the tangent of a line is turned as its normal is
    const Vector<Dim>& own = surface.normal[static_cast<std::size_t>(pair.facets.facet[side])];
    return geometry::turned<Dim>(geometry::PlaneFrame<Dim>(own).tangents(), own, normal);
}

template <int Dim>
template <class SlipOf>
void FaceFrictionLaw<Dim>::take_pairs(const SurfaceView<Dim>& surface, const PairList<Dim>& list,
                                      const ActivePairs<Dim>& active, const SlipOf& slip_of, ContactStep<Dim>& step) {
    halves_.clear();
    pairs_.clear();
    for (std::int32_t a = 0; a < active.size(); ++a) {
        const ContactPair<Dim>& pair = list[active.pairs[static_cast<std::size_t>(a)]];
        PairStep<Dim>& of_step = step.pairs[static_cast<std::size_t>(a)];
        const Pressing pressing{of_step.normal_force, of_step.area, of_step.active_share};
        if (pair.friction < 0 || !pressing.acts()) continue;
        pairs_.push_back({.facets = {.facet = {Facet{pair.face_1}, Facet{pair.face_2}}},
                          .normal = of_step.normal,
                          .in_step = a,
                          .listed = {pair.listed_1, pair.listed_2}});
        Pair& sliding = pairs_.back();
        append_halves<Dim>(
            surface, options_.laws[static_cast<std::size_t>(pair.friction)], pressing, slip_of(pair, of_step),
            [&](std::size_t side) { return tangents(surface, sliding, side); }, sliding.facets, halves_);
    }
}

template <int Dim>
void FaceFrictionLaw<Dim>::apply(const SurfaceView<Dim>& surface, const PairList<Dim>& list, const ActivePairs<Dim>& active,
                                 double dt, std::span<const Vector<Dim>> u_0, std::span<const Vector<Dim>> u_1,
                                 TakenForce take, FacetStore& facets, ContactStep<Dim>& step) {
    const auto slip_of = [&](const ContactPair<Dim>& pair, PairStep<Dim>& of_step) {
        const auto motion_of = [&](std::int32_t listed) -> Vector<Dim> { return u_1[listed] - u_0[listed]; };
        const Vector<Dim> relative = motion_of(pair.listed_2) - motion_of(pair.listed_1);
        of_step.point = 0.5 * (surface.centroid[pair.face_1] + surface.centroid[pair.face_2]) +
                        0.25 * (u_0[pair.listed_1] + u_1[pair.listed_1] + u_0[pair.listed_2] + u_1[pair.listed_2]);
        return of_step.slip = relative - of_step.normal * of_step.normal.dot(relative);
    };
    take_pairs(surface, list, active, slip_of, step);
    pass_.apply(dt, take, halves_, facets, step.report.friction, step.friction);
    for (Pair& pair : pairs_) {
        take_weights<n_tangents>(halves_, pair.facets);
        const Vector<Dim> force = force_on_second<Dim>(
            halves_, [&](std::size_t side) { return tangents(surface, pair, side); }, pair.facets);
        add_force(pair, force, step);
    }
}

template <int Dim>
void FaceFrictionLaw<Dim>::evaluate(const SurfaceView<Dim>& surface, const PairList<Dim>& list,
                                    const ActivePairs<Dim>& active, const FacetStore& facets, ContactStep<Dim>& step) {
    step.report.friction.energy = stick_energy<n_tangents>(facets);
    list_friction<n_tangents>(facets, step.friction);
    const auto none = [](const ContactPair<Dim>&, const PairStep<Dim>&) -> Vector<Dim> { return Vector<Dim>::Zero(); };
    take_pairs(surface, list, active, none, step);
    pass_.weigh(halves_);
    for (Pair& pair : pairs_) {
        take_weights<n_tangents>(halves_, pair.facets);
        const Vector<Dim> force = spring_force_on_second<Dim>(
            facets, [&](std::size_t side) { return tangents(surface, pair, side); }, pair.facets);
        add_force(pair, force, step);
    }
}

template <int Dim>
void FaceFrictionLaw<Dim>::add_force(const Pair& pair, const Vector<Dim>& force, ContactStep<Dim>& step) {
    for (std::size_t side = 0; side < 2; ++side) step.mean_gradient[ListedFace{pair.listed[side]}] -= sign_of(side) * force;
    PairStep<Dim>& of_step = step.pairs[static_cast<std::size_t>(pair.in_step)];
    of_step.force += force;
    of_step.friction += force;
}

template class FaceFrictionLaw<2>;
template class FaceFrictionLaw<3>;

}  // namespace abut::contact
