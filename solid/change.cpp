#include "abut/solid/change.hpp"

#include <utility>

#include "abut/base/error.hpp"
#include "abut/contact/report.hpp"
#include "abut/dynamics/ledger.hpp"
#include "abut/dynamics/mass.hpp"
#include "abut/solid/contact_view.hpp"
#include "abut/solid/options/made_features.hpp"
#include "abut/solid/solid.hpp"

namespace abut::solid {
namespace {

template <int Dim>
double mass_of(const Solid<Dim>& solid) {
    double mass = 0.0;
    for (const double of_point : solid.masses()) mass += of_point;
    return mass;
}

template <int Dim>
Vector<Dim> momentum_of(const dynamics::IntegratorState& motion) {
    Vector<Dim> momentum = Vector<Dim>::Zero();
    for (const auto* p : {&motion.p_before, &motion.p_after})
        for (const Vector<Dim>& of_point : as_vectors<Dim>(std::span<const double>(*p))) momentum += 0.5 * of_point;
    return momentum;
}

template <int Dim>
double kinetic_of(const Solid<Dim>& solid, const dynamics::IntegratorState& motion) {
    return 0.5 * dynamics::mass_product(motion.p_before, solid.inverse_mass(), motion.p_after);
}

template <int Dim>
AxialVector<Dim> rest_moment_of(const Solid<Dim>& solid, const dynamics::IntegratorState& motion) {
    const dynamics::RunView<Dim> run(motion);
    AxialVector<Dim> sum = AxialVector<Dim>::Zero();
    for (std::size_t i = 0; i < solid.rest_positions().size(); ++i)
        sum += moment<Dim>(solid.rest_positions()[i], run.momentum(static_cast<std::ptrdiff_t>(i)));
    return sum;
}

template <int Dim>
AxialVector<Dim> pseudo_moment_of(const Solid<Dim>& solid, const dynamics::IntegratorState& motion) {
    return dynamics::pseudo_angular_momentum<Dim>(dynamics::RunView<Dim>(motion), motion.dt, solid.rest_positions(),
                                                  solid.masses());
}

/// Dissipated so far, with what faces that have left stored as they stuck [J].
template <int Dim>
double friction_of(const Solid<Dim>& solid) {
    return solid.contact().report().friction_dissipated;
}

}  // namespace

template <int Dim>
Change<Dim> change(Solid<Dim>& before, const dynamics::IntegratorState& motion, Solid<Dim>& after,
                   std::span<const std::int32_t> old_cells) {
    for (const Solid<Dim>* solid : {&before, &after})
        require_together(solid->mesh(), solid->options(), features_of(solid->ranks()) | FeatureSet{Feature::mesh_change});
    Change<Dim> changed;
    dynamics::IntegratorState& now = changed.state.motion = after.take_over(before, motion, old_cells);
    changed.state.solid = after.state();
    after.restore(changed.state.solid, now.q);
    changed.left = {
        .cells = before.mesh().n_cells() - after.mesh().n_cells(),
        .mass = mass_of(before) - mass_of(after),
        .momentum = momentum_of<Dim>(motion) - momentum_of<Dim>(now),
        .rest_angular_momentum = rest_moment_of(before, motion) - rest_moment_of(after, now),
        .pseudo_angular_momentum = pseudo_moment_of(before, motion) - pseudo_moment_of(after, now),
        .kinetic = kinetic_of(before, motion) - kinetic_of(after, now),
        .potential = before.potential(motion.q) - after.potential(now.q) - (friction_of(after) - friction_of(before))};
    return changed;
}

template Change<2> change<2>(Solid<2>&, const dynamics::IntegratorState&, Solid<2>&, std::span<const std::int32_t>);
template Change<3> change<3>(Solid<3>&, const dynamics::IntegratorState&, Solid<3>&, std::span<const std::int32_t>);

}  // namespace abut::solid
