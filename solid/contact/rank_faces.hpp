#pragma once
// Private to the sources of this layer.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "abut/contact/sharing.hpp"
#include "abut/contact/step.hpp"
#include "abut/contact/surface/surface.hpp"
#include "abut/dynamics/filter.hpp"
#include "abut/solid/ccg/ccg.hpp"
#include "abut/solid/part/rank_part.hpp"

namespace abut::solid {

/// The faces of bodies that deform, as contact has them: each rank has all of them in the order of the whole mesh, and
/// evaluates those of its own cells. What it evaluates is brought to all, so that contact is the same everywhere. On
/// one rank all are its own, and there is nothing to bring. What says that it brings something is a call of all ranks.
template <int Dim>
class SharedFaces {
public:
    /// A face as it is at rest.
    struct Rest {
        std::int32_t body;
        double depth, stiffness;
        std::vector<Vector<Dim>> corners;
    };

    SharedFaces() = default;
    SharedFaces(const SharedFaces&) = delete;
    SharedFaces& operator=(const SharedFaces&) = delete;
    virtual ~SharedFaces() = default;

    [[nodiscard]] std::size_t size() const { return here_.size(); }
    /// Boundary face here of each; `no_face`: it is on other ranks alone.
    [[nodiscard]] std::span<const BoundaryFace> here() const { return here_; }
    [[nodiscard]] virtual Rest rest(std::size_t face) const = 0;
    [[nodiscard]] virtual Vector<Dim> centroid(std::size_t face) const = 0;  ///< at rest
    /// Cells that move the face, by their numbers in the whole mesh.
    [[nodiscard]] virtual std::span<const std::int32_t> cells_of(std::size_t face) const = 0;
    /// Holds of a cell, by its number in the whole mesh (holds_of_cell); nothing holds a point of a rigid body.
    [[nodiscard]] virtual std::vector<dynamics::Hold<Dim>> holds_of(std::int32_t point) const = 0;
    [[nodiscard]] virtual bool is_own(std::size_t face) const = 0;
    /// Who shares the work of contact; null: nobody does.
    [[nodiscard]] virtual contact::Sharing* sharing() = 0;

    /// Brings a number of each face, from those of the own faces in their order.
    [[nodiscard]] virtual std::vector<double> numbers_of_all(std::span<const double> of_own) const = 0;
    /// Places in a list of faces, in the order in which owners bring what they have, each in the order of the list;
    /// empty where nobody brings anything.
    [[nodiscard]] virtual std::vector<std::size_t> as_brought(std::span<const std::size_t> faces) const = 0;
    /// Brings û of all faces of the surface [m], from that of the boundary faces here.
    virtual void bring_displacement(std::span<const Vector<Dim>> of_boundary, std::span<Vector<Dim>> of_surface) const = 0;

    /// These faces are listed from now on, increasing.
    virtual void set_listed(std::span<const contact::Face> listed) = 0;
    /// Listed faces that are evaluated here, increasing.
    [[nodiscard]] std::span<const BoundaryFace> own_listed() const { return own_listed_; }
    /// Evaluates û [m] and y [N] of those in q and brings them to all; `region` is that of `own_listed`.
    virtual void evaluate_listed(Ccg<Dim>& ccg, const Region<Dim>& region, std::span<const Vector<Dim>> q,
                                 const BoundaryLoad<Dim>& load, std::span<Vector<Dim>> displacement,
                                 std::span<Vector<Dim>> gradient) = 0;
    /// Brings that of all listed faces, from that of those which have a boundary face here (`Ccg::coupling`).
    [[nodiscard]] virtual contact::FaceCoupling<Dim> coupling_of_all(contact::FaceCoupling<Dim> here) const = 0;

protected:
    std::vector<BoundaryFace> here_;
    std::vector<BoundaryFace> own_listed_;
};

/// Shared faces of this part. All arguments must outlive them.
template <int Dim>
[[nodiscard]] std::unique_ptr<SharedFaces<Dim>> shared_faces(const RankPart<Dim>& part, const mesh::Mesh<Dim>& mesh,
                                                             const Ccg<Dim>& ccg);

}  // namespace abut::solid
