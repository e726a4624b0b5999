#pragma once
#include <numeric>
#include <vector>

#include "abut/dynamics/filter.hpp"
#include "abut/dynamics/point_system.hpp"
#include "studies/scenes/bars.hpp"

namespace abut::studies {

/// The chain of a bar as a host of filter and restart, of one dimension. Its lowest masses are a patch after each step that
/// begins or ends in contact; the wall holds it, so that its rigid motion stays in e and v. Of one mass a filter takes
/// nothing.
class BarHost : public BarChain {
public:
    static constexpr int dimension = 1;

    BarHost(const BarOnWall& scene, int cells, int patch)
        : BarChain(bar_chain(scene, cells)), gap_(scene.gap), points_(static_cast<std::size_t>(patch)), bodies_(size(), 0) {
        std::iota(points_.begin(), points_.end(), 0);
        const double h = scene.bar.length / cells;
        for (int i = 0; i < cells; ++i) {
            rest_.emplace_back(gap_ + (i + 0.5) * h);
            masses_.push_back(1.0 / inverse_mass()[static_cast<std::size_t>(i)]);
        }
    }
    [[nodiscard]] std::span<const Vector<1>> rest_positions() const { return rest_; }
    [[nodiscard]] std::span<const double> masses() const { return masses_; }
    [[nodiscard]] dynamics::MomentArms moment_arms() const { return dynamics::MomentArms::rest; }
    [[nodiscard]] std::span<const std::int32_t> body_of_points() const { return bodies_; }
    [[nodiscard]] dynamics::ContactCounts contact_counts() const { return {touches_ ? 1 : 0, events_}; }

    void mean_force(std::span<const double> q_0, std::span<const double> q_1, double time, double dt,
                    std::span<double> force) {
        touches_ = presses(q_0) || presses(q_1);
        events_ += presses(q_0) != presses(q_1) ? 1 : 0;
        BarChain::mean_force(q_0, q_1, time, dt, force);
    }
    [[nodiscard]] std::vector<dynamics::ContactPatch<1>> contact_patches() const {
        if (!touches_) return {};
        return {{.points = points_, .holds = {{Vector<1>(0.0), Vector<1>(1.0)}}}};
    }
    void end_force_on(std::span<const std::int32_t> points, std::span<const double> q, std::span<Vector<1>> on_points) {
        force_.resize(size());
        force(q, force_);
        for (std::size_t k = 0; k < points.size(); ++k) on_points[k][0] = force_[static_cast<std::size_t>(points[k])];
    }

    /// Whether the lowest mass presses on the wall.
    [[nodiscard]] bool presses(std::span<const double> q) const { return q[0] + gap_ < 0.0; }

private:
    double gap_;
    std::vector<std::int32_t> points_, bodies_;
    std::vector<Vector<1>> rest_;
    std::vector<double> masses_, force_;
    bool touches_ = false;
    std::int64_t events_ = 0;
};

}  // namespace abut::studies
