#pragma once
// Private to the layer.
#include <cstdint>

#include "abut/contact/options.hpp"
#include "abut/contact/surface/surface.hpp"
#include "abut/geometry/box.hpp"

namespace abut::contact {

/// Whether faces pair whatever their normals.
[[nodiscard]] inline bool by_distance_alone(const CandidateOptions& options) { return options.facing_cosine == 1.0; }

/// How steeply faces lie against the planes of their pairs: where the gap of a pair is taken between the centroids, its
/// faces can be farther apart than the gap where they overlap.
template <int Dim>
class FaceTilt {
public:
    FaceTilt(const SurfaceView<Dim>& surface, const CandidateOptions& options);
    /// Largest sine of the angle between a face and the plane of a pair it takes part in: of faces as they are at rest.
    [[nodiscard]] double sine(const SurfaceView<Dim>& surface, std::int32_t face) const {
        if (surface.is_rigid(face)) return 0.0;  // it gives the normal
        const bool whole =
            surface.steps_to_edge(face) < far_from_sharp_edge || surface.area[face] < much_larger_exist_below_;
        return whole ? of_whole_angle_ : elsewhere_;
    }
    [[nodiscard]] double largest_sine() const { return of_whole_angle_; }

private:
    double elsewhere_;
    double of_whole_angle_;           // where the other face gives the normal
    double much_larger_exist_below_;  // |f| of which a partner may be that much larger [m^(Dim-1)]
};

/// The data of a face at rest that a search reads again and again.
template <int Dim>
struct RestFace {
    geometry::Box<Dim> corners;
    double interaction_radius;  ///< how far past its corners an active pair can be, without distance and skin [m]
    double radius;              ///< largest distance of a corner from the centroid [m]
    std::int32_t face;
};

/// Makes the rest faces of a surface; both must outlive it.
template <int Dim>
class RestFaceMaker {
public:
    RestFaceMaker(const SurfaceView<Dim>& surface, const CandidateOptions& options);
    [[nodiscard]] RestFace<Dim> operator()(std::int32_t face) const;

private:
    const SurfaceView<Dim>& surface_;
    bool by_distance_alone_;
    FaceTilt<Dim> tilt_;
};

/// The box of a face on its path from u_0 to u_1, grown by all that an active pair can reach past its faces (2 d_f, the tilt
/// against the pair normal) and by `margin`. docs/method.md, Contact.
template <int Dim>
[[nodiscard]] geometry::Box<Dim> swept_box(const RestFace<Dim>& rest, const Vector<Dim>& u_0, const Vector<Dim>& u_1,
                                           double margin) {
    return geometry::Box<Dim>{rest.corners.lower + u_0.cwiseMin(u_1), rest.corners.upper + u_0.cwiseMax(u_1)}.grown(
        rest.interaction_radius + margin);
}

/// Mean over the deformable faces [m]; 0 without any.
template <int Dim>
[[nodiscard]] double mean_face_size(const SurfaceView<Dim>& surface);

}  // namespace abut::contact
