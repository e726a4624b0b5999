#pragma once
// Private to the sources of this layer.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "abut/mesh/mesh.hpp"
#include "abut/solid/material/orthotropic.hpp"

namespace abut::solid {

/// Cells of materials with directions: what their stiffness has beside lambda and mu, which the sweeps know by themselves.
template <int Dim>
class DirectedCells {
public:
    DirectedCells() = default;
    /// One material per body.
    DirectedCells(const mesh::Mesh<Dim>& mesh, std::span<const Material> materials) {
        if (std::ranges::all_of(materials, &Material::is_isotropic)) return;
        for (const Material& material : materials) of_body_.emplace_back(material);
        body_.assign(mesh.cell_body.begin(), mesh.cell_body.end());
    }

    /// Whether a body is of them, on any rank.
    [[nodiscard]] bool any() const { return !of_body_.empty(); }
    [[nodiscard]] bool contains(std::ptrdiff_t cell) const { return any() && (*this)[cell].any(); }
    /// Stiffness for a cell of any body, where there are any.
    [[nodiscard]] const DirectedStiffness<Dim>& operator[](std::ptrdiff_t cell) const {
        return of_body_[static_cast<std::size_t>(body_[static_cast<std::size_t>(cell)])];
    }

private:
    std::vector<DirectedStiffness<Dim>> of_body_;  // empty: all are isotropic
    std::vector<std::int32_t> body_;               // of each cell
};

}  // namespace abut::solid
