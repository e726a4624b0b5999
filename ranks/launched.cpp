// Without MPI, so that a program that is built without it can tell that mpirun has started it.
#include <array>
#include <cstdlib>

#include "abut/ranks/session.hpp"

namespace abut::ranks {

bool is_launched() {
    constexpr std::array names{"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK"};
    for (const char* name : names)
        if (std::getenv(name) != nullptr) return true;
    return false;
}

}  // namespace abut::ranks
