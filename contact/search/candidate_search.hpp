#pragma once
#include <cstdint>
#include <memory>
#include <span>

#include "abut/base/strided_points.hpp"
#include "abut/contact/options.hpp"
#include "abut/contact/report.hpp"
#include "abut/contact/sharing.hpp"
#include "abut/contact/surface/surface.hpp"
#include "abut/geometry/broad_phase/broad_phase.hpp"

namespace abut::contact {

/// Points between which a host measures the gap of a pair of faces, along the normal of the pair.
enum class GapOf {
    overlap,    ///< over points that both faces cover: it is the distance of two points of the faces
    centroids,  ///< between the two centroids, as `Overlap::gap`: faces that are tilted can be farther apart than it
};

/// The pairs of faces that can touch: a list over any number of surfaces, that lives for many steps. docs/detection.md.
///
/// Each step the host asks `is_valid_for` with an upper bound on the motion since the last search, and searches again if
/// need be: with `search` where faces translate, with `search_moved` where they turn or deform. The faces of a body are kept
/// in a spatial order from one search to the next, so that the packed tree is built in one sweep over them.
template <int Dim>
class CandidateSearch {
public:
    /// Keeps the view: the host's arrays must outlive it, and stay as they are: bodies at rest. `sharing` must outlive
    /// it, too; null: nobody shares the work. Throws BadInput naming what is wrong: a surface that `check` refuses, or
    /// an option out of range.
    explicit CandidateSearch(SurfaceView<Dim> surface, const CandidateOptions& options = {}, Sharing* sharing = nullptr);
    ~CandidateSearch();
    CandidateSearch(CandidateSearch&&) noexcept;
    CandidateSearch& operator=(CandidateSearch&&) noexcept;

    /// Whether the list is still a superset of all pairs in question, when no corner has moved by more than `motion` [m]
    /// from where the path of the search began. After `search` no face may have turned either: normals have decided which
    /// faces look at each other and where a gap lies, and no skin allows for a change of them; after `search_moved` faces
    /// turn and deform as they like. False before the first search, and after one that failed.
    [[nodiscard]] bool is_valid_for(double motion) const;

    /// Rebuilds the list for a step along straight lines from u_0 to u_1, the displacements of all faces (n) [m]: every pair
    /// of facing faces (face_1 < face_2) that can be in contact, or come as near as `distance`, on that path and as long as
    /// no face has moved by more than half the skin from u_0. Without a condition on facing (facing_cosine = 1) it is every
    /// pair of faces, whatever their normals, that can come as near as `distance` in space. Rigid faces never pair. Throws
    /// Diverged naming the face if a displacement is not finite, or a face moves farther within the step than
    /// `largest_motion` allows: the run has diverged. geometry::SearchLimitError if there are too many pairs, or too little
    /// memory is allowed; BadInput for arrays of the wrong size. The list is empty then.
    void search(std::span<const Vector<Dim>> u_0, std::span<const Vector<Dim>> u_1);

    /// Rebuilds the list for faces that turn and deform: for a step in which the vertices (n_vertices) move along straight
    /// lines from x_0 to x_1 [m], all of them from wherever they were at rest. It holds every pair that at any time on that
    /// path, or while no vertex is farther than half the skin from x_0, is seen to overlap along any direction with a gap
    /// |g| <= distance + 2 (d_1 + d_2), 2 (d_1 + d_2) being what contact allows; g is that over points that both faces
    /// cover. With GapOf::centroids it is every pair that faces each other (facing_cosine) and whose centroids are so far
    /// apart along its normal. With facing_cosine = 1 it is every pair that comes as near as `distance` in space. Boxes
    /// around the vertices at x_0 and x_1 decide, normals play no part: of pairs whose boxes overlap all are listed,
    /// whichever way they look, and `is_valid_for` allows for turns. Surfaces are as flat as the host keeps them: a
    /// polygon is all points between its corners. Neighbours, rigid faces and errors as `search`, Diverged names the
    /// vertex too, and the extent that limits its motion is that at rest. Vertices that no face names may hold
    /// anything. `within`: which pairs of faces of one body are wanted; asked from several threads at once, empty: all.
    /// `left_out`: not 0 for faces that are in no pair (n), looked at during the call alone; empty: all may be.
    void search_moved(PointsView<Dim> x_0, PointsView<Dim> x_1, GapOf gap = GapOf::overlap,
                      const geometry::PairFilter& within = {}, std::span<const char> left_out = {});

    /// The list: face_1 < face_2, sorted, each once. The same for every broad phase and any number of threads and parts.
    [[nodiscard]] std::span<const geometry::IndexPair> candidates() const;
    [[nodiscard]] double skin() const;  ///< of the current list [m]; before the first search, of the first one
    /// The skin of the next list [m]: all that a search learns from its lists.
    [[nodiscard]] double next_skin() const;
    /// Continues with a skin that another search had come to, of the same surface and options. Throws BadInput unless it is
    /// finite and >= 0.
    void restore_skin(double skin);
    [[nodiscard]] const CandidateReport& report() const;

private:
    class Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace abut::contact
