#pragma once
// Private to the sources of this layer.
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "abut/base/state_bytes.hpp"
#include "abut/contact/step.hpp"
#include "abut/solid/body/bodies.hpp"
#include "abut/solid/load/held_places.hpp"
#include "abut/solid/load/held_points.hpp"

namespace abut::solid {

/// Springs, dashpots, moments and tractions on bodies that turn: what acts on places that move with points. Springs are part
/// of V; of all others the work is booked. In a step every force is the one whose work is exactly the change of V, or that
/// which is booked, and has no other moment about the mean positions than it should.
template <int Dim>
class PointLoads {
public:
    using TurnOf = std::function<Matrix<Dim>(std::int32_t body)>;

    /// All must outlive it. Each rank has all loads and looks at all points that they act on; every function that takes values by
    /// point is a call of all ranks. Throws BadInput for a body that does not exist, or a value
    /// out of range.
    PointLoads(const Bodies<Dim>& bodies, const RankPart<Dim>& part);

    [[nodiscard]] bool any() const { return !springs_.empty() || !moments_.empty() || !tractions_.empty(); }
    /// Whether V does not tell all forces.
    [[nodiscard]] bool do_work() const;
    /// Energy of the springs [J].
    [[nodiscard]] double energy(std::span<const Vector<Dim>> q) const;
    /// Adds the forces of a step from q_0 at `time` to q_1 [N], and the work of what is booked to `work` [J]: means, or of
    /// springs those at its end. `turn_of(body)`: the mean of its rotations at both ends.
    ///
    /// With the mean, dashpots act on the mean of the rates of this step and of the one before. On those of this step alone a
    /// two-step scheme answers with an alternating mode that grows; on those of the one before alone with vibrations that grow
    /// where omega dt is above sqrt 2. docs/method.md, Bodies that turn.
    void add(std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1, double time, double dt,
             contact::TakenForce take, const TurnOf& turn_of, std::span<Vector<Dim>> force, double& work);
    /// The last rates are those of velocities v in q (n_points) [m/s].
    void set_rates(std::span<const Vector<Dim>> q, std::span<const Vector<Dim>> v);
    [[nodiscard]] bool damp() const;  ///< whether some force depends on rates
    /// Adds the forces of one state [N], dashpots at the last rates.
    void add_at(std::span<const Vector<Dim>> q, double time, const TurnOf& turn_of, std::span<Vector<Dim>> force) const;
    /// Adds what springs resist a displacement with, all in one direction or the other: for the stable step [N].
    void add_stiffness(std::span<const Vector<Dim>> q, std::span<Vector<Dim>> product) const;

    void save(StateWriter& state) const;  ///< between two steps
    void restore(StateReader& state);
    /// Throws BadInput where `before` has other springs or moments.
    void take_over(const PointLoads& before);
    /// Where the tractions of a condition act, one place per face of its group, with numbers of points of the system; empty
    /// where the bodies do not turn.
    [[nodiscard]] std::vector<HeldPlace<Dim>> traction_places(std::size_t condition) const;
    /// Tractions of a condition that is from outside, by face of its group (n) [Pa]; not looked at.
    void set_traction(std::size_t condition, std::span<const Vector<Dim>> traction) {
        outside_[condition].assign(traction.begin(), traction.end());
    }

private:
    /// What a dashpot acts on: of a hinge all of it, else the first component alone, which is that of the length [m/s]. Like
    /// this a rate does not turn with the spring from one step to the next.
    using Rate = Vector<Dim>;
    struct HeldSpring {
        HeldPlace<Dim> first, second;
        Spring<Dim> law;
        std::optional<Rate> rate = {};  // in the last step
    };
    struct HeldMoment {
        BodyMoment<Dim> law;
        double mass;                                // of the body [kg]
        std::optional<AxialVector<Dim>> spin = {};  // in the last step [rad/s]
    };
    struct HeldTraction {
        HeldPlace<Dim> place;
        double area;
        std::int32_t body;
        std::size_t condition;
        std::size_t face;                     // in the group
        Vector<Dim> normal;                   // at rest
        std::vector<HeldPlace<Dim>> corners;  // of a face that a pressure turns with, and stretches; else empty
    };

    [[nodiscard]] Vector<Dim> value_of(const HeldTraction& traction, double time) const;
    void hold_springs(HeldPlaces<Dim>& places);
    void hold_tractions(HeldPlaces<Dim>& places);
    void take_held_points();
    void check_moments() const;
    [[nodiscard]] static Rate rate_of(const Spring<Dim>& law, const Vector<Dim>& r, const Vector<Dim>& velocity);
    [[nodiscard]] static Vector<Dim> damping_tension(const Spring<Dim>& law, const Vector<Dim>& r, const Rate& rate);
    void push(const HeldSpring& spring, const Vector<Dim>& tension, std::span<Vector<Dim>> force) const;
    void add_springs(std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1, double dt, contact::TakenForce take,
                     std::span<Vector<Dim>> force, double& work);
    double add_tractions(std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1, double time,
                         const TurnOf& turn_of, std::span<Vector<Dim>> force) const;
    double add_pressure(const HeldTraction& traction, const Vector<Dim>& value, std::span<const Vector<Dim>> q_0,
                        std::span<const Vector<Dim>> q_1, std::span<Vector<Dim>> force) const;
    /// A body in the middle of a step.
    struct Middle {
        Vector<Dim> centre;
        Matrix<Dim> second_moment;
    };
    [[nodiscard]] Middle middle_of(const HeldMoment& held, std::span<const Vector<Dim>> q_0,
                                   std::span<const Vector<Dim>> q_1) const;
    /// Of the body where velocity(point) is that of its points.
    template <class Velocity>
    [[nodiscard]] AxialVector<Dim> spin_at(const HeldMoment& held, const Middle& middle, std::span<const Vector<Dim>> q_0,
                                           std::span<const Vector<Dim>> q_1, const Velocity& velocity) const;
    double add_moment(const BodyMoment<Dim>& law, const AxialVector<Dim>& spin, const Middle& middle,
                      std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1,
                      std::span<Vector<Dim>> force) const;
    template <class OfPoint>
    void for_each_here(std::int32_t body, const OfPoint& of_point) const;
    template <class Value, class Term>
    [[nodiscard]] Value sum_of(std::int32_t body, const Value& zero, const Term& term) const;

    const Bodies<Dim>& bodies_;
    const SolidOptions<Dim>& options_;
    const RankPart<Dim>& part_;
    HeldPoints<Dim> held_;
    std::vector<HeldSpring> springs_;
    std::vector<HeldMoment> moments_;
    std::vector<HeldTraction> tractions_;
    std::vector<std::vector<Vector<Dim>>> outside_;  // by condition and face; empty: not from outside
};

}  // namespace abut::solid
