#pragma once
// Private to the sources of this layer.
#include <optional>
#include <vector>

#include "abut/solid/body/bodies.hpp"
#include "abut/solid/load/held_points.hpp"
#include "abut/solid/load/point_load.hpp"

namespace abut::solid {

/// Springs, hinges and dashpots between places of bodies or on the ground. Springs are part of V; the work of dashpots
/// is booked.
template <int Dim>
class Springs final : public PointLoad<Dim> {
public:
    /// All must outlive it; `held` has their places when a step comes. Throws BadInput for a body that does not exist,
    /// or a value out of range. A call of all ranks.
    Springs(const Bodies<Dim>& bodies, HeldPlaces<Dim>& places, const HeldPoints<Dim>& held);

    [[nodiscard]] bool any() const override { return !springs_.empty(); }
    [[nodiscard]] bool is_in_potential() const override { return any(); }
    [[nodiscard]] bool does_work() const override { return damps(); }
    [[nodiscard]] bool damps() const override;
    [[nodiscard]] std::vector<HeldPlace<Dim>*> places() override;
    [[nodiscard]] double energy(const ByPoint<Dim>& q) const override;
    void add(const PointStep<Dim>& step, std::span<Vector<Dim>> force, double& work) override;
    void set_rates(const ByPoint<Dim>& q, const ByPoint<Dim>& v) override;
    void add_at(const ByPoint<Dim>& q, double time, const TurnOf<Dim>& turn_of, std::span<Vector<Dim>> force) const override;
    void add_stiffness(const ByPoint<Dim>& q, std::span<Vector<Dim>> product) const override;
    void save(StateWriter& state) const override;
    void restore(StateReader& state) override;
    void take_over(const PointLoad<Dim>& before) override;

private:
    /// Rate on which a dashpot acts: of a hinge all of it, else the first component alone, which is that of the length
    /// [m/s]. Like this a rate does not turn with the spring from one step to the next.
    using Rate = Vector<Dim>;
    struct Held {
        HeldPlace<Dim> first, second;
        Spring<Dim> law;
        std::optional<Rate> rate = {};  // in the last step
    };

    [[nodiscard]] static Rate rate_of(const Spring<Dim>& law, const Vector<Dim>& r, const Vector<Dim>& velocity);
    [[nodiscard]] static Vector<Dim> damping_tension(const Spring<Dim>& law, const Vector<Dim>& r, const Rate& rate);
    void push(const Held& spring, const Vector<Dim>& tension, std::span<Vector<Dim>> force) const;

    const Bodies<Dim>& bodies_;
    const HeldPoints<Dim>& held_;
    std::vector<Held> springs_;
};

}  // namespace abut::solid
