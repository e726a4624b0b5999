#pragma once
#include <cstddef>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "abut/mesh/mesh.hpp"
#include "abut/ranks/session.hpp"
#include "abut/run/steps/share.hpp"
#include "abut/solid/options/options.hpp"

namespace abut::apps {

/// The ranks that this program is one of, from the first call on; null where it runs alone. Of all but rank 0 nothing
/// is seen: their standard output and standard error are closed.
[[nodiscard]] const ranks::Session* rank_session();
/// To be called once, at the start of the program; the ranks end with what it returns. Null where it runs alone.
[[nodiscard]] std::unique_ptr<ranks::Session> join_ranks();

/// To be called by a rank that ends with this error, which rank 0 has told of. Where the others wait for this rank in
/// vain it ends all of them, after 10 seconds or as many as ABUT_RANKS_PATIENCE says; a rank that nobody sees tells of
/// it first.
void leave_ranks(const std::string& error);

/// Starts the program again where it runs alone and is to have `n_ranks` > 1. Throws BadInput where mpirun has started
/// another number of them, or cannot be started, or Abut was built without MPI.
void start_ranks(int n_ranks);
/// Throws BadInput where there are several: `what` is done by one.
void refuse_ranks(const char* what);

/// Calls body() on all ranks, or where the program runs alone; throws on all of them what one throws.
template <class Body>
void on_all(const Body& body) {
    if (!rank_session()) return body();
    std::exception_ptr error;
    try {
        body();
    } catch (...) {
        error = std::current_exception();
    }
    rank_session()->all().agree(error);
}

/// The bytes of rank 0 on all ranks, or where the program runs alone. A call of all ranks.
[[nodiscard]] std::vector<std::byte> of_first_rank(std::vector<std::byte> bytes);

/// The share of this rank in a scene.
template <int Dim>
class SceneShare {
public:
    /// A call of all ranks; nothing is made where the program runs alone. Rank 0 has the mesh, which must outlive this, and
    /// sends each rank its part. Throws BadInput on all as solid::part_of and ranks::PointRanks.
    SceneShare(const mesh::Mesh<Dim>& mesh, std::vector<solid::Kinematics> kinematics);
    ~SceneShare();
    SceneShare(const SceneShare&) = delete;
    SceneShare& operator=(const SceneShare&) = delete;

    [[nodiscard]] const run::Share<Dim>* get() const { return share_ ? &*share_ : nullptr; }  ///< null: alone

private:
    struct Part;
    [[nodiscard]] run::Share<Dim> share_out(std::span<const double> weights);

    const mesh::Mesh<Dim>& mesh_;
    std::vector<solid::Kinematics> kinematics_;
    std::unique_ptr<Part> part_, part_before_;
    std::optional<run::Share<Dim>> share_;
};

}  // namespace abut::apps
