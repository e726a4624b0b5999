#pragma once
// Private to the sources of this layer.
#include <cstdint>
#include <span>

#include "abut/contact/step.hpp"
#include "abut/solid/operator/arrays.hpp"
#include "abut/solid/operator/operator_values.hpp"

namespace abut::solid {

/// See Ccg.
template <int Dim>
[[nodiscard]] Region<Dim> region_of_faces(const CcgArrays<Dim>& arrays, std::span<const BoundaryFace> faces);
template <int Dim>
[[nodiscard]] Region<Dim> region_of_tilted_faces(const CcgArrays<Dim>& arrays, std::span<const BoundaryFace> faces);
template <int Dim>
[[nodiscard]] Region<Dim> region_of_cells(const CcgArrays<Dim>& arrays, std::span<const std::int32_t> cells);

/// How face gradients answer to face displacements: Q_ff' among these boundary faces. docs/method.md, Time.
template <int Dim>
[[nodiscard]] contact::FaceCoupling<Dim> face_coupling(const CcgArrays<Dim>& arrays, std::span<const BoundaryFace> faces);

}  // namespace abut::solid
