#pragma once
// Private to the sources of this layer.
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "abut/solid/body/bodies.hpp"
#include "abut/solid/ccg/ccg.hpp"
#include "abut/solid/options/attachments.hpp"
#include "abut/solid/part/rank_part.hpp"

namespace abut::solid {

/// A place that moves with some points: x = sum w (X + q). Arrays are by these numbers of points.
template <int Dim>
struct HeldPlace {
    std::vector<std::int32_t> points;  ///< none: it stands still
    std::vector<double> weights;
    Vector<Dim> rest = Vector<Dim>::Zero();  ///< [m]

    [[nodiscard]] Vector<Dim> at(std::span<const Vector<Dim>> q) const {
        Vector<Dim> x = rest;
        for (std::size_t i = 0; i < points.size(); ++i) x += weights[i] * q[points[i]];
        return x;
    }
    /// How it moves where these points do.
    [[nodiscard]] Vector<Dim> displacement(std::span<const Vector<Dim>> q) const {
        Vector<Dim> u = Vector<Dim>::Zero();
        for (std::size_t i = 0; i < points.size(); ++i) u += weights[i] * q[points[i]];
        return u;
    }
};

/// The area of a face with these corners times its normal, whether they lie in a plane or not [m^(Dim-1)].
template <int Dim>
[[nodiscard]] Vector<Dim> area_vector(std::span<const Vector<Dim>> corners);

/// Finds the points that hold a place: on several ranks by their numbers among those of all. Every function is a call of all
/// ranks.
template <int Dim>
class HeldPlaces {
public:
    /// A face of a body.
    struct Face {
        std::int64_t key;  // orders the faces of a body
        std::int32_t body;
        std::size_t in_group;  // its number among the faces of the group on all ranks
        double area;
        Vector<Dim> centroid;
        Vector<Dim> normal;                // out of the body
        std::vector<Vector<Dim>> corners;  // in the order in which the normal sees them run to the left
        HeldPlace<Dim> place;              // of its centroid, as below
    };

    /// All must outlive it.
    HeldPlaces(const Bodies<Dim>& bodies, const Ccg<Dim>& ccg, const RankPart<Dim>& part)
        : bodies_(bodies), ccg_(ccg), part_(part), boundary_in_mesh_(bodies.boundary_in_mesh()) {}

    /// Throws BadInput for a body that does not exist, and for one whose cells span nothing to hold a place beside.
    [[nodiscard]] HeldPlace<Dim> of(const Anchor<Dim>& anchor);
    /// Faces of a group on all ranks, by body and key. Centroids of bodies that deform are held as the operators hold
    /// them, by rows of R, which are affine where a traction pulls at places: no other weights give forces that a
    /// uniform stress of the cells balances.
    [[nodiscard]] std::vector<Face> faces_of(const std::string& group);

private:
    /// The points of a body, on several ranks those of all of them, increasing by number.
    struct Points {
        std::vector<std::int32_t> number;
        std::vector<Vector<Dim>> rest;
        std::vector<double> mass;
    };
    struct Cloud;

    [[nodiscard]] const Points& points_of(std::int32_t body);
    [[nodiscard]] Points gathered_points_of(std::int32_t body) const;
    [[nodiscard]] std::vector<std::size_t> cells_around(const Points& points, const Anchor<Dim>& anchor) const;
    [[nodiscard]] HeldPlace<Dim> held_by(const Points& points, std::span<const std::size_t> chosen,
                                         const Vector<Dim>& position) const;

    [[nodiscard]] HeldPlace<Dim> place_of(std::int32_t face) const;

    const Bodies<Dim>& bodies_;
    const Ccg<Dim>& ccg_;
    const RankPart<Dim>& part_;
    std::vector<BoundaryFace> boundary_in_mesh_;  // of the faces of bodies that deform
    std::map<std::int32_t, Points> points_;       // of the bodies that were asked for
};

}  // namespace abut::solid
