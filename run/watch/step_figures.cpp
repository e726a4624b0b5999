#include "abut/run/watch/step_figures.hpp"

#include <algorithm>

#include "abut/base/parallel.hpp"
#include "abut/dynamics/ledger.hpp"
#include "abut/dynamics/sum_over.hpp"
#include "abut/run/body_names.hpp"
#include "abut/solid/contact_view.hpp"
#include "abut/solid/solid.hpp"

namespace abut::run {

template <int Dim>
double largest_speed(const dynamics::RunView<Dim>& run, const solid::Solid<Dim>& solid) {
    const auto mass = solid.masses();
    return solid.ranks().largest(
        largest(std::ssize(mass), [&](std::ptrdiff_t i) { return run.momentum(i).norm() / mass[i]; }));
}

template <int Dim>
Vector<Dim> momentum_from_outside(double time, std::int32_t n_bodies, const solid::Solid<Dim>& solid) {
    Vector<Dim> given = Vector<Dim>::Zero();
    for (const solid::BodyImpulse<Dim>& pair : solid.contact().impulses())
        if (pair.body_1 < n_bodies && pair.body_2 >= n_bodies) given -= pair.impulse;
    const auto& acceleration = solid.options().acceleration;
    if (acceleration.empty()) return given;
    const auto mass = solid.masses();
    const auto body = solid.body_of_points();
    const auto weight_of = [&](std::ptrdiff_t i) -> Vector<Dim> {
        return mass[i] * acceleration[static_cast<std::size_t>(body[i])];
    };
    const Vector<Dim> zero = Vector<Dim>::Zero();
    const Vector<Dim> weight = dynamics::sum_over(solid.ranks(), {}, std::ssize(mass), zero, weight_of);
    return given + time * weight;
}

template <int Dim>
Compressed most_compressed(const Scene<Dim>& scene, const solid::Solid<Dim>& solid) {
    Compressed most;
    for (const solid::BodyImpulse<Dim>& pair : solid.contact().impulses()) {
        if (!(pair.compression > most.compression)) continue;
        most.compression = pair.compression;
        most.steps = pair.compressed_steps;
        most.body_1 = quoted_name(scene, pair.body_1);
        most.body_2 = quoted_name(scene, pair.body_2);
    }
    return most;
}

#define ABUT_INSTANTIATE(Dim)                                                                        \
    template double largest_speed<Dim>(const dynamics::RunView<Dim>&, const solid::Solid<Dim>&);     \
    template Vector<Dim> momentum_from_outside<Dim>(double, std::int32_t, const solid::Solid<Dim>&); \
    template Compressed most_compressed<Dim>(const Scene<Dim>&, const solid::Solid<Dim>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::run
