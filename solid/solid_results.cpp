// What a solid tells of its points and bodies.
#include <algorithm>
#include <vector>

#include "abut/base/rotation.hpp"
#include "abut/dynamics/ledger.hpp"
#include "abut/solid/body/bodies.hpp"
#include "abut/solid/body/body_rotation.hpp"
#include "abut/solid/bond_view.hpp"
#include "abut/solid/cell_view.hpp"
#include "abut/solid/contact/contact_driver.hpp"
#include "abut/solid/contact_view.hpp"
#include "abut/solid/load/outside_loads.hpp"
#include "abut/solid/outside_view.hpp"
#include "abut/solid/part/rank_part.hpp"
#include "abut/solid/solid.hpp"

namespace abut::solid {
namespace {

constexpr double contact_margin = 0.85;  // of 2/omega_max

}  // namespace

template <int Dim>
std::span<const double> Solid<Dim>::inverse_mass() const {
    return part_->inverse_masses();
}

template <int Dim>
std::span<const double> Solid<Dim>::masses() const {
    return part_->masses();
}

template <int Dim>
std::span<const Vector<Dim>> Solid<Dim>::rest_positions() const {
    return part_->rest();
}

template <int Dim>
std::span<const std::int32_t> Solid<Dim>::body_of_points() const {
    return part_->body_of_points();
}

template <int Dim>
std::vector<double> Solid<Dim>::rotations(std::span<const double> q) const {
    const auto u = as_vectors<Dim>(q);
    std::vector<Vector<Dim>> kept;
    const auto of_part = bodies_->any_rigid() ? part_->filled(u, kept) : u;
    return bodies_->of_bodies(rotation_->angles(u), [&](std::size_t rigid) {
        return rotation_angle<Dim>(nearest_rotation(bodies_->rigid().place(rigid, of_part).map));
    });
}

template <int Dim>
std::vector<double> Solid<Dim>::local_rotations(std::span<const double> q) {
    static_cast<void>(potential(q));  // leaves the displacement gradients of this state behind
    const mesh::Mesh<Dim>& part = bodies_->deformable();
    std::vector<double> largest(static_cast<std::size_t>(part.n_bodies()), 0.0);
    for (const std::int32_t c : part_->own_cells()) {
        if (bodies_->is_finite(bodies_->body_of_points()[static_cast<std::size_t>(c)])) continue;
        double& of_body = largest[static_cast<std::size_t>(part.cell_body[c])];
        of_body = larger(of_body, 0.5 * axial<Dim>(ccg_.displacement_gradient(c)).norm());
    }
    for (double& of_body : largest) of_body = ranks().largest(of_body);
    return bodies_->of_bodies(largest, [](std::size_t) { return 0.0; });
}

template <int Dim>
std::vector<dynamics::ContactPatch<Dim>> Solid<Dim>::contact_patches() const {
    return contact_ ? contact_->patches() : std::vector<dynamics::ContactPatch<Dim>>{};
}

template <int Dim>
ContactState<Dim> Solid<Dim>::contact_at(std::span<const double> q) {
    if (contact_) {
        const auto u = state_here(q);
        frames_->stand_at(of_cells(u));
        contact_->evaluate(u, time_);
    }
    return ContactState<Dim>(*this);
}

template <int Dim>
dynamics::ContactCounts Solid<Dim>::contact_counts() const {
    const contact::ContactReport report = contact().report();
    dynamics::ContactCounts counts{.active_pairs = report.active_pairs, .events = report.events};
    if (contact_) {
        const contact::FrictionFigures& friction = contact_->friction();
        counts.dissipated = report.friction_dissipated;
        counts.friction_energy = friction.energy;
        counts.sticking_faces = report.sticking_faces;
        counts.sliding_faces = report.sliding_faces;
    }
    return counts;
}

template <int Dim>
ContactView<Dim> Solid<Dim>::contact() const {
    return ContactView<Dim>(*this);
}

template <int Dim>
BondView<Dim> Solid<Dim>::bonds() const {
    return BondView<Dim>(*this);
}

template <int Dim>
CellView<Dim> Solid<Dim>::cells() const {
    return CellView<Dim>(*this);
}

template <int Dim>
OutsideView<Dim> Solid<Dim>::outside(const std::string& group) const {
    return OutsideView<Dim>(*this, group);
}

template <int Dim>
void Solid<Dim>::set_traction(const std::string& group, std::span<const Vector<Dim>> traction) {
    outside_->set_traction(group, traction);
}

template <int Dim>
OutsideWork Solid<Dim>::outside_work(std::span<const double> q) const {
    std::vector<Vector<Dim>> of_part;
    return outside_->work(part_->filled(as_vectors<Dim>(q), of_part));
}

template <int Dim>
dynamics::MomentArms Solid<Dim>::moment_arms() const {
    return bodies_->any_turns() ? dynamics::MomentArms::mid_step : dynamics::MomentArms::rest;
}

template <int Dim>
double Solid<Dim>::step_margin() const {
    double margin = contact_ ? contact_margin : 1.0;
    for (std::int32_t body = 0; body < mesh_.n_bodies(); ++body)
        margin = std::min(margin, bodies_->properties(body).step_margin);
    return margin;
}

template <int Dim>
double Solid<Dim>::damping_ratio(double omega) const {
    return ranks().largest(ccg_.damping_ratio(omega));
}

#define ABUT_INSTANTIATE(Dim)                                                                                \
    template std::span<const double> Solid<Dim>::inverse_mass() const;                                       \
    template std::span<const double> Solid<Dim>::masses() const;                                             \
    template std::span<const Vector<Dim>> Solid<Dim>::rest_positions() const;                                \
    template std::span<const std::int32_t> Solid<Dim>::body_of_points() const;                               \
    template std::vector<double> Solid<Dim>::rotations(std::span<const double> q) const;                     \
    template std::vector<double> Solid<Dim>::local_rotations(std::span<const double> q);                     \
    template std::vector<dynamics::ContactPatch<Dim>> Solid<Dim>::contact_patches() const;                   \
    template ContactState<Dim> Solid<Dim>::contact_at(std::span<const double> q);                            \
    template dynamics::ContactCounts Solid<Dim>::contact_counts() const;                                     \
    template ContactView<Dim> Solid<Dim>::contact() const;                                                   \
    template BondView<Dim> Solid<Dim>::bonds() const;                                                        \
    template CellView<Dim> Solid<Dim>::cells() const;                                                        \
    template OutsideView<Dim> Solid<Dim>::outside(const std::string& group) const;                           \
    template void Solid<Dim>::set_traction(const std::string& group, std::span<const Vector<Dim>> traction); \
    template OutsideWork Solid<Dim>::outside_work(std::span<const double> q) const;                          \
    template dynamics::MomentArms Solid<Dim>::moment_arms() const;                                           \
    template double Solid<Dim>::step_margin() const;                                                         \
    template double Solid<Dim>::damping_ratio(double omega) const;
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::solid
