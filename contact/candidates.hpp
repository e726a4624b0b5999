#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "abut/contact/options.hpp"
#include "abut/contact/surface.hpp"
#include "abut/geometry/broad_phase.hpp"

namespace abut::contact {

/// A box around every face: its corners at the displacements u_0 and u_1, grown by all that an active
/// pair can reach past its faces (2 d_f, the tilt against the pair normal) and by half the skin. docs/method.md, Contact.
template <int Dim>
[[nodiscard]] std::vector<geometry::Box<Dim>> swept_boxes(const SurfaceView<Dim>& surface, std::span<const Vector<Dim>> u_0,
                                                          std::span<const Vector<Dim>> u_1, double facing_cosine,
                                                          double skin);

/// Every pair of facing faces (face_1 < face_2) whose swept boxes overlap and whose gap and shift allow contact: a superset
/// of all pairs that can be active on the straight way from u_0 to u_1, and as long as no face has moved by more than half
/// the skin from u_0. Sorted. Rigid faces never pair with each other. The same list for every broad phase.
template <int Dim>
[[nodiscard]] std::vector<geometry::IndexPair> find_candidates(const SurfaceView<Dim>& surface,
                                                               std::span<const Vector<Dim>> u_0,
                                                               std::span<const Vector<Dim>> u_1,
                                                               const ContactOptions& options, double skin);

}  // namespace abut::contact
