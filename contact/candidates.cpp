#include "abut/contact/candidates.hpp"

#include <algorithm>
#include <cmath>

#include "abut/contact/pairs.hpp"

namespace abut::contact {
namespace {

/// Largest sine of the angle between a face and the plane of a pair it takes part in. Between deformable faces the pair
/// normal halves the angle that facing allows; against a rigid face it is that face's own normal.
double largest_tilt_sine(double facing_cosine, bool against_rigid) {
    const double angle = std::acos(-facing_cosine);
    return std::sin(against_rigid ? angle : 0.5 * angle);
}

struct BodyFaces {
    std::int32_t body;
    std::vector<std::int32_t> faces;
    bool is_rigid = true;  ///< all of them are
};

template <int Dim>
std::vector<BodyFaces> faces_by_body(const SurfaceView<Dim>& surface) {
    std::vector<BodyFaces> bodies;
    for (std::int32_t face = 0; face < surface.size(); ++face) {
        const std::int32_t body = surface.body[face];
        auto place = std::lower_bound(bodies.begin(), bodies.end(), body,
                                      [](const BodyFaces& b, std::int32_t id) { return b.body < id; });
        if (place == bodies.end() || place->body != body) place = bodies.insert(place, {.body = body, .faces = {}});
        place->faces.push_back(face);
        place->is_rigid = place->is_rigid && surface.is_rigid(face);
    }
    return bodies;
}

template <int Dim>
class CandidateFinder {
public:
    CandidateFinder(const SurfaceView<Dim>& surface, std::span<const Vector<Dim>> u_0, std::span<const Vector<Dim>> u_1,
                    const ContactOptions& options, double skin)
        : surface_(surface),
          u_0_(u_0),
          u_1_(u_1),
          options_(options),
          skin_(skin),
          boxes_(swept_boxes(surface, u_0, u_1, options.facing_cosine, skin)),
          bodies_(faces_by_body(surface)) {
        for (std::int32_t face = 0; face < surface.size(); ++face) radius_.push_back(circumradius(surface, face));
    }

    std::vector<geometry::IndexPair> find() {
        std::vector<std::vector<geometry::Box<Dim>>> face_boxes;
        std::vector<geometry::Box<Dim>> body_boxes;
        for (const BodyFaces& body : bodies_) {
            face_boxes.push_back(select(body.faces));
            body_boxes.push_back(geometry::bounding_box<Dim>(face_boxes.back()));
        }
        for (std::size_t a = 0; a < bodies_.size(); ++a) {
            if (options_.self_contact)
                keep_reachable(geometry::overlapping_pairs<Dim>(options_.broad_phase, face_boxes[a]), a, a);
            for (std::size_t b = a + 1; b < bodies_.size(); ++b) {
                if ((bodies_[a].is_rigid && bodies_[b].is_rigid) || !body_boxes[a].overlaps(body_boxes[b])) continue;
                keep_reachable(geometry::overlapping_pairs<Dim>(options_.broad_phase, face_boxes[a], face_boxes[b]), a, b);
            }
        }
        std::sort(found_.begin(), found_.end());
        return std::move(found_);
    }

private:
    std::vector<geometry::Box<Dim>> select(const std::vector<std::int32_t>& faces) const {
        std::vector<geometry::Box<Dim>> selected;
        selected.reserve(faces.size());
        for (const std::int32_t face : faces) selected.push_back(boxes_[face]);
        return selected;
    }

    void keep_reachable(const std::vector<geometry::IndexPair>& overlapping, std::size_t a, std::size_t b) {
        for (const auto& [i, j] : overlapping) {
            const auto [face_1, face_2] = std::minmax(bodies_[a].faces[i], bodies_[b].faces[j]);
            if (surface_.is_rigid(face_1) && surface_.is_rigid(face_2)) continue;
            if (are_facing(surface_, face_1, face_2, options_.facing_cosine) && can_touch(face_1, face_2))
                found_.push_back({face_1, face_2});
        }
    }

    /// Whether g can become negative where the faces share area: on the way from u_0 to u_1, or within the skin of u_0.
    bool can_touch(std::int32_t face_1, std::int32_t face_2) const {
        const Vector<Dim> n = pair_normal(surface_, face_1, face_2);
        const Vector<Dim> rest = surface_.centroid[face_2] - surface_.centroid[face_1];
        const Vector<Dim> at_0 = rest + (u_0_[face_2] - u_0_[face_1]);
        const Vector<Dim> at_1 = rest + (u_1_[face_2] - u_1_[face_1]);
        if (at_0.dot(n) - skin_ > 0.0 && at_1.dot(n) > 0.0) return false;
        const double reach = radius_[face_1] + radius_[face_2] + std::max(skin_, (at_1 - at_0).norm());
        return (at_0 - at_0.dot(n) * n).norm() <= (1.0 + 1e-12) * reach;
    }

    const SurfaceView<Dim>& surface_;
    std::span<const Vector<Dim>> u_0_;
    std::span<const Vector<Dim>> u_1_;
    const ContactOptions& options_;
    double skin_;
    std::vector<geometry::Box<Dim>> boxes_;
    std::vector<BodyFaces> bodies_;
    std::vector<double> radius_;
    std::vector<geometry::IndexPair> found_;
};

}  // namespace

template <int Dim>
std::vector<geometry::Box<Dim>> swept_boxes(const SurfaceView<Dim>& surface, std::span<const Vector<Dim>> u_0,
                                            std::span<const Vector<Dim>> u_1, double facing_cosine, double skin) {
    bool any_rigid = false;
    for (std::int32_t face = 0; face < surface.size(); ++face) any_rigid = any_rigid || surface.is_rigid(face);
    const double tilt = largest_tilt_sine(facing_cosine, any_rigid);

    std::vector<geometry::Box<Dim>> boxes(static_cast<std::size_t>(surface.size()));
    for (std::int32_t face = 0; face < surface.size(); ++face) {
        for (const std::int32_t v : surface.vertices_of(face)) {
            boxes[face].extend(surface.vertices[v] + u_0[face]);
            boxes[face].extend(surface.vertices[v] + u_1[face]);
        }
        const double reach = surface.is_rigid(face) ? 0.0 : 2.0 * surface.depth[face] + circumradius(surface, face) * tilt;
        boxes[face] = boxes[face].grown(reach + 0.5 * skin);
    }
    return boxes;
}

template <int Dim>
std::vector<geometry::IndexPair> find_candidates(const SurfaceView<Dim>& surface, std::span<const Vector<Dim>> u_0,
                                                 std::span<const Vector<Dim>> u_1, const ContactOptions& options,
                                                 double skin) {
    return CandidateFinder<Dim>(surface, u_0, u_1, options, skin).find();
}

template std::vector<geometry::Box<2>> swept_boxes<2>(const SurfaceView<2>&, std::span<const Vector<2>>,
                                                      std::span<const Vector<2>>, double, double);
template std::vector<geometry::Box<3>> swept_boxes<3>(const SurfaceView<3>&, std::span<const Vector<3>>,
                                                      std::span<const Vector<3>>, double, double);
template std::vector<geometry::IndexPair> find_candidates<2>(const SurfaceView<2>&, std::span<const Vector<2>>,
                                                             std::span<const Vector<2>>, const ContactOptions&, double);
template std::vector<geometry::IndexPair> find_candidates<3>(const SurfaceView<3>&, std::span<const Vector<3>>,
                                                             std::span<const Vector<3>>, const ContactOptions&, double);

}  // namespace abut::contact
