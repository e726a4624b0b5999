#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "abut/base/vector.hpp"
#include "abut/ranks/communicator.hpp"
#include "abut/ranks/point_ranks.hpp"

namespace abut::ranks {

/// The rank of each point (n): as many to each, by recursive bisection of space (Zoltan's RCB), or as much weight. All ranks
/// give the same points and weights (n; empty: all 1), and get the same answer, always. A call of all ranks. Throws BadInput
/// on all for weights that are not finite and >= 0, or of another number, and where ranks give points of different numbers.
template <int Dim>
[[nodiscard]] std::vector<int> partition(const Communicator& communicator, std::span<const Vector<Dim>> points,
                                         std::span<const double> weights = {});

/// `partition` of points and weights that rank 0 alone has: it gets the answer, the others nothing. A call of all ranks.
template <int Dim>
[[nodiscard]] std::vector<int> partition_of_first(const Communicator& communicator, std::span<const Vector<Dim>> points,
                                                  std::span<const double> weights = {});

/// The points of a part as PointRanks takes them: their numbers among `n_points`, increasing, and their owners (n
/// each), of cells as mesh::MeshPart has them, or as solid::points_of gives them. The points of a rank are those that
/// it owns, `dimension` values each.
[[nodiscard]] SharedPoints shared_points(const Communicator& communicator, int dimension, std::int32_t n_points,
                                         std::span<const std::int32_t> number, std::span<const int> owner);

}  // namespace abut::ranks
