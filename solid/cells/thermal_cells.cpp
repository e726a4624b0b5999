#include "abut/solid/cells/thermal_cells.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"
#include "abut/solid/material/orthotropic.hpp"

namespace abut::solid {
namespace {

/// Beyond it strains are not small; a coefficient that lacks its power of ten is far beyond.
constexpr double largest_linear_strain = 0.1;
/// Less than what would turn a cell inside out.
constexpr double largest_finite_strain = 0.5;

}  // namespace

template <int Dim>
ThermalCells<Dim>::ThermalCells(const mesh::Mesh<Dim>& mesh, std::span<const Material> materials,
                                std::span<const TemperatureRise<Dim>> temperature, const FiniteCells<Dim>& finite)
    : mesh_name_(mesh.name),
      body_(mesh.cell_body.begin(), mesh.cell_body.end()),
      label_(mesh.cell_label.begin(), mesh.cell_label.end()),
      centroid_(mesh.cell_centroid.begin(), mesh.cell_centroid.end()) {
    of_body_.resize(materials.size());
    for (std::size_t c = 0; c < body_.size(); ++c)
        if (finite.contains(static_cast<std::ptrdiff_t>(c))) of_body_[static_cast<std::size_t>(body_[c])].is_finite = true;
    for (std::size_t body = 0; body < materials.size(); ++body) {
        OfBody& of = of_body_[body];
        of.rise = temperature[body];
        if (!of.rise.value) continue;
        const Material& material = materials[body];
        of.strain = std::max({std::abs(material.expansion.along_1), std::abs(material.expansion.along_2),
                              std::abs(material.expansion.along_3)});
        if (of.is_finite) continue;
        const Matrix<3> strain = thermal_strain(materials[body]);
        const Matrix<3> stress = 2.0 * materials[body].mu() * strain +
                                 materials[body].lambda() * strain.trace() * Matrix<3>::Identity() +
                                 DirectedStiffness<3>(materials[body]).stress(strain);
        of.stress = stress.template topLeftCorner<Dim, Dim>();
        of.out_of_plane = stress(2, 2);
        of.twice_energy = stress.cwiseProduct(strain).sum();
    }
}

template <int Dim>
bool ThermalCells<Dim>::varies() const {
    return std::ranges::any_of(of_body_, [](const OfBody& of) { return of.rise.value && of.rise.varies; });
}

template <int Dim>
std::vector<double> ThermalCells<Dim>::rise_at(double time) const {
    std::vector<double> rise;
    for (std::size_t c = 0; c < body_.size(); ++c) {
        const OfBody& of = of_cell(static_cast<std::ptrdiff_t>(c));
        rise.push_back(of.rise.value ? of.rise.value(of.rise.varies ? time : 0.0, centroid_[c]) : 0.0);
        if (!std::isfinite(rise.back()))
            throw BadInput(mesh_name_ + ": the rise of the temperature of cell " + std::to_string(label_[c]) +
                               " is not finite. Correct SolidOptions::temperature_rise.",
                           {.cell = static_cast<std::int32_t>(c)});
        const double allowed = of.is_finite ? largest_finite_strain : largest_linear_strain;
        if (const double strain = of.strain * std::abs(rise.back()); strain > allowed)
            throw BadInput(mesh_name_ + ": cell " + std::to_string(label_[c]) + " is " + number(rise.back()) +
                               " K warmer at t = " + number(time) + " s, a thermal strain of " + number(strain) + "; " +
                               number(allowed) + " is allowed" + (of.is_finite ? "" : ", as strains are linear here") +
                               ". Correct SolidOptions::temperature_rise or the "
                               "thermal_expansion of its material, which is in 1/K.",
                           {.cell = static_cast<std::int32_t>(c), .value = strain, .allowed = allowed});
    }
    return rise;
}

template class ThermalCells<2>;
template class ThermalCells<3>;

}  // namespace abut::solid
