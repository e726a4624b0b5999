#pragma once
// Private to the layer.
#include <cstdint>
#include <span>
#include <vector>

#include "abut/contact/options.hpp"
#include "abut/contact/surface/surface.hpp"
#include "abut/geometry/plane_frame.hpp"

namespace abut::contact {

/// Two facing faces, and everything about them that stays the same while they move without rotation. docs/method.md,
/// Contact.
template <int Dim>
struct ContactPair {
    std::int32_t face_1;  ///< in the surface
    std::int32_t face_2;
    geometry::PlaneFrame<Dim> frame;  ///< its normal is n_12, from face 1's body into face 2's
    double theta_1;                   ///< share of the correction that face 1 takes [-]
    double theta_2;
    double interaction_radius;   ///< sum of the circumradii of the projected faces: farther apart they share nothing [m]
    double admission_depth;      ///< D = d_1 + d_2 [m]
    std::int32_t listed_1 = -1;  ///< index of the face in the list of PairList::list_faces
    std::int32_t listed_2 = -1;
    std::int32_t corners_1 = 0;  ///< where the projected corners of face 1 begin in the corners of the PairList
    std::int32_t corners_2 = 0;
    std::int32_t corners_end = 0;
    std::int32_t friction = -1;  ///< index of its law of friction; -1: none
};

/// Relative position of the two faces of a pair.
template <int Dim>
struct PairPosition {
    double gap;                          ///< g [m], > 0 apart
    PlaneVector<Dim> tangential_offset;  ///< s [m], centroid of face 2 seen from that of face 1, in the plane of the pair
};

/// The candidate pairs of one search with their projected faces, sorted by (face_1, face_2).
template <int Dim>
class PairList {
public:
    /// Pairs come in increasing order.
    void append(const SurfaceView<Dim>& surface, std::int32_t face_1, std::int32_t face_2, InterfaceWeighting weighting,
                std::int32_t friction = -1);
    void clear();
    /// The faces of all pairs, increasing; then `number_faces`.
    void list_faces(std::vector<Face>& faces);
    /// Sets `listed_1` and `listed_2`: the indices of the pairs' faces among these, which increase.
    void number_faces(std::span<const Face> faces);

    [[nodiscard]] std::span<const ContactPair<Dim>> pairs() const { return pairs_; }
    [[nodiscard]] const ContactPair<Dim>& operator[](std::int32_t i) const { return pairs_[static_cast<std::size_t>(i)]; }
    [[nodiscard]] std::int32_t size() const { return static_cast<std::int32_t>(pairs_.size()); }

    /// Position of a pair whose faces have the displacements u_1 and u_2 [m].
    [[nodiscard]] PairPosition<Dim> position(const SurfaceView<Dim>& surface, const ContactPair<Dim>& pair,
                                             const Vector<Dim>& u_1, const Vector<Dim>& u_2) const;
    [[nodiscard]] geometry::OverlapArea<Dim> overlap(const ContactPair<Dim>& pair, const PlaneVector<Dim>& tangential_offset,
                                                     geometry::AreaMethod method) const;
    /// Whether the faces are sure to share no area while the offset goes straight from s_0 to s_1 (a cheap test).
    [[nodiscard]] bool stay_apart(const ContactPair<Dim>& pair, const PlaneVector<Dim>& s_0,
                                  const PlaneVector<Dim>& s_1) const {
        const double allowed = pair.interaction_radius + (s_1 - s_0).norm();
        return s_0.squaredNorm() > allowed * allowed;
    }
    void append_overlap_events(const ContactPair<Dim>& pair, const PlaneVector<Dim>& s_0, const PlaneVector<Dim>& s_1,
                               std::vector<double>& events) const;

private:
    [[nodiscard]] geometry::ProjectedFace<Dim> face_1(const ContactPair<Dim>& pair) const;
    [[nodiscard]] geometry::ProjectedFace<Dim> face_2(const ContactPair<Dim>& pair) const;

    std::vector<ContactPair<Dim>> pairs_;
    std::vector<PlaneVector<Dim>> corners_;  // of each pair: face 1, then face 2, about their own centroids
    std::vector<std::int32_t> listed_;       // work array: number in the list by face
};

}  // namespace abut::contact
