#pragma once
// Private to the sources of this layer.
#include <optional>
#include <vector>

#include "abut/solid/body/bodies.hpp"
#include "abut/solid/load/point_load.hpp"
#include "abut/solid/part/rank_part.hpp"

namespace abut::solid {

/// Moments on bodies as a whole, with brakes. Their work is booked.
template <int Dim>
class BodyMoments final : public PointLoad<Dim> {
public:
    /// Both must outlive it. Throws BadInput for a body that does not exist, or a value out of range. A call of all ranks.
    BodyMoments(const Bodies<Dim>& bodies, const RankPart<Dim>& part);

    [[nodiscard]] bool any() const override { return !moments_.empty(); }
    [[nodiscard]] bool does_work() const override { return any(); }
    [[nodiscard]] bool damps() const override;
    void add(const PointStep<Dim>& step, std::span<Vector<Dim>> force, double& work) override;
    void set_rates(const ByPoint<Dim>& q, const ByPoint<Dim>& v) override;
    void add_at(const ByPoint<Dim>& q, double time, const TurnOf<Dim>& turn_of, std::span<Vector<Dim>> force) const override;
    void save(StateWriter& state) const override;
    void restore(StateReader& state) override;
    void take_over(const PointLoad<Dim>& before) override;

private:
    struct Held {
        BodyMoment<Dim> law;
        double mass;                                // of the body [kg]
        std::optional<AxialVector<Dim>> spin = {};  // in the last step [rad/s]
    };
    /// A body in the middle of a step.
    struct Middle {
        Vector<Dim> centre;
        Matrix<Dim> second_moment;
    };
    using Points = std::span<const Vector<Dim>>;

    void check() const;
    /// Throws BadInput for one that is not finite.
    [[nodiscard]] static AxialVector<Dim> moment_at(const BodyMoment<Dim>& law, double time);
    [[nodiscard]] Middle middle_of(const Held& held, Points q_0, Points q_1) const;
    /// Spin of the body where velocity(point) is that of its points.
    template <class Velocity>
    [[nodiscard]] AxialVector<Dim> spin_at(const Held& held, const Middle& middle, Points q_0, Points q_1,
                                           const Velocity& velocity) const;
    double add_moment(std::int32_t body, const AxialVector<Dim>& moment, const Middle& middle, Points q_0, Points q_1,
                      std::span<Vector<Dim>> force) const;
    template <class OfPoint>
    void for_each_here(std::int32_t body, const OfPoint& of_point) const;
    template <class Value, class Term>
    [[nodiscard]] Value sum_of(std::int32_t body, const Value& zero, const Term& term) const;

    const Bodies<Dim>& bodies_;
    const RankPart<Dim>& part_;
    std::vector<Held> moments_;
};

}  // namespace abut::solid
