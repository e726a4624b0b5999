#pragma once
// Private to the sources of this layer.
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "abut/base/state_bytes.hpp"
#include "abut/base/vector.hpp"
#include "abut/contact/step.hpp"
#include "abut/solid/load/held_places.hpp"

namespace abut::solid {

/// The mean of the rotations of a body at both ends of a step.
template <int Dim>
using TurnOf = std::function<Matrix<Dim>(std::int32_t body)>;

/// Values by point of the part, and of those that places are held by.
template <int Dim>
struct ByPoint {
    std::span<const Vector<Dim>> all, held;
};

/// A step from q_0 at `time` to q_1 [m].
template <int Dim>
struct PointStep {
    ByPoint<Dim> q_0, q_1;
    double time, dt;
    contact::TakenForce take;
    const TurnOf<Dim>& turn_of;
};

/// Loads of one kind that act on places which move with points. In a step every force is the one whose work is exactly
/// the change of V, or that which is booked, and has no other moment about the mean positions than it should.
template <int Dim>
class PointLoad {
public:
    PointLoad() = default;
    PointLoad(const PointLoad&) = delete;
    PointLoad& operator=(const PointLoad&) = delete;
    virtual ~PointLoad() = default;

    [[nodiscard]] virtual bool any() const = 0;
    [[nodiscard]] virtual bool is_in_potential() const { return false; }  ///< whether V tells some of their forces
    [[nodiscard]] virtual bool does_work() const = 0;                     ///< whether V does not tell all of them
    [[nodiscard]] virtual bool damps() const { return false; }            ///< whether some of them depend on rates
    /// All places that they hold, for whoever numbers the points of these.
    [[nodiscard]] virtual std::vector<HeldPlace<Dim>*> places() { return {}; }

    [[nodiscard]] virtual double energy(const ByPoint<Dim>&) const { return 0.0; }  ///< in V [J]
    /// Adds the forces of a step [N], and the work of what is booked to `work` [J]: means, or of what is in V those at
    /// its end.
    virtual void add(const PointStep<Dim>& step, std::span<Vector<Dim>> force, double& work) = 0;
    /// The last rates are those of velocities v in q [m/s].
    virtual void set_rates(const ByPoint<Dim>&, const ByPoint<Dim>&) {}
    /// Adds the forces of one state [N], dashpots at the last rates.
    virtual void add_at(const ByPoint<Dim>& q, double time, const TurnOf<Dim>& turn_of,
                        std::span<Vector<Dim>> force) const = 0;
    /// Adds what resists a displacement, all in one direction or the other: for the stable step [N].
    virtual void add_stiffness(const ByPoint<Dim>&, std::span<Vector<Dim>>) const {}

    virtual void save(StateWriter&) const {}  ///< between two steps
    virtual void restore(StateReader&) {}
    /// From those of the same kind in the run before. Throws BadInput where these are others.
    virtual void take_over(const PointLoad&) {}
};

/// Rate on which dashpots and brakes act in a step whose rate is `now`: with the mean force, the mean of the rates of
/// this step and of the one before. On those of this step alone a two-step scheme answers with an alternating mode that
/// grows; on those of the one before alone with vibrations that grow where omega dt is above sqrt 2. docs/method.md,
/// Bodies that turn.
template <class Rate>
[[nodiscard]] Rate acting_rate(contact::TakenForce take, const std::optional<Rate>& before, const Rate& now) {
    return take == contact::TakenForce::mean && before ? Rate(0.5 * (*before + now)) : now;
}

}  // namespace abut::solid
