#include "abut/dynamics/ranks.hpp"

#include <string>

#include "abut/base/error.hpp"

namespace abut::dynamics {

void refuse_ranks(const Ranks* ranks, const char* what) {
    if (ranks)
        throw BadInput(std::string(what) +
                       ": not made for a run on several ranks yet. Run it on one, or leave it out; docs/ranks.md says what "
                       "there is.");
}

}  // namespace abut::dynamics
