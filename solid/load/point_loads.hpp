#pragma once
// Private to the sources of this layer.
#include <array>
#include <span>

#include "abut/solid/load/body_moments.hpp"
#include "abut/solid/load/point_tractions.hpp"
#include "abut/solid/load/springs.hpp"

namespace abut::solid {

/// All loads that act on places which move with points, in the order of `loads_`: sums run in it.
template <int Dim>
class PointLoads {
public:
    /// All must outlive it. Each rank has all loads and looks at all points that they act on; every function that takes
    /// values by point is a call of all ranks. Throws BadInput for a body that does not exist, or a value out of range.
    PointLoads(const Bodies<Dim>& bodies, const Ccg<Dim>& ccg, const RankPart<Dim>& part);
    PointLoads(const PointLoads&) = delete;
    PointLoads& operator=(const PointLoads&) = delete;

    // What all of them do together: see PointLoad. Displacements q and velocities v are those of all points (n_points).

    [[nodiscard]] bool any() const;
    [[nodiscard]] bool do_work() const;
    [[nodiscard]] bool damp() const;
    [[nodiscard]] double energy(std::span<const Vector<Dim>> q) const;
    void add(std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1, double time, double dt,
             contact::TakenForce take, const TurnOf<Dim>& turn_of, std::span<Vector<Dim>> force, double& work);
    void set_rates(std::span<const Vector<Dim>> q, std::span<const Vector<Dim>> v);
    void add_at(std::span<const Vector<Dim>> q, double time, const TurnOf<Dim>& turn_of, std::span<Vector<Dim>> force) const;
    void add_stiffness(std::span<const Vector<Dim>> q, std::span<Vector<Dim>> product) const;

    void save(StateWriter& state) const;
    void restore(StateReader& state);
    void take_over(const PointLoads& before);

    [[nodiscard]] PointTractions<Dim>& tractions() { return tractions_; }

private:
    PointLoads(const Bodies<Dim>& bodies, const RankPart<Dim>& part, HeldPlaces<Dim> places);
    [[nodiscard]] HeldPoints<Dim> held_points(const RankPart<Dim>& part);

    HeldPoints<Dim> held_;
    Springs<Dim> springs_;
    PointTractions<Dim> tractions_;
    BodyMoments<Dim> moments_;
    std::array<PointLoad<Dim>*, 3> loads_{&springs_, &tractions_, &moments_};
};

}  // namespace abut::solid
