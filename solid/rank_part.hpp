#pragma once
// Private to the sources of this layer.
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "abut/base/parallel.hpp"
#include "abut/dynamics/ranks.hpp"
#include "abut/solid/bodies.hpp"
#include "abut/solid/boundary_face.hpp"

namespace abut::solid {

/// What one of several ranks has of a solid. The points of its system are its own cells, then the points of rigid bodies that
/// are its own. Its part has copies beside these: points of the part are the cells that deform there, its own and copies, then
/// the points of all rigid bodies. It turns arrays by own point into arrays by point of the part, and back.
template <int Dim>
class RankPart {
public:
    /// All arguments must outlive it. A call of all ranks.
    RankPart(const dynamics::Ranks& ranks, const Bodies<Dim>& bodies);

    [[nodiscard]] const dynamics::Ranks& ranks() const { return ranks_; }
    /// Among the cells of the part that deform, increasing.
    [[nodiscard]] std::span<const std::int32_t> own_cells() const { return ranks_.positions().first(n_own_cells_); }
    /// Rigid bodies whose points are own ones, increasing.
    [[nodiscard]] std::span<const std::int32_t> own_rigid() const { return own_rigid_; }
    [[nodiscard]] std::int32_t n_all_cells() const { return body_begin_.back(); }  ///< that deform, of all ranks
    /// Own cells of a body, numbered as in Bodies::deformable.
    [[nodiscard]] std::span<const std::int32_t> own_cells_of(std::size_t body) const {
        const auto begin = static_cast<std::size_t>(own_begin_[body]), end = static_cast<std::size_t>(own_begin_[body + 1]);
        return own_cells().subspan(begin, end - begin);
    }
    /// Boundary faces of own cells, increasing: they are boundary faces of the whole mesh, too.
    [[nodiscard]] std::span<const BoundaryFace> own_faces() const { return own_faces_; }
    /// Of these, increasing as their numbers among the boundary faces of the whole mesh do.
    [[nodiscard]] std::span<const std::int64_t> face_keys() const { return face_keys_; }
    /// The key of a boundary face here; another one than that of every boundary face of the whole mesh where the part ends.
    [[nodiscard]] std::int64_t key_of(const mesh::Mesh<Dim>& mesh, BoundaryFace face) const;
    /// Of the face at a position of a cell that deforms.
    [[nodiscard]] std::int64_t key_of(std::int32_t cell, std::ptrdiff_t position) const;
    /// The numbers of the cells here that deform among all that do, increasing (n_cells).
    [[nodiscard]] std::span<const double> cell_numbers() const { return cell_numbers_; }
    /// Values of all boundary faces of the whole mesh, in their order, from those of the boundary faces here. A call of all ranks.
    [[nodiscard]] std::vector<Vector<Dim>> gather_faces(std::span<const Vector<Dim>> of_faces) const;
    /// The other way round, which needs no other rank; 0 for a face that the whole mesh does not have.
    [[nodiscard]] std::vector<Vector<Dim>> faces_here(const mesh::Mesh<Dim>& mesh,
                                                      std::span<const Vector<Dim>> of_all) const;
    [[nodiscard]] std::size_t n_all_faces() const { return all_face_keys_.size(); }  ///< boundary faces of the whole mesh
    /// Where the cells of each body that deforms begin among all that do, one more at the end (n_bodies + 1).
    [[nodiscard]] std::span<const std::int32_t> body_begin() const { return body_begin_; }

    // Of own points, cells first
    [[nodiscard]] std::span<const Vector<Dim>> rest() const { return rest_; }
    [[nodiscard]] std::span<const double> masses() const { return masses_; }
    [[nodiscard]] std::span<const double> inverse_masses() const { return inverse_masses_; }
    [[nodiscard]] std::span<const std::int32_t> body_of_points() const { return body_; }  ///< in the mesh

    // By point of the part, from values of own points: calls of all ranks

    /// From now on only own points, these cells and the points of rigid bodies are filled. A call of all ranks.
    void fill_only(std::span<const std::int32_t> cells);

    /// A state; valid until the next call.
    [[nodiscard]] std::span<const Vector<Dim>> state(std::span<const Vector<Dim>> q) { return fill(q, state_); }
    /// Both ends of a step, valid until the next call; the start is exchanged only where it is not the end of the call before.
    [[nodiscard]] std::pair<std::span<const Vector<Dim>>, std::span<const Vector<Dim>>> step(
        std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1);
    [[nodiscard]] std::vector<Vector<Dim>> filled(std::span<const Vector<Dim>> q) const;
    /// What the owner of each cell here has of it (n_cells).
    [[nodiscard]] std::vector<double> of_owners(std::span<const double> of_cells) const;
    /// The other way round, which needs no other rank.
    [[nodiscard]] std::vector<Vector<Dim>> own(std::span<const Vector<Dim>> of_part) const;

    // Of own rigid bodies; without other ranks

