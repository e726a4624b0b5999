#pragma once
// Private to the sources of this layer.
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "abut/contact/step.hpp"
#include "abut/contact/surface.hpp"
#include "abut/dynamics/filter.hpp"
#include "abut/solid/ccg/ccg.hpp"
#include "abut/solid/rank_part.hpp"

namespace abut::solid {

/// The contact surface of a solid on several ranks: each has all of its faces, and evaluates those of its own cells. What it
/// evaluates is gathered on all, so that contact is the same everywhere. Constructor and all that gathers are calls of all
/// ranks.
template <int Dim>
class RankFaces {
public:
    struct Face {
        std::int64_t key;
        int owner;
        std::int32_t body;
        double cell_depth, stiffness;
        Vector<Dim> centroid;              // at rest
        std::vector<Vector<Dim>> corners;  // at rest
        std::vector<std::int32_t> cells;   // that move it, by their numbers in the whole mesh
    };

    /// All arguments must outlive it.
    RankFaces(const RankPart<Dim>& part, const mesh::Mesh<Dim>& mesh, const Ccg<Dim>& ccg);

    /// Appends all faces in the order of the whole mesh; and of each the boundary face here, `no_face` if there is none.
    void append_to(contact::Surface<Dim>& surface, std::vector<BoundaryFace>& boundary) const;

    [[nodiscard]] std::span<const Face> faces() const { return faces_; }  ///< in the order of the whole mesh
    /// Of each, the boundary face here; `no_face`: it is on other ranks alone.
    [[nodiscard]] std::span<const BoundaryFace> here() const { return here_; }
    [[nodiscard]] bool is_own(std::size_t face) const { return faces_[face].owner == part_.ranks().rank(); }
    /// Of a cell, by its number in the whole mesh (holds_of_cell).
    [[nodiscard]] std::vector<dynamics::Hold<Dim>> holds_of(std::int32_t cell) const;
    /// Places in a list of faces, in the order in which `gather` brings what their owners give, each in the order of the list.
    [[nodiscard]] std::vector<std::size_t> by_owner(std::span<const std::size_t> faces) const;
    /// A number of each face, from those of the own faces in their order.
    [[nodiscard]] std::vector<double> gather_numbers(std::span<const double> of_own) const;

    /// û of all faces of the surface [m], from that of the boundary faces here.
    void gather_displacement(std::span<const Vector<Dim>> of_boundary, std::span<Vector<Dim>> of_surface) const;

    /// These faces are listed from now on, increasing.
    void set_listed(std::span<const contact::Face> listed);
    /// Those that are evaluated here, increasing.
    [[nodiscard]] std::span<const BoundaryFace> own_listed() const { return own_listed_; }
    /// û [m] and y [N] of all listed faces, from those that are evaluated here.
    void gather_listed(std::span<const Vector<Dim>> own_displacement, std::span<const Vector<Dim>> own_gradient,
                       std::span<Vector<Dim>> displacement, std::span<Vector<Dim>> gradient) const;
    /// Of all listed faces, from that of those which have a boundary face here (`Ccg::coupling`).
    [[nodiscard]] contact::FaceCoupling<Dim> gather_coupling(const contact::FaceCoupling<Dim>& here) const;

private:
    void append_own(const mesh::Mesh<Dim>& mesh, const Ccg<Dim>& ccg, BoundaryFace face, std::int64_t key,
                    std::vector<double>& values) const;
    void take_all(std::span<const double> values);
    void gather_holds(const mesh::Mesh<Dim>& mesh, const Ccg<Dim>& ccg);
    void find_here(const mesh::Mesh<Dim>& mesh);

    const RankPart<Dim>& part_;
    std::vector<Face> faces_;                                          // in the order of the whole mesh
    std::vector<std::pair<std::int32_t, dynamics::Hold<Dim>>> holds_;  // of cells, by their numbers in the whole mesh
    std::vector<BoundaryFace> here_;                                   // of each; none: it is on other ranks alone
    std::vector<std::size_t> all_by_owner_;                            // faces as `gather` brings them: rank after rank
    std::vector<std::size_t> listed_;                                  // in the surface
    std::vector<std::size_t> listed_by_owner_;                         // as `gather` brings them, in the list
    std::vector<BoundaryFace> own_listed_;
};

}  // namespace abut::solid
