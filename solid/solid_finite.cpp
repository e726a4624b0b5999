// What bodies of Kinematics::finite need of a solid beside their operators.
#include <algorithm>
#include <cmath>
#include <string>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"
#include "abut/base/parallel.hpp"
#include "abut/solid/bodies.hpp"
#include "abut/solid/solid.hpp"

namespace abut::solid {
namespace {

constexpr double least_determinant = 0.1;   // det F of a cell
constexpr double tiny_displacement = 1e-8;  // of the size of a cell

}  // namespace

/// Gradients of bodies of Kinematics::finite are linear for tiny displacements alone; powers of two cost no digits.
template <int Dim>
void Solid<Dim>::stiffness_of_cells(std::span<const Vector<Dim>> u, std::span<Vector<Dim>> result) {
    if (!bodies_->any_finite()) return ccg_.gradient(u, ccg_.load_free(), {}, result);
    const mesh::Mesh<Dim>& part = bodies_->deformable();
    double largest = 0.0;
    for (const Vector<Dim>& of_cell : u) largest = larger(largest, of_cell.cwiseAbs().maxCoeff());
    const double size = std::pow(std::ranges::min(part.cell_measure), 1.0 / Dim);
    const double scale = largest > 0.0 ? std::exp2(std::floor(std::log2(tiny_displacement * size / largest))) : 1.0;
    in_frames_.resize(u.size());
    for (std::size_t c = 0; c < u.size(); ++c) in_frames_[c] = scale * u[c];
    ccg_.gradient(in_frames_, ccg_.load_free(), {}, result);
    for (std::size_t c = 0; c < u.size(); ++c) result[c] /= scale;
}

/// Of bodies of Kinematics::finite; the energy does not show it.
template <int Dim>
void Solid<Dim>::require_no_collapse() {
    if (!bodies_->any_finite()) return;
    FiniteExtremes now = ccg_.finite_extremes();
    finite_extremes_.strain = std::max(finite_extremes_.strain, now.strain);
    if (now.cell < 0) return;
    now.cell = bodies_->mesh_cell(now.cell);
    if (!(now.determinant >= finite_extremes_.determinant)) {
        finite_extremes_.determinant = now.determinant;
        finite_extremes_.cell = now.cell;
    }
    if (now.determinant > least_determinant) return;
    throw Diverged(mesh_.name + ": cell " + std::to_string(mesh_.cell_label[now.cell]) + " of body '" +
                       mesh_.body_names[mesh_.cell_body[now.cell]] + "', of Kinematics::finite, has collapsed: det F is " +
                       number(now.determinant) + ", more than " + number(least_determinant) +
                       " is needed (0: a free face is stretched too far). Load it less, refine its mesh, or take a shorter "
                       "time step if it is noise that grows.",
                   {.cell = now.cell, .value = now.determinant, .allowed = least_determinant});
}

#define ABUT_INSTANTIATE(Dim)                                                                                    \
    template void Solid<Dim>::stiffness_of_cells(std::span<const Vector<Dim>> u, std::span<Vector<Dim>> result); \
    template void Solid<Dim>::require_no_collapse();
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::solid
