#pragma once
// Private to the sources of this layer.
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "abut/base/parallel.hpp"
#include "abut/dynamics/ranks.hpp"
#include "abut/dynamics/sum_over.hpp"
#include "abut/solid/boundary/boundary_face.hpp"
#include "abut/solid/part/solid_points.hpp"

namespace abut::solid {

/// Part of a solid that a rank has. The points of its system are its own cells, then the points of rigid bodies that
/// are its own. The part has copies beside these: points of the part are the cells that deform there, its own and
/// copies, then the points of all rigid bodies. It turns arrays by own point into arrays by point of the part, and
/// back; on one rank both are the same array.
template <int Dim>
class RankPart {
public:
    /// All arguments must outlive it. A call of all ranks.
    RankPart(const dynamics::Ranks& ranks, const SolidPoints<Dim>& points);
    RankPart(const RankPart&) = delete;
    RankPart& operator=(const RankPart&) = delete;

    /// Reads positions at rest again: Bodies::place_cell_points has changed them.
    void take_rest(std::span<const Vector<Dim>> rest);

    /// Ranks that it was made with; of one alone, with the points of this solid.
    [[nodiscard]] const dynamics::Ranks& ranks() const { return ranks_; }
    /// Whether it is all of the solid, on the only rank: every point is where its number says.
    [[nodiscard]] bool is_whole() const { return is_whole_; }
    /// Among the cells of the part that deform, increasing.
    [[nodiscard]] std::span<const std::int32_t> own_cells() const { return own_cells_; }
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
    /// Keys of these, increasing as their numbers among the boundary faces of the whole mesh do.
    [[nodiscard]] std::span<const std::int64_t> face_keys() const { return face_keys_; }
    /// The key of a boundary face here; another one than that of every boundary face of the whole mesh where the part ends.
    [[nodiscard]] std::int64_t key_of(const mesh::Mesh<Dim>& mesh, BoundaryFace face) const;
    /// Key of the face at a position of a cell that deforms.
    [[nodiscard]] std::int64_t key_of(std::int32_t cell, std::ptrdiff_t position) const;
    /// The number of a boundary face of the whole mesh among all of them, from its key; `n_all_faces` of another one.
    [[nodiscard]] std::size_t face_number(std::int64_t key) const;
    /// Boundary face here for each one of the whole mesh, `no_face` where it is on other ranks alone (n_all_faces).
    [[nodiscard]] std::vector<BoundaryFace> faces_by_number(const mesh::Mesh<Dim>& mesh) const;
    /// The numbers of the cells here that deform among all that do, increasing (n_cells).
    [[nodiscard]] std::span<const double> cell_numbers() const { return cell_numbers_; }
    /// Point of the part with this number among all points; it must be here, as all those of rigid bodies are.
    [[nodiscard]] std::int32_t position_of(std::int32_t number) const;
    /// Values of all boundary faces of the whole mesh, in their order, from those of the boundary faces here. A call of
    /// all ranks.
    [[nodiscard]] std::vector<Vector<Dim>> gather_faces(std::span<const Vector<Dim>> of_faces) const;
    /// The other way round, which needs no other rank; 0 for a face that the whole mesh does not have.
    [[nodiscard]] std::vector<Vector<Dim>> faces_here(const mesh::Mesh<Dim>& mesh,
                                                      std::span<const Vector<Dim>> of_all) const;
    [[nodiscard]] std::size_t n_all_faces() const { return all_face_keys_.size(); }  ///< boundary faces of the whole mesh
    /// Begin of the cells of each body that deforms among all that do, one more at the end (n_bodies + 1).
    [[nodiscard]] std::span<const std::int32_t> body_begin() const { return body_begin_; }

    // Of own points, cells first
    [[nodiscard]] std::span<const Vector<Dim>> rest() const { return rest_; }
    [[nodiscard]] std::span<const double> masses() const { return masses_; }
    [[nodiscard]] std::span<const double> inverse_masses() const { return inverse_masses_; }
    [[nodiscard]] std::span<const std::int32_t> body_of_points() const { return body_; }  ///< in the mesh

    // By point of the part, from values of own points: calls of all ranks. On one rank nothing is copied.

    /// From now on only own points, these cells and the points of rigid bodies are filled. A call of all ranks.
    void fill_only(std::span<const std::int32_t> cells);

    /// A state; valid until the next call.
    [[nodiscard]] std::span<const Vector<Dim>> state(std::span<const Vector<Dim>> q) { return filled(q, state_); }
    /// Both ends of a step, valid until the next call; the start is exchanged only where it is not the end of the call
    /// before.
    [[nodiscard]] std::pair<std::span<const Vector<Dim>>, std::span<const Vector<Dim>>> step(
        std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1);
    /// Any values, in `kept` or, on one rank, in q itself.
    [[nodiscard]] std::span<const Vector<Dim>> filled(std::span<const Vector<Dim>> q, std::vector<Vector<Dim>>& kept) const;
    /// Value that the owner of each cell here has for it (n_cells).
    [[nodiscard]] std::vector<double> of_owners(std::span<const double> of_cells) const;
    /// The other way round, which needs no other rank.
    [[nodiscard]] std::vector<Vector<Dim>> own(std::span<const Vector<Dim>> of_part) const;

    // Of own rigid bodies; without other ranks

