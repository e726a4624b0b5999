#pragma once
#include <cstdint>
#include <vector>

#include "abut/base/vector.hpp"
#include "abut/run/values/forward.hpp"
#include "abut/run/values/moment.hpp"
#include "abut/solid/contact/contact_results.hpp"

namespace abut::run {

/// All bodies in one state of a run, as files and pictures show them: cells and faces are those of `mesh`, whichever ranks
/// they are on. It is valid while whoever gets it is called.
template <int Dim>
struct Sight {
    Moment<Dim> moment;
    const mesh::Mesh<Dim>* mesh = nullptr;              ///< of the scene, or of what is left of it
    const solid::SolidOptions<Dim>* options = nullptr;  ///< of the solid
    bool any_turns = false;  ///< a body may turn: cells do not take vertices along by their displacement alone

    std::vector<Vector<Dim>> displacement;           ///< of the cells (n_cells) [m]
    std::vector<Vector<Dim>> velocity;               ///< (n_cells) [m/s], of p = (p^- + p^+)/2
    std::vector<Matrix<Dim>> displacement_gradient;  ///< CellView::displacement_gradient (n_cells) [-]
    std::vector<Matrix<Dim>> stress;                 ///< (n_cells) [Pa]
    std::vector<double> out_of_plane_stress;         ///< CellView::out_of_plane_stress (n_cells) [Pa]
    std::vector<double> plastic_strain;              ///< (n_cells) [-]; empty where no material has one
    std::vector<double> fragment;                    ///< fragment_of_cells (n_cells); empty where no bond may break

    solid::ContactField contact;                ///< by boundary face
    std::vector<double> bond;                   ///< left_of_bonds (n_boundary); empty without bonds
    std::vector<solid::ActingPair<Dim>> pairs;  ///< that push each other

    /// Displacement of the vertices (n_vertices) [m]: CellView::vertex_displacement; 0 where there are no gradients.
    [[nodiscard]] std::vector<Vector<Dim>> vertex_displacement() const;
};

/// Evaluations that a solid needs before it is seen.
enum class Evaluated : std::uint8_t {
    no,          ///< it is evaluated in this state
    yes,         ///< it was evaluated last in this state; contact is evaluated, and leaves other stresses behind
    cells_alone  ///< nothing is evaluated: faces are where contact has moved them last; no contact, bonds and pairs
};

/// Bodies at the node of `run`, on rank 0; without values on the others. A call of all ranks. `whole`, the mesh of the
/// cells of all ranks, is looked at on rank 0 alone. `Evaluated::no` leaves the solid evaluated in this state.
template <int Dim>
[[nodiscard]] Sight<Dim> sight_of(const dynamics::RunView<Dim>& run, solid::Solid<Dim>& solid, const mesh::Mesh<Dim>& whole,
                                  Evaluated evaluated = Evaluated::no);
/// Bodies at the node of `run`, on one rank.
template <int Dim>
[[nodiscard]] Sight<Dim> sight_of(const dynamics::RunView<Dim>& run, solid::Solid<Dim>& solid);

}  // namespace abut::run
