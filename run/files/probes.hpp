#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "abut/base/vector.hpp"
#include "abut/mesh/mesh.hpp"
#include "abut/run/files/contact_forces.hpp"
#include "abut/run/values/forward.hpp"
#include "abut/run/values/outputs.hpp"

namespace abut::run {

/// The probes of a scene while it is run. A probe at a place takes the cell that holds it: the displacement is that of
/// the place itself, velocity and stress are those of the cell. That of a body takes the means over its volume; with
/// `Probe::contact` also the forces of contact on it, the mean since the look before, and its slip.
template <int Dim>
class Probes {
public:
    Probes() = default;
    /// Throws BadInput for a body that does not exist, and for a place that is beside its body, with the distance.
    Probes(const Scene<Dim>& scene, const RunResult<Dim>& result);

    /// "displacement_x" [m], "velocity_x" [m/s], "stress_xx" [Pa] and so on, "von_mises" [Pa]; in 2D stress_zz is that
    /// of plane strain. With `contact` also "contact_normal_x" and "friction_x" [N], which together are the force on
    /// the body, and "slip_velocity_x" [m/s], its velocity past what it touches with friction, 0 where nothing presses.
    [[nodiscard]] static std::vector<std::string> columns(const Probe<Dim>& probe);
    /// At the start, every `Outputs::interval` steps, and at the end.
    [[nodiscard]] bool wants_look(std::int64_t step) const;
    /// The columns of each probe. Called at each look, the start included: forces of contact are those since the last one.
    [[nodiscard]] std::vector<std::vector<double>> values(const Sight<Dim>& sight);
    /// Numbers that the cells have in the scene's mesh, of a run that some have left: means are those of cells that are
    /// there, and a place whose cell has left is at rest no more: all that is seen there is NaN.
    void take_cells(std::span<const std::int32_t> first_cells);
    /// Memory of a checkpoint.
    static auto fields(auto& self) { return std::tie(self.forces_); }

private:
    /// The cells that a probe looks at, and their shares.
    struct Watched {
        std::vector<std::int32_t> cells;
        std::vector<double> weights;
        std::vector<Vector<Dim>> arms;  // from the centroid of the cell to the place [m]
        std::int32_t contact_of = -1;   // the body whose contact is watched; -1: none
    };
    [[nodiscard]] static Watched watched(const mesh::Mesh<Dim>& mesh, const Probe<Dim>& probe);

    std::vector<Watched> at_start_;  // of the scene's mesh
    std::vector<Watched> probes_;
    ContactForces<Dim> forces_;  // since the last look
    std::int64_t interval_ = 1;
    std::int64_t n_steps_ = 0;
};

/// The cell of a body that holds a place at rest; of one that is beside all cells, but by no more than half the size of the
/// nearest, that one. Throws BadInput with the distance for a place that is farther.
template <int Dim>
[[nodiscard]] std::int32_t cell_at(const mesh::Mesh<Dim>& mesh, std::int32_t body, const Vector<Dim>& position);

}  // namespace abut::run
