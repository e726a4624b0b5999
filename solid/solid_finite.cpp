// What bodies of Kinematics::finite need of a solid beside their operators.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"
#include "abut/base/parallel.hpp"
#include "abut/solid/body/bodies.hpp"
#include "abut/solid/bond/bonds.hpp"
#include "abut/solid/part/rank_part.hpp"
#include "abut/solid/solid.hpp"

namespace abut::solid {
namespace {

constexpr double collapsed_determinant = 0.1;  // det F of a cell
constexpr double flat_cells = 0.5;  // a plastic strain by which cells are as flat as their steps may have to be short
constexpr double tiny_displacement = 1e-8;  // of the size of a cell

/// Extremes of deformation of bodies of Kinematics::finite, and how to name the cell.
struct Extremes {
    FiniteExtremes values{};  // the cell in the whole mesh
    std::int64_t label = 0;   // of that cell
    std::size_t body = 0;
};

/// Extremes of all ranks, from those of each.
Extremes of_ranks(const dynamics::Ranks& ranks, const Extremes& here) {
    if (ranks.is_one()) return here;
    const std::vector<double> all = ranks.gather(
        std::vector{here.values.determinant, here.values.strain, static_cast<double>(here.values.cell),
                    static_cast<double>(here.label), static_cast<double>(here.body), here.values.plastic_strain});
    Extremes extremes;
    FiniteExtremes& values = extremes.values;
    for (std::size_t i = 0; i < all.size(); i += 6) {
        values.strain = std::max(values.strain, all[i + 1]);
        values.plastic_strain = std::max(values.plastic_strain, all[i + 5]);
        const double determinant = all[i];
        const auto cell = static_cast<std::int32_t>(all[i + 2]);
        if (cell < 0 || (determinant >= values.determinant && !(determinant == values.determinant && cell < values.cell)))
            continue;
        values.determinant = determinant;
        values.cell = cell;
        extremes.label = static_cast<std::int64_t>(all[i + 3]);
        extremes.body = static_cast<std::size_t>(all[i + 4]);
    }
    return extremes;
}

}  // namespace

/// Gradients of bodies of Kinematics::finite are linear for tiny displacements alone; powers of two cost no digits.
template <int Dim>
void Solid<Dim>::stiffness_of_cells(std::span<const Vector<Dim>> u, std::span<Vector<Dim>> result) {
    const BoundaryLoad<Dim> free = ccg_.load_free();
    const auto apply = [&](std::span<const Vector<Dim>> displacement) {
        bonds_->add_stiffness(
            displacement, free,
            [&](const FaceCorrections<Dim>& corrections) { ccg_.gradient(displacement, free, corrections, result); },
            result);
    };
    if (!bodies_->any_finite()) return apply(u);
    const mesh::Mesh<Dim>& part = bodies_->deformable();
    double largest = 0.0, smallest = std::numeric_limits<double>::infinity();
    for (const std::int32_t c : part_->own_cells())
        largest = larger(largest, u[static_cast<std::size_t>(c)].cwiseAbs().maxCoeff());
    for (const double measure : part.cell_measure) smallest = std::min(smallest, measure);
    largest = ranks().largest(largest);
    smallest = -ranks().largest(-smallest);
    const double size = std::pow(smallest, 1.0 / Dim);
    const double scale = largest > 0.0 ? std::exp2(std::floor(std::log2(tiny_displacement * size / largest))) : 1.0;
    in_frames_.resize(u.size());
    for (std::size_t c = 0; c < u.size(); ++c) in_frames_[c] = scale * u[c];
    apply(in_frames_);
    for (std::size_t c = 0; c < u.size(); ++c) result[c] /= scale;
}

/// Throws for collapsed cells of bodies of Kinematics::finite; the energy does not show them.
template <int Dim>
void Solid<Dim>::require_no_collapse() {
    if (!bodies_->any_finite() && !any_inelastic()) return;
    Extremes now{ccg_.finite_extremes(part_->own_cells())};
    if (now.values.cell >= 0) {
        const std::int32_t cell = bodies_->mesh_cell(now.values.cell);
        now.label = mesh_.cell_label[cell];
        now.body = static_cast<std::size_t>(mesh_.cell_body[cell]);
        // Cells of rigid bodies before it are all here.
        now.values.cell = static_cast<std::int32_t>(part_->cell_numbers()[now.values.cell]) + cell - now.values.cell;
    }
    now = of_ranks(ranks(), now);
    const auto& [determinant, strain, cell, plastic_strain] = now.values;
    finite_extremes_.strain = std::max(finite_extremes_.strain, strain);
    finite_extremes_.plastic_strain = plastic_strain;
    if (cell < 0) return;
    if (!(determinant >= finite_extremes_.determinant)) {
        finite_extremes_.determinant = determinant;
        finite_extremes_.cell = cell;
    }
    if (determinant > collapsed_determinant) return;
    const std::string flat = plastic_strain > flat_cells
                                 ? " Metal that has flowed so far, by a plastic strain of " + number(plastic_strain) +
                                       ", has flat cells, and these need shorter steps: take a lower cfl first."
                                 : "";
    throw Diverged(mesh_.name + ": cell " + std::to_string(now.label) + " of body '" + mesh_.body_names[now.body] +
                       "', of Kinematics::finite, has collapsed: det F is " + number(determinant) + ", more than " +
                       number(collapsed_determinant) +
                       " is needed (0: a free face is stretched too far). Load it less, refine its mesh, or take a shorter "
                       "time step if it is noise that grows, and linear_viscosity = 0.25 with quadratic_viscosity = 2 if it "
                       "is a shock." +
                       flat,
                   {.cell = cell, .value = determinant, .allowed = collapsed_determinant});
}

#define ABUT_INSTANTIATE(Dim)                                                                                    \
    template void Solid<Dim>::stiffness_of_cells(std::span<const Vector<Dim>> u, std::span<Vector<Dim>> result); \
    template void Solid<Dim>::require_no_collapse();
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::solid
