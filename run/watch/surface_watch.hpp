#pragma once
// Private to the layer.
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "abut/base/state_bytes.hpp"
#include "abut/run/scene.hpp"
#include "abut/run/values/sight.hpp"
#include "abut/run/values/surface_looks.hpp"
#include "abut/solid/contact/contact_results.hpp"

namespace abut::run {

/// Measures how the surfaces of a scene lie to each other while it is run. How often it looks follows from counts of
/// cells and pairs, not from a clock: all figures are the same for any number of threads and ranks.
template <int Dim>
class SurfaceWatch {
public:
    /// The scene must outlive it. Without contact it never looks.
    explicit SurfaceWatch(const Scene<Dim>& scene);

    [[nodiscard]] bool is_due(std::int64_t step) const { return is_on() && step >= next_; }
    /// `speed` is the largest of the run so far [m/s]; `touch`: something did in the last step.
    void look(const Sight<Dim>& sight, double speed, bool touch);
    /// The last look of a run, if there was none at this step, and, where nothing `has_touched`, the two that are nearest.
    void end(const Sight<Dim>& sight, double speed, bool touch, bool has_touched);
    [[nodiscard]] const SurfaceLooks& looks() const { return looks_; }

    /// Memory of a checkpoint.
    static auto fields(auto& self) { return std::tie(self.last_, self.next_, self.looks_); }

private:
    using Points = std::vector<Vector<Dim>>;

    /// A cell with a boundary face, or a face of an obstacle.
    struct Part {
        std::vector<std::int32_t> corners;             // of its hull, in `position_`
        std::vector<std::vector<std::int32_t>> faces;  // its boundary faces
        std::vector<std::vector<std::int32_t>> sides;  // all faces
        std::int32_t cell;                             // of the mesh; -1: of an obstacle
    };
    struct Body {
        std::int32_t number;  // obstacles come behind the bodies of the mesh
        std::vector<Part> parts;
    };

    [[nodiscard]] bool is_on() const { return bodies_.size() > 1; }
    [[nodiscard]] bool is_obstacle(std::int32_t body) const { return body >= scene_.mesh.n_bodies(); }
    using Pairs = std::vector<std::array<std::int32_t, 2>>;
    /// Pairs of bodies that pass through each other, or overlap on purpose, at `time` [s].
    [[nodiscard]] Pairs passing_pairs(double time) const;
    [[nodiscard]] bool may_meet(const Body& body_1, const Body& body_2, const Pairs& passing) const;
    [[nodiscard]] Points points(std::span<const std::int32_t> corners) const;
    void move(const Sight<Dim>& sight);
    std::int64_t look_at_depths(double time);
    std::int64_t look_at_pairs(const Sight<Dim>& sight, double speed);
    void look_at_pressure(const Sight<Dim>& sight, double speed);
    [[nodiscard]] double depth(const Part& part_1, const Part& part_2, double at_least) const;
    [[nodiscard]] double size(const Part& part) const;
    void look_for_nearest(double time);

    const Scene<Dim>& scene_;
    std::vector<Body> bodies_;             // with what may touch of the scene
    std::vector<std::int32_t> vertex_;     // of the mesh, by position; -1: of an obstacle
    std::vector<std::int32_t> of_vertex_;  // the position of a vertex of the mesh; -1: none
    Points position_;                      // now
    Points at_rest_;                       // of those of obstacles
    std::vector<std::int32_t> obstacle_;   // of those
    std::int64_t n_parts_ = 0;
    std::int64_t last_ = -1;  // step of the last look
    std::int64_t next_ = 0;
    SurfaceLooks looks_;
};

}  // namespace abut::run
