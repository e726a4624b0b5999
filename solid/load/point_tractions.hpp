#pragma once
// Private to the sources of this layer.
#include <cstddef>
#include <cstdint>
#include <vector>

#include "abut/solid/body/bodies.hpp"
#include "abut/solid/load/held_points.hpp"
#include "abut/solid/load/point_load.hpp"

namespace abut::solid {

/// Tractions and pressures on bodies that turn (TractionHold::points): forces at the centroids of faces, which move as
/// the cells have them. Their work is booked. Forces of a pressure p on faces f of a body of Kinematics::finite are the
/// slopes of -p times the volume
///
///     sum of v_f + (x_f - c_f) . a_f
///
/// with the place x_f of the face, the volume v_f below its corners, their area vector a_f, and their mean c_f with the
/// weights with which they share the force of a pressure at rest. Affine motions leave x_f = c_f, and the force -p a_f
/// at x_f alone, which a uniform stress balances. Faces share corners, so that an equal pressure all round has no force
/// and no moment in any state.
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

    /// Places where tractions of a condition act, one per face of its group on all ranks, in their order, with numbers of
    /// points among those of all; empty where the bodies do not turn.
    [[nodiscard]] std::vector<HeldPlace<Dim>> places_of(std::size_t condition) const;
    /// Sets tractions of a condition that is from outside, by face of its group on all ranks (n) [Pa]; they are not checked.
    void set(std::size_t condition, std::span<const Vector<Dim>> traction) {
        outside_[condition].assign(traction.begin(), traction.end());
    }

private:
    struct Held {
        HeldPlace<Dim> place;
        double area;
        std::int32_t body;
        std::size_t condition;
        std::size_t face;                     // of the group on all ranks
        Vector<Dim> normal;                   // at rest
        std::vector<HeldPlace<Dim>> corners;  // of a face that a pressure turns with, and stretches; else empty
        std::vector<double> weights;          // of c_f, as many
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
