#pragma once
// Private to the sources of this layer.
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "abut/run/scene.hpp"
#include "abut/run/values/sightings.hpp"

namespace abut::run {

/// Obstacles of a scene that do nothing for a body, since it begins behind them.
struct Behind {
    std::int32_t body;  ///< -1: all of them
    std::int32_t obstacle;
};

/// At the start: bodies that are wholly behind a flat obstacle and not beside it; and obstacles of several faces that all
/// bodies are behind. Pairs that pass through each other do not count.
template <int Dim>
[[nodiscard]] std::vector<Behind> behind_at_start(const Scene<Dim>& scene);

/// Looks at records whether a body has gone past the rim of a flat obstacle (one of a single face): it began in front of it,
/// its centre of mass is not over it, and it is behind it, or has been over it at the start and is no farther from it than
/// its own size. Of bodies that begin beside it, those that pass it.
template <int Dim>
class ObstacleWatch {
public:
    /// The scene must outlive it; rank 0 has its whole mesh. A call of all ranks.
    ObstacleWatch(const Scene<Dim>& scene, const dynamics::Ranks& ranks);

    /// Adds bodies of which nothing was found before to `found`. A call of all ranks, for the displacements of the
    /// points of this one.
    void look(const solid::Solid<Dim>& solid, std::span<const double> q, double time, std::vector<PastRim>& found);

private:
    struct Place {
        double height;  // > 0 in front [m]
        bool is_over;   // seen along the normal
    };
    struct Watched {
        std::int32_t body, obstacle;
        Place at_start{};
        bool is_done = false;
    };
    [[nodiscard]] Place place(const Watched& pair, const Vector<Dim>& centre, double time) const;
    [[nodiscard]] std::vector<Vector<Dim>> centres(const solid::Solid<Dim>& solid, std::span<const double> q) const;

    const Scene<Dim>& scene_;
    std::vector<double> size_;    // of each body at rest [m]
    std::vector<Watched> pairs_;  // that begin in front
};

}  // namespace abut::run
