#pragma once
// Private to the layer.
#include <cstddef>
#include <cstdint>
#include <span>

#include "abut/contact/contact.hpp"

namespace abut::contact {

struct NodalOptions;

/// Checks of a host's input. All throw BadInput; `check_path` throws Diverged where a value is not finite.
void check_options(const ContactOptions& options);
void check_options(const NodalOptions& options);
/// `has_shear_stiffness`: of the surface.
void check_friction(const FrictionOptions& friction, bool has_shear_stiffness);
/// `dt` [s] must be finite and > 0.
void check_step_length(double dt);
/// An array that should have one entry per listed face.
void check_listed(std::size_t size, std::size_t n_faces);
/// A coupling that is no second derivative of an energy would give a wrong force, or none. Linear in the number of blocks,
/// except that the block of a column is looked for in its row.
template <int Dim>
void check_coupling(const SurfaceView<Dim>& surface, std::span<const Face> faces, const FaceCoupling<Dim>& coupling);
template <int Dim>
void check_path(const SurfaceView<Dim>& surface, std::span<const Face> faces, const FacePath<Dim>& path);
/// One old number per face of the surface, out of `n_old`, each at most once; -1: it was not there.
void check_old_faces(std::span<const std::int32_t> old_face_of, std::int32_t n_faces, std::int32_t n_old);
template <int Dim>
void check_host_step(const SurfaceView<Dim>& surface, const HostStep<Dim>& host);

}  // namespace abut::contact
