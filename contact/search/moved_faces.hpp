#pragma once
// Private to the layer.
#include <cstdint>
#include <string>

#include "abut/base/strided_points.hpp"
#include "abut/contact/search/candidate_search.hpp"
#include "abut/contact/search/face_boxes.hpp"
#include "abut/contact/search/face_order.hpp"
#include "abut/contact/search/pair_filter.hpp"

namespace abut::contact {

/// The faces of a search whose vertices move from x_0 to x_1 on straight lines, each as it likes: the functions are those of
/// TranslatedFaces. Normals are those of no one time, so that the boxes alone decide.
///
/// They suffice. Let the faces 1 and 2 overlap at some time, seen along any unit vector n: there are points p_1 and p_2 of
/// them, p_2 - p_1 = g n. A point of a face is a mean of its vertices at that time, with weights >= 0, and so lies in the
/// box B_f around its vertices at x_0 and x_1; and if no vertex is farther than skin/2 from x_0, within skin/2 of the box
/// around x_0 in every component. No component of g n is larger than |g|. So boxes grown by a_1 and a_2 overlap if
///
///     |g| + skin <= a_1 + a_2.
///
/// With a_f = 2 d_f + (distance + skin)/2 that is |g| <= 2 D + distance, D = d_1 + d_2, whatever the normals are: no facing
/// and no tilt enters, for g is a distance between two points of the faces. Where the gap is taken between centroids c_f it
/// is none: p_2 - p_1 is then (gap + (p_2 - c_2).n - (p_1 - c_1).n) n, and these two products are up to r_f sin(tilt_f). The
/// radius is that at the time of contact: r_f is a norm of differences that are linear on the path, and so largest at an end
/// of it, and gains at most one skin where vertices and centroid each move by half of it.
template <int Dim>
class MovedFaces {
public:
    /// Surface and options must outlive it. Throws BadInput for arrays of the wrong size.
    MovedFaces(const SurfaceView<Dim>& surface, const CandidateOptions& options, PointsView<Dim> x_0, PointsView<Dim> x_1,
               GapOf gap);

    void prepare(const FaceOrder& order) { order_ = &order; }

    /// How far the vertex of a face moves that moves farthest; NaN where one of its positions is not finite.
    [[nodiscard]] double motion(std::int32_t face) const;
    [[nodiscard]] std::string name_of_position(std::int32_t face) const;
    [[nodiscard]] std::string name_of_mover(std::int32_t face) const;

    [[nodiscard]] Vector<Dim> middle(std::int32_t face) const;
    [[nodiscard]] geometry::Box<Dim> box(std::ptrdiff_t i, double skin) const;
    [[nodiscard]] double growth_per_skin() const { return 1.0 + 2.0 * skin_tilt_; }
    [[nodiscard]] PairVerdict verdict(std::int32_t, std::int32_t, double) const { return PairVerdict::may_touch; }

private:
    [[nodiscard]] double motion_of_vertex(std::int32_t v) const;
    [[nodiscard]] std::string name_of_vertex(std::int32_t face) const;
    [[nodiscard]] double radius(std::int32_t face, const PointsView<Dim>& x) const;

    const SurfaceView<Dim>& surface_;
    const CandidateOptions& options_;
    PointsView<Dim> x_0_, x_1_;
    double skin_tilt_;  // sine, or 0 where the tilt plays no part
    const FaceOrder* order_ = nullptr;
};

}  // namespace abut::contact
