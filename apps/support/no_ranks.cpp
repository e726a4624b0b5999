// Stands in for rank_session.cpp and the layer ranks where MPI or Zoltan was not there to build with: programs run
// alone, and refuse what asks for more.
#include "abut/base/error.hpp"
#include "apps/support/rank_session.hpp"

namespace abut {
namespace {

[[noreturn]] void refuse() {
    throw BadInput(
        "ranks: this build of Abut has no MPI, which --ranks and mpirun need. Leave them out, or install the packages "
        "libopenmpi-dev and libtrilinos-zoltan-dev (scripts/setup scripts/packages-ranks.txt) and build it again.");
}

}  // namespace

namespace ranks {

struct Communicator::Impl {};
Communicator::~Communicator() = default;
int Communicator::rank() const { refuse(); }
int Communicator::size() const { refuse(); }
void Communicator::agree(const std::exception_ptr&) const { refuse(); }
double Communicator::largest(double) const { refuse(); }
Session::~Session() = default;

}  // namespace ranks

namespace apps {

const ranks::Session* rank_session() { return nullptr; }
std::unique_ptr<ranks::Session> join_ranks() {
    if (ranks::is_launched()) refuse();
    return nullptr;
}
void leave_ranks(const std::string&) {}
void start_ranks(int n_ranks) {
    if (n_ranks > 1) refuse();
}
void refuse_ranks(const char*) {}
std::vector<std::byte> of_first_rank(std::vector<std::byte> bytes) { return bytes; }

template <int Dim>
struct SceneShare<Dim>::Part {};
template <int Dim>
SceneShare<Dim>::SceneShare(const mesh::Mesh<Dim>& mesh, std::vector<solid::Kinematics>) : mesh_(mesh) {}
template <int Dim>
SceneShare<Dim>::~SceneShare() = default;

template class SceneShare<2>;
template class SceneShare<3>;

}  // namespace apps
}  // namespace abut
