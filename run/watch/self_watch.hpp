#pragma once
// Private to the sources of this layer.
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "abut/run/scene.hpp"
#include "abut/run/values/sight.hpp"
#include "abut/run/values/sightings.hpp"
#include "abut/solid/all_points.hpp"

namespace abut::run {

/// Looks at records whether a body comes together with itself, where contact does not see that: two faces of its boundary
/// that look at each other, share area, and are no farther apart than a tenth of the depth of their cells, nor deeper
/// in each other than it, though they were more than twice as far from each other at rest.
///
/// A look takes as long as some steps. The next one is due when the body, seen from the rotation that fits it best, has
/// deformed by as much as the faces that it found need to meet; what is never bent much is looked at once. Said once
/// per body, until it has gone through itself.
template <int Dim>
class SelfWatch {
public:
    /// Watches the bodies of the scene that deform, except those within which contact acts: on rank 0, and the others only
    /// say with it whether there is anything to watch.
    SelfWatch(const Scene<Dim>& scene, const solid::Solid<Dim>& solid);
    ~SelfWatch();
    SelfWatch(const SelfWatch&) = delete;
    SelfWatch& operator=(const SelfWatch&) = delete;

    /// Whether any body is watched, on any rank.
    [[nodiscard]] bool is_on() const { return is_on_; }
    /// Whether a body has deformed enough since it was looked at, at the node of these points; for rank 0.
    [[nodiscard]] bool is_due(const solid::AllPoints<Dim>& points, std::int64_t step);
    /// Looks at the bodies that `is_due` has found. Throws Diverged where two faces that look at each other across an
    /// opening at rest are more than 0.3 of the depth of both cells inside each other.
    void look(const Sight<Dim>& sight, Sightings<Dim>& found);

private:
    class Body;
    bool is_on_ = false;
    std::vector<std::unique_ptr<Body>> bodies_;
};

}  // namespace abut::run
