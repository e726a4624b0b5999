#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "abut/contact/options.hpp"
#include "abut/contact/surface.hpp"
#include "abut/geometry/plane_frame.hpp"

namespace abut::contact {

/// Two facing faces and all of them that does not change while they move without rotation. docs/method.md, Contact.
template <int Dim>
struct ContactPair {
    std::int32_t face_1;
    std::int32_t face_2;
    geometry::PlaneFrame<Dim> frame;  ///< its normal is n_12, from face 1's body into face 2's
    double theta_1;                   ///< share of the correction that face 1 takes [-]
    double theta_2;
    double reach;                ///< sum of the circumradii of the projected faces: farther apart they share nothing [m]
    double depth;                ///< D = d_1 + d_2 [m]
    std::int32_t corners_1 = 0;  ///< where the projected corners of face 1 begin in PairList::corners
    std::int32_t corners_2 = 0;
    std::int32_t corners_end = 0;
    bool admitted = false;  ///< whether A > 0 and g < 0 means contact; decided only where A min(g, 0) = 0
};

/// Relative position of the two faces of a pair.
template <int Dim>
struct PairPosition {
    double gap;              ///< g [m], > 0 apart
    PlaneVector<Dim> shift;  ///< s [m], centroid of face 2 seen from the centroid of face 1, in the plane of the pair
};

/// Pairs with their projected faces, sorted by (face_1, face_2).
template <int Dim>
class PairList {
public:
    /// Pairs come in increasing order.
    void append(const SurfaceView<Dim>& surface, std::int32_t face_1, std::int32_t face_2, Weights weights);
    void clear();

    [[nodiscard]] std::span<const ContactPair<Dim>> pairs() const { return pairs_; }
    [[nodiscard]] std::span<ContactPair<Dim>> pairs() { return pairs_; }
    [[nodiscard]] std::int32_t size() const { return static_cast<std::int32_t>(pairs_.size()); }

    /// Position of a pair whose faces have the displacements u_1 and u_2 [m].
    [[nodiscard]] PairPosition<Dim> position(const SurfaceView<Dim>& surface, const ContactPair<Dim>& pair,
                                             const Vector<Dim>& u_1, const Vector<Dim>& u_2) const;
    [[nodiscard]] geometry::SharedArea<Dim> shared_area(const ContactPair<Dim>& pair, const PlaneVector<Dim>& shift,
                                                        geometry::AreaMethod method) const;
    /// Whether the faces are sure to share no area while the shift goes straight from shift_0 to shift_1 (a cheap test).
    [[nodiscard]] bool stay_apart(const ContactPair<Dim>& pair, const PlaneVector<Dim>& shift_0,
                                  const PlaneVector<Dim>& shift_1) const {
        const double allowed = pair.reach + (shift_1 - shift_0).norm();
        return shift_0.squaredNorm() > allowed * allowed;
    }
    void append_overlap_events(const ContactPair<Dim>& pair, const PlaneVector<Dim>& shift_0,
                               const PlaneVector<Dim>& shift_1, std::vector<double>& events) const;

private:
    [[nodiscard]] geometry::ProjectedFace<Dim> face_1(const ContactPair<Dim>& pair) const;
    [[nodiscard]] geometry::ProjectedFace<Dim> face_2(const ContactPair<Dim>& pair) const;

    std::vector<ContactPair<Dim>> pairs_;
    std::vector<PlaneVector<Dim>> corners_;  // of each pair: face 1, then face 2, about their own centroids
};

/// n_12, unit, from face 1's body into face 2's: (n_1 - n_2)/|n_1 - n_2|, or the normal of the face that is rigid, because
/// an obstacle's face may be far larger than its partner and a gap read at its centroid along a tilted normal would mean
/// nothing.
template <int Dim>
[[nodiscard]] Vector<Dim> pair_normal(const SurfaceView<Dim>& surface, std::int32_t face_1, std::int32_t face_2);

/// Largest distance of a corner from the centroid [m].
template <int Dim>
[[nodiscard]] double circumradius(const SurfaceView<Dim>& surface, std::int32_t face);

/// Whether two faces look at each other: n_1 . n_2 < facing_cosine.
template <int Dim>
[[nodiscard]] bool are_facing(const SurfaceView<Dim>& surface, std::int32_t face_1, std::int32_t face_2,
                              double facing_cosine);

}  // namespace abut::contact
