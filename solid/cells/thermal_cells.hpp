#pragma once
// Private to the sources of this layer.
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "abut/mesh/mesh.hpp"
#include "abut/solid/cells/finite_cells.hpp"
#include "abut/solid/cells/temperature.hpp"
#include "abut/solid/material/material.hpp"

namespace abut::solid {

/// How warm cells are, and what that does where strains are linear: with the thermal strain a T per volume a cell stores
///
///     1/2 (eps - a T) : C : (eps - a T)
///
/// T being the rise of its temperature, constant in it, and a the tensor of ThermalExpansion. Cells of bodies of
/// Kinematics::finite have a ThermalStretch. docs/method.md, Temperature.
template <int Dim>
class ThermalCells {
public:
    /// None.
    ThermalCells() = default;
    /// One material and one field per body.
    ThermalCells(const mesh::Mesh<Dim>& mesh, std::span<const Material> materials,
                 std::span<const TemperatureRise<Dim>> temperature, const FiniteCells<Dim>& finite);

    [[nodiscard]] bool any() const { return !of_body_.empty(); }
    [[nodiscard]] bool varies() const;
    /// T of all cells at a time [K]. Throws BadInput where it is not finite, or strains by more than 0.1, of finite
    /// bodies 0.5.
    [[nodiscard]] std::vector<double> rise_at(double time) const;
    /// C : a of a cell, which stress is less by per kelvin [Pa/K].
    [[nodiscard]] const Matrix<Dim>& stress(std::ptrdiff_t cell) const { return of_cell(cell).stress; }
    /// In the plane: the same out of it.
    [[nodiscard]] double out_of_plane_stress(std::ptrdiff_t cell) const { return of_cell(cell).out_of_plane; }
    /// The terms of twice the energy that the rise of temperature is in [J/m^3].
    [[nodiscard]] double twice_energy(std::ptrdiff_t cell, double rise, const Matrix<Dim>& g) const {
        return rise * (rise * of_cell(cell).twice_energy - 2.0 * of_cell(cell).stress.cwiseProduct(g).sum());
    }

private:
    /// Per kelvin, and its square.
    struct OfBody {
        Matrix<Dim> stress = Matrix<Dim>::Zero();
        double out_of_plane = 0.0, twice_energy = 0.0;
        double strain = 0.0;  // largest along an axis
        bool is_finite = false;
        TemperatureRise<Dim> rise;
    };
    [[nodiscard]] const OfBody& of_cell(std::ptrdiff_t cell) const {
        return of_body_[static_cast<std::size_t>(body_[static_cast<std::size_t>(cell)])];
    }

    std::string mesh_name_;
    std::vector<OfBody> of_body_;
    std::vector<std::int32_t> body_;     // of each cell
    std::vector<std::int64_t> label_;    // of each cell, for people
    std::vector<Vector<Dim>> centroid_;  // of each cell
};

}  // namespace abut::solid
