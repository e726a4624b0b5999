#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "abut/base/vector.hpp"

namespace abut::solid {

template <int Dim>
class Solid;

/// The faces of a group whose tractions a program outside sets (TractionCondition::from_outside, Solid::outside), all
/// in the order of the group. It is of use as long as the solid lives. docs/loads.md; `outside_faces` gives all of it
/// in one value.
///
/// On several ranks each has the faces of its own cells, and of rigid bodies whose points it owns: arrays are of these.
/// Functions that take q or p, and `gather`, are calls of all ranks.
template <int Dim>
class OutsideView {
public:
    OutsideView(const Solid<Dim>& solid, std::string group) : solid_(solid), group_(std::move(group)) {}

    [[nodiscard]] std::span<const std::int32_t> faces() const;  ///< in the mesh of this rank, increasing (n_faces)
    /// Numbers of these in the order of one rank, which has all faces of the group, increasing (n_faces).
    [[nodiscard]] std::span<const std::int32_t> numbers() const;
    [[nodiscard]] std::size_t n_all() const;  ///< faces of all ranks
    /// Values of the faces of all ranks by number, on all of them (n_all), from those of this rank (n_faces).
    [[nodiscard]] std::vector<double> gather(std::span<const double> of_faces) const;
    [[nodiscard]] std::vector<Vector<Dim>> gather(std::span<const Vector<Dim>> of_faces) const;

    [[nodiscard]] std::span<const Vector<Dim>> traction() const;  ///< as set last (n_faces) [Pa]
    /// Share of each face that bonds hold to another body now: 0 where it is bare, 1 where it is covered (n_faces) [-].
    [[nodiscard]] std::vector<double> bonded() const;
    /// Positions of the centroids in q, under the tractions of the last step (n_faces) [m].
    [[nodiscard]] std::vector<Vector<Dim>> position(std::span<const double> q) const;
    /// Velocities of the centroids at momenta p, while tractions and supports stay (n_faces) [m/s].
    [[nodiscard]] std::vector<Vector<Dim>> velocity(std::span<const double> p) const;
    /// Motion of the centroids in a step from q_0 at `time` to q_1 at time + dt (n_faces) [m]: sum of |f| t . this is the
    /// work of the tractions. It does not depend on them, and with Memm::next_q it is known before the step.
    [[nodiscard]] std::vector<Vector<Dim>> motion(std::span<const double> q_0, std::span<const double> q_1, double time,
                                                  double dt) const;
    /// Unit normals out of the body in q, which was stepped to or evaluated last; at rest where it has no frame (n_faces).
    [[nodiscard]] std::vector<Vector<Dim>> normal(std::span<const double> q) const;

private:
    void require_values(std::size_t n_given) const;

    const Solid<Dim>& solid_;
    std::string group_;
};

}  // namespace abut::solid
