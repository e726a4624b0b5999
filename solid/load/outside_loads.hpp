#pragma once
// Private to the sources of this layer.
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "abut/base/state_bytes.hpp"
#include "abut/solid/body/bodies.hpp"
#include "abut/solid/ccg/ccg.hpp"
#include "abut/solid/load/group_faces.hpp"
#include "abut/solid/load/loads.hpp"
#include "abut/solid/load/outside_work.hpp"
#include "abut/solid/load/point_tractions.hpp"

namespace abut::solid {

/// Tractions that a program outside sets between steps: on whom they act, how far these faces move, and the work of that.
/// Displacements q are those of all points (n_points); groups are found by their names, and BadInput is thrown for others.
/// Arrays by face are of the own ones of a group. What changes tractions or sums over faces is a call of all ranks.
template <int Dim>
class OutsideLoads {
public:
    struct Group {
        std::string name;
        std::size_t condition;  // in the options
        GroupFaces<Dim> faces;
        std::vector<BoundaryFace> boundary;  // of the bodies that deform; empty where bodies turn
        std::vector<HeldPlace<Dim>> places;  // empty where they do not
        std::vector<Vector<Dim>> traction;   // as set last [Pa]
        std::vector<Vector<Dim>> acting;     // in the last step, or at the start
    };

    /// All must outlive it.
    OutsideLoads(const Bodies<Dim>& bodies, const RankPart<Dim>& part, Ccg<Dim>& ccg, const Loads<Dim>& loads,
                 PointTractions<Dim>& tractions);

    [[nodiscard]] bool any() const { return !groups_.empty(); }
    [[nodiscard]] const Group& group(const std::string& name) const;
    /// Throws BadInput for another number than the group has faces, a traction that is not finite, or ranks that give those
    /// of different groups.
    void set_traction(const std::string& name, std::span<const Vector<Dim>> traction);

    /// Displacement of the centroids in q, with the loads at the end of the step (n_faces) [m].
    [[nodiscard]] std::vector<Vector<Dim>> displacement(const Group& group, std::span<const Vector<Dim>> q) const;
    /// Their velocity at those of the points, while tractions and supports stay (n_faces) [m/s].
    [[nodiscard]] std::vector<Vector<Dim>> velocity(const Group& group, std::span<const Vector<Dim>> of_points) const;
    /// By how far they move from q_0 at `time` to q_1 at time + dt, while tractions stay (n_faces) [m].
    [[nodiscard]] std::vector<Vector<Dim>> motion(const Group& group, std::span<const Vector<Dim>> q_0,
                                                  std::span<const Vector<Dim>> q_1, double time, double dt) const;

    /// By how much `held` changes in q, from the loads at the start of the step to those at its end [J].
    [[nodiscard]] double held_change(std::span<const Vector<Dim>> q) const;
    /// As `held_change`, where temperatures change, and tractions not.
    [[nodiscard]] double held_change_of_heat(std::span<const Vector<Dim>> q) const;
    /// A change of the tractions between two steps has given the bodies this energy [J].
    void add_change(double energy) { work_.changes += energy; }
    /// A change of the temperatures has changed V by so much, and what V has less for these tractions, as faces move [J].
    void add_heat(double change, double held_change) {
        work_.heat += change;
        work_.steps += held_change;
    }
    /// A step from q_0 to q_1; `turn_of(body)`: the mean of its rotations at both ends.
    void add_step(std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1, const TurnOf<Dim>& turn_of);
    [[nodiscard]] OutsideWork work(std::span<const Vector<Dim>> q) const;

    void clear_work() { work_ = {}; }

    void save(StateWriter& state) const;  ///< between two steps
    void restore(StateReader& state);
    /// `old_faces`: of each face of the mesh its number in that of `before`.
    void take_over(const OutsideLoads& before, std::span<const std::int32_t> old_faces);

private:
    [[nodiscard]] Group& known_group(const std::string& name, std::span<const Vector<Dim>> traction);
    void require_same(const Group& group) const;
    void set_all(Group& group, std::span<const Vector<Dim>> of_all);
    [[nodiscard]] std::vector<Vector<Dim>> displacement_under(const Group& group, std::span<const Vector<Dim>> q,
                                                              const BoundaryLoad<Dim>& load) const;
    [[nodiscard]] std::vector<Vector<Dim>> motion_under(const Group& group, std::span<const Vector<Dim>> q_0,
                                                        std::span<const Vector<Dim>> q_1, const BoundaryLoad<Dim>& load_0,
                                                        const BoundaryLoad<Dim>& load_1) const;
    [[nodiscard]] double held(const Group& group, std::span<const Vector<Dim>> traction, std::span<const Vector<Dim>> q,
                              const BoundaryLoad<Dim>& load) const;
    [[nodiscard]] double area(const Group& group, std::size_t face) const;

    const Bodies<Dim>& bodies_;
    const RankPart<Dim>& part_;
    Ccg<Dim>& ccg_;
    const Loads<Dim>& loads_;
    PointTractions<Dim>& tractions_;
    std::vector<Group> groups_;
    OutsideWork work_;  // `held` is that of a state, and not kept
};

}  // namespace abut::solid
