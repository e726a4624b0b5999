#pragma once
// Private to the sources of this layer.
#include <cstdint>
#include <span>
#include <vector>

#include "abut/contact/surface/obstacle.hpp"

namespace abut::solid {

/// The rigid obstacles of a run: where their paths take them, and what acts on them.
template <int Dim>
class Obstacles {
public:
    /// They must outlive this.
    explicit Obstacles(std::span<const contact::RigidObstacle<Dim>> obstacles);

    [[nodiscard]] std::size_t size() const { return obstacles_.size(); }
    [[nodiscard]] const contact::RigidObstacle<Dim>& operator[](std::size_t obstacle) const { return obstacles_[obstacle]; }
    /// Whether one of them has a path.
    [[nodiscard]] bool move() const;
    /// Whether one of them has a path on which it may turn.
    [[nodiscard]] bool turn() const;
    /// Throws BadInput where a path gives one that is not finite, or no rotation.
    [[nodiscard]] contact::Placement<Dim> placement(std::size_t obstacle, double time) const;
    /// From rest [m]. Throws BadInput where a path gives one that is not finite.
    [[nodiscard]] Vector<Dim> displacement(std::size_t obstacle, double time) const;
    /// How far a corner of the one that moves most is at `to` from where it was at `from`, at most [m].
    [[nodiscard]] double motion(double from, double to) const;

    /// Appends their faces to a surface; they are its bodies from `first_body` on.
    void append_to(contact::Surface<Dim>& surface, std::int32_t first_body) const;
    /// Sets the displacements of their faces, in the order of `append_to` [m].
    void displace(double time, std::span<Vector<Dim>> faces) const;

    /// Force on an obstacle, the mean of the last step [N]; while steps fall into parts, of the parts of the step so far.
    [[nodiscard]] Vector<Dim> force(std::size_t obstacle) const {
        return mean_force_.empty() ? force_.at(obstacle) : mean_force_.at(obstacle);
    }
    void clear_forces();
    void add_force(std::size_t obstacle, const Vector<Dim>& force) { force_[obstacle] += force; }
    /// A step of this length begins that falls into parts: the forces of each count when `add_part` says so [s].
    void begin_parts(double dt);
    void add_part(double dt);

private:
    std::span<const contact::RigidObstacle<Dim>> obstacles_;
    std::vector<Vector<Dim>> force_;
    std::vector<Vector<Dim>> mean_force_;  // over the parts of a step; empty: it has none
    double step_ = 0.0;                    // which is that long
};

}  // namespace abut::solid
