#pragma once
// Private to the sources of this layer.
#include <cstddef>
#include <cstdint>
#include <vector>

#include "abut/solid/body/bodies.hpp"
#include "abut/solid/load/held_points.hpp"
#include "abut/solid/load/point_load.hpp"

namespace abut::solid {

/// Tractions and pressures on bodies that turn (TractionHold::points). Their work is booked.
template <int Dim>
class PointTractions final : public PointLoad<Dim> {
public:
    /// All must outlive it; `held` has their places when a step comes. A call of all ranks.
    PointTractions(const Bodies<Dim>& bodies, HeldPlaces<Dim>& places, const HeldPoints<Dim>& held);

    [[nodiscard]] bool any() const override { return !tractions_.empty(); }
    [[nodiscard]] bool does_work() const override { return any(); }
    [[nodiscard]] std::vector<HeldPlace<Dim>*> places() override;
    void add(const PointStep<Dim>& step, std::span<Vector<Dim>> force, double& work) override;
    void add_at(const ByPoint<Dim>& q, double time, const TurnOf<Dim>& turn_of, std::span<Vector<Dim>> force) const override;

    /// Where those of a condition act, one place per face of its group, with numbers of points of the system; empty where the bodies
    /// do not turn.
    [[nodiscard]] std::vector<HeldPlace<Dim>> places_of(std::size_t condition) const;
    /// Those of a condition that is from outside, by face of its group (n) [Pa]; not looked at.
    void set(std::size_t condition, std::span<const Vector<Dim>> traction) {
        outside_[condition].assign(traction.begin(), traction.end());
    }

private:
    struct Held {
        HeldPlace<Dim> place;
        double area;
        std::int32_t body;
        std::size_t condition;
        std::size_t face;                     // in the group
        Vector<Dim> normal;                   // at rest
        std::vector<HeldPlace<Dim>> corners;  // of a face that a pressure turns with, and stretches; else empty
    };
    using Points = std::span<const Vector<Dim>>;

    [[nodiscard]] Vector<Dim> value_of(const Held& traction, double time) const;
    double add_all(Points q_0, Points q_1, double time, const TurnOf<Dim>& turn_of, std::span<Vector<Dim>> force) const;
    double add_pressure(const Held& traction, const Vector<Dim>& value, Points q_0, Points q_1,
                        std::span<Vector<Dim>> force) const;

    const Bodies<Dim>& bodies_;
    const HeldPoints<Dim>& held_;
    std::vector<Held> tractions_;
    std::vector<std::vector<Vector<Dim>>> outside_;  // by condition and face; empty: not from outside
};

}  // namespace abut::solid