    /// Calls constrain(q, p) with values by point of the part, of which those of own rigid bodies are set, and takes
    /// their p back. A call of all ranks.
    template <class Constrain>
    void constrain_rigid(std::span<const Vector<Dim>> q, std::span<Vector<Dim>> p, const Constrain& constrain) {
        if (is_whole_) return constrain(q, p);
        spread_rigid(q, rigid_q_);
        spread_rigid(p, rigid_p_);
        dynamics::agreed(ranks_,
                         [&] { constrain(std::span<const Vector<Dim>>(rigid_q_), std::span<Vector<Dim>>(rigid_p_)); });
        take_rigid(rigid_p_, p);
    }

    /// To be written by point of the part; `take_result` then copies what belongs to own points. On one rank `of_own`
    /// itself.
    [[nodiscard]] std::span<Vector<Dim>> result(std::span<Vector<Dim>> of_own) {
        return is_whole_ ? of_own : std::span<Vector<Dim>>(result_);
    }
    void take_result(std::span<Vector<Dim>> of_own) const;

    // Sums of all ranks, with the bits of one

    /// Sum of values by cell of the part: `ordered_sum` over all cells.
    template <class Term>
    [[nodiscard]] double sum_of_cells(const Term& term) const {
        return sum_of({.first = 0, .last = n_all_cells()}, own_cells(), 0.0, term);
    }
    /// start + term of each boundary face, one after the other.
    template <class Term>
    [[nodiscard]] double fold_faces(double start, const Term& term) const {
        if (is_whole_) {
            for (const BoundaryFace face : own_faces_) start += term(face);
            return start;
        }
        std::vector<double> terms;
        terms.reserve(own_faces_.size());
        for (const BoundaryFace face : own_faces_) terms.push_back(term(face));
        return ranks_.fold(start, face_keys_, terms);
    }
    /// Sum of values by cell of the part: `ordered_sum` over the cells of a body that deforms.
    template <class Value, class Term>
    [[nodiscard]] Value sum_of_body(std::size_t body, const Value& zero, const Term& term) const {
        return sum_of({.first = body_begin_[body], .last = body_begin_[body + 1]}, own_cells_of(body), zero, term);
    }
    /// Calls of_cell(cell) for the own cells of a body that deforms, concurrently.
    template <class OfCell>
    void each_cell_of_body(std::size_t body, const OfCell& of_cell) const {
        const auto own = own_cells_of(body);
        const std::ptrdiff_t begin = body_begin_[body];
        if (is_whole_) return parallel_each(std::ssize(own), [&](std::ptrdiff_t i) { of_cell(begin + i); });
        parallel_each(std::ssize(own), [&](std::ptrdiff_t i) { of_cell(own[static_cast<std::size_t>(i)]); });
    }
    /// Values of the first cell of each body that deforms (n_bodies), from values by cell of the part. A call of all ranks.
    [[nodiscard]] std::vector<Vector<Dim>> of_first_cells(std::span<const Vector<Dim>> of_part) const;
    /// Values of all rigid bodies (n_rigid, width), from those of own ones. A call of all ranks.
    [[nodiscard]] std::vector<double> gather_rigid(std::span<const double> of_own) const;
    /// Whether one rank says yes.
    [[nodiscard]] bool any(bool here) const { return ranks_.largest(here ? 1.0 : 0.0) > 0.0; }

private:
    /// Sum over the own ones among cells, which have these numbers. On one rank these are the cells: nothing is looked up.
    template <class Value, class Term>
    [[nodiscard]] Value sum_of(const dynamics::Summands& numbers, std::span<const std::int32_t> own, const Value& zero,
                               const Term& term) const {
        if (is_whole_)
            return ordered_sum(std::ssize(own), zero,
                               [&](std::ptrdiff_t i) { return term(numbers.first + static_cast<std::int32_t>(i)); });
        return dynamics::sum_over(ranks_, numbers, std::ssize(own), zero,
                                  [&](std::ptrdiff_t i) { return term(own[static_cast<std::size_t>(i)]); });
    }
    void fill(std::span<const Vector<Dim>> q, std::vector<Vector<Dim>>& of_part) const;
    void spread_rigid(std::span<const Vector<Dim>> of_own, std::vector<Vector<Dim>>& of_part) const;
    void take_rigid(std::span<const Vector<Dim>> of_part, std::span<Vector<Dim>> of_own) const;
    void take_points(const SolidPoints<Dim>& points);
    void check(const SolidPoints<Dim>& points) const;
    void set_cell_numbers(const mesh::Mesh<Dim>& mesh);
    void set_body_begin(const mesh::Mesh<Dim>& mesh);
    void find_first_cells();
    void find_own_rigid(std::span<const std::int32_t> first_points);
    void check_rigid(const SolidPoints<Dim>& points) const;
    void order_faces();

    bool is_whole_;
    dynamics::OneRank one_;  // of a whole: it numbers the points
    const dynamics::Ranks& ranks_;
    std::size_t n_points_;  // of the part
    std::span<const std::int32_t> own_cells_;
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
    std::span<const Vector<Dim>> rest_;        // of own points, as below; of a whole those of the bodies
    std::span<const double> masses_, inverse_masses_;
    std::span<const std::int32_t> body_;
    std::vector<Vector<Dim>> rest_here_;
    std::vector<double> masses_here_, inverse_masses_here_;
    std::vector<std::int32_t> body_here_;
    std::vector<Vector<Dim>> state_, start_, end_, result_, rigid_q_, rigid_p_;  // none of a whole
};

}  // namespace abut::solid
