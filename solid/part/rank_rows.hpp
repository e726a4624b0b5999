#pragma once
// Private to the sources of this layer.
#include "abut/solid/ccg/ccg.hpp"
#include "abut/solid/part/rank_part.hpp"

namespace abut::solid {

/// Whether all ranks make the same operator: what the forces on own cells depend on has the faces and the rows that its
/// owners have, and nobody's face uses an own cell that does not use it here. Throws BadInput on all ranks where copies
/// do not reach far enough. A call of all ranks.
template <int Dim>
void check_rows_of_ranks(const RankPart<Dim>& part, const mesh::Mesh<Dim>& mesh, const Ccg<Dim>& ccg);

}  // namespace abut::solid
