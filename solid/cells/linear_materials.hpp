#pragma once
// Private to the sources of this layer.
#include <cstdint>
#include <span>

#include "abut/solid/cells/capped_jumps.hpp"
#include "abut/solid/cells/plastic_cells.hpp"
#include "abut/solid/cells/sweep_lists.hpp"
#include "abut/solid/cells/sweep_state.hpp"
#include "abut/solid/cells/thermal_cells.hpp"
#include "abut/solid/cells/viscous_cells.hpp"

namespace abut::solid {

/// Stresses that cells whose strains are linear have beside lambda and mu of their strain: directions, heat, flow,
/// damping, and jumps that last. In each sweep they add to what LinearPool and
/// SimplexPool have computed.
template <int Dim>
class LinearMaterials {
public:
    /// All must outlive it.
    LinearMaterials(SweepState<Dim, double>& state, ViscousCells<Dim>& viscous, PlasticCells<Dim>& plastic,
                    CappedJumps<Dim>& capped, const ThermalCells<Dim>& thermal)
        : state_(state), viscous_(viscous), plastic_(plastic), capped_(capped), thermal_(thermal) {}

    // A chunk

    /// Lets metal flow in the step, after gradients and before stresses: a jump depends on the flow of both cells.
    void let_flow(std::span<const Run> cells);
    /// Removes the lasting parts of jumps from what pushes the cells, after their stresses.
    void remove_lasting_jumps(std::span<const Run> cells);
    /// Adds the stresses of flow and damping, of directions and heat.
    void add_stresses(std::span<const Run> cells);

    // One cell in a state, not in a step

    void remove_lasting_jumps(std::int32_t c) {
        if (capped_.contains(c)) remove_jumps_of(c);
    }
    /// Adds the stresses of directions, heat and flow.
    void add_stress_of_state(std::int32_t c);
    /// sigma_c [Pa].
    [[nodiscard]] Matrix<Dim> stress(std::int32_t c) const;
    /// `elastic`, the CellPool::twice_energy_density of the cell, plus twice the energy density of directions, heat and
    /// flow [J/m^3].
    [[nodiscard]] double twice_energy_density(std::int32_t c, double elastic) const;
    /// [u] without its lasting part [m].
    [[nodiscard]] Lanes<Dim> elastic_jump(std::int32_t c, std::int32_t half_face) const {
        const Lanes<Dim> all = state_.jump(c, half_face);
        if (!capped_.contains(c)) return all;
        return load_packed<Dim>(capped_.at(half_face, unload(all), Matrix<Dim>::Zero()).jump);
    }
    [[nodiscard]] const PlasticCells<Dim>& metal() const { return plastic_; }
    /// Part that heat takes of the stress out of the plane, of any cell in it [Pa].
    [[nodiscard]] double heat_out_of_plane(std::int32_t c) const {
        return is_warm() ? rise_of(c) * thermal_.out_of_plane_stress(c) : 0.0;
    }

private:
    [[nodiscard]] bool is_warm() const { return !state_.temperature.empty(); }
    [[nodiscard]] double rise_of(std::int32_t c) const { return state_.temperature[static_cast<std::size_t>(c)]; }
    /// Whether a cell may have a stress of directions or heat.
    [[nodiscard]] bool has_stress_of_material() const { return state_.arrays.directed.any() || is_warm(); }
    [[nodiscard]] Matrix<Dim> stress_of_material(std::int32_t c, const Matrix<Dim>& g) const;
    void add_stress_of_material(std::int32_t c);

    [[nodiscard]] Matrix<Dim> elastic_stress_of_stage(std::int32_t c) const;
    void flow(std::int32_t c);
    void set_push_of_contact(std::int32_t c);
    void take_stress_of_flow(std::int32_t c);
    void add_stress_of_step(std::int32_t c);

    [[nodiscard]] Matrix<Dim> trace_change(std::int32_t c) const;
    [[nodiscard]] Vector<Dim> jump_change(std::int32_t c, std::int32_t half_face, const Matrix<Dim>& of_cell) const;
    [[nodiscard]] Vector<Dim> jump_of_flow(std::int32_t c, std::int32_t half_face) const;
    void remove_jumps_of(std::int32_t c);

    SweepState<Dim, double>& state_;
    ViscousCells<Dim>& viscous_;
    PlasticCells<Dim>& plastic_;
    CappedJumps<Dim>& capped_;
    const ThermalCells<Dim>& thermal_;
};

}  // namespace abut::solid
