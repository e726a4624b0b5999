#pragma once
// Private to the sources of this layer.
#include <cstdint>
#include <span>
#include <vector>

#include "abut/dynamics/losses.hpp"
#include "abut/mesh/mesh.hpp"
#include "abut/solid/cells/cell_pool.hpp"
#include "abut/solid/cells/finite_cell.hpp"
#include "abut/solid/material/material.hpp"
#include "abut/solid/operator/directed_cells.hpp"

namespace abut::solid {

/// Forces of cells that depend on rates: Rayleigh's damping and the viscosity of shocks (Material). They act on the
/// mean of the rate of a step and of that of the step before, which cells remember: docs/method.md, Damping and
/// viscosity.
///
/// A step that has not ended leaves no trace. Functions of different cells may be called from several threads at once.
template <int Dim>
class ViscousCells {
public:
    /// One material per body.
    ViscousCells(const mesh::Mesh<Dim>& mesh, std::span<const Material> materials);
    ViscousCells(const ViscousCells&) = delete;
    ViscousCells& operator=(const ViscousCells&) = delete;

    /// Whether a body is damped, on any rank.
    [[nodiscard]] bool any() const { return any_; }
    [[nodiscard]] bool contains(std::ptrdiff_t cell) const { return any() && index_[static_cast<std::size_t>(cell)] >= 0; }
    /// Viscous stress (P) of a step in which F - I of a cell changes by `change` about the mean `g`, for small strains
    /// 0 [Pa]. `free`: the free faces of the cell, where `g` is of affine ones; null: it has none, or `g` knows where
    /// they are.
    [[nodiscard]] Matrix<Dim> stress(std::ptrdiff_t cell, const Matrix<Dim>& g, const Matrix<Dim>& change, double dt,
                                     const FreeCell<Dim>* free = nullptr);
    /// Force of Damping::mass on a cell of this mass that moves by `motion` in a step [N]. A cell that flies
    /// freely is slowed by exp(-alpha dt) in each step, to round-off.
    [[nodiscard]] Vector<Dim> drag(std::ptrdiff_t cell, double mass, const Vector<Dim>& motion, double dt);
    /// Energy that both have dissipated in the step.
    [[nodiscard]] dynamics::Losses loss(std::ptrdiff_t cell) const;
    /// The next step begins where this one ends.
    void end_step();
    /// The next step begins with rates of 0.
    void bring_to_rest();

    /// The largest Material::damping_ratio of a mode with this frequency [rad/s].
    [[nodiscard]] double damping_ratio(double omega) const;

    /// How many numbers a cell remembers.
    [[nodiscard]] std::int32_t memory_size(std::ptrdiff_t cell) const { return contains(cell) ? n_numbers : 0; }
    /// Writes them behind `values`.
    void put_memory(std::ptrdiff_t cell, std::vector<double>& values) const;
    void set_memory(std::ptrdiff_t cell, std::span<const double> values);
    /// Whether a cell remembers the same things as one of another mesh.
    [[nodiscard]] bool remembers_as(std::ptrdiff_t cell, const ViscousCells& other, std::ptrdiff_t other_cell) const {
        return contains(cell) == other.contains(other_cell);
    }

private:
    /// Rates that acted in a step.
    struct Rates {
        Matrix<Dim> strain = Matrix<Dim>::Zero();         // of Green's strain [1/s]
        double volume = 0.0;                              // [1/s]
        Vector<Dim> velocity = Vector<Dim>::Zero();       // [m/s]
        bool deforms_known = false, moves_known = false;  // whether there was a step
    };
    static constexpr std::int32_t n_numbers = Dim * Dim + Dim + 3;
    struct Cell {
        const Material* material;
        double measure, size;
        Rates before = {}, now = {};
        dynamics::Losses of_stress = {}, of_drag = {};
        double drag_step = 0.0, drag_rate = 0.0;  // (1 - exp(-alpha dt))/dt of the step dt [s, 1/s]
    };
    [[nodiscard]] Cell& at(std::ptrdiff_t cell) {
        return cells_[static_cast<std::size_t>(index_[static_cast<std::size_t>(cell)])];
    }
    [[nodiscard]] const Cell& at(std::ptrdiff_t cell) const {
        return cells_[static_cast<std::size_t>(index_[static_cast<std::size_t>(cell)])];
    }

    std::vector<Material> materials_;
    DirectedCells<Dim> directed_;
    bool any_ = false;                 // known from materials alone: this rank may have no cell of them
    std::vector<std::int32_t> index_;  // of each cell; empty where no body is damped
    std::vector<Cell> cells_;
};

static_assert(RememberingCells<ViscousCells<2>> && RememberingCells<ViscousCells<3>>);

}  // namespace abut::solid
