#pragma once
// Private to the layer.
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/base/parallel.hpp"
#include "abut/contact/search/face_boxes.hpp"
#include "abut/contact/search/face_order.hpp"
#include "abut/contact/search/pair_filter.hpp"
#include "abut/contact/surface/face_name.hpp"

namespace abut::contact {

/// The faces of a search, each translating from u_0 to u_1. Its public functions, and those of MovedFaces, are all
/// that a search knows of how faces move. i and j are indices into the order of the search.
template <int Dim>
class TranslatedFaces {
public:
    /// Surface and options must outlive it.
    TranslatedFaces(const SurfaceView<Dim>& surface, const CandidateOptions& options)
        : surface_(surface), options_(options) {}

    /// Throws BadInput for arrays of the wrong size.
    void set_path(std::span<const Vector<Dim>> u_0, std::span<const Vector<Dim>> u_1) {
        const auto n = static_cast<std::size_t>(surface_.size());
        for (const std::size_t size : {u_0.size(), u_1.size()})
            if (size != n)
                throw BadInput("contact: " + std::to_string(size) + " displacements are given for " + std::to_string(n) +
                                   " faces of the surface; give one each.",
                               {.value = static_cast<double>(size), .allowed = static_cast<double>(n)});
        u_0_ = u_0;
        u_1_ = u_1;
    }
    /// The order is another one.
    void forget() { rest_.clear(); }
    void prepare(const FaceOrder& order) {
        if (!rest_.empty()) return;
        rest_.resize(order.faces.size());
        const RestFaceMaker<Dim> at_rest(surface_, options_);
        parallel_each(order.size(), [&](std::ptrdiff_t i) { rest_[i] = at_rest(order.faces[static_cast<std::size_t>(i)]); });
    }

    /// How far a face moves; NaN where one of its two displacements is not finite.
    [[nodiscard]] double motion(std::int32_t face) const {
        return u_0_[face].allFinite() ? (u_1_[face] - u_0_[face]).norm() : std::numeric_limits<double>::quiet_NaN();
    }
    [[nodiscard]] std::string name_of_position(std::int32_t face) const {
        return "the displacement of " + face_name(surface_, face);
    }
    [[nodiscard]] std::string name_of_mover(std::int32_t face) const { return face_name(surface_, face); }

    [[nodiscard]] Vector<Dim> middle(std::int32_t face) const { return surface_.centroid[face] + u_0_[face]; }
    [[nodiscard]] geometry::Box<Dim> box(std::ptrdiff_t i, double skin) const {
        const RestFace<Dim>& rest = rest_[i];
        return swept_box(rest, u_0_[rest.face], u_1_[rest.face], 0.5 * (options_.distance + skin));
    }
    /// How much two boxes grow together with the skin.
    [[nodiscard]] double growth_per_skin() const { return 1.0; }
    /// Verdict on faces whose boxes overlap.
    [[nodiscard]] PairVerdict verdict(std::int32_t i, std::int32_t j, double skin) const {
        if (by_distance_alone(options_)) return PairVerdict::may_touch;
        if (!are_facing(surface_, rest_[i].face, rest_[j].face, options_.facing_cosine)) return PairVerdict::not_facing;
        return can_touch(surface_, options_, rest_[i], rest_[j], u_0_, u_1_, skin) ? PairVerdict::may_touch
                                                                                   : PairVerdict::too_far_apart;
    }

private:
    const SurfaceView<Dim>& surface_;
    const CandidateOptions& options_;
    std::span<const Vector<Dim>> u_0_, u_1_;
    std::vector<RestFace<Dim>> rest_;  // in the order of the search
};

}  // namespace abut::contact
