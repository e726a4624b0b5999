// What the ranks of a program hold of a mesh while it is made and shared out: bytes of operator new, counted. Run by mpirun.
#define CATCH_CONFIG_RUNNER
#include <atomic>
#include <catch2/catch.hpp>
#include <cstddef>
#include <cstdlib>
#include <new>
#include <string>

#include "abut/input/scene_file.hpp"
#include "abut/mesh/mesh_bytes.hpp"
#include "apps/support/rank_session.hpp"
#include "apps/support/scene_of_rank.hpp"

namespace {

std::atomic<std::size_t> n_bytes{0}, most_bytes{0};

/// The number of bytes stands in front of them.
void* counted(std::size_t size, std::size_t alignment) {
    auto* const memory =
        static_cast<std::byte*>(std::aligned_alloc(alignment, (size + 2 * alignment - 1) / alignment * alignment));
    if (!memory) throw std::bad_alloc();
    *reinterpret_cast<std::size_t*>(memory) = size;
    const std::size_t now = n_bytes += size;
    for (std::size_t most = most_bytes; most < now && !most_bytes.compare_exchange_weak(most, now);) continue;
    return memory + alignment;
}

void release(void* memory, std::size_t alignment) noexcept {
    if (!memory) return;
    auto* const begin = static_cast<std::byte*>(memory) - alignment;
    n_bytes -= *reinterpret_cast<std::size_t*>(begin);
    std::free(begin);
}

constexpr std::size_t usual = __STDCPP_DEFAULT_NEW_ALIGNMENT__;

}  // namespace

void* operator new(std::size_t size) { return counted(size, usual); }
void* operator new[](std::size_t size) { return counted(size, usual); }
void* operator new(std::size_t size, std::align_val_t to) { return counted(size, static_cast<std::size_t>(to)); }
void* operator new[](std::size_t size, std::align_val_t to) { return counted(size, static_cast<std::size_t>(to)); }
void operator delete(void* memory) noexcept { release(memory, usual); }
void operator delete[](void* memory) noexcept { release(memory, usual); }
void operator delete(void* memory, std::size_t) noexcept { release(memory, usual); }
void operator delete[](void* memory, std::size_t) noexcept { release(memory, usual); }
void operator delete(void* memory, std::align_val_t to) noexcept { release(memory, static_cast<std::size_t>(to)); }
void operator delete[](void* memory, std::align_val_t to) noexcept { release(memory, static_cast<std::size_t>(to)); }
void operator delete(void* memory, std::size_t, std::align_val_t to) noexcept {
    release(memory, static_cast<std::size_t>(to));
}
void operator delete[](void* memory, std::size_t, std::align_val_t to) noexcept {
    release(memory, static_cast<std::size_t>(to));
}

using namespace abut;

namespace {

/// Two bars of 32 x 10 x 10 cells per rank, end to end.
std::string bars(int n_ranks) {
    const auto body = [&](const std::string& name, int x) {
        return "[bodies." + name + "]\nshape = \"structured_box\"\nlower = [" + std::to_string(x * n_ranks) +
               ".01, 0, 0]\nupper = [" + std::to_string((x + 1) * n_ranks) + ", 1, 1]\ncounts = [" +
               std::to_string(32 * n_ranks) + ", 10, 10]\nyoung = 1\ndensity = 1\n";
    };
    return "dim = 3\n" + body("left", 0) + body("right", 1) + "[run]\nsteps = 2\n";
}

}  // namespace

TEST_CASE("ranks other than the first never hold the whole mesh, and the first never as much as 2.5 of it",
          "[ranks][memory]") {
    const ranks::Communicator& all = apps::rank_session()->all();
    const input::SceneFile file(input::SceneText{.toml = bars(all.size())});
    const std::size_t before = n_bytes;
    most_bytes = before;
    const run::Scene<3> scene = apps::scene_of_rank<3>([&](Answers& mesh) { return file.scene<3>(mesh); });
    const apps::SceneShare<3> share(scene.mesh, {});
    const auto most = static_cast<double>(most_bytes - before), now = static_cast<double>(n_bytes - before);
    const double whole = all.largest(static_cast<double>(mesh::bytes_of(scene.mesh).size()));

    // Copies of a bar are eight layers at each cut: a part has 64 layers of its own, and up to 80.
    const double part = static_cast<double>(mesh::bytes_of(share.get()->part).size());
    const bool is_first = all.rank() == 0;
    INFO(all.rank() << ": whole " << whole << ", part " << part << ", most " << most << ", now " << now);
    CHECK(all.largest(is_first ? 0.0 : now / part) < 1.5);
    CHECK(all.largest(is_first ? 0.0 : most / part) < 2.5);
    CHECK(all.largest(is_first ? 0.0 : most / whole) < 0.8);
    CHECK(all.largest(is_first ? most / whole : 0.0) < 2.5);
}

/// Ranks other than the first are silent: what they find wrong, the first says.
int main(int argc, char** argv) {
    const auto session = apps::join_ranks();
    return Catch::Session().run(argc, argv);
}