    /// Sets those of their points, by point of the part.
    void spread_rigid(std::span<const Vector<Dim>> of_own, std::vector<Vector<Dim>>& of_part) const;
    void take_rigid(std::span<const Vector<Dim>> of_part, std::span<Vector<Dim>> of_own) const;

    /// To be written by point of the part; `take_result` copies what belongs to own points.
    [[nodiscard]] std::span<Vector<Dim>> result() { return result_; }
    void take_result(std::span<Vector<Dim>> of_own) const;

    // Sums of all ranks, with the bits of one

    /// Of values by cell of the part: `ordered_sum` over all cells.
    template <class Term>
    [[nodiscard]] double sum_of_cells(const Term& term) const {
        const auto own = own_cells();
        return dynamics::sum_over(ranks_, {.last = n_all_cells()}, std::ssize(own), 0.0,
                                  [&](std::ptrdiff_t i) { return term(own[static_cast<std::size_t>(i)]); });
    }
    /// start + term of each boundary face, one after the other.
    template <class Term>
    [[nodiscard]] double fold_faces(double start, const Term& term) const {
        std::vector<double> terms;
        terms.reserve(own_faces_.size());
        for (const BoundaryFace face : own_faces_) terms.push_back(term(face));
        return ranks_.fold(start, face_keys_, terms);
    }
    /// Of values by cell of the part: `ordered_sum` over the cells of a body that deforms.
    template <class Value, class Term>
    [[nodiscard]] Value sum_of_body(std::size_t body, const Value& zero, const Term& term) const {
        const auto own = own_cells_of(body);
        return dynamics::sum_over(ranks_, {.first = body_begin_[body], .last = body_begin_[body + 1]}, std::ssize(own), zero,
                                  [&](std::ptrdiff_t i) { return term(own[static_cast<std::size_t>(i)]); });
    }
    /// Those of the first cell of each body that deforms (n_bodies), from values by cell of the part. A call of all ranks.
    [[nodiscard]] std::vector<Vector<Dim>> of_first_cells(std::span<const Vector<Dim>> of_part) const;
    /// Values of all rigid bodies (n_rigid, width), from those of own ones. A call of all ranks.
    [[nodiscard]] std::vector<double> gather_rigid(std::span<const double> of_own) const;
    /// Whether one rank says yes.
    [[nodiscard]] bool any(bool here) const { return ranks_.largest(here ? 1.0 : 0.0) > 0.0; }

private:
    std::span<const Vector<Dim>> fill(std::span<const Vector<Dim>> q, std::vector<Vector<Dim>>& of_part) const;
    void check(const Bodies<Dim>& bodies) const;
    void set_cell_numbers(const mesh::Mesh<Dim>& mesh);
    void set_body_begin(const mesh::Mesh<Dim>& mesh);
    void find_first_cells();
    void find_own_rigid(const RigidBodies<Dim>& rigid);
    void check_rigid(const Bodies<Dim>& bodies) const;
    void order_faces();
    [[nodiscard]] std::size_t position_of(std::int64_t key) const;

    const dynamics::Ranks& ranks_;
    dynamics::CopySet copies_ = dynamics::CopySet::all;
    std::size_t n_own_cells_ = 0;
    std::vector<double> cell_numbers_;
    std::vector<BoundaryFace> own_faces_;
    std::vector<std::int64_t> face_keys_;
    std::vector<std::int64_t> all_face_keys_;     // of all ranks, increasing
    std::vector<std::size_t> gathered_position_;  // among these, of each face as `gather` brings them
    std::vector<std::int32_t> body_begin_;
    std::vector<std::int32_t> own_begin_;        // among own cells, of each body, one more at the end
    std::vector<std::int32_t> own_first_cells_;  // first cells of bodies that are own ones
    std::vector<std::size_t> gathered_body_;     // as `gather` brings the first cells of all ranks
    std::vector<std::int32_t> own_rigid_;
    std::vector<std::size_t> gathered_rigid_;  // as `gather` brings the rigid bodies of all ranks
    std::vector<Vector<Dim>> rest_;
    std::vector<double> masses_, inverse_masses_;
    std::vector<std::int32_t> body_;
    std::vector<Vector<Dim>> state_, start_, end_, result_;
};

/// Of term(point) over the points [first, second) of a body, as `ordered_sum`; on several ranks (`part` is not null then) over
/// those of all of them, `body` being numbered as in Bodies::deformable.
template <int Dim, class Value, class Term>
[[nodiscard]] Value sum_over_body(const RankPart<Dim>* part, std::ptrdiff_t body,
                                  std::pair<std::int32_t, std::int32_t> points, const Value& zero, const Term& term) {
    if (part) return part->sum_of_body(static_cast<std::size_t>(body), zero, term);
    return ordered_sum(points.second - points.first, zero,
                       [&](std::ptrdiff_t i) { return term(points.first + static_cast<std::int32_t>(i)); });
}

}  // namespace abut::solid
