#pragma once
// Private to the layer.
#include <array>
#include <cstdint>
#include <map>

#include "abut/base/state_bytes.hpp"
#include "abut/run/body_sliding.hpp"
#include "abut/run/scene.hpp"
#include "abut/solid/contact/contact_results.hpp"

namespace abut::run {

/// Measures by parts of a run how fully bodies that slide past each other rub: of the bodies as a whole, since single faces
/// that vibrate stick and slide in turn, each by its law, while the body glides on less than mu N. Parts in which
/// bodies hardly move past each other, or do so without a loss, as where they stick and swing, do not count.
template <int Dim>
class FrictionWatch {
public:
    static constexpr std::int64_t records_per_part = 25;  // as SlidingWindows
    /// Speed past each other, over the largest in the run so far, from which on bodies slide [-].
    static constexpr double sliding_speed = 0.1;
    /// Friction of a body that slides over its limit, from which on it is right [-].
    static constexpr double enough_friction = 0.9;

    /// `scene` and `options` must outlive it.
    FrictionWatch(const Scene<Dim>& scene, const RunOptions& options) : scene_(scene), options_(options) {}

    /// A record at `time` [s]: friction has dissipated `dissipated` [J] until then, and the largest speed was `speed` [m/s].
    void record(double time, std::span<const solid::BodyImpulse<Dim>> pairs, double dissipated, double speed);

    /// The pair of bodies that slid so for the longest time.
    [[nodiscard]] WeakFriction weakest() const;

    void save(StateWriter& state) const;
    void restore(StateReader& state);

private:
    using Bodies = std::array<std::int32_t, 2>;
    struct Pair {
        Vector<Dim> friction = Vector<Dim>::Zero(), slip = Vector<Dim>::Zero();  // until the last part ended
        double rubbing = 0.0;                                                    // the same
        double seconds = 0.0, found = 0.0, limit = 0.0;                          // of parts with too little
    };
    template <class Self, class Visit>
    static void for_each(Self& pair, const Visit& visit);
    /// The least mu that laws give two bodies [-]; 0: none, or one that is not known.
    [[nodiscard]] double coefficient(Bodies bodies) const;

    const Scene<Dim>& scene_;
    const RunOptions& options_;
    std::map<Bodies, Pair> pairs_;
    std::int64_t records_ = 0;
    double began_ = 0.0;       // when the part did [s]
    double dissipated_ = 0.0;  // until then [J]
};

}  // namespace abut::run
