#pragma once
// Private to the layer.
#include <cstdint>

#include "abut/base/vector.hpp"
#include "abut/run/values/body_sliding.hpp"
#include "abut/run/values/forward.hpp"

/// Figures of a node of a run that its accounts record (Accounts::record), beside those of the ledger.
namespace abut::run {

/// Largest speed of the points, on all ranks [m/s].
template <int Dim>
[[nodiscard]] double largest_speed(const dynamics::RunView<Dim>& run, const solid::Solid<Dim>& solid);

/// Momentum by gravity and by contact with obstacles so far [kg m/s].
template <int Dim>
[[nodiscard]] Vector<Dim> momentum_from_outside(double time, std::int32_t n_bodies, const solid::Solid<Dim>& solid);

/// Bodies that are pressed into each other deepest, so far, by more than ContactOptions::compression_warning.
template <int Dim>
[[nodiscard]] Compressed most_compressed(const Scene<Dim>& scene, const solid::Solid<Dim>& solid);

}  // namespace abut::run
