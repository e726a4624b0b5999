// Stands in for embree.cpp where Embree was not there to build with.
#include "abut/base/error.hpp"
#include "abut/geometry/broad_phase/backends.hpp"

namespace abut::geometry::backend {
namespace {

[[noreturn]] void refuse() {
    throw BadInput(
        "broad phase: this build of Abut has no Embree. Take packed_tree, which finds the same pairs, or build it where the "
        "package libembree-dev is installed.");
}

}  // namespace

const bool has_embree = false;

void find_by_embree(Boxes, Boxes, FoundPairs&) { refuse(); }
void find_by_embree(Boxes, FoundPairs&) { refuse(); }

}  // namespace abut::geometry::backend
