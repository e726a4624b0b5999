// Stands in for fcl.cpp where FCL was not there to build with.
#include "abut/base/error.hpp"
#include "abut/geometry/broad_phase/backends.hpp"

namespace abut::geometry::backend {
namespace {

[[noreturn]] void refuse() {
    throw BadInput(
        "broad phase: this build of Abut has no FCL. Take packed_tree, which finds the same pairs, or build it where the "
        "package libfcl-dev is installed.");
}

}  // namespace

const bool has_fcl = false;

void find_by_fcl(Boxes, Boxes, FoundPairs&) { refuse(); }
void find_by_fcl(Boxes, FoundPairs&) { refuse(); }

}  // namespace abut::geometry::backend
