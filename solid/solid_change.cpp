// What a solid takes over from that of another mesh: by old numbers of cells and faces.
#include <algorithm>
#include <string>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/dynamics/integrator.hpp"
#include "abut/solid/body/bodies.hpp"
#include "abut/solid/bond/bonds.hpp"
#include "abut/solid/contact/contact_driver.hpp"
#include "abut/solid/load/frame_loads.hpp"
#include "abut/solid/load/loads.hpp"
#include "abut/solid/load/outside_loads.hpp"
#include "abut/solid/load/point_loads.hpp"
#include "abut/solid/old_numbers.hpp"
#include "abut/solid/part/body_cells.hpp"
#include "abut/solid/part/rank_part.hpp"
#include "abut/solid/solid.hpp"

namespace abut::solid {
namespace {

constexpr std::int32_t was_not_there = -1;

[[noreturn]] void refuse_change(const std::string& mesh, const std::string& what) { throw BadInput(mesh + ": " + what); }

template <int Dim>
std::string body_in_words(const mesh::Mesh<Dim>& mesh, std::int32_t body) {
    return "body '" + mesh.body_names[static_cast<std::size_t>(body)] + "'";
}

template <int Dim>
void check_bodies(const mesh::Mesh<Dim>& before, const mesh::Mesh<Dim>& after) {
    if (before.body_names != after.body_names)
        refuse_change(after.name, "its bodies are not those of the mesh before, " + before.name +
                                      ". Give the same bodies in the same order; pieces of a body stay one body.");
}

template <int Dim>
std::int32_t size_of_body(const mesh::Mesh<Dim>& mesh, std::int32_t body) {
    const auto [first, last] = cells_of_body(mesh, body);
    return last - first;
}

/// Old numbers of the cells of the bodies that deform, among themselves.
template <int Dim>
std::vector<std::int32_t> old_deformable_cells(const Bodies<Dim>& before, const Bodies<Dim>& after,
                                               std::span<const std::int32_t> old_cells) {
    std::vector<std::int32_t> old;
    for (std::int32_t cell = 0; cell < after.n_cells(); ++cell)
        old.push_back(before.deformable_cell(old_cells[static_cast<std::size_t>(after.mesh_cell(cell))]).first);
    return old;
}

}  // namespace

template <int Dim>
void Solid<Dim>::check_old_cells(const Solid& before, std::span<const std::int32_t> old_cells) const {
    if (std::ssize(old_cells) != mesh_.n_cells())
        throw BadInput(mesh_.name + ": old numbers of " + std::to_string(old_cells.size()) + " cells are given for " +
                           std::to_string(mesh_.n_cells()) + " cells. Give one per cell.",
                       {.value = static_cast<double>(old_cells.size()), .allowed = static_cast<double>(mesh_.n_cells())});
    std::vector<char> is_taken(before.mesh_.cell_measure.size(), 0);
    for (std::int32_t cell = 0; cell < mesh_.n_cells(); ++cell) {
        const std::int32_t old = old_cells[static_cast<std::size_t>(cell)];
        const std::string who =
            mesh_.name + ": cell " + std::to_string(mesh_.cell_label[static_cast<std::size_t>(cell)]) + " ";
        if (old < 0 || old >= before.mesh_.n_cells())
            throw BadInput(who + "is said to have been cell " + std::to_string(old) + ", counted from 0, of " +
                               std::to_string(before.mesh_.n_cells()) +
                               ". New cells are not made: a run goes on with cells that it had.",
                           {.cell = cell});
        if (std::exchange(is_taken[static_cast<std::size_t>(old)], 1) != 0)
            throw BadInput(who + "is said to have been cell " + std::to_string(old) +
                               ", counted from 0, as another cell is. Give each number once.",
                           {.cell = cell});
        const std::int32_t body = mesh_.cell_body[static_cast<std::size_t>(cell)];
        if (before.mesh_.cell_body[static_cast<std::size_t>(old)] != body)
            throw BadInput(who + "of " + body_in_words(mesh_, body) + " was a cell of " +
                               body_in_words(before.mesh_, before.mesh_.cell_body[static_cast<std::size_t>(old)]) +
                               ". Cells stay in their bodies; pieces of a body stay one body.",
                           {.cell = cell});
    }
    for (std::int32_t body = 0; body < mesh_.n_bodies(); ++body) {
        if (bodies_->kinematics(body) != before.bodies_->kinematics(body))
            refuse_change(mesh_.name, body_in_words(mesh_, body) + " is of other kinematics than before. Keep them.");
        const std::int32_t n_before = size_of_body(before.mesh_, body), n_now = size_of_body(mesh_, body);
        if (bodies_->is_rigid(body) && n_now != n_before)
            refuse_change(mesh_.name,
                          body_in_words(mesh_, body) + " is rigid and has lost " + std::to_string(n_before - n_now) +
                              " cells, which is not made. Let it deform (Kinematics::small, ::floating or ::finite).");
    }
}

/// Displacements and momenta in the numbers of this solid. Of bodies that keep all their cells, and of those whose
/// points are the centroids, they are the same.
template <int Dim>
dynamics::IntegratorState Solid<Dim>::motion_of(const Solid& before, const dynamics::IntegratorState& motion,
                                                std::span<const std::int32_t> old_cells) const {
    dynamics::IntegratorState now = motion;
    const std::vector<std::int32_t> old_points = old_deformable_cells(*before.bodies_, *bodies_, old_cells);
    const auto taken = [&](const std::vector<double>& from, std::vector<double>& to, const auto& of_cells,
                           const auto& of_points, const auto& take_rigid) {
        to.assign(size(), 0.0);
        const auto old = as_vectors<Dim>(std::span<const double>(from));
        const auto values = as_vectors<Dim>(std::span<double>(to));
        for (std::size_t i = 0; i < old_points.size(); ++i) values[i] = old[static_cast<std::size_t>(old_points[i])];
        for (std::size_t i = 0; i < bodies_->rigid().size(); ++i) take_rigid(i, old, values);
        std::vector<Vector<Dim>> moved;  // by point, from the centroids of the cells
        for (std::int32_t body = 0; body < mesh_.n_bodies(); ++body) {
            if (!bodies_->turns(body) || size_of_body(mesh_, body) == size_of_body(before.mesh_, body)) continue;
            if (moved.empty()) {
                const std::vector<Vector<Dim>> at_old = of_cells(old);
                std::vector<Vector<Dim>> at_new;
                for (const std::int32_t cell : old_cells) at_new.push_back(at_old[static_cast<std::size_t>(cell)]);
                moved = of_points(std::span<const Vector<Dim>>(at_new));
            }
            const auto [first, last] = bodies_->points_of(body);
            std::copy(moved.begin() + first, moved.begin() + last, values.begin() + first);
        }
    };
    const auto places = [&](std::size_t i, auto old, auto q) {
        bodies_->rigid().take_points(i, before.bodies_->rigid(), old, q);
    };
    const auto momenta = [&](std::size_t i, auto old, auto p) {
        bodies_->rigid().take_momenta(i, before.bodies_->rigid(), old, p);
    };
    const auto displacement = [&](auto old) { return before.bodies_->of_cells(old); };
    const auto velocity = [&](auto old) { return before.bodies_->velocities(old); };
    taken(
        motion.q, now.q, displacement, [&](auto of_cells) { return bodies_->of_points(of_cells); }, places);
    for (const auto of : {&dynamics::IntegratorState::p_before, &dynamics::IntegratorState::p_after})
        taken(
            motion.*of, now.*of, velocity, [&](auto of_cells) { return bodies_->momenta(of_cells); }, momenta);
    return now;
}

template <int Dim>
dynamics::IntegratorState Solid<Dim>::take_over(const Solid& before, const dynamics::IntegratorState& motion,
                                                std::span<const std::int32_t> old_cells) {
    check_bodies(before.mesh_, mesh_);
    check_old_cells(before, old_cells);
    if (levels_ || before.levels_) require({Feature::mesh_change, Feature::local_steps});
    const std::vector<std::int32_t> faces = old_faces(before.mesh_, mesh_, old_cells);
    const std::vector<std::int32_t> boundary = old_boundary_faces(before.mesh_, mesh_, std::span<const std::int32_t>(faces));
    if (contact_) check_corners(before.mesh_, mesh_, std::span<const std::int32_t>(boundary));
    const mesh::Mesh<Dim>&deformable = bodies_->deformable(), &old_deformable = before.bodies_->deformable();
    const std::vector<std::int32_t> cells = old_deformable_cells(*before.bodies_, *bodies_, old_cells);
    const std::vector<std::int32_t> cell_faces = old_faces(old_deformable, deformable, std::span<const std::int32_t>(cells));
    const std::vector<std::int32_t> cell_boundary =
        old_boundary_faces(old_deformable, deformable, std::span<const std::int32_t>(cell_faces));

    time_ = before.time_;
    work_ = before.work_;
    evaluations_ = before.evaluations_;
    dissipated_ = before.dissipated_;
    finite_extremes_ = before.finite_extremes_;
    if (const auto at = std::ranges::find(old_cells, finite_extremes_.cell); finite_extremes_.cell >= 0)
        finite_extremes_.cell = at == old_cells.end() ? was_not_there : static_cast<std::int32_t>(at - old_cells.begin());
    outside_->take_over(*before.outside_, faces);
    loads_->take_over(*before.loads_, cell_boundary, time_);
    if (frame_loads_->any()) frame_loads_->take(loads_->end());
    point_loads_->take_over(*before.point_loads_);
    bodies_->rigid().take_over(before.bodies_->rigid());
    ccg_.take_memory(before.ccg_, cells, cell_faces);
    bonds_->take_over(*before.bonds_, boundary);
    unite_frames();
    if ((contact_ != nullptr) != (before.contact_ != nullptr) ||
        (contact_ && contact_->contact().index() != before.contact_->contact().index()))
        refuse_change(mesh_.name, "contact is by another law than before, or by none. Keep the law of contact.");
    if (contact_) {
        contact_->take_over(*before.contact_, boundary);
        contact_->restore_impulses({before.contact_->impulses().begin(), before.contact_->impulses().end()});
    }
    return motion_of(before, motion, old_cells);
}

#define ABUT_INSTANTIATE(Dim)                                                                                \
    template dynamics::IntegratorState Solid<Dim>::take_over(const Solid&, const dynamics::IntegratorState&, \
                                                             std::span<const std::int32_t>);                 \
    template void Solid<Dim>::check_old_cells(const Solid&, std::span<const std::int32_t>) const;            \
    template dynamics::IntegratorState Solid<Dim>::motion_of(const Solid&, const dynamics::IntegratorState&, \
                                                             std::span<const std::int32_t>) const;
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::solid
